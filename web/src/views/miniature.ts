// Draws a plate as a small picture under its own lamp, from its beads and without a graphics card: for lists.
import type { Toolpath } from 'sillon';
import { tonesOf } from './lit.js';
import type { Look } from './look.js';
import { strokeBeads } from './strokes-of-beads.js';

/** Draws a square WebP picture of a plate. @param side  [pixels] */
export async function miniature(toolpath: Toolpath, look: Look, side: number): Promise<Blob> {
  const { page } = toolpath.shape;
  const scale = (side - 4) / Math.max(page[0], page[1]);
  const canvas = new OffscreenCanvas(side, side);
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('no canvas');
  context.setTransform(scale, 0, 0, -scale, (side - page[0] * scale) / 2, (side + page[1] * scale) / 2);
  strokeBeads(context, toolpath, scale, tonesOf(look));
  return canvas.convertToBlob({ type: 'image/webp', quality: 0.85 });
}
