// Strokes of a hand on a sliced print: told on the bed, drawn on the page that a view shows.
import type { Stroke } from 'sillon';
import type { HandBrush } from '../model/rebrush.js';
import { usualRadius, type DrawnStroke } from '../views/print-drawing.js';

type Corner = readonly [number, number];

const moved = (points: readonly number[], [dx, dy]: Corner): number[] =>
  points.map((value, k) => value + (k % 2 === 0 ? dx : dy));

export const draws = (brush: HandBrush | undefined): boolean => brush !== undefined && brush.tool !== 'pan';

/** @param points  on the page [mm]. @param corner  of the page, on the bed [mm]. @returns undefined: it draws nothing */
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

/** What is not beads yet. @param points  of the stroke that is being drawn, on the page */
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
