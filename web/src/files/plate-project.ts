// A plate as a project's JSON, and back: in project files, in links and in the browser's storage alike. The core reads and checks
// it; a section `studio` has what no toolpath needs: names of files as they came, a spool of one's own.
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

/** The first had directions and strokes of the studio's own beside the layers, which told the same. */
const version = 2;

/** The stand-in for a file. */
export type PathOf = (file: SourceFile) => string;

/** Each once. */
export function filesOf({ shape, layers, body }: Pick<Plate, 'shape' | 'layers' | 'body'>): SourceFile[] {
  const files = [
    ...(shape.kind === 'file' ? [shape.file] : []),
    ...layers.flatMap(filesOfLayer),
    ...(body === undefined ? [] : [body.file]),
  ];
  return [...new Map(files.map((file) => [file.id, file])).values()];
}

// --- Out ---------------------------------------------------------------------------------------------------------------

/** Stands for a file that nobody has chosen yet. */
export const nothing: SourceFile = { id: 'nothing', name: '', bytes: new Blob() };
const noText = '-';

/** The layer with stand-ins for what it lacks, as the core reads no layer that lacks anything. */
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

/** project.json as data. @param lacking  with the layers that lack something, which no other program would read */
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

/** The engine's calls that reading a project takes. */
export type ProjectEngine = Pick<Engine, 'readProject' | 'readShape'>;

/** A file by its path as it stands in a project. @returns undefined for what nobody has chosen yet */
export type FileAt = (path: string, name: string) => Promise<SourceFile | undefined>;

type GivenLayer = NonNullable<Project['layers']>[number];

const pathsIn = ({ file, pictures = [], maskFile, modeFile, font }: GivenLayer): string[] =>
  [file, ...pictures.map((one) => one.file), maskFile, modeFile, font !== undefined && isFontFile(font) && font].filter(
    (path): path is string => typeof path === 'string' && path !== '',
  );

type Files = ReadonlyMap<string, SourceFile>;

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

function shapeFrom(shape: Project['shape'], files: Files): ShapeSource {
  const { builtin, unitless } = shape;
  const file = files.get(shape.file);
  const kind = builtin === 'none' ? 'rectangle' : builtin;
  const begun = file === undefined ? newShape(kind) : newFileShape(file, unitless);
  return { ...begun, ...without(shape, 'builtin', 'size', 'pageWidth', 'file') };
}

/** The page as it stood in the studio, unless the project has another size since; else as the core makes it. */
async function pageFrom(
  { shape: told }: Project,
  given: unknown,
  { shape, layers }: Pick<Plate, 'shape' | 'layers'>,
  engine: ProjectEngine,
): Promise<[number, number]> {
  // The page is that without what an offset adds to it.
  const { builtin, size, radius, corners, points, inner, text, font, pageWidth, unitless } = told;
  const most = 10_000; // [mm] as the core has it
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

/** @param name  of the plate, where the project tells none
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
  // Slopes of one's own spool are the plate's as long as the project has them.
  const own = { ...plate, pictures: { ...plate.pictures, slopes: null } };
  return String(slopesOf(own)) === String(project.pictures.slopes) ? own : without(plate, 'spool');
}
