// A plate in the hash of a link: version, then deflated JSON. Only settings and generators travel; what comes in may have
// been written by anybody, and is let through only as far as a control could have set it.
import { fieldsOf, textIn, Unfit, type Fields } from './check.js';
import { directionsFrom, heightFrom, modeFrom, nameFrom, plateSpoolFrom, shapeFrom, widthFrom } from './check-plate.js';
import { fileKinds, newGenerator, newPlate, newShape, pictureDefaults } from './defaults.js';
import type { DirectionSource, Plate, ShapeSource, SourceFile } from './plate.js';
import { layersFrom } from './check-layers.js';
import { mostPictures } from './lamp.js';
import { mostLayers } from './layer-list.js';
import { profileOf } from './printers.js';
import { toldLayers } from './share-layers.js';
import { StudioError } from './problem.js';
import { accepts, settings, settingOf, settingsOf, type Setting, type SettingValue } from './settings.js';

const key = 'plate=';
const version = 1;
/** Browsers and chats cut longer ones. An honest link has under 2000 characters. */
const mostCharacters = 16_000;
const mostBytes = 200_000;

/** What a link cannot carry. */
export const untoldParts = ['shape', 'directions', 'detail', 'modes', 'layers', 'strokes', 'blocks'] as const;
export type Untold = (typeof untoldParts)[number];

/** Of all pictures of a link together, and of its drawing [bytes]. */
export const mostPictureBytes = 8000;
const mostDrawingBytes = 4000;

/** A picture made small enough; undefined: it cannot be. @param most  [bytes] */
export type Shrink = (file: SourceFile, most: number) => Promise<Uint8Array | undefined>;
/** A file of a link. */
export type Unpack = (name: string, bytes: Uint8Array<ArrayBuffer>) => Promise<SourceFile>;

export interface Link {
  /** With its '#'. */
  hash: string;
  untold: Untold[];
}

// --- Bytes -------------------------------------------------------------------------------------------------------------

async function collected(stream: ReadableStream<Uint8Array>, most: number): Promise<Uint8Array<ArrayBuffer>> {
  const pieces: Uint8Array[] = [];
  let length = 0;
  const reader = stream.getReader();
  for (;;) {
    const { value, done } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > most) {
      void reader.cancel().catch(() => undefined);
      throw new StudioError('LinkTooLong', { bytes: length, most });
    }
    pieces.push(value);
  }
  const bytes = new Uint8Array(length);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return bytes;
}

const streamOf = (bytes: Uint8Array<ArrayBuffer>): ReadableStream<Uint8Array<ArrayBuffer>> =>
  new Blob([bytes]).stream();

const deflated = (bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> =>
  collected(streamOf(bytes).pipeThrough(new CompressionStream('deflate-raw')), Infinity);

const inflated = (bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> =>
  collected(streamOf(bytes).pipeThrough(new DecompressionStream('deflate-raw')), mostBytes);

function toBase64Url(bytes: Uint8Array): string {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

function fromBase64Url(text: string): Uint8Array<ArrayBuffer> {
  if (!/^[\w-]*$/.test(text)) throw new StudioError('LinkBroken');
  return Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (letter) => letter.charCodeAt(0));
}

// --- Out ---------------------------------------------------------------------------------------------------------------

/** What would move and heat the machine of whoever opens the link, and may hold names and passwords of a network. */
const ownAlone: readonly string[] = ['printer.startGcode', 'printer.endGcode', 'printer.anyTemperature'];

const isFileKind = (kind: string): boolean => (fileKinds as readonly string[]).includes(kind);

/** All that travel. */
const travelling: readonly Setting[] = [...settingsOf('pictures'), ...settings];

/** Settings that are not the default's. */
function changed(plate: Plate): Record<string, SettingValue> {
  const values: Record<string, SettingValue> = {};
  const profile = profileOf(plate.printer) !== undefined;
  for (const setting of travelling) {
    if (!profile && ownAlone.includes(setting.id)) continue;
    const value = (plate[setting.section] as unknown as Record<string, SettingValue>)[setting.key] as SettingValue;
    if (JSON.stringify(value) !== JSON.stringify(setting.default)) values[setting.id] = value;
  }
  return values;
}

const toldFile = (name: string, bytes: Uint8Array): object => ({ name, data: toBase64Url(bytes) });

/** A drawing that is small as it is; undefined: it cannot travel. */
async function toldShape(shape: ShapeSource, shrink: Shrink | undefined): Promise<{ told: unknown; bytes: number }> {
  if (shape.kind !== 'file') return { told: shape, bytes: 0 };
  const { bytes: blob, name } = shape.file;
  if (shrink === undefined || blob.type !== 'image/svg+xml' || blob.size > mostDrawingBytes) {
    return { told: undefined, bytes: 0 };
  }
  const bytes = new Uint8Array(await blob.arrayBuffer());
  return { told: { ...shape, file: toldFile(name, bytes) }, bytes: bytes.length };
}

/** What a link tells of directions; undefined: it cannot. @param room  for pictures [bytes] */
async function toldDirections(directions: DirectionSource, shrink: Shrink | undefined, room: number): Promise<unknown> {
  if (directions.kind === 'map') return undefined; // made small, its angles would be others
  if (directions.kind === 'colours') {
    // Its own bytes: grey and small, it would show other colours.
    const { file } = directions;
    if (shrink === undefined || file.bytes.size > Math.min(room, mostDrawingBytes)) return undefined;
    return { ...directions, file: toldFile(file.name, new Uint8Array(await file.bytes.arrayBuffer())) };
  }
  if (directions.kind !== 'lamp') {
    if (!('file' in directions)) return directions;
    const bytes = await shrink?.(directions.file, room);
    return bytes === undefined ? undefined : { ...directions, file: toldFile(directions.file.name, bytes) };
  }
  const most = room / directions.pictures.length;
  const pictures = [];
  for (const { file, lamp } of directions.pictures) {
    const bytes = await shrink?.(file, most);
    if (bytes === undefined) return undefined;
    pictures.push({ file: toldFile(file.name, bytes), lamp });
  }
  return { ...directions, pictures };
}

/** @param shrink  left out: pictures do not travel */
export async function writeLink(plate: Plate, shrink?: Shrink): Promise<Link> {
  const untold: Untold[] = [];
  const { name, shape, width, height, directions, modes } = plate;
  const drawing = await toldShape(shape, shrink);
  if (drawing.told === undefined) untold.push('shape');
  const toldOf = await toldDirections(directions, shrink, mostPictureBytes - drawing.bytes);
  if (toldOf === undefined) untold.push('directions');
  const taken = 'file' in directions || directions.kind === 'lamp';
  const room = taken ? 0 : mostPictureBytes - drawing.bytes;
  const layers = await toldLayers(plate, room, shrink, toldFile);
  const small = toldOf !== undefined && (directions.kind === 'lamp' || isFileKind(directions.kind));
  if (small || layers.shrunk) untold.push('detail');
  if (layers.lacks) untold.push('layers');
  if (modes.file !== undefined) untold.push('modes');
  if (plate.strokes.length > 0) untold.push('strokes');
  if (profileOf(plate.printer) === undefined && plate.printer.startGcode + plate.printer.endGcode !== '')
    untold.push('blocks');
  const told = {
    name,
    shape: drawing.told,
    width,
    height,
    directions: toldOf,
    mode: modes.mode,
    ...(layers.told.length > 0 && { layers: layers.told }),
    settings: changed(plate),
    ...(plate.spool !== undefined && { spool: plate.spool }),
    ...(untold.length > 0 ? { untold } : {}),
  };
  const packed = await deflated(new TextEncoder().encode(JSON.stringify(told)));
  return { hash: `#${key}${version}.${toBase64Url(packed)}`, untold };
}

// --- In ----------------------------------------------------------------------------------------------------------------

/** Sparse: what is not told has its default. */
function settingsFrom(plate: Plate, value: unknown): Plate {
  const ids = travelling.map(({ id }) => id);
  const fields = fieldsOf(value, 'settings', ids);
  const { pictures, toolpath, print, printer } = plate;
  const sections = structuredClone({ pictures, toolpath, print, printer });
  for (const id of ids) {
    if (!(id in fields)) continue;
    const setting: Setting = settingOf(id);
    const given = fields[id];
    if (!accepts(setting, given)) throw new Unfit(id, given);
    (sections[setting.section] as unknown as Fields)[setting.key] = given;
  }
  return { ...plate, ...sections };
}

/** Of the pictures in a link, which may have been written by anybody. */
async function filesIn(value: unknown, unpack: Unpack): Promise<Map<unknown, SourceFile>> {
  const files = new Map<unknown, SourceFile>();
  const read = async (part: unknown, where: string, key = 'file'): Promise<void> => {
    const told = (part as Fields | null | undefined)?.[key];
    if (typeof told !== 'object' || told === null) return;
    const { name, data } = fieldsOf(told, where, ['name', 'data']);
    const bytes = fromBase64Url(textIn(data, where, mostCharacters));
    files.set(told, await unpack(textIn(name, where, 1000), bytes));
  };
  const { shape, directions, layers } = (value ?? {}) as Fields;
  await read(shape, 'shape.file');
  await read(directions, 'directions.file');
  const pictures = (directions as Fields | null | undefined)?.['pictures'];
  for (const [k, one] of (Array.isArray(pictures) ? pictures.slice(0, mostPictures) : []).entries()) {
    await read(one, `directions.pictures[${k}].file`);
  }
  for (const [k, one] of (Array.isArray(layers) ? layers.slice(0, mostLayers) : []).entries()) {
    for (const key of ['file', 'maskFile', 'modeFile', 'font']) await read(one, `layers[${k}].${key}`, key);
    const others = (one as Fields | null | undefined)?.['others'];
    for (const [n, other] of (Array.isArray(others) ? others.slice(0, mostPictures) : []).entries()) {
      await read(other, `layers[${k}].others[${n}].file`);
    }
  }
  return files;
}

function toldPlate(value: unknown, files: ReadonlyMap<unknown, SourceFile>): Plate {
  const fileFrom = (told: unknown, where: string): SourceFile => {
    const file = files.get(told);
    if (file === undefined) throw new Unfit(where, told);
    return file;
  };
  const known = ['name', 'shape', 'width', 'height', 'directions', 'mode', 'layers', 'settings', 'spool', 'untold'];
  const fields = fieldsOf(value, '', known);
  const { shape, directions } = fields; // undefined: it was a file
  const plate: Plate = {
    ...newPlate(),
    pictures: { ...pictureDefaults },
    name: nameFrom(fields['name']),
    shape: shape === undefined ? newShape('rectangle') : shapeFrom(shape, files.size > 0 ? fileFrom : undefined),
    width: widthFrom(fields['width']),
    height: heightFrom(fields['height']),
    directions:
      directions === undefined
        ? newGenerator('angle')
        : directionsFrom(directions, files.size > 0 ? fileFrom : undefined),
    modes: { mode: modeFrom(fields['mode'], 'mode') },
    layers: layersFrom(fields['layers'] ?? [], files.size > 0 ? fileFrom : undefined),
    ...plateSpoolFrom(fields['spool']),
  };
  return settingsFrom(plate, fields['settings']);
}

/** Links of earlier versions do not say it, but leave out what they lack. */
function missingIn(value: unknown): Untold[] {
  const { untold, shape, directions } = value as Fields;
  if (Array.isArray(untold)) return untoldParts.filter((part) => untold.includes(part));
  return [
    ...(shape === undefined ? ['shape' as const] : []),
    ...(directions === undefined ? ['directions' as const] : []),
  ];
}

/** @returns undefined where the hash is no plate's.
 * @param unpack  left out: pictures are refused
 * @param tell  what the link could not carry
 * @throws StudioError LinkTooLong, LinkTooNew, LinkBroken, LinkValue */
export async function readLink(
  hash: string,
  unpack?: Unpack,
  tell?: (parts: Untold[]) => void,
): Promise<Plate | undefined> {
  const text = hash.replace(/^#/, '');
  if (!text.startsWith(key)) return undefined;
  if (text.length > mostCharacters) throw new StudioError('LinkTooLong', { bytes: text.length, most: mostCharacters });
  const [, number, packed] = /^(\d{1,6})\.(.*)$/s.exec(text.slice(key.length)) ?? [];
  if (number === undefined || packed === undefined) throw new StudioError('LinkBroken');
  if (Number(number) !== version) throw new StudioError('LinkTooNew', { version: Number(number) });
  let value: unknown;
  try {
    const json = new TextDecoder('utf-8', { fatal: true }).decode(await inflated(fromBase64Url(packed)));
    value = JSON.parse(json);
  } catch (error) {
    if (error instanceof StudioError) throw error;
    throw new StudioError('LinkBroken');
  }
  try {
    const plate = toldPlate(value, unpack === undefined ? new Map() : await filesIn(value, unpack));
    tell?.(missingIn(value));
    return plate;
  } catch (error) {
    if (error instanceof Unfit) throw new StudioError('LinkValue', { where: error.where, value: error.value });
    throw error;
  }
}
