// Reads a QR code in pictures of a plate, as a phone would: which of them show it.
import jsQR from 'jsqr';

export interface ScanRequest {
  picture: Blob;
  /** What the code must say. */
  text: string;
}

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
    (read) => {
      self.postMessage(read);
    },
    () => {
      self.postMessage(false);
    },
  );
});
