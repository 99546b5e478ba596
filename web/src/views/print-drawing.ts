// Draws a sliced print on flat canvases: its relief, the outlines of its faces, and strokes.
import type { PrintRelief } from 'sillon';
import type { Outline } from './print-page.js';
import { addLine } from './print-page.js';
import { shadedRelief } from './relief.js';

const fewFaces = 60; // most faces whose outlines glow: glow is slow to draw

/** Radius of strokes that name none [mm], as in the core. */
export const usualRadius = 4;

export interface DrawnStroke {
  points: readonly number[];
  /** Radius [mm]. */
  radius: number;
}

/** Returns the sRGB colour of the plastic of the slicer's beads. */
export const bodyOf = (dark: boolean): [number, number, number] => (dark ? [128, 134, 140] : [206, 204, 198]);

/** Draws the relief of a print as a picture, one pixel per cell. */
export function reliefPicture(relief: PrintRelief, dark: boolean): OffscreenCanvas {
  const picture = new OffscreenCanvas(relief.columns, relief.rows);
  const pixels = shadedRelief(relief, bodyOf(dark));
  picture.getContext('2d')?.putImageData(new ImageData(pixels, relief.columns, relief.rows), 0, 0);
  return picture;
}

export interface Outlined {
  outlines: readonly Outline[];
  chosen: ReadonlySet<number>;
  /** Faces that have new beads. */
  laid: { has(index: number): boolean };
  /** Faces under the pointer. */
  pointed: readonly (number | undefined)[];
  accent: string;
  soft: string;
}

type Context = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

/** Draws the outlines of faces; chosen faces are solid, the others are dashed.
 * @param context  transformed to millimetres of the page
 * @param pixel  size of a CSS pixel [mm]
 * @param ratio  device pixels per CSS pixel: shadows ignore the transformation */
export function drawOutlines(context: Context, of: Outlined, pixel: number, ratio: number): void {
  const glows = of.outlines.length <= fewFaces;
  for (const { index, parts, seen } of of.outlines) {
    const chosen = of.chosen.has(index);
    const pointed = of.pointed.includes(index);
    context.strokeStyle = chosen ? of.accent : of.soft;
    context.fillStyle = of.accent;
    context.lineWidth = (pointed ? 3 : chosen ? 1.75 : 1.25) * pixel;
    context.setLineDash(chosen ? [] : [4 * pixel, 4 * pixel]);
    context.shadowColor = chosen && glows ? of.accent : 'transparent';
    context.shadowBlur = 12 * ratio;
    for (const { path, rule } of parts) {
      context.globalAlpha = chosen && !of.laid.has(index) ? 0.3 : pointed ? 0.12 : 0;
      if (context.globalAlpha > 0) context.fill(path, rule);
    }
    context.globalAlpha = 1;
    context.stroke(seen);
  }
  context.shadowColor = 'transparent';
  context.setLineDash([]);
}

/** Draws strokes as wide translucent lines. @param context  transformed to millimetres of the page */
export function drawStrokes(context: Context, strokes: readonly DrawnStroke[], colour: string): void {
  context.lineCap = 'round';
  context.lineJoin = 'round';
  context.strokeStyle = colour;
  context.globalAlpha = 0.35;
  for (const { points, radius } of strokes) {
    const path = new Path2D();
    addLine(path, points);
    if (points.length === 2) addLine(path, [...points, ...points]);
    context.lineWidth = 2 * radius;
    context.stroke(path);
  }
  context.globalAlpha = 1;
}
