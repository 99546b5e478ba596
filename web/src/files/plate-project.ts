// Converts a plate to a project's JSON and back, for project files, links and the browser's storage. The core reads and
// checks the JSON; its section `studio` has what no toolpath needs, such as the files' original names and the visitor's
// own spool.
import type { Engine, LampPicture as ToldPicture, Project } from 'sillon';
import { bodyFrom, toldBody } from '../model/body.js';
import { numberIn, textIn, type Fields } from '../model/check.js';
import { newFileShape, newShape } from '../model/defaults.js';
import { givenSlopes, slopesOf } from '../model/filaments.js';
import { sectionsOf } from '../model/input.js';
import { filesOfLayer, isFontFile, layerDefaults, projectLayer } from '../model/layer-list.js';
import { lackOf, layerInput } from '../model/layers.js';
import { plateSpoolFrom } from '../model/own-spool.js';
import type { Plate, PlateLayer, ShapeSource, SourceFile } from '../model/plate.js';
import { without } from '../model/without.js';
import { stemOf } from './source-file.js';

/** Version of the section `studio`. In version 1 it held directions and strokes that repeated the layers. */
const version = 2;

/** Path of a file in a project. */
export type PathOf = (file: SourceFile) => string;

/** All files of a plate, each once. */
export function filesOf({ shape, layers, body }: Pick<Plate, 'shape' | 'layers' | 'body'>): SourceFile[] {
  const files = [
    ...(shape.kind === 'file' ? [shape.file] : []),
    ...layers.flatMap(filesOfLayer),
    ...(body === undefined ? [] : [body.file]),
  ];
  return [...new Map(files.map((file) => [file.id, file])).values()];
}

// --- Out ---------------------------------------------------------------------------------------------------------------

/** Stand-in for a file that nobody has chosen yet. */
export const nothing: SourceFile = { id: 'nothing', name: '', bytes: new Blob() };
const noText = '-';

/** The layer with stand-ins for what it lacks, since the core reads no incomplete layer. */
function filled(layer: PlateLayer): PlateLayer {
  switch (lackOf(layer)) {
    case 'file':
      return filled(
        layer.kind === 'picture'
          ? { ...layer, pictures: [{ file: nothing, lamp: null }] }
          : { ...layer, file: nothing },
      );
    case 'text':
      return filled({ ...layer, text: noText });
    case 'mask':
      return filled({ ...layer, maskFile: nothing });
    default:
      return layer;
  }
}

/** project.json as data. @param lacking  includes incomplete layers, which no other program would read */
export function projectData(plate: Plate, pathOf: PathOf, lacking = false): object {
  const { name, width, height, spool, layers } = plate;
  const all = lacking ? { ...plate, layers: layers.map(filled) } : plate;
  const sections = sectionsOf(all, (file) => (file === nothing ? nothing.id : pathOf(file)), projectLayer);
  const textless = layers.flatMap((layer, k) => (lackOf({ ...layer, mask: 'own' }) === 'text' ? [k] : []));
  return {
    sillon: 1,
    ...sections,
    pictures: { ...sections.pictures, slopes: givenSlopes(plate) },
    studio: {
      version,
      name,
      page: [width, height],
      files: Object.fromEntries(filesOf(plate).map((file) => [pathOf(file), file.name])),
      ...(lacking && textless.length > 0 && { textless }),
      ...(spool !== undefined && { spool }),
      ...toldBody(plate, pathOf),
    },
  };
}

// --- In ----------------------------------------------------------------------------------------------------------------

/** The engine's calls needed to read a project. */
export type ProjectEngine = Pick<Engine, 'readProject' | 'readShape'>;

/** Finds a file by its path in a project. @returns undefined for a file that nobody has chosen yet */
export type FileAt = (path: string, name: string) => Promise<SourceFile | undefined>;

type GivenLayer = NonNullable<Project['layers']>[number];

/** Paths of the files that a project's layer refers to. */
const pathsIn = ({ file, pictures = [], maskFile, modeFile, font }: GivenLayer): string[] =>
  [file, ...pictures.map((one) => one.file), maskFile, modeFile, font !== undefined && isFontFile(font) && font].filter(
    (path): path is string => typeof path === 'string' && path !== '',
  );

type Files = ReadonlyMap<string, SourceFile>;

/** A layer of a project as the studio keeps it. Files that nobody has chosen yet are null. */
function layerFrom(layer: GivenLayer, id: number, files: Files): PlateLayer {
  const usual = layerDefaults();
  const at = (path: string | undefined): SourceFile | null => files.get(path ?? '') ?? null;
  const { font = usual.font as string, pictures = [] } = layer;
  return {
    ...usual,
    ...layer,
    id,
    file: at(layer.file),
    pictures: pictures.flatMap(({ file, lamp }: ToldPicture) => {
      const found = at(file);
      return found === null ? [] : [{ file: found, lamp }];
    }),
    maskFile: at(layer.maskFile),
    modeFile: at(layer.modeFile),
    font: at(font) ?? font,
  };
}

/** The shape of a project as the studio keeps it; a shape without an outline becomes a rectangle. */
function shapeFrom(shape: Project['shape'], files: Files): ShapeSource {
  const { builtin, unitless } = shape;
  const file = files.get(shape.file);
  const kind = builtin === 'none' ? 'rectangle' : builtin;
  const begun = file === undefined ? newShape(kind) : newFileShape(file, unitless);
  return { ...begun, ...without(shape, 'builtin', 'size', 'pageWidth', 'file') };
}

/** Size of the page: the studio's own where the project still has that size, else the core's. */
async function pageFrom(
  { shape: told }: Project,
  given: unknown,
  { shape, layers }: Pick<Plate, 'shape' | 'layers'>,
  engine: ProjectEngine,
): Promise<[number, number]> {
  // The size excludes what an offset adds to the page.
  const { builtin, size, radius, corners, points, inner, text, font, pageWidth, unitless } = told;
  const most = 10_000; // [mm], the core's own limit
  if (
    Array.isArray(given) &&
    JSON.stringify(shape.kind === 'file' ? [pageWidth, given[1] as unknown] : size) === JSON.stringify(given)
  ) {
    return [numberIn(given[0], 'studio.page', 0.1, most), numberIn(given[1], 'studio.page', 0, most)];
  }
  const own =
    shape.kind === 'file'
      ? { file: shape.file.bytes, pageWidth, unitless }
      : { ...(builtin !== 'none' && { builtin }), size, radius, corners, points, inner, text, font };
  const [lowest] = layers;
  const lender = lowest?.kind === 'map' || lowest?.kind === 'picture' ? lowest : undefined;
  const lent = lender && lackOf(lender) === undefined ? [layerInput(lender, ({ bytes }) => bytes)] : [];
  const { page } = await engine.readShape(own, lent);
  return [page[0], page[1]];
}

/** Reads a plate from a project's JSON.
 * @param name  file name from which the plate is named where the project gives no name
 * @throws errors of the engine and of `fileAt`; Unfit for the studio's own section */
export async function plateOf(text: string, name: string, fileAt: FileAt, engine: ProjectEngine): Promise<Plate> {
  const project = await engine.readProject(text);
  const studio = (project.studio ?? { version }) as Fields;
  numberIn(studio['version'], 'studio.version', 1, version);
  const names = (studio['files'] ?? {}) as Fields;
  const told = project.layers ?? [];
  const files = new Map<string, SourceFile>();
  for (const path of new Set([project.shape.file, ...told.flatMap(pathsIn)])) {
    if (path === '') continue;
    const file = await fileAt(path, textIn(names[path] ?? path, `studio.files.${path}`, 1000));
    if (file !== undefined) files.set(path, file);
  }
  const textless = Array.isArray(studio['textless']) ? (studio['textless'] as unknown[]) : [];
  const layers = told
    .map((layer, k) => layerFrom(layer, k + 1, files))
    .map((layer, k) => (textless.includes(k) ? { ...layer, text: '' } : layer));
  const shape = shapeFrom(project.shape, files);
  const [width, height] = await pageFrom(project, studio['page'], { shape, layers }, engine);
  const { profile, filament, ...printer } = project.printer;
  const plate: Plate = {
    name: textIn(studio['name'] ?? stemOf(name).slice(0, 200), 'studio.name', 200),
    shape,
    width,
    height,
    layers,
    pictures: project.pictures,
    toolpath: project.toolpath,
    print: project.print,
    printer: { ...printer, ...(profile !== '' && { profile }), ...(filament !== '' && { filament }) },
    ...plateSpoolFrom(studio['spool']),
    ...(await bodyFrom(studio['body'], (path) => fileAt(path, textIn(names[path] ?? path, 'studio.files', 1000)))),
  };
  if (plate.spool === undefined) return plate;
  // The slopes belong to the visitor's own spool only while the project still has that spool's values.
  const own = { ...plate, pictures: { ...plate.pictures, slopes: null } };
  return String(slopesOf(own)) === String(project.pictures.slopes) ? own : without(plate, 'spool');
}
