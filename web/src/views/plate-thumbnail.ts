// A plate as a thumbnail from its directions alone, before there are beads: for choices, where each shows what it would give.
import type { DirectionRaster } from '../model/raster.js';
import { litColour, shine } from './miniature.js';
import type { Light } from '../model/view.js';

/** What of the page is inside the shape: rows from the top, 1 inside. */
interface Mask {
  width: number;
  height: number;
  inside: Uint8Array;
}

/** Of the longer side [pixels]. */
export const thumbnailSide = 96;

/** Brightness 0..1 of each texel of a raster under a light. */
export function brightnessOf({ width, height, angle }: DirectionRaster, light: Light): Float32Array {
  const known = new Map<number, number>();
  return Float32Array.from({ length: width * height }, (_, k) => {
    const stored = angle[k] as number;
    let bright = known.get(stored);
    if (bright === undefined) {
      bright = shine(((stored / 65535) * 180 - 90) * (Math.PI / 180), light);
      known.set(stored, bright);
    }
    return bright;
  });
}

/** @param bright  0..1, stretched over the page, row 0 on top
 * @param inside  of the page; left out: all
 * @param colour  sRGB 0..255 */
export async function plateThumbnail(
  { width, height, bright }: { width: number; height: number; bright: Float32Array },
  inside: Mask | undefined,
  colour: readonly [number, number, number],
): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  if (context === null) throw new Error('no canvas');
  const image = context.createImageData(width, height);
  const cover = (x: number, y: number): number => {
    if (inside === undefined) return 255;
    // Mean of the mask's texels under this one, so that rims are smooth.
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
      image.data.set([...litColour(colour, bright[k] as number), cover(x, y)], 4 * k);
    }
  }
  context.putImageData(image, 0, 0);
  return canvas.convertToBlob({ type: 'image/png' });
}
