// The project file: a zip with project.json, which the command line reads as it is once it is unpacked, and studio.json, from
// which the page gets back what no toolpath needs: where directions came from, strokes, the filament's look.
import { strFromU8, strToU8, zipSync, type Zippable } from 'fflate';
import type { DirectionInput, Engine, PrinterValues, Project, ShapeInput } from 'sillon';
import type { DirectionRaster } from '../model/raster.js';
import { engineInput, paintOf } from '../model/input.js';
import { fieldsOf, numberIn, plateFrom, textIn, Unfit, type Fields } from '../model/check-plate.js';
import { newLampDirections, newPlate } from '../model/defaults.js';
import { mostPictures, pictureInput } from '../model/lamp.js';
import { withoutBrought } from '../model/brought.js';
import type { LampPicture, Plate, SourceFile } from '../model/plate.js';
import { isOfFile, StudioError } from '../model/problem.js';
import type { Stored } from './autosave.js';
import { enoughToKnow, kindOf } from './kind.js';
import { filesOf, plateData } from './plate-data.js';
import { encodeGreyPng } from './png16.js';
import { sourceFile, stemOf } from './source-file.js';
import { openZip, ZipError, type Entry } from './unzip.js';

const version = 1;
/** Of one input, of the plate with its strokes, and of the command line's projects [bytes]. */
export const mostBytes = { input: 64e6, plate: 16e6, project: 1 << 20 };
const mostDepth = 64;

// --- Out ---------------------------------------------------------------------------------------------------------------

/** Names that every file system takes, each once. */
function pathsFor(files: readonly SourceFile[]): Map<string, string> {
  const taken = new Set<string>();
  const paths = new Map<string, string>();
  for (const { id, name } of files) {
    const plain = Array.from(name.normalize('NFC').replace(/[^\p{L}\p{N}._ -]+/gu, '_'))
      .slice(0, 80)
      .join('');
    const tidy = plain.replace(/^[. ]+|[. ]+$/g, '') || 'file';
    const stem = stemOf(tidy);
    const ending = tidy.slice(stem.length);
    let path = `inputs/${tidy}`;
    for (let n = 2; taken.has(path.toLowerCase()); ++n) path = `inputs/${stem}-${n}${ending}`;
    taken.add(path.toLowerCase());
    paths.set(id, path);
  }
  return paths;
}

const json = (value: unknown): Uint8Array<ArrayBuffer> => strToU8(`${JSON.stringify(value, undefined, 2)}\n`);

/** A texel's samples as the engine is handed them. */
interface Texels {
  width: number;
  height: number;
  samples: Uint8Array | Uint16Array;
}

/** What the command line reads, and the pictures that it names. @param paths  of the plate's own files */
function described(
  plate: Plate,
  raster: DirectionRaster | undefined,
  paths: ReadonlyMap<string, string>,
): { project: object; pictures: [name: string, texels: Texels][] } {
  const { input, params } = engineInput({ plate, raster });
  const { shape, directions = {}, modes = {} } = input;
  const { modes: told } = plate;
  const lit = plate.directions.kind === 'lamp' ? plate.directions : undefined;
  const pathOf = ({ id }: SourceFile): string => paths.get(id) ?? '';
  const { print, printer } = plate;
  const pictures: [string, Texels][] = [];
  const named = (name: string, part: object): object => {
    if (!('file' in part)) return part;
    pictures.push([name, part.file as Texels]);
    return { ...part, file: name };
  };
  const project = {
    sillon: 1,
    shape: plate.shape.kind === 'file' ? { ...shape, file: paths.get(plate.shape.file.id) } : shape,
    ...(lit === undefined
      ? { directions: named('directions.png', directions), modes: named('modes.png', modes) }
      : {
          pictures: pictureInput(plate, lit, pathOf),
          modes: told.file === undefined ? modes : { file: pathOf(told.file) },
        }),
    toolpath: params,
    print,
    printer,
  };
  return { project, pictures };
}

/** project.json of the project file, as data. */
export const projectData = (plate: Plate, raster: DirectionRaster | undefined): object =>
  described(plate, raster, pathsFor(filesOf(plate))).project;

/** The same plate and raster give the same bytes.
 * @param raster  of the plate, as the engine gets it; undefined: one direction and one mode everywhere */
export async function writeProject(plate: Plate, raster: DirectionRaster | undefined): Promise<Blob> {
  const files = filesOf(plate);
  const paths = pathsFor(files);
  const packed: Zippable = {};
  const { project, pictures } = described(plate, raster, paths);
  for (const [name, { width, height, samples }] of pictures) {
    packed[name] = [await encodeGreyPng(width, height, samples), { level: 0 }];
  }
  // Nobody has said that it may be used.
  const own = withoutBrought(plate);
  const studio = { studio: version, plate: plateData(own, ({ id, name }) => ({ path: paths.get(id), name })) };

  for (const { id, bytes } of files) {
    const isText = bytes.type === 'image/svg+xml';
    const content = new Uint8Array(await bytes.arrayBuffer());
    packed[paths.get(id) ?? ''] = [content, { level: isText ? 6 : 0 }];
  }
  return zipped({ 'project.json': json(project), 'studio.json': json(studio), ...packed });
}

/** The clock has no part in it. */
const zipped = (whole: Zippable): Blob =>
  new Blob([zipSync(whole, { level: 6, mtime: new Date(1980, 0, 1) })], { type: 'application/zip' });

/** What was kept of a plate that only another version can read: everything as it is, and a studio.json for that version.
 * @param stored  as of `Autosave.stored` */
export async function packStored({ record, about, files }: Stored): Promise<Blob> {
  const names = new Map<unknown, string>();
  const blobs = new Map<string, Blob>();
  const told = (value: unknown): { id: string; name: string } | undefined => {
    const { id, name } = (value ?? {}) as { id?: unknown; name?: unknown };
    return typeof id === 'string' && typeof name === 'string' && files.has(id) ? { id, name } : undefined;
  };
  /** JSON lacks bytes: they stand beside it. */
  const text = (value: unknown): unknown =>
    JSON.parse(
      JSON.stringify(value ?? null, (_, part: unknown) => {
        const file = told(part);
        if (file !== undefined && !names.has(file.id)) names.set(file.id, file.name);
        if (!(part instanceof Blob)) return part;
        const id = `of record ${blobs.size + 1}`;
        blobs.set(id, part);
        return { id };
      }),
    );
  const [plain, plainAbout] = [text(record), text(about)];
  for (const [id, bytes] of files) if (bytes instanceof Blob) blobs.set(id, bytes);
  const sources = Array.from(blobs, ([id, bytes]) => ({ id, name: names.get(id) ?? id, bytes }));
  const paths = pathsFor(sources);
  const { plate } = (plain ?? {}) as { plate?: unknown };
  const pathed: unknown = JSON.parse(
    JSON.stringify(plate ?? null, (_, part: unknown) => {
      const file = told(part);
      return file === undefined ? part : { path: paths.get(file.id), name: file.name };
    }),
  );
  const packed: Zippable = {};
  for (const { id, bytes } of sources) packed[paths.get(id) ?? id] = new Uint8Array(await bytes.arrayBuffer());
  return zipped({
    'studio.json': json({ studio: version, plate: pathed }),
    'kept.json': json({ record: plain, about: plainAbout, files: Object.fromEntries(paths) }),
    ...packed,
  });
}

// --- In ----------------------------------------------------------------------------------------------------------------

/** What reading a project of the command line takes. */
export type ProjectEngine = Pick<Engine, 'readProject' | 'readShape'>;

/** Without recursion, which hostile text could exhaust. */
function tooDeep(text: string): boolean {
  let depth = 0;
  let quoted = false;
  for (let k = 0; k < text.length; ++k) {
    const letter = text[k];
    if (letter === '"') quoted = !quoted;
    else if (quoted) k += letter === '\\' ? 1 : 0;
    else if (letter === '{' || letter === '[') ++depth;
    else if (letter === '}' || letter === ']') --depth;
    if (depth > mostDepth) return true;
  }
  return false;
}

function parsed(text: string): unknown {
  if (tooDeep(text)) throw new Unfit('', 'nested too deep');
  return JSON.parse(text);
}

function checkSize(size: number, most: number, what: string): void {
  if (size > most) throw new ZipError(`${what} has ${Math.round(size / 1e5) / 10} MB; at most ${most / 1e6} MB`);
}

async function textOf(entry: Entry, most: number): Promise<string> {
  checkSize(entry.size, most, entry.path);
  return strFromU8(await entry.read());
}

/** Of studio.json. @param entryAt  by a path as it stands there */
async function studioPlate(text: string, entryAt: (path: string) => Entry | undefined): Promise<Plate> {
  const { studio, plate } = fieldsOf(parsed(text), '', ['studio', 'plate']);
  numberIn(studio, 'studio', version, version);
  const files = new Map<unknown, SourceFile>();
  const part = (name: string): Fields | null | undefined =>
    (plate as Fields | null)?.[name] as Fields | null | undefined;
  const named: [where: string, told: unknown][] = ['shape', 'directions', 'modes'].map((name) => [
    `${name}.file`,
    part(name)?.['file'],
  ]);
  const lit = part('directions')?.['pictures'];
  if (Array.isArray(lit)) {
    lit.slice(0, mostPictures).forEach((one: unknown, k) => {
      named.push([`directions.pictures[${k}].file`, (one as Fields | null)?.['file']]);
    });
  }
  for (const [where, told] of named) {
    if (told === undefined) continue;
    const { path, name } = fieldsOf(told, where, ['path', 'name']);
    const entry = entryAt(textIn(path, `${where}.path`, 1000));
    if (entry === undefined) throw new ZipError(`${String(path)} is missing`);
    checkSize(entry.size, mostBytes.input, entry.path);
    files.set(told, await sourceFile(textIn(name, `${where}.name`, 1000), await entry.read()));
  }
  const read = plateFrom(plate, (told, where) => {
    const file = files.get(told);
    if (file === undefined) throw new Unfit(where, told);
    return file;
  });
  return withoutBrought(read);
}

/** What its names of printer and filament stand for is in the other fields already. */
function valuesOf(printer: Project['printer']): PrinterValues {
  const values: Partial<Project['printer']> = { ...printer };
  delete values.profile;
  delete values.filament;
  return {
    ...(values as PrinterValues),
    name: printer.name.slice(0, 64),
    filamentType: printer.filamentType.slice(0, 64),
  };
}

/** Of the command line's project, as far as a plate can tell it: what follows from pictures and shapes is filled in.
 * @param fileNamed  by a path as it stands there */
async function commandLinePlate(
  name: string,
  text: string,
  fileNamed: (path: string) => Promise<SourceFile>,
  engine: ProjectEngine,
): Promise<Plate> {
  const project = await engine.readProject(text);
  const { shape, directions, modes, pictures, toolpath, print, printer } = project;
  const named = (path: string): Promise<SourceFile | undefined> =>
    path === '' ? Promise.resolve(undefined) : fileNamed(path);
  const ofShape = await named(shape.file);
  const ofDirections = await named(directions.file);
  const ofModes = await named(modes.file);
  const lit: LampPicture[] = [];
  for (const { file, lamp } of pictures.files) lit.push({ file: await fileNamed(file), lamp });
  const page = await pageOf(project, ofShape, ofDirections ?? lit[0]?.file, engine);
  const builtin = shape.builtin === 'none' ? 'rectangle' : shape.builtin;
  const data = {
    name: stemOf(name).slice(0, 200),
    shape:
      ofShape !== undefined
        ? {
            kind: 'file',
            file: ofShape,
            unitless: shape.unitless,
            ...(shape.paint !== paintOf({ unitless: shape.unitless }) && { paint: shape.paint }),
            ...(shape.keepThin === true && { keepThin: true }),
          }
        : builtin === 'rounded'
          ? { kind: builtin, radius: shape.radius }
          : { kind: builtin },
    width: page[0],
    height: page[1],
    directions:
      lit.length > 0
        ? {
            ...newLampDirections(lit),
            lampSize: pictures.lampSize,
            smoothness: pictures.smoothness,
            localContrast: pictures.localContrast,
          }
        : ofDirections === undefined
          ? { kind: 'angle', angle: directions.angle }
          : { kind: 'map', file: ofDirections, encoding: directions.encoding },
    modes: ofModes === undefined ? { base: modes.mode } : { base: modes.mode, file: ofModes },
    strokes: [],
    toolpath,
    print,
    printer: valuesOf(printer),
    filament: lit.length > 0 ? pictures.spool : newPlate().filament,
  };
  return plateFrom(data, (file) => file as SourceFile);
}

async function pageOf(
  { shape, directions }: Project,
  ofShape: SourceFile | undefined,
  ofDirections: SourceFile | undefined,
  engine: ProjectEngine,
): Promise<[number, number]> {
  const { builtin, size, radius, pageWidth, unitless } = shape;
  const shapeInput: ShapeInput =
    ofShape !== undefined
      ? { file: ofShape.bytes, pageWidth, unitless }
      : builtin === 'none'
        ? { size }
        : { builtin, size, radius };
  const directionInput: DirectionInput =
    ofDirections === undefined
      ? { angle: directions.angle }
      : { file: ofDirections.bytes, encoding: directions.encoding };
  return (await engine.readShape(shapeInput, directionInput)).page;
}

const baseName = (path: string): string => path.split('/').at(-1) ?? path;

/** The archive's file of this name that lies least deep: archives are often packed again with a folder around them. */
function topmost(entries: Map<string, Entry>, name: string): Entry | undefined {
  const depth = ({ path }: Entry): number => path.split('/').length;
  const found = [...entries.values()].filter(({ path }) => baseName(path) === name && !path.startsWith('__MACOSX/'));
  return found.sort((a, b) => depth(a) - depth(b))[0];
}

async function zippedPlate(name: string, bytes: Uint8Array<ArrayBuffer>, engine: ProjectEngine): Promise<Plate> {
  const entries = openZip(bytes);
  const studio = topmost(entries, 'studio.json');
  const main = studio ?? topmost(entries, 'project.json');
  if (main === undefined) {
    const ofSlicer = topmost(entries, '3dmodel.model') !== undefined;
    throw new StudioError(ofSlicer ? 'PrinterFileHere' : 'UnknownFile', { name });
  }
  const folder = main.path.slice(0, main.path.length - baseName(main.path).length);
  const entryAt = (path: string): Entry | undefined => entries.get(folder + path);
  if (studio !== undefined) return studioPlate(await textOf(studio, mostBytes.plate), entryAt);
  const fileNamed = async (path: string): Promise<SourceFile> => {
    const entry = entryAt(path);
    if (entry === undefined) throw missing(name, path);
    checkSize(entry.size, mostBytes.input, path);
    return sourceFile(path, await entry.read());
  };
  return commandLinePlate(name, await textOf(main, mostBytes.project), fileNamed, engine);
}

const missing = (name: string, path: string): StudioError =>
  new StudioError('BrokenProject', { name }, `${path} is missing: open it together with the project`);

/** @param file  a zip, or the JSON of the command line
 * @param others  opened together with it: a JSON names files
 * @throws StudioError UnknownFile (an archive of something else), BrokenProject; errors of the engine's own */
export async function readProject(
  file: SourceFile,
  others: readonly SourceFile[],
  engine: ProjectEngine,
): Promise<Plate> {
  const { name } = file;
  try {
    const bytes = new Uint8Array(await file.bytes.arrayBuffer());
    if (kindOf(bytes.subarray(0, enoughToKnow), name).kind === 'zip') return await zippedPlate(name, bytes, engine);
    checkSize(bytes.length, mostBytes.project, name);
    const fileNamed = (path: string): Promise<SourceFile> => {
      const found = others.find((other) => other.name === baseName(path));
      return found === undefined ? Promise.reject(missing(name, path)) : Promise.resolve(found);
    };
    return await commandLinePlate(name, new TextDecoder().decode(bytes), fileNamed, engine);
  } catch (error) {
    if (error instanceof StudioError || !(error instanceof Error)) throw error;
    if (error.name === 'AbortError' || (error.name === 'SillonError' && !isOfFile(error))) throw error;
    throw new StudioError('BrokenProject', { name }, error.message);
  }
}
