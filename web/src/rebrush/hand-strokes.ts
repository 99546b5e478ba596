// Strokes on a sliced print: stored relative to the bed, drawn on the page of a view.
import type { Stroke } from 'sillon';
import type { HandBrush } from '../model/rebrush.js';
import { usualRadius, type DrawnStroke } from '../views/print-drawing.js';

type Corner = readonly [number, number];

const moved = (points: readonly number[], [dx, dy]: Corner): number[] =>
  points.map((value, k) => value + (k % 2 === 0 ? dx : dy));

export const draws = (brush: HandBrush | undefined): boolean => brush !== undefined && brush.tool !== 'pan';

/** Returns a stroke on the bed.
 * @param points  points on the page [mm]
 * @param corner  corner of the page on the bed [mm]
 * @returns undefined if the brush draws nothing */
export function strokeOf(brush: HandBrush, points: readonly number[], corner: Corner): Stroke | undefined {
  if (brush.tool === 'pan' || points.length === 0) return undefined;
  return {
    tool: brush.tool,
    points: moved(points, corner),
    radius: brush.across / 2,
    soft: brush.soft,
    ...(brush.tool === 'mode' ? { mode: brush.mode } : {}),
  };
}

/** Returns the strokes that have no beads yet, on the page. @param points  the stroke being drawn, on the page */
export function strokesOnPage(
  strokes: readonly Stroke[],
  corner: Corner,
  points: readonly number[] | undefined,
  brush: HandBrush,
): DrawnStroke[] {
  const shown = strokes.map((stroke) => ({
    points: moved(stroke.points, [-corner[0], -corner[1]]),
    radius: stroke.radius ?? usualRadius,
  }));
  return points === undefined ? shown : [...shown, { points, radius: brush.across / 2 }];
}
