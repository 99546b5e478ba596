// The project file: a zip with project.json, which the command line reads as it is once it is unpacked, and the files that it
// names. Its sections are the core's; a section of the studio's own, which other programs leave as it is, has what no toolpath
// needs: where directions came from, strokes, a spool of one's own, the names of files as they came.
import { strFromU8, strToU8, zipSync, type Zippable } from 'fflate';
import type { Engine, Project } from 'sillon';
import { fieldsOf, numberIn, textIn, type Fields } from '../model/check.js';
import { heightFrom, plateFrom, widthFrom } from '../model/check-plate.js';
import { givenSlopes, slopesOf } from '../model/filaments.js';
import { groundOf, studioLayer } from '../model/ground.js';
import { rasterPictures, sectionsOf } from '../model/input.js';
import { projectLayer } from '../model/layer-list.js';
import { isDrawn, type Plate, type SourceFile } from '../model/plate.js';
import { isOfFile, StudioError } from '../model/problem.js';
import type { DirectionRaster } from '../model/raster.js';
import { without } from '../model/without.js';
import { plateOf, type Stored } from './autosave.js';
import { enoughToKnow, fontType, kindOf } from './kind.js';
import { filesOf, partData, plateData } from './plate-data.js';
import { encodeGreyPng } from './png16.js';
import { sourceFile, stemOf } from './source-file.js';
import { openZip, ZipError, type Entry } from './unzip.js';

const version = 1;
/** Limits of one input, and of a project with its strokes, as the core has them [bytes]. */
export const mostBytes = { input: 64e6, project: 16 << 20 };
/** Pictures that the studio has drawn for the engine. */
const drawnFiles = { directions: 'directions.png', modes: 'modes.png' };

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

/** The section `studio`: all that the core has no section for. @param paths  of the plate's own files */
function studioSection(plate: Plate, paths: ReadonlyMap<string, string>): object {
  const { name, width, height, directions, modes, strokes, spool } = plate;
  const pathOf = ({ id }: SourceFile): string | undefined => paths.get(id);
  return {
    version,
    name,
    page: [width, height],
    files: Object.fromEntries(filesOf(plate).map((file) => [paths.get(file.id), file.name] as const)) as object,
    ...(isDrawn(plate) && { directions: partData(directions, pathOf), modes: modes.file && pathOf(modes.file) }),
    ...(strokes.length > 0 && { strokes }),
    ...(spool !== undefined && { spool }),
  };
}

function projectOf(plate: Plate, paths: ReadonlyMap<string, string>): object {
  const pathOf = ({ id }: SourceFile): string | undefined => paths.get(id);
  const sections = sectionsOf(plate, pathOf, isDrawn(plate) ? drawnFiles : undefined, projectLayer);
  const pictures = { ...sections.pictures, slopes: givenSlopes(plate) };
  return { sillon: 1, ...sections, pictures, studio: studioSection(plate, paths) };
}

/** project.json of the project file, as data. */
export const projectData = (plate: Plate): object => projectOf(plate, pathsFor(filesOf(plate)));

/** The same plate and raster give the same bytes. A printer that nobody has said may be used is left out.
 * @param raster  of the plate, as the engine gets it */
export async function writeProject(plate: Plate, raster: DirectionRaster): Promise<Blob> {
  const files = filesOf(plate);
  const paths = pathsFor(files);
  const packed: Zippable = {};
  if (isDrawn(plate)) {
    const { directions, modes } = rasterPictures(raster);
    for (const [name, { width, height, samples }] of [
      [drawnFiles.directions, directions],
      [drawnFiles.modes, modes],
    ] as const) {
      packed[name] = [await encodeGreyPng(width, height, samples), { level: 0 }];
    }
  }
  for (const { id, bytes } of files) {
    const isLoose = bytes.type === 'image/svg+xml' || bytes.type === fontType;
    const content = new Uint8Array(await bytes.arrayBuffer());
    packed[paths.get(id) ?? ''] = [content, { level: isLoose ? 6 : 0 }];
  }
  return zipped({ 'project.json': json(projectOf(plate, paths)), ...packed });
}

/** The clock has no part in it. */
const zipped = (whole: Zippable): Blob =>
  new Blob([zipSync(whole, { level: 6, mtime: new Date(1980, 0, 1) })], { type: 'application/zip' });

/** Packs what was kept of a plate that only another version can read: everything as it is, which that version opens.
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
  const packed: Zippable = {};
  for (const { id, bytes } of sources) packed[paths.get(id) ?? id] = new Uint8Array(await bytes.arrayBuffer());
  return zipped({
    'kept.json': json({ record: plain, about: plainAbout, files: Object.fromEntries(paths) }),
    ...packed,
  });
}

// --- In ----------------------------------------------------------------------------------------------------------------

/** The engine's calls that reading a project takes. */
export type ProjectEngine = Pick<Engine, 'readProject' | 'readShape'>;

/** A file by its path as it stands in a project. */
type FileAt = (path: string, name: string) => Promise<SourceFile>;

const megabytes = (bytes: number): number => Math.round(bytes / 1e5) / 10;

function checkSize(size: number, most: number, what: string): void {
  if (size > most) throw new ZipError(`${what} has ${megabytes(size)} MB; at most ${megabytes(most)} MB`);
}

async function textOf(entry: Entry, most: number): Promise<string> {
  checkSize(entry.size, most, entry.path);
  return strFromU8(await entry.read());
}

const baseName = (path: string): string => path.split('/').at(-1) ?? path;

/** A plate whose files are their paths. The core's sections count: what the studio tells of directions only where they are
 * still those that it drew. */
function sketchOf(project: Project, studio: Fields, name: string): Plate {
  const { shape, layers: all = [], toolpath, print, pictures } = project;
  const { builtin, file } = shape;
  const { profile, filament, ...printer } = project.printer;
  const kind = file !== '' ? 'file' : builtin === 'none' ? 'rectangle' : builtin;
  const lowest = groundOf(all);
  const { pictures: lit = [], file: map = '', modeFile = '' } = lowest ?? {};
  const drawn =
    studio['directions'] !== undefined &&
    baseName(map) === drawnFiles.directions &&
    baseName(modeFile) === drawnFiles.modes;
  const told =
    lit.length > 0
      ? { kind: 'lamp', pictures: lit.map(({ file, lamp }) => ({ file, lamp })) }
      : map === ''
        ? { kind: 'angle', angle: lowest?.angle ?? 0 }
        : { kind: 'map', file: map, encoding: lowest?.encoding ?? 'angle' };
  const modes = drawn ? studio['modes'] : modeFile || undefined;
  const layers = all.slice(lowest === undefined ? 0 : 1).map(studioLayer);
  const data = {
    name: studio['name'] ?? stemOf(name).slice(0, 200),
    shape: { kind, ...without(shape, 'builtin', 'size', 'pageWidth', 'file'), ...(kind === 'file' && { file }) },
    width: 1,
    height: 1,
    directions: drawn ? studio['directions'] : told,
    modes: { mode: lowest?.mode ?? 'constrained', ...(modes !== undefined && { file: modes }) },
    layers,
    pictures,
    strokes: drawn || lit.length > 0 ? (studio['strokes'] ?? []) : [],
    toolpath,
    print,
    printer: { ...printer, ...(profile !== '' && { profile }), ...(filament !== '' && { filament }) },
    spool: studio['spool'],
  };
  const plate = plateFrom(data, (path, where) => {
    const id = textIn(path, where, 1024);
    return { id, name: id, bytes: new Blob() };
  });
  if (plate.spool === undefined) return plate;
  // Slopes of one's own spool are the plate's as long as the project has them.
  const own = { ...plate, pictures: { ...plate.pictures, slopes: null } };
  if (String(slopesOf(own)) === String(pictures.slopes)) return own;
  return without(plate, 'spool');
}

/** The page as it stood in the studio, unless the project has another size since; else as the core makes it. */
async function pageOf(
  project: Project,
  studio: Fields,
  plate: Plate,
  engine: ProjectEngine,
): Promise<[number, number]> {
  // The page is that without what an offset adds to it.
  const { builtin, size, radius, corners, points, inner, text, font, pageWidth, unitless } = project.shape;
  const { shape, directions } = plate;
  const page: unknown = studio['page'];
  if (Array.isArray(page) && String(shape.kind === 'file' ? [pageWidth, page[1]] : size) === String(page)) {
    return [widthFrom(page[0]), heightFrom(page[1])];
  }
  const own =
    shape.kind === 'file'
      ? { file: shape.file.bytes, pageWidth, unitless }
      : { ...(builtin !== 'none' && { builtin }), size, radius, corners, points, inner, text, font };
  const lender = directions.kind === 'lamp' ? directions.pictures[0]?.file : 'file' in directions && directions.file;
  const read = await engine.readShape(own, lender ? [{ kind: 'map', file: lender.bytes }] : []);
  return [widthFrom(read.page[0]), heightFrom(read.page[1])];
}

async function plateIn(text: string, name: string, fileAt: FileAt, engine: ProjectEngine): Promise<Plate> {
  const project = await engine.readProject(text);
  const known = ['version', 'name', 'page', 'files', 'directions', 'modes', 'strokes', 'spool'];
  const studio = fieldsOf(project.studio ?? { version }, 'studio', known);
  numberIn(studio['version'], 'studio.version', version, version);
  const names = (studio['files'] ?? {}) as Fields;
  const sketch = sketchOf(project, studio, name);
  const files = new Map<string, SourceFile>();
  for (const { id: path } of filesOf(sketch)) {
    files.set(path, await fileAt(path, textIn(names[path] ?? path, `studio.files.${path}`, 1000)));
  }
  const plate = plateData(sketch, ({ id }) => files.get(id)) as Plate;
  const [width, height] = await pageOf(project, studio, plate, engine);
  return { ...plate, width, height };
}

/** The archive's file of this name that lies least deep: archives are often packed again with a folder around them. */
function topmost(entries: Map<string, Entry>, name: string): Entry | undefined {
  const depth = ({ path }: Entry): number => path.split('/').length;
  const found = [...entries.values()].filter(({ path }) => baseName(path) === name && !path.startsWith('__MACOSX/'));
  return found.sort((a, b) => depth(a) - depth(b))[0];
}

/** Reads what `packStored` has packed. */
async function storedPlate(text: string, entryAt: (path: string) => Entry | undefined): Promise<Plate> {
  const { record, files } = JSON.parse(text) as { record: unknown; files: Record<string, string> };
  const blobs = new Map<string, Blob>();
  for (const [id, path] of Object.entries(files)) {
    const entry = entryAt(path);
    if (entry === undefined) continue;
    checkSize(entry.size, mostBytes.input, path);
    blobs.set(id, (await sourceFile(path, await entry.read())).bytes);
  }
  return plateOf(record, (id) => blobs.get(id));
}

async function zippedPlate(name: string, bytes: Uint8Array<ArrayBuffer>, engine: ProjectEngine): Promise<Plate> {
  const entries = openZip(bytes);
  const project = topmost(entries, 'project.json');
  const main = project ?? topmost(entries, 'kept.json');
  if (main === undefined) {
    const ofSlicer = topmost(entries, '3dmodel.model') !== undefined;
    throw new StudioError(ofSlicer ? 'PrinterFileHere' : 'UnknownFile', { name });
  }
  const folder = main.path.slice(0, main.path.length - baseName(main.path).length);
  const entryAt = (path: string): Entry | undefined => entries.get(folder + path);
  const text = await textOf(main, mostBytes.project);
  if (project === undefined) return storedPlate(text, entryAt);
  const fileAt: FileAt = async (path, named) => {
    const entry = entryAt(path);
    if (entry === undefined) throw missing(name, path);
    checkSize(entry.size, mostBytes.input, path);
    return sourceFile(named, await entry.read());
  };
  return plateIn(text, name, fileAt, engine);
}

const missing = (name: string, path: string): StudioError =>
  new StudioError('BrokenProject', { name }, `${path} is missing: open it together with the project`);

/** @param file  a zip, or a project's JSON alone
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
    const fileAt: FileAt = (path, named) => {
      const found = others.find((other) => [baseName(path), named].includes(other.name));
      return found === undefined ? Promise.reject(missing(name, path)) : Promise.resolve(found);
    };
    return await plateIn(new TextDecoder().decode(bytes), name, fileAt, engine);
  } catch (error) {
    if (error instanceof StudioError || !(error instanceof Error)) throw error;
    if (error.name === 'AbortError' || (error.name === 'SillonError' && !isOfFile(error))) throw error;
    throw new StudioError('BrokenProject', { name }, error.message);
  }
}
