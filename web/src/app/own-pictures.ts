// Draws small pictures for choices: the plate with each fill, and in each shape.
import type { ColourAngle, Engine } from 'sillon';
import { bitmapOf, coloursOf } from '../files/drawn.js';
import { shapeRoom } from '../layers/shape-room.js';
import {
  filledWith,
  fillOf,
  groundOf,
  groundPictures,
  isPictureFill,
  patternFills,
  pictureFills,
  type Fill,
} from '../model/fills.js';
import { lookOf } from '../model/filaments.js';
import { homeLight } from '../model/lamp.js';
import { filesFor, leftOf, type Left } from '../model/left.js';
import { pageOf, type Plate, type ShapeSource, type SourceFile } from '../model/plate.js';
import { sizeFor, type Size } from '../model/raster.js';
import { builtinShapes, withShape } from '../model/shapes.js';
import { lightBy, litColour } from '../views/lit.js';
import { smallLook } from '../views/plate-look.js';
import { brightnessOf, plateThumbnail, thumbnailSide } from '../views/plate-thumbnail.js';
import { drawDirections } from './directions.js';

type ShapeKind = ShapeSource['kind'];

interface Bright extends Size {
  bright: Float32Array;
}

let drawn: { bytes: Blob; bright: Bright } | undefined;

/** Returns a picture's brightness at thumbnail size. @throws Error if the browser cannot draw it */
async function litPicture({ bytes }: SourceFile, page: readonly [number, number], engine: Engine): Promise<Bright> {
  const size = sizeFor(page, thumbnailSide);
  if (drawn?.bytes === bytes && drawn.bright.width === size.width && drawn.bright.height === size.height) {
    return drawn.bright;
  }
  const bitmap = await bitmapOf(bytes, engine);
  const context = new OffscreenCanvas(size.width, size.height).getContext('2d', { willReadFrequently: true });
  if (context === null) throw new Error('no canvas');
  // The engine places it the same way: it covers the page, and is cropped equally on both sides.
  const scale = Math.max(size.width / bitmap.width, size.height / bitmap.height);
  const [width, height] = [bitmap.width * scale, bitmap.height * scale];
  context.fillStyle = 'white';
  context.fillRect(0, 0, size.width, size.height);
  context.drawImage(bitmap, (size.width - width) / 2, (size.height - height) / 2, width, height);
  const { data } = context.getImageData(0, 0, size.width, size.height);
  const bright = Float32Array.from({ length: size.width * size.height }, (_, k) => {
    const [r = 0, g = 0, b = 0] = data.subarray(4 * k, 4 * k + 3);
    return ((0.2126 * r + 0.7152 * g + 0.0722 * b) / 255) ** 2.2; // linear light instead of the sRGB value
  });
  drawn = { bytes, bright: { ...size, bright } };
  return drawn.bright;
}

/** Resamples values to another size by the nearest neighbour. */
const nearest = (values: Float32Array, from: Size, to: Size): Float32Array =>
  Float32Array.from({ length: to.width * to.height }, (_, k) => {
    const [x, y] = [k % to.width, Math.floor(k / to.width)];
    const [column, row] = [Math.floor((x * from.width) / to.width), Math.floor((y * from.height) / to.height)];
    return values[row * from.width + column] as number;
  });

/** Returns the brightness of the plate's ground alone, as its beads would have it. */
async function litGround(plate: Plate, engine: Engine): Promise<Bright> {
  const ground = groundOf(plate);
  const alone = { ...plate, layers: ground === undefined ? [] : [ground] };
  const raster = await drawDirections(alone, engine, thumbnailSide);
  const light = lightBy(smallLook(alone, homeLight(alone, undefined)));
  const bright = brightnessOf(raster, (x, y) => light(x, y, 0, 0));
  const size = sizeFor(pageOf(plate), thumbnailSide);
  // A single direction is one texel, and maps have a size of their own.
  return { ...size, bright: nearest(bright, raster, size) };
}

/** Returns the plate with another fill: its own or a former one, otherwise with default values.
 * @param colours  colours of the file */
function filled(plate: Plate, fill: Fill, left: Left, file: SourceFile | undefined, colours: ColourAngle[]): Plate {
  const ground = groundOf(plate);
  if (ground !== undefined && fillOf(ground) === fill) return plate;
  const before = leftOf(left, fill, file);
  if (before !== undefined) return filledWith(plate, fill, before);
  return filledWith(plate, fill, isPictureFill(fill) && file !== undefined ? { file, colours } : {});
}

/** Draws the plate with each fill.
 * @param lamp  index of the picture whose lamp shines
 * @param wanted  tells whether the pictures are still of use
 * @returns pictures of the fills that could be drawn; fills that need a picture are left out without one */
export async function fillPictures(
  plate: Plate,
  lamp: number,
  left: Left,
  engine: Engine,
  wanted: () => boolean,
): Promise<Map<Fill, Blob>> {
  const made = new Map<Fill, Blob>();
  const colour = litColour(lookOf(plate).colour);
  const room = await shapeRoom(plate, engine);
  const { shape } = plate;
  const own = groundPictures(plate)[lamp]?.file ?? filesFor(plate, left)[0];
  const file = own ?? (shape.kind === 'file' ? shape.file : undefined);
  const draw = async (fill: Fill): Promise<Bright | undefined> => {
    if (isPictureFill(fill) && file === undefined) return undefined;
    if (fill === 'picture') return file && litPicture(file, pageOf(plate), engine);
    const colours = fill === 'colours' && file !== undefined ? await coloursOf(file, engine) : [];
    return litGround(filled(plate, fill, left, file, colours), engine);
  };
  for (const fill of [...pictureFills, ...patternFills]) {
    if (!wanted()) break;
    const lit = await draw(fill).catch(() => undefined); // browsers, or the engine, cannot draw this kind of file
    if (lit !== undefined) made.set(fill, await plateThumbnail(lit, room, colour));
  }
  return made;
}

/** Draws the plate in each of the shapes. */
export async function shapePictures(
  plate: Plate,
  lamp: number,
  engine: Engine,
  wanted: () => boolean,
): Promise<Map<ShapeKind, Blob>> {
  const made = new Map<ShapeKind, Blob>();
  const colour = litColour(lookOf(plate).colour);
  const file = groundPictures(plate)[lamp]?.file;
  for (const kind of [...builtinShapes, 'file'] as const) {
    if (!wanted()) break;
    const changed = plate.shape.kind === kind ? plate : kind === 'file' ? undefined : withShape(plate, kind);
    if (changed === undefined) continue;
    const room = await shapeRoom(changed, engine);
    const lit = file === undefined ? litGround(changed, engine) : litPicture(file, pageOf(changed), engine);
    const bright = await lit.catch(() => undefined);
    if (bright !== undefined) made.set(kind, await plateThumbnail(bright, room, colour));
  }
  return made;
}
