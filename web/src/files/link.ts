// A plate in the hash of a link: a version, then deflated JSON of the plate's project and of those files that are small
// or can be made so. A link may have been written by anybody; the core checks its project like any other.
import { fieldsOf, textIn, Unfit } from '../model/check.js';
import { newShape } from '../model/defaults.js';
import { groundOf } from '../model/fills.js';
import { filesOfLayer, projectLayer } from '../model/layer-list.js';
import { completeLayers } from '../model/layers.js';
import type { Plate, PlateLayer, SourceFile } from '../model/plate.js';
import { profileOf } from '../model/printers.js';
import { problemOf, StudioError } from '../model/problem.js';
import { untoldParts, type Untold } from '../model/untold.js';
import { without } from '../model/without.js';
import { shapeTable, table } from '../model/setting-table.js';
import { filesOf, plateOf, projectData, type ProjectEngine } from './plate-project.js';
import { readAll } from './stream.js';

const key = 'plate=';
/** Version of links. Version 1 kept directions and settings in a form of the studio's own. */
const version = 2;
/** Most characters of a link; browsers and chats truncate longer ones. A usual link has under 2000. */
const mostCharacters = 16_000;
const mostBytes = 200_000;
/** Most characters of JSON that all strokes together may take. */
const mostStrokes = 20_000;
/** Most bytes of a packed link. Base64 adds a third, and some room is left below `mostCharacters`. */
const mostPacked = 11_000;

/** Most bytes of all pictures in a link together, and below of one drawing. */
export const mostPictureBytes = 8000;
const mostDrawingBytes = 4000;

/** Makes a picture small enough; undefined where that is impossible. @param most  [bytes] */
export type Shrink = (file: SourceFile, most: number) => Promise<Uint8Array | undefined>;
/** Turns a link's packed file into one of a plate. */
export type Unpack = (name: string, bytes: Uint8Array<ArrayBuffer>) => Promise<SourceFile>;

export interface Link {
  /** Hash of the link, with '#'. */
  hash: string;
  untold: Untold[];
}

// --- Bytes -------------------------------------------------------------------------------------------------------------

/** Passes bytes through a stream. @throws StudioError LinkTooLong beyond `most` bytes */
async function piped(
  bytes: Uint8Array<ArrayBuffer>,
  through: CompressionStream | DecompressionStream,
  most: number,
): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytes]).stream().pipeThrough(through);
  const all = await readAll(stream, most, (length) => new StudioError('LinkTooLong', { bytes: length, most }));
  return new Uint8Array(await all.arrayBuffer());
}

const deflated = (bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> =>
  piped(bytes, new CompressionStream('deflate-raw'), Infinity);

const inflated = (bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> =>
  piped(bytes, new DecompressionStream('deflate-raw'), mostBytes);

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

/** Settings that are never put into a link. They would move and heat the machine of whoever opens it, and may
 * contain names and passwords of a network. */
const ownAlone: Readonly<Record<string, true>> = { startGcode: true, endGcode: true, generalHeatLimits: true };

const svgType = 'image/svg+xml';

/** Tells whether a file goes into a link unchanged: drawings do, and so do pictures whose colours stand for
 * directions, since the small form is grey. */
const isWhole = ({ kind, by, file }: PlateLayer, one: SourceFile): boolean =>
  one.bytes.type === svgType || (kind === 'tones' && by === 'colours' && one === file);

const whole = async ({ bytes }: SourceFile, most: number): Promise<Uint8Array | undefined> =>
  bytes.size > Math.min(most, mostDrawingBytes) ? undefined : new Uint8Array(await bytes.arrayBuffer());

/** The small form of a layer's file. Maps and pictures of modes would mean something else when reduced, and fonts
 * have no small form. */
async function smallFile(layer: PlateLayer, file: SourceFile, most: number, shrink: Shrink) {
  const exact = file === layer.font || file === layer.modeFile || (file === layer.file && layer.kind === 'map');
  if (exact) return undefined;
  return isWhole(layer, file) ? whole(file, most) : shrink(file, most);
}

const sizeOf = (all: Iterable<Uint8Array>): number => [...all].reduce((sum, { length }) => sum + length, 0);

/** The parts of a plate that a link can carry, their files, and the parts that it cannot. */
interface Carried {
  plate: Plate;
  files: Map<string, Uint8Array>;
  untold: Set<Untold>;
}

/** The plate with its shape, or with a rectangle where the shape's file is too large. */
async function withShapeOf({ plate, files, untold }: Carried, shrink: Shrink | undefined): Promise<Plate> {
  const { shape } = plate;
  if (shape.kind !== 'file') return plate;
  const bytes = shape.file.bytes.type === svgType && shrink ? await whole(shape.file, mostDrawingBytes) : undefined;
  if (bytes === undefined) {
    untold.add('shape');
    return { ...plate, shape: newShape('rectangle') };
  }
  files.set(shape.file.id, bytes);
  return plate;
}

/** The plate with those layers that fit into the link. */
async function withLayersOf({ plate, files, untold }: Carried, shrink: Shrink | undefined): Promise<Plate> {
  const complete = completeLayers(plate);
  const ground = groundOf(plate);
  const layers: PlateLayer[] = [];
  const bare = await packedOf(toldOf({ plate: { ...plate, layers: [] }, files, untold }));
  let left = mostPacked - bare.length;
  let room = mostPictureBytes - sizeOf(files.values());
  let waiting = complete.flatMap(filesOfLayer).length;
  let strokes = 0;
  if (complete.length < plate.layers.length) untold.add('layers');
  for (const layer of complete) {
    const own = filesOfLayer(layer);
    const small: [SourceFile, Uint8Array][] = [];
    const words = (await packedOf(projectLayer(layer, ({ name }) => name))).length;
    const free = Math.min(room, left - words);
    let taken = 0;
    for (const file of own) {
      const most = (free - taken) / waiting;
      const bytes = shrink && most > 0 ? await smallFile(layer, file, most, shrink) : undefined;
      --waiting;
      if (bytes === undefined) continue;
      taken += bytes.length;
      small.push([file, bytes]);
    }
    strokes += JSON.stringify(layer.strokes).length;
    if (layer.strokes.length > 0 && (strokes > mostStrokes || words > left)) untold.add('strokes');
    else if (small.length < own.length || words > left) untold.add(layer === ground ? 'directions' : 'layers');
    else {
      layers.push(layer);
      room -= taken;
      left -= words + taken;
      for (const [file, bytes] of small) {
        files.set(file.id, bytes);
        if (!isWhole(layer, file)) untold.add('detail');
      }
    }
  }
  return { ...plate, layers };
}

type Rows = Readonly<Record<string, { default: unknown }>>;

/** Values that differ from the defaults. */
const changed = (section: object, rows: Rows, left: Readonly<Record<string, unknown>> = {}): object =>
  Object.fromEntries(
    Object.entries(section).filter(
      ([name, value]) => !(name in left) && JSON.stringify(value) !== JSON.stringify(rows[name]?.default),
    ),
  );

/** A project without the values that every reader fills in. */
function sparse(project: object, plate: Plate): object {
  const sections = project as Record<'shape' | keyof typeof table, object>;
  // The names of profiles would reset values that the plate has changed.
  const left = { profile: true, filament: true, ...(profileOf(plate.printer) === undefined && ownAlone) };
  return {
    ...project,
    shape: changed(sections.shape, shapeTable),
    pictures: changed(sections.pictures, table.pictures),
    toolpath: changed(sections.toolpath, table.toolpath),
    print: changed(sections.print, table.print),
    printer: changed(sections.printer, table.printer, left),
  };
}

/** A plate in the form of a link's data. */
function toldOf({ plate, files, untold }: Carried): object {
  const paths = new Map(filesOf(plate).map(({ id, name }, k) => [id, `${k}/${name}`]));
  const project = projectData(plate, ({ id }) => paths.get(id) ?? '');
  return {
    project: sparse(project, plate),
    ...(files.size > 0 && {
      files: Object.fromEntries(Array.from(files, ([id, bytes]) => [paths.get(id), toBase64Url(bytes)])) as object,
    }),
    ...(untold.size > 0 && { untold: [...untold] }),
  };
}

const packedOf = (told: object): Promise<Uint8Array> => deflated(new TextEncoder().encode(JSON.stringify(told)));

/** Makes a plate's link. @param shrink  makes pictures small; without it no files go into the link */
export async function writeLink(given: Plate, shrink?: Shrink): Promise<Link> {
  // A body is too large for any link.
  const carried: Carried = { plate: without(given, 'body'), files: new Map(), untold: new Set() };
  carried.plate = await withShapeOf(carried, shrink);
  carried.plate = await withLayersOf(carried, shrink);
  const { plate, untold } = carried;
  const { printer } = plate;
  if (profileOf(printer) === undefined && printer.startGcode + printer.endGcode !== '') untold.add('blocks');
  const packed = await packedOf(toldOf(carried));
  return { hash: `#${key}${version}.${toBase64Url(packed)}`, untold: untoldParts.filter((part) => untold.has(part)) };
}

// --- In ----------------------------------------------------------------------------------------------------------------

/** Reads a link's data. @param tell  called with the parts that the link could not carry */
async function plateIn(
  value: unknown,
  unpack: Unpack,
  engine: ProjectEngine,
  tell: (parts: Untold[]) => void,
): Promise<Plate> {
  const { project, files = {}, untold = [] } = fieldsOf(value, '', ['project', 'files', 'untold']);
  const packed = fieldsOf(files, 'files', Object.keys(files ?? {}));
  const fileAt = async (path: string, name: string): Promise<SourceFile> => {
    if (!Object.hasOwn(packed, path)) throw new Unfit(path, undefined);
    return unpack(name, fromBase64Url(textIn(packed[path], path, mostCharacters)));
  };
  const plate = await plateOf(JSON.stringify(project ?? null), '', fileAt, engine);
  tell(untoldParts.filter((part) => Array.isArray(untold) && untold.includes(part)));
  return plate;
}

/** Reads the plate of a link.
 * @param hash  of the page's address, with or without '#'
 * @returns undefined where the hash contains no plate
 * @throws StudioError LinkTooLong, LinkTooNew, LinkBroken, LinkValue; errors of the engine */
export async function readLink(
  hash: string,
  unpack: Unpack,
  engine: () => Promise<ProjectEngine>,
  tell: (parts: Untold[]) => void = () => undefined,
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
  const reader = await engine();
  try {
    return await plateIn(value, unpack, reader, tell);
  } catch (error) {
    if (error instanceof Unfit) throw new StudioError('LinkValue', { where: error.where, value: error.value });
    if (problemOf(error).code !== 'Internal') throw error;
    throw new StudioError('LinkBroken'); // files that are no base64, or JSON that is nested too deeply
  }
}
