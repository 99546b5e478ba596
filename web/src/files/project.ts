// The project file: a zip with project.json, which the command line reads once it is unpacked, and the files named
// there.
import { strFromU8, strToU8, zipSync, type Zippable } from 'fflate';
import { completeLayers } from '../model/layers.js';
import type { Plate, SourceFile } from '../model/plate.js';
import { isOfFile, StudioError } from '../model/problem.js';
import { keptPlate, type Stored } from './autosave.js';
import { enoughToKnow, fontType, kindOf } from './kind.js';
import { filesOf, plateOf, projectData, type FileAt, type ProjectEngine } from './plate-project.js';
import { sourceFile, stemOf } from './source-file.js';
import { openZip, ZipError, type Entry } from './unzip.js';

/** Limits of one input and of project.json with its strokes, equal to the core's [bytes]. */
export const mostBytes = { input: 64e6, project: 16 << 20 };

// --- Out ---------------------------------------------------------------------------------------------------------------

/** A unique path for each file, with names that every file system accepts. */
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

/** The plate without incomplete layers and their files. */
const whole = (plate: Plate): Plate => ({ ...plate, layers: completeLayers(plate) });

/** project.json of the project file, as data. */
export function projectFileData(plate: Plate): object {
  const paths = pathsFor(filesOf(whole(plate)));
  return projectData(whole(plate), ({ id }) => paths.get(id) ?? '');
}

/** Writes a project file; the same plate gives the same bytes. A printer not yet accepted by the visitor is left
 * out. */
export async function writeProject(plate: Plate): Promise<Blob> {
  const files = filesOf(whole(plate));
  const paths = pathsFor(files);
  const packed: Zippable = {};
  for (const { id, bytes } of files) {
    const isLoose = bytes.type === 'image/svg+xml' || bytes.type === fontType;
    const content = new Uint8Array(await bytes.arrayBuffer());
    packed[paths.get(id) ?? ''] = [content, { level: isLoose ? 6 : 0 }];
  }
  return zipped({ 'project.json': json(projectFileData(plate)), ...packed });
}

/** Packs files with a fixed date, so that equal contents give equal bytes. */
const zipped = (content: Zippable): Blob =>
  new Blob([zipSync(content, { level: 6, mtime: new Date(1980, 0, 1) })], { type: 'application/zip' });

/** Packs the data of a plate that only another version can read, unchanged, so that that version can open them.
 * @param stored  result of `Autosave.stored` */
export async function packStored({ record, about, files }: Stored): Promise<Blob> {
  const names = new Map<unknown, string>();
  const blobs = new Map<string, Blob>();
  const told = (value: unknown): { id: string; name: string } | undefined => {
    const { id, name } = (value ?? {}) as { id?: unknown; name?: unknown };
    return typeof id === 'string' && typeof name === 'string' && files.has(id) ? { id, name } : undefined;
  };
  /** A copy without bytes, which JSON cannot hold; they are packed as files. */
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

const megabytes = (bytes: number): number => Math.round(bytes / 1e5) / 10;

function checkSize(size: number, most: number, what: string): void {
  if (size > most) throw new ZipError(`${what} has ${megabytes(size)} MB; at most ${megabytes(most)} MB`);
}

async function textOf(entry: Entry, most: number): Promise<string> {
  checkSize(entry.size, most, entry.path);
  return strFromU8(await entry.read());
}

const baseName = (path: string): string => path.split('/').at(-1) ?? path;

/** The file of this name that is least deep in the archive, since archives are often repacked with a folder around
 * them. */
function topmost(entries: Map<string, Entry>, name: string): Entry | undefined {
  const depth = ({ path }: Entry): number => path.split('/').length;
  const found = [...entries.values()].filter(({ path }) => baseName(path) === name && !path.startsWith('__MACOSX/'));
  return found.sort((a, b) => depth(a) - depth(b))[0];
}

/** Reads a plate that `packStored` has packed. */
async function storedPlate(
  text: string,
  entryAt: (path: string) => Entry | undefined,
  engine: ProjectEngine,
): Promise<Plate> {
  const { record, files } = JSON.parse(text) as { record: unknown; files: Record<string, string> };
  const blobs = new Map<string, Blob>();
  for (const [id, path] of Object.entries(files)) {
    const entry = entryAt(path);
    if (entry === undefined) continue;
    checkSize(entry.size, mostBytes.input, path);
    blobs.set(id, (await sourceFile(path, await entry.read())).bytes);
  }
  return keptPlate(record, (id) => blobs.get(id), engine);
}

/** Reads the plate of a zip, from project.json or from what `packStored` has packed. */
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
  if (project === undefined) return storedPlate(text, entryAt, engine);
  const fileAt: FileAt = async (path, named) => {
    const entry = entryAt(path);
    if (entry === undefined) throw missing(name, path);
    checkSize(entry.size, mostBytes.input, path);
    return sourceFile(named, await entry.read());
  };
  return plateOf(text, name, fileAt, engine);
}

const missing = (name: string, path: string): StudioError =>
  new StudioError('BrokenProject', { name }, `${path} is missing: open it together with the project`);

/** Reads the plate of a project.
 * @param file  a zip, or a project's JSON alone
 * @param others  files opened with it, which a JSON may refer to
 * @throws StudioError UnknownFile and PrinterFileHere (archives of something else), BrokenProject; errors of the
 * engine's own */
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
    return await plateOf(new TextDecoder().decode(bytes), name, fileAt, engine);
  } catch (error) {
    if (error instanceof StudioError || !(error instanceof Error)) throw error;
    if (error.name === 'AbortError' || (error.name === 'SillonError' && !isOfFile(error))) throw error;
    throw new StudioError('BrokenProject', { name }, error.message);
  }
}
