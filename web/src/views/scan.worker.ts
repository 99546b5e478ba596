// Tells whether a phone could read a QR code in a picture of a plate.
import jsQR from 'jsqr';

export interface ScanRequest {
  picture: Blob;
  /** Text that the code must contain. */
  text: string;
}

/** Tells whether the picture contains a code with exactly that text. */
async function reads({ picture, text }: ScanRequest): Promise<boolean> {
  const bitmap = await createImageBitmap(picture);
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (context === null) throw new Error('no canvas');
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return jsQR(context.getImageData(0, 0, width, height).data, width, height)?.data === text;
}

self.addEventListener('message', ({ data }: MessageEvent<ScanRequest>) => {
  reads(data).then(
    (read) => self.postMessage(read),
    () => self.postMessage(false),
  );
});
