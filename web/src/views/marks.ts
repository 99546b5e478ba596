// Finds places worth a look before printing: gaps, U-turns, and beads whose width is far from the spacing.
import type { Toolpath } from 'sillon';
import { findGaps } from './gaps.js';
import type { Mark } from '../model/view.js';

const mostMarks = 200;
const turnWithin = 1.5; // [spacings] length of path within which a U-turn turns round
// A path that turns by more within that length is a U-turn [radians].
const turnFrom = (120 * Math.PI) / 180;
const narrow = 0.55; // [spacings]
const wide = 1.6;
const oneEach = 3; // [spacings] distance within which two marks of a kind count as one

interface Found extends Mark {
  /** Badness of the place; the worst places are kept. */
  weight: number;
}

/** Returns at most 200 marks: widened places and gaps first, then
 * the worst of the others, no two of a kind within three spacings. */
export function findMarks(toolpath: Toolpath): Mark[] {
  const { cycles, spacing } = toolpath;
  const kept = new Sparse(oneEach * spacing);
  const found: Found[] = [];
  for (const { points, widths } of cycles) {
    findTurns(points, spacing, found);
    for (let k = 0; k < widths.length; ++k) {
      const ratio = (widths[k] as number) / spacing;
      const place = { x: points[2 * k] as number, y: points[2 * k + 1] as number };
      if (ratio < narrow) found.push({ ...place, kind: 'narrow', weight: narrow / Math.max(ratio, 1e-3) });
      else if (ratio > wide) found.push({ ...place, kind: 'wide', weight: ratio / wide });
    }
  }
  found.sort((a, b) => b.weight - a.weight);
  const widened = (toolpath.shape.kept ?? []).slice(0, mostMarks / 4);
  const marks: Mark[] = widened.map(([x, y]) => ({ x, y, kind: 'kept' }));
  const gaps = findGaps(toolpath, mostMarks / 2).filter(({ kind, x, y }) => kept.add(kind, x, y));
  marks.push(...gaps);
  for (const { x, y, kind } of found) {
    if (marks.length === mostMarks) break;
    if (kept.add(kind, x, y)) marks.push({ x, y, kind });
  }
  return marks;
}

/** Finds U-turns: turning angles are summed over a window that slides along the path. */
function findTurns(points: Float32Array, spacing: number, found: Found[]): void {
  const count = points.length / 2;
  if (count < 4) return;
  const lengths = new Float32Array(count);
  const turns = new Float32Array(count); // turn at the beginning of each segment [radians]
  let before: number | undefined;
  for (let round = 0; round < 2; ++round) {
    for (let k = 0; k < count; ++k) {
      const j = (k + 1) % count;
      const dx = (points[2 * j] as number) - (points[2 * k] as number);
      const dy = (points[2 * j + 1] as number) - (points[2 * k + 1] as number);
      lengths[k] = Math.hypot(dx, dy);
      if (lengths[k] === 0) continue;
      const angle = Math.atan2(dy, dx);
      if (before !== undefined) turns[k] = Math.atan2(Math.sin(angle - before), Math.cos(angle - before));
      before = angle;
      if (round === 1) break; // the first segment's turn needed the last segment's direction
    }
  }
  const window = turnWithin * spacing;
  let last = 0;
  let length = 0;
  let turned = turns[0] as number;
  for (let first = 0; first < count; ++first) {
    while (length < window && last - first < count - 1) {
      length += lengths[last % count] as number;
      ++last;
      turned += turns[last % count] as number;
    }
    if (Math.abs(turned) > turnFrom) {
      const middle = Math.round((first + last) / 2) % count;
      const [x, y] = [points[2 * middle] as number, points[2 * middle + 1] as number];
      found.push({ x, y, kind: 'turn', weight: Math.abs(turned) / Math.PI });
    }
    length -= lengths[first] as number;
    turned -= turns[first] as number;
  }
}

/** Keeps places of a kind at least a distance apart, by a grid of cells. */
class Sparse {
  readonly #cells = new Map<string, [number, number][]>();

  constructor(private readonly distance: number) {}

  /** Adds a place unless another of its kind is too near. @returns true if it was added */
  add(kind: string, x: number, y: number): boolean {
    const [column, row] = [Math.floor(x / this.distance), Math.floor(y / this.distance)];
    const key = (dx: number, dy: number): string => `${kind} ${column + dx} ${row + dy}`;
    for (let dy = -1; dy <= 1; ++dy) {
      for (let dx = -1; dx <= 1; ++dx) {
        const near = this.#cells.get(key(dx, dy)) ?? [];
        if (near.some(([px, py]) => Math.hypot(px - x, py - y) < this.distance)) return false;
      }
    }
    const own = this.#cells.get(key(0, 0)) ?? [];
    own.push([x, y]);
    this.#cells.set(key(0, 0), own);
    return true;
  }
}
