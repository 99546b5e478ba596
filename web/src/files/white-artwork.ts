// White artwork on a transparent ground, as sold for dark shirts. It would vanish on the white paper behind pictures,
// so it gets a black ground.
import type { Picture } from 'sillon';
import type { SourceFile } from '../model/plate.js';
import { sourceFile } from './source-file.js';

/** The artwork on black. @param picture  the file's pixels, with an alpha channel @throws Error where the browser
 * has no canvas of that size */
export async function onBlack({ name }: SourceFile, picture: Picture): Promise<SourceFile> {
  const { width, height, channels, samples } = picture;
  const scale = samples instanceof Uint16Array ? 1 / 257 : 1;
  const pixels = new Uint8ClampedArray(4 * width * height);
  for (let pixel = 0; pixel < width * height; ++pixel) {
    const from = pixel * channels;
    const cover = ((samples[from + channels - 1] as number) * scale) / 255;
    for (let part = 0; part < 3; ++part) {
      pixels[4 * pixel + part] = (samples[from + (channels < 3 ? 0 : part)] as number) * scale * cover;
    }
    pixels[4 * pixel + 3] = 255;
  }
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext('2d')?.putImageData(new ImageData(pixels, width, height), 0, 0);
  const png = await canvas.convertToBlob({ type: 'image/png' });
  return sourceFile(name, new Uint8Array(await png.arrayBuffer()));
}
