// A plate as a small picture under its own lamp, drawn from its beads without a graphics card: for lists.
import type { Toolpath } from 'sillon';
import type { Light } from '../model/view.js';

const tones = 24;

/** How bright a bead is that runs at `angle` under the light, 0..1: brightest across it. @param angle  [radians] */
export const shine = (angle: number, { azimuth }: Light): number => {
  const across = Math.sin(angle - (azimuth * Math.PI) / 180);
  return 0.16 + 0.84 * across ** 4;
};

/** A filament's colour so brightly lit: beyond its own it goes to white, as a gloss does. @param bright  0..1 */
export function litColour(
  colour: readonly [number, number, number],
  bright: number,
): readonly [number, number, number] {
  const channel = (one: number): number => {
    const lit = one * Math.min(1, 0.12 + 1.25 * bright);
    return Math.round(lit + (255 - lit) * 0.55 * Math.max(0, bright - 0.55));
  };
  return [channel(colour[0]), channel(colour[1]), channel(colour[2])];
}

/** @param colour  sRGB 0..255 @param side  of the square picture [pixels] */
export async function miniature(
  { shape: { page }, cycles }: Pick<Toolpath, 'shape' | 'cycles'>,
  colour: readonly [number, number, number],
  light: Light,
  side: number,
): Promise<Blob> {
  const scale = (side - 4) / Math.max(page[0], page[1]);
  const [left, top] = [(side - page[0] * scale) / 2, (side + page[1] * scale) / 2];
  const canvas = new OffscreenCanvas(side, side);
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('no canvas');
  // One path for each tone: few calls, whatever the number of beads.
  const paths = Array.from({ length: tones }, () => new Path2D());
  let wide = 0;
  let count = 0;
  for (const { points, widths } of cycles) {
    let [x, y] = [points[0] ?? 0, points[1] ?? 0];
    for (let k = 2; k + 1 < points.length; k += 2) {
      const [nx, ny] = [points[k] as number, points[k + 1] as number];
      // Shorter than a pixel: the next point will do.
      if (Math.hypot(nx - x, ny - y) * scale < 0.7 && k + 3 < points.length) continue;
      const tone = Math.min(tones - 1, Math.floor(shine(Math.atan2(ny - y, nx - x), light) * tones));
      const path = paths[tone] as Path2D;
      path.moveTo(left + x * scale, top - y * scale);
      path.lineTo(left + nx * scale, top - ny * scale);
      [x, y] = [nx, ny];
    }
    for (const width of widths) wide += width;
    count += widths.length;
  }
  context.lineWidth = Math.max(0.9, (1.15 * scale * wide) / Math.max(1, count));
  context.lineCap = 'round';
  for (const [k, path] of paths.entries()) {
    context.strokeStyle = `rgb(${litColour(colour, (k + 0.5) / tones).join(' ')})`;
    context.stroke(path);
  }
  return canvas.convertToBlob({ type: 'image/webp', quality: 0.85 });
}
