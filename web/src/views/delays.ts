// Waits of beads for their neighbours, as a colour.
import type { Toolpath } from 'sillon';

/** A toolpath in short pieces, with the delay at each of its points [s]. */
export interface Delayed {
  toolpath: Toolpath;
  /** One array per cycle, one value per point. */
  delays: Float32Array[];
}

/** Neighbours’ middles lie between these distances to a side [spacings]: a little wider than in core’s measure, as points lie apart. */
const nearest = 0.5;
const farthest = 1.45;

/**
 * Times between a bead and its neighbour, on the worse of its two sides, if all beads are laid at one speed.
 * @param speed  of the beads [mm/s]
 */
export function delaysOf({ cycles, ...rest }: Toolpath, speed: number): Delayed {
  const { spacing } = rest;
  const pieces = cycles.map((cycle) => inPieces(cycle, spacing));
  const cells = new Map<number, number[]>(); // x, y and time of points, by cells one reach wide
  const cellAt = (x: number, y: number): number =>
    Math.floor(y / (farthest * spacing)) * 1e6 + Math.floor(x / (farthest * spacing));
  let time = 0;
  const times = pieces.map(({ points, widths }) =>
    widths.map((_, k) => {
      const [x, y] = [points[2 * k] ?? 0, points[2 * k + 1] ?? 0];
      const at = time;
      const cell = cellAt(x, y);
      const there = cells.get(cell);
      if (there === undefined) cells.set(cell, [x, y, at]);
      else there.push(x, y, at);
      const next = (k + 1) % widths.length;
      time += Math.hypot((points[2 * next] ?? 0) - x, (points[2 * next + 1] ?? 0) - y) / speed;
      return at;
    }),
  );
  const delays = pieces.map(({ points, widths }, cycle) =>
    widths.map((_, k) => {
      const [x, y] = [points[2 * k] ?? 0, points[2 * k + 1] ?? 0];
      const [before, after] = [(k + widths.length - 1) % widths.length, (k + 1) % widths.length];
      const along = [
        (points[2 * after] ?? 0) - (points[2 * before] ?? 0),
        (points[2 * after + 1] ?? 0) - (points[2 * before + 1] ?? 0),
      ];
      const length = Math.hypot(along[0] ?? 0, along[1] ?? 0) || 1;
      const [alongX, alongY] = [(along[0] ?? 0) / length, (along[1] ?? 0) / length];
      const now = times[cycle]?.[k] ?? 0;
      const sides: [number, number] = [Infinity, Infinity];
      for (let row = -1; row <= 1; ++row) {
        for (let column = -1; column <= 1; ++column) {
          const there = cells.get(cellAt(x, y) + row * 1e6 + column) ?? [];
          for (let i = 0; i < there.length; i += 3) {
            const [dx, dy] = [(there[i] ?? 0) - x, (there[i + 1] ?? 0) - y];
            if (Math.abs(dx * alongX + dy * alongY) > 0.75 * spacing) continue;
            const across = alongX * dy - alongY * dx;
            if (Math.abs(across) < nearest * spacing || Math.abs(across) > farthest * spacing) continue;
            const side = across > 0 ? 0 : 1;
            sides[side] = Math.min(sides[side], Math.abs((there[i + 2] ?? 0) - now));
          }
        }
      }
      return Math.max(...sides.filter((delay) => delay < Infinity), 0);
    }),
  );
  return { toolpath: { ...rest, cycles: pieces }, delays };
}

type Cycle = Toolpath['cycles'][number];

/** The same cycle with a point at least every spacing. */
function inPieces({ points, widths }: Cycle, spacing: number): Cycle {
  const places: number[] = [];
  const wide: number[] = [];
  widths.forEach((width, k) => {
    const next = (k + 1) % widths.length;
    const [x, y] = [points[2 * k] ?? 0, points[2 * k + 1] ?? 0];
    const [dx, dy] = [(points[2 * next] ?? 0) - x, (points[2 * next + 1] ?? 0) - y];
    const parts = Math.max(1, Math.ceil(Math.hypot(dx, dy) / spacing));
    for (let part = 0; part < parts; ++part) {
      places.push(x + (dx * part) / parts, y + (dy * part) / parts);
      wide.push(width + (((widths[next] ?? 0) - width) * part) / parts);
    }
  });
  return { points: Float32Array.from(places), widths: Float32Array.from(wide) };
}
