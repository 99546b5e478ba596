// What each kind of directions, and each shape, makes of the plate that is there: small pictures to choose by.
import type { Engine, Picture } from 'sillon';

import { tonesAt } from '../generators/grey.js';
import { qrPicture } from '../generators/qr.js';
import { rasteriseSource } from '../generators/rasterise.js';
import type { Room } from '../generators/room.js';
import { shapeRoom } from '../generators/shape-room.js';
import { drawText } from '../generators/text.js';
import { sizeFor, type Size } from '../generators/texels.js';
import { bitmapOf } from '../files/drawn.js';
import { fileKinds, generatorKinds, newColours, newFileDirections, newGenerator } from '../model/defaults.js';
import { viewLook } from '../model/filaments.js';
import { directionsFor, flatColours } from '../model/flat-colours.js';
import { homeLight } from '../model/lamp.js';
import { filesFor, filesIn, nothingLeft, type Kind, type Left } from '../model/left.js';
import {
  isRoundKind,
  pageOf,
  type DirectionSource,
  type Plate,
  type ShapeSource,
  type SourceFile,
} from '../model/plate.js';
import { builtinShapes, withShape } from '../model/shapes.js';
import { brightnessOf, plateThumbnail, thumbnailSide } from '../views/plate-thumbnail.js';

type ShapeKind = ShapeSource['kind'];

const pictureSide = 256; // [pixels]: enough for what is seen of it

let drawn: { bytes: Blob; picture: Picture } | undefined;

/** Small, as the browser draws it. @throws where it does not */
async function smallPicture({ bytes }: SourceFile, engine: Engine): Promise<Picture> {
  if (drawn?.bytes === bytes) return drawn.picture;
  const bitmap = await bitmapOf(bytes, engine);
  const scale = Math.min(1, pictureSide / Math.max(bitmap.width, bitmap.height));
  const [width, height] = [bitmap.width, bitmap.height].map((side) => Math.max(1, Math.round(side * scale))) as [
    number,
    number,
  ];
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  if (context === null) throw new Error('no canvas');
  context.drawImage(bitmap, 0, 0, width, height);
  const picture: Picture = { width, height, channels: 4, samples: context.getImageData(0, 0, width, height).data };
  drawn = { bytes, picture };
  return picture;
}

/** The picture that directions are told from, or were last; else the drawing of the shape. */
function ownFile(plate: Plate, lamp: number, left: Left): SourceFile | undefined {
  const { directions, shape } = plate;
  if (directions.kind === 'lamp') return directions.pictures[lamp]?.file;
  return filesFor(plate, left)[0] ?? (shape.kind === 'file' ? shape.file : undefined);
}

const isFileKind = (kind: Kind): kind is (typeof fileKinds)[number] => (fileKinds as readonly Kind[]).includes(kind);

/** As the plate has it, else as it would begin. */
function sourceOf(
  kind: Exclude<Kind, 'lamp'>,
  { directions }: Plate,
  left: Left,
  own: { file: SourceFile; picture: Picture } | undefined,
): DirectionSource | undefined {
  if (directions.kind === kind) return directions;
  const before = left.directions.get(kind);
  if (before !== undefined && filesIn(before).every((file) => file === own?.file)) return before;
  if (kind === 'colours') {
    return own === undefined ? undefined : newColours(own.file, directionsFor(flatColours(own.picture)));
  }
  if (!isFileKind(kind)) return newGenerator(kind);
  return own === undefined ? undefined : newFileDirections(kind, own.file);
}

async function brightOf(source: DirectionSource, plate: Plate, size: Size, own: Picture | undefined) {
  const page = pageOf(plate);
  const round = isRoundKind(plate.shape.kind);
  const picture =
    source.kind === 'text' ? drawText(source, size, round) : source.kind === 'qr' ? await qrPicture(source.text) : own;
  // A map would keep its own texels.
  const pictures = picture === undefined ? {} : { source: picture };
  const raster = rasteriseSource(source, { mode: 'constrained' }, page, thumbnailSide, pictures, round);
  const light = homeLight({ ...plate, directions: source, layers: [] }, undefined);
  return { width: raster.width, height: raster.height, bright: brightnessOf(raster, light) };
}

/** Under its lamp, such a plate shows the picture. */
const litPicture = (picture: Picture, size: Size) => ({
  ...size,
  bright: tonesAt(picture, size).map((tone) => 0.05 + 0.85 * tone),
});

async function own(plate: Plate, lamp: number, left: Left, engine: Engine) {
  const file = ownFile(plate, lamp, left);
  if (file === undefined) return undefined;
  const picture = await smallPicture(file, engine).catch(() => undefined); // of a kind that browsers do not draw
  return picture === undefined ? undefined : { file, picture };
}

/** @param wanted  whether it is still of use
 * @returns what could be drawn; kinds that need a picture are left out without one */
export async function kindPictures(
  plate: Plate,
  lamp: number,
  left: Left,
  engine: Engine,
  wanted: () => boolean,
): Promise<Map<Kind, Blob>> {
  const made = new Map<Kind, Blob>();
  const size = sizeFor(pageOf(plate), thumbnailSide);
  const { colour } = viewLook(plate);
  const [given, room] = await Promise.all([own(plate, lamp, left, engine), shapeRoom(plate, engine)]);
  if (given !== undefined) made.set('lamp', await plateThumbnail(litPicture(given.picture, size), room, colour));
  for (const kind of [...generatorKinds, ...fileKinds, 'colours'] as const) {
    if (!wanted()) break;
    const source = sourceOf(kind, plate, left, given);
    if (source === undefined) continue;
    made.set(kind, await plateThumbnail(await brightOf(source, plate, size, given?.picture), room, colour));
  }
  return made;
}

/** The plate's directions in each of the shapes. */
export async function shapePictures(
  plate: Plate,
  lamp: number,
  engine: Engine,
  wanted: () => boolean,
): Promise<Map<ShapeKind, Blob>> {
  const made = new Map<ShapeKind, Blob>();
  const { colour } = viewLook(plate);
  const given = await own(plate, lamp, nothingLeft, engine);
  for (const kind of [...builtinShapes, 'file'] as const) {
    if (!wanted()) break;
    const changed = plate.shape.kind === kind ? plate : kind === 'file' ? undefined : withShape(plate, kind);
    if (changed === undefined) continue;
    const size = sizeFor(pageOf(changed), thumbnailSide);
    const room: Room = await shapeRoom(changed, engine);
    const lit =
      plate.directions.kind === 'lamp'
        ? given && litPicture(given.picture, size)
        : await brightOf(plate.directions, changed, size, given?.picture);
    if (lit !== undefined) made.set(kind, await plateThumbnail(lit, room, colour));
  }
  return made;
}
