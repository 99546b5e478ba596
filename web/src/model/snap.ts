// Snaps a layer that is moved or resized to lines of the page and of other layers.
import type { Bounds, Point } from './layer-frame.js';

/** A line across the page: upright at x = `at` where `axis` is 0, otherwise level at y = `at` [mm]. */
export interface Guide {
  axis: 0 | 1;
  at: number;
}

const near = 1e-6;

/** Edges and middle line of a page side. */
const linesOf = (length: number): number[] => [0, length / 2, length];

/** The offset with the smallest absolute value; Infinity where there are none. */
const leastOf = (ways: readonly number[]): number =>
  ways.reduce((least, one) => (Math.abs(one) < Math.abs(least) - near ? one : least), Infinity);

/** Snaps a layer that is moved: its edges to the page's edges and middle lines, its middle to the page's middle and to
 * the middles of other layers.
 * @param within  greatest distance that snaps [mm]
 * @returns the offset to add, and the lines that the layer then lies on */
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
      ...linesOf(page[axis]).flatMap((line) => [[line, first] as const, [line, last] as const]),
    ];
    const away = pairs.map(([line, own]) => line - own);
    const best = leastOf(away);
    if (!(Math.abs(best) <= within)) continue;
    by[axis] = best;
    const lines = pairs.filter((_, k) => Math.abs((away[k] as number) - best) <= near).map(([line]) => line);
    for (const at of new Set(lines)) guides.push({ axis, at });
  }
  return { by, guides };
}

/** Snaps the corner of a layer that is resized to the page's edges and middle lines.
 * @param fixed  the opposite corner, where the proportions are kept: the corner then moves only straight away from it
 * or towards it
 * @param within  greatest distance that snaps [mm] */
export function cornerSnapped(
  corner: Point,
  page: Point,
  fixed: Point | undefined,
  within: number,
): { corner: Point; guides: Guide[] } {
  const lines = ([0, 1] as const).flatMap((axis) => linesOf(page[axis]).map((at): Guide => ({ axis, at })));
  const step = (ways: readonly number[]): number => {
    const least = leastOf(ways);
    return Math.abs(least) <= within ? least : 0;
  };
  let [x, y] = corner;
  if (fixed === undefined) {
    x += step(linesOf(page[0]).map((at) => at - x));
    y += step(linesOf(page[1]).map((at) => at - y));
  } else {
    const span: Point = [x - fixed[0], y - fixed[1]];
    const length = Math.hypot(...span);
    const share = step(lines.map(({ axis, at }) => (length * (at - corner[axis])) / span[axis])) / length;
    x += share * span[0];
    y += share * span[1];
  }
  return { corner: [x, y], guides: lines.filter(({ axis, at }) => Math.abs(at - (axis === 0 ? x : y)) <= near) };
}
