// A plate in the hash of a link: version, then deflated JSON. Only settings and generators travel; what comes in may have
// been written by anybody, and is let through only as far as a control could have set it.
import {
  directionsFrom,
  fieldsOf,
  filamentFrom,
  heightFrom,
  modeFrom,
  nameFrom,
  shapeFrom,
  Unfit,
  widthFrom,
  type Fields,
} from './check-plate.js';
import { fileKinds, newGenerator, newPlate, newShape } from './defaults.js';
import type { Plate } from './plate.js';
import { StudioError } from './problem.js';
import { accepts, settings, settingOf, type Setting, type SettingValue } from './settings.js';

const key = 'plate=';
const version = 1;
/** Browsers and chats cut longer ones. An honest link has under 2000 characters. */
const mostCharacters = 16_000;
const mostBytes = 200_000;

/** What a link cannot carry. */
export type Untold = 'shape' | 'directions' | 'modes' | 'strokes';

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

const isFileKind = (kind: string): boolean => (fileKinds as readonly string[]).includes(kind);

/** Settings that are not the default's. */
function changed(plate: Plate): Record<string, SettingValue> {
  const values: Record<string, SettingValue> = {};
  for (const setting of settings) {
    const value = (plate[setting.section] as unknown as Record<string, SettingValue>)[setting.key] as SettingValue;
    if (JSON.stringify(value) !== JSON.stringify(setting.default)) values[setting.id] = value;
  }
  return values;
}

export async function writeLink(plate: Plate): Promise<Link> {
  const untold: Untold[] = [];
  const { name, shape, width, height, directions, modes, filament } = plate;
  if (shape.kind === 'file') untold.push('shape');
  if (isFileKind(directions.kind)) untold.push('directions');
  if (modes.file !== undefined) untold.push('modes');
  if (plate.strokes.length > 0) untold.push('strokes');
  const told = {
    name,
    shape: shape.kind === 'file' ? undefined : shape,
    width,
    height,
    directions: isFileKind(directions.kind) ? undefined : directions,
    mode: modes.base,
    filament,
    settings: changed(plate),
  };
  const packed = await deflated(new TextEncoder().encode(JSON.stringify(told)));
  return { hash: `#${key}${version}.${toBase64Url(packed)}`, untold };
}

// --- In ----------------------------------------------------------------------------------------------------------------

/** Sparse: what is not told has its default. */
function settingsFrom(plate: Plate, value: unknown): Plate {
  const ids = settings.map(({ id }) => id);
  const fields = fieldsOf(value, 'settings', ids);
  const sections = { toolpath: { ...plate.toolpath }, print: { ...plate.print }, printer: { ...plate.printer } };
  for (const id of ids) {
    if (!(id in fields)) continue;
    const setting: Setting = settingOf(id);
    const given = fields[id];
    if (!accepts(setting, given)) throw new Unfit(id, given);
    (sections[setting.section] as unknown as Fields)[setting.key] = given;
  }
  return { ...plate, ...sections };
}

function toldPlate(value: unknown): Plate {
  const known = ['name', 'shape', 'width', 'height', 'directions', 'mode', 'filament', 'settings'];
  const fields = fieldsOf(value, '', known);
  const { shape, directions } = fields; // undefined: it was a file
  const plate: Plate = {
    ...newPlate(),
    name: nameFrom(fields['name']),
    shape: shape === undefined ? newShape('rectangle') : shapeFrom(shape),
    width: widthFrom(fields['width']),
    height: heightFrom(fields['height']),
    directions: directions === undefined ? newGenerator('angle') : directionsFrom(directions),
    modes: { base: modeFrom(fields['mode'], 'mode') },
    strokes: [],
    filament: filamentFrom(fields['filament']),
  };
  return settingsFrom(plate, fields['settings']);
}

/** @returns undefined where the hash is no plate's.
 * @throws StudioError LinkTooLong, LinkTooNew, LinkBroken, LinkValue */
export async function readLink(hash: string): Promise<Plate | undefined> {
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
    return toldPlate(value);
  } catch (error) {
    if (error instanceof Unfit) throw new StudioError('LinkValue', { where: error.where, value: error.value });
    throw error;
  }
}
