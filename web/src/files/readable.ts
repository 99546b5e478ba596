// Files in a form that the engine reads.
import { problemOf, StudioError } from '../model/problem.js';
import { browserPicture } from './kind.js';

/** Pictures of kinds that only the browser reads, as PNG; everything else as it is. What it is, its bytes say: files of phones
 * and chats come with wrong types, or with none.
 * @throws StudioError BrowserPicture */
export async function readable(file: File): Promise<File> {
  const head = await file
    .slice(0, 64)
    .arrayBuffer()
    .catch(() => new ArrayBuffer(0)); // a folder, or gone: told when it is read
  const type = browserPicture(new Uint8Array(head));
  if (type === '') return file;
  try {
    const image = await createImageBitmap(new Blob([file], { type }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    canvas.getContext('2d')?.drawImage(image, 0, 0);
    return new File([await canvas.convertToBlob({ type: 'image/png' })], file.name, { type: 'image/png' });
  } catch (error) {
    throw new StudioError('BrowserPicture', { name: file.name }, problemOf(error).detail);
  }
}
