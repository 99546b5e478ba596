// Lines of the page and of other layers that a layer which is moved comes to lie on.
import type { Bounds, Point } from './layer-frame.js';

/** A line across the page: where `axis` 0 is upright, at this x; else level, at this y [mm]. */
export interface Guide {
  axis: 0 | 1;
  at: number;
}

const near = 1e-6;

/** A layer that is moved has an outline and a middle: edges snap to the page's edges and middle lines, its middle to the page's middle
 * and to those of others.
 * @param within  farther away nothing happens [mm]
 * @returns how far it goes, and the lines that it then lies on */
export function snapped(
  { low, high }: Bounds,
  page: Point,
  middles: readonly Point[],
  within: number,
): { by: [number, number]; guides: Guide[] } {
  const by: [number, number] = [0, 0];
  const guides: Guide[] = [];
  for (const axis of [0, 1] as const) {
    const [first, last] = [low[axis], high[axis]];
    const half = page[axis] / 2;
    const pairs = [
      ...[half, ...middles.map((middle) => middle[axis])].map((line) => [line, (first + last) / 2] as const),
      ...[0, half, page[axis]].flatMap((line) => [[line, first] as const, [line, last] as const]),
    ];
    const away = pairs.map(([line, own]) => line - own);
    const best = away.reduce((least, one) => (Math.abs(one) < Math.abs(least) - near ? one : least), Infinity);
    if (!(Math.abs(best) <= within)) continue;
    by[axis] = best;
    const lines = pairs.filter((_, k) => Math.abs((away[k] as number) - best) <= near).map(([line]) => line);
    for (const at of new Set(lines)) guides.push({ axis, at });
  }
  return { by, guides };
}
