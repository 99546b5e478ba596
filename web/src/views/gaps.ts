// Finds the places of a shape that stay empty: between beads, and where the shape is too narrow for one.
import type { Shape, Toolpath } from 'sillon';
import type { Mark } from '../model/view.js';

const cellsPerSpacing = 3;
const mostCells = 4_000_000;
/** Reach of a bead beyond its own width [cells], so that joints between neighbours do not count as gaps. */
const slack = 0.75;
const smallest = { gap: 0.12, lost: 0.9 }; // [spacings²] least areas of a mark, by kind

interface Found extends Mark {
  area: number;
}

/** Returns marks `gap` and `lost`, the largest first. Places below an eighth of a square spacing are left out. */
export function findGaps({ shape, cycles, spacing }: Toolpath, most: number): Mark[] {
  const [width, height] = shape.page;
  const cell = Math.max(spacing / cellsPerSpacing, Math.sqrt((width * height) / mostCells));
  const columns = Math.max(1, Math.ceil(width / cell));
  const rows = Math.max(1, Math.ceil(height / cell));
  const empty = insideOf(shape, columns, rows, cell);
  for (const { points, widths } of cycles) coverPath(empty, columns, rows, cell, points, widths);
  const found = clusters(empty, columns, rows, cell, spacing);
  found.sort((a, b) => b.area - a.area);
  return found.slice(0, most).map(({ x, y, kind }) => ({ x, y, kind }));
}

/** Returns 1 for each cell whose middle is inside the shape. */
function insideOf({ paths }: Shape, columns: number, rows: number, cell: number): Uint8Array {
  const inside = new Uint8Array(columns * rows);
  for (const { rings, fillRule } of paths) {
    // Crossings of edges with the middle of each row: x, and the way the edge goes.
    const crossings: [number, number][][] = Array.from({ length: rows }, () => []);
    for (const ring of rings) {
      const count = ring.length / 2;
      for (let k = 0; k < count; ++k) {
        const j = (k + 1) % count;
        const [ax, ay] = [ring[2 * k] as number, ring[2 * k + 1] as number];
        const [bx, by] = [ring[2 * j] as number, ring[2 * j + 1] as number];
        const from = Math.max(0, Math.ceil(Math.min(ay, by) / cell - 0.5));
        const to = Math.min(rows - 1, Math.ceil(Math.max(ay, by) / cell - 0.5) - 1);
        for (let row = from; row <= to; ++row) {
          const y = (row + 0.5) * cell;
          crossings[row]?.push([ax + ((bx - ax) * (y - ay)) / (by - ay), by > ay ? 1 : -1]);
        }
      }
    }
    for (const [row, line] of crossings.entries()) {
      line.sort((a, b) => a[0] - b[0]);
      let winding = 0;
      for (const [k, [x, way]] of line.entries()) {
        winding += fillRule === 'evenodd' ? (winding === 0 ? 1 : -1) : way;
        const next = line[k + 1];
        if (winding === 0 || next === undefined) continue;
        const from = Math.max(0, Math.ceil(x / cell - 0.5));
        const to = Math.min(columns, Math.ceil(next[0] / cell - 0.5));
        if (to > from) inside.fill(1, row * columns + from, row * columns + to);
      }
    }
  }
  return inside;
}

/** Clears the cells under a closed path of beads. */
function coverPath(
  empty: Uint8Array,
  columns: number,
  rows: number,
  cell: number,
  points: Float32Array,
  widths: Float32Array,
): void {
  const count = widths.length;
  for (let k = 0; k < count; ++k) {
    const j = (k + 1) % count;
    const [ax, ay] = [points[2 * k] as number, points[2 * k + 1] as number];
    const [dx, dy] = [(points[2 * j] as number) - ax, (points[2 * j + 1] as number) - ay];
    const steps = Math.max(1, Math.ceil(Math.hypot(dx, dy) / cell));
    const [from, to] = [widths[k] as number, widths[j] as number];
    for (let step = 0; step < steps; ++step) {
      const t = step / steps;
      const reach = (from + (to - from) * t) / 2 / cell + slack;
      const [x, y] = [(ax + dx * t) / cell, (ay + dy * t) / cell];
      const bottom = Math.max(0, Math.ceil(y - reach - 0.5));
      const top = Math.min(rows - 1, Math.floor(y + reach - 0.5));
      for (let row = bottom; row <= top; ++row) {
        const half = Math.sqrt(Math.max(0, reach * reach - (row + 0.5 - y) ** 2));
        const left = Math.max(0, Math.ceil(x - half - 0.5));
        const right = Math.min(columns, Math.floor(x + half - 0.5) + 1);
        if (right > left) empty.fill(0, row * columns + left, row * columns + right);
      }
    }
  }
}

/** Joins empty cells that touch each other into one mark each, and clears them (flood fill). */
function clusters(empty: Uint8Array, columns: number, rows: number, cell: number, spacing: number): Found[] {
  const found: Found[] = [];
  const waiting: number[] = [];
  for (let start = empty.indexOf(1); start >= 0; start = empty.indexOf(1, start + 1)) {
    let [count, sumX, sumY] = [0, 0, 0];
    empty[start] = 0;
    waiting.push(start);
    for (let at = waiting.pop(); at !== undefined; at = waiting.pop()) {
      const [column, row] = [at % columns, Math.floor(at / columns)];
      ++count;
      sumX += column + 0.5;
      sumY += row + 0.5;
      const near = [
        column > 0 ? at - 1 : -1,
        column + 1 < columns ? at + 1 : -1,
        row > 0 ? at - columns : -1,
        row + 1 < rows ? at + columns : -1,
      ];
      for (const next of near) {
        if (next < 0 || empty[next] !== 1) continue;
        empty[next] = 0;
        waiting.push(next);
      }
    }
    const area = count * (cell / spacing) ** 2;
    if (area < smallest.gap) continue;
    const kind = area < smallest.lost ? 'gap' : 'lost';
    found.push({ x: (sumX / count) * cell, y: (sumY / count) * cell, kind, area });
  }
  return found;
}
