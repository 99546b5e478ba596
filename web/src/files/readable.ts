// Converts files to forms that the engine reads.
import { problemOf, StudioError } from '../model/problem.js';
import { browserPicture, enoughToKnow, kindOf, startsWith } from './kind.js';
import { readAll } from './stream.js';

const mostUnpacked = 64e6; // [bytes], the limit of any file

/** A gzipped drawing (.svgz), unpacked; undefined where it holds no readable drawing. */
async function unpackedDrawing(file: File): Promise<File | undefined> {
  const stream = file.stream().pipeThrough(new DecompressionStream('gzip'));
  const bytes = await readAll(stream, mostUnpacked, () => new Error('too large')).catch(() => undefined);
  if (bytes === undefined) return undefined;
  const name = file.name.replace(/(?:\.svgz|\.svg\.gz|\.gz)?$/i, '.svg');
  const drawing = new File([bytes], name, { type: 'image/svg+xml' });
  const head = new Uint8Array(await drawing.slice(0, enoughToKnow).arrayBuffer());
  return kindOf(head, drawing.name).kind === 'svg' ? drawing : undefined;
}

/** Converts pictures that only the browser reads to PNG, and unpacks gzipped drawings; other files stay as they are.
 * The bytes decide, because files from phones and chats have wrong types or none.
 * @throws StudioError BrowserPicture */
export async function readable(file: File): Promise<File> {
  const head = await file
    .slice(0, 64)
    .arrayBuffer()
    .catch(() => new ArrayBuffer(0)); // a folder, or a deleted file, is reported when it is read
  if (startsWith(new Uint8Array(head), 0x1f, 0x8b)) return (await unpackedDrawing(file)) ?? file;
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
