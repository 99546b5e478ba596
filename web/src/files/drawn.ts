// Pictures and drawings as pixels. The engine reads and paints them: a file that anybody may have made is never left to
// the browser to draw.
import type { ColourAngle, Engine, Picture } from 'sillon';
import { directionsFor, flatColours } from '../model/flat-colours.js';
import type { SourceFile } from '../model/plate.js';

export type DrawingEngine = Pick<Engine, 'decodePicture' | 'paintDrawing'>;

const svgType = 'image/svg+xml';

export const isSvg = ({ bytes }: Pick<SourceFile, 'bytes'>): boolean => bytes.type === svgType;

const painted = new WeakMap<Blob, Promise<Picture>>();

/** Pixels of a picture or a drawing; each drawing is painted once. @throws errors of the engine */
function pictureOf(file: Blob, engine: DrawingEngine): Promise<Picture> {
  if (file.type !== svgType) return engine.decodePicture(file);
  const picture = painted.get(file) ?? engine.paintDrawing(file);
  painted.set(file, picture);
  picture.catch(() => painted.delete(file)); // a later attempt may succeed
  return picture;
}

/** A bitmap of a file, for drawing it over the plate.
 * @throws errors of the engine; Error where the browser cannot decode a picture */
export async function bitmapOf(file: Blob, engine: DrawingEngine): Promise<ImageBitmap> {
  if (file.type !== svgType) return createImageBitmap(file);
  const { width, height, samples } = await pictureOf(file, engine);
  const bytes = Uint8ClampedArray.from(samples, (sample) => sample >> 8); // the engine paints with 16 bits
  return createImageBitmap(new ImageData(bytes, width, height));
}

/** A small PNG of a file for an <img>. @param side  most pixels of its longer side @throws as `bitmapOf` */
export async function smallPng(file: Blob, engine: DrawingEngine, side: number): Promise<Blob> {
  const bitmap = await bitmapOf(file, engine);
  const scale = Math.min(1, side / Math.max(bitmap.width, bitmap.height));
  const [width, height] = [bitmap.width, bitmap.height].map((length) => Math.max(1, Math.round(scale * length)));
  const canvas = new OffscreenCanvas(width as number, height as number);
  canvas.getContext('2d')?.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  return canvas.convertToBlob({ type: 'image/png' });
}

/** The flat colours of a drawing or a picture, from dark to light; empty where it cannot be read. */
export const coloursIn = ({ bytes }: SourceFile, engine: DrawingEngine): Promise<string[]> =>
  pictureOf(bytes, engine).then(flatColours, () => []);

/** A direction for each flat colour of a file. @param before  as for `directionsFor` */
export const coloursOf = async (
  file: SourceFile,
  engine: DrawingEngine,
  before?: readonly ColourAngle[],
): Promise<ColourAngle[]> => directionsFor(await coloursIn(file, engine), before);
