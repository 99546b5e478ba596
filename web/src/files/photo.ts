// Photographs as pixels. The browser decodes them, since it knows more formats than the engine and turns them upright.
import type { Picture } from 'sillon';
import { StudioError } from '../model/problem.js';

const mostPixels = 16e6; // a coupon that fills half of them has 18 pixels across a bead, where 7 are enough

/** Decodes a photograph. @throws StudioError InvalidFile */
export async function photograph(file: Blob & { name?: string }): Promise<Picture> {
  const name = file.name ?? '';
  if (file.type === 'image/svg+xml') throw new StudioError('InvalidFile', { name }, 'a drawing is no photograph');
  const decoded = await createImageBitmap(file).catch((error: unknown) => {
    throw new StudioError('InvalidFile', { name }, String(error));
  });
  const scale = Math.min(1, Math.sqrt(mostPixels / (decoded.width * decoded.height)));
  const width = Math.max(1, Math.round(decoded.width * scale));
  const height = Math.max(1, Math.round(decoded.height * scale));
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d', { willReadFrequently: true });
  if (context === null) throw new StudioError('InvalidFile', { name });
  context.imageSmoothingQuality = 'high';
  context.drawImage(decoded, 0, 0, width, height);
  decoded.close();
  return { width, height, channels: 4, samples: context.getImageData(0, 0, width, height).data };
}
