// Draws a plate as a thumbnail from its directions alone, before
// there are beads: each choice shows its result this way.
import type { DirectionRaster } from '../model/raster.js';
import type { Rgb } from './lit.js';

/** Cells of the page that are inside the shape: rows from the top, 1 inside. */
interface Mask {
  width: number;
  height: number;
  inside: Uint8Array;
}

/** Longer side of a thumbnail [pixels]. */
export const thumbnailSide = 96;

/** Returns the brightness of each texel of a raster. @param
 * lightOf  brightness of a direction, given as a unit vector */
export function brightnessOf(
  { width, height, angle }: DirectionRaster,
  lightOf: (alongX: number, alongY: number) => number,
): Float32Array {
  const known = new Map<number, number>();
  return Float32Array.from({ length: width * height }, (_, k) => {
    const stored = angle[k] as number;
    let bright = known.get(stored);
    if (bright === undefined) {
      const turn = (stored / 65535 - 0.5) * Math.PI;
      bright = lightOf(Math.cos(turn), Math.sin(turn));
      known.set(stored, bright);
    }
    return bright;
  });
}

/** Draws a thumbnail as a PNG.
 * @param bright  light of each texel, 1: that of the brightest direction; stretched over the page, row 0 on top
 * @param inside  mask of the page; left out: all of it is drawn
 * @param colour  colour of a texel of that light */
export async function plateThumbnail(
  { width, height, bright }: { width: number; height: number; bright: Float32Array },
  inside: Mask | undefined,
  colour: (light: number) => Rgb,
): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('no canvas');
  const image = context.createImageData(width, height);
  const cover = (x: number, y: number): number => {
    if (inside === undefined) return 255;
    // The mean of the mask's texels under this one makes rims smooth.
    const [left, right] = [(x * inside.width) / width, ((x + 1) * inside.width) / width];
    const [top, low] = [(y * inside.height) / height, ((y + 1) * inside.height) / height];
    let [sum, count] = [0, 0];
    for (let v = Math.floor(top); v < Math.max(low, top + 1) && v < inside.height; ++v) {
      for (let u = Math.floor(left); u < Math.max(right, left + 1) && u < inside.width; ++u, ++count) {
        sum += inside.inside[v * inside.width + u] as number;
      }
    }
    return (255 * sum) / Math.max(1, count);
  };
  for (let y = 0, k = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x, ++k) {
      image.data.set([...colour(bright[k] as number), cover(x, y)], 4 * k);
    }
  }
  context.putImageData(image, 0, 0);
  return canvas.convertToBlob({ type: 'image/png' });
}
