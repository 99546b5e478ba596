// Makes pictures small enough for a link.
import type { SourceFile } from '../model/plate.js';

const sides = [320, 240, 180, 128, 96, 64]; // longer sides [pixels] to try, the largest first

/** The largest grey JPEG within `most` bytes. Colour can go, since a plate does not show it.
 * @returns undefined for drawings, and where the browser cannot draw the file */
export async function shrunk({ bytes }: SourceFile, most: number): Promise<Uint8Array | undefined> {
  if (bytes.type === 'image/svg+xml') return undefined; // some browsers would draw it, whatever it contains
  let image: ImageBitmap;
  try {
    image = await createImageBitmap(bytes);
  } catch {
    return undefined;
  }
  for (const side of sides) {
    const scale = Math.min(1, side / Math.max(image.width, image.height));
    const canvas = new OffscreenCanvas(
      Math.max(1, Math.round(image.width * scale)),
      Math.max(1, Math.round(image.height * scale)),
    );
    const context = canvas.getContext('2d');
    if (context === null) return undefined;
    context.fillStyle = 'white'; // white paper, which the engine also puts behind transparent pixels
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.filter = 'grayscale(1)';
    context.imageSmoothingQuality = 'high';
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    const blob = await canvas.convertToBlob({ type: 'image/jpeg', quality: 0.8 });
    if (blob.size <= most) return new Uint8Array(await blob.arrayBuffer());
  }
  return undefined;
}
