// Reads bodies made for slicers as triangles: STL, and 3MF with all parts in their places. Anybody may have made the
// file.
import { openZip, type Entry } from '../files/unzip.js';
import { StudioError } from '../model/problem.js';

/** Corners of triangles [mm], nine numbers for each triangle. */
export type Mesh = Float64Array;

const mostBytes = 64e6; // [bytes], the engine's limit for one input
const header = 84; // bytes of a binary STL before its triangles
const facet = 50; // bytes of one triangle

const broken = (name: string): StudioError => new StudioError('InvalidFile', { name });

// --- STL -----------------------------------------------------------------------------------------------------------------

/** Reads a binary or a text STL. @throws StudioError InvalidFile */
function fromStl(bytes: Uint8Array<ArrayBuffer>, name: string): Mesh {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = bytes.length >= header ? view.getUint32(80, true) : 0;
  if (bytes.length === header + facet * count && count > 0) {
    const mesh = new Float64Array(9 * count);
    for (let k = 0; k < mesh.length; ++k) {
      mesh[k] = view.getFloat32(header + facet * Math.floor(k / 9) + 12 + 4 * (k % 9), true);
    }
    return mesh;
  }
  const text = new TextDecoder().decode(bytes);
  if (!/^\s*solid/.test(text)) throw broken(name);
  const corners: number[] = [];
  for (const [, x, y, z] of text.matchAll(/^\s*vertex\s+(\S+)\s+(\S+)\s+(\S+)/gm))
    corners.push(Number(x), Number(y), Number(z));
  if (corners.length === 0 || corners.length % 9 !== 0) throw broken(name);
  return Float64Array.from(corners);
}

/** Writes a binary STL, which the engine reads. */
export function stlOf(mesh: Mesh): Blob {
  const count = mesh.length / 9;
  const view = new DataView(new ArrayBuffer(header + facet * count));
  view.setUint32(80, count, true);
  for (let k = 0; k < mesh.length; ++k) {
    view.setFloat32(header + facet * Math.floor(k / 9) + 12 + 4 * (k % 9), mesh[k] as number, true);
  }
  return new Blob([view.buffer], { type: 'model/stl' });
}

// --- 3MF -----------------------------------------------------------------------------------------------------------------

/** Four rows of three numbers: a 3 × 3 matrix for points as row vectors, and the offset. */
type Transform = readonly number[];

const identity: Transform = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
const millimetres: Readonly<Record<string, number>> = {
  micron: 0.001,
  millimeter: 1,
  centimeter: 10,
  inch: 25.4,
  foot: 304.8,
  meter: 1000,
};
const deepest = 16; // levels of nested parts

const patterns = new Map<string, RegExp>(); // compiled once, since millions of corners need the same ones

function attribute(tag: string, name: string): string {
  const pattern = patterns.get(name) ?? new RegExp(`\\s${name}="([^"]*)"`);
  patterns.set(name, pattern);
  return pattern.exec(tag)?.[1] ?? '';
}

function transformOf(tag: string): Transform {
  const given = attribute(tag, 'transform').trim().split(/\s+/).map(Number);
  return given.length === 12 && given.every(Number.isFinite) ? given : identity;
}

/** The transform that applies `a` first and then `b`. */
function joined(a: Transform, b: Transform): Transform {
  const at = (t: Transform, row: number, column: number): number => t[3 * row + column] as number;
  return identity.map((_, k) => {
    const [row, column] = [Math.floor(k / 3), k % 3];
    const sum = [0, 1, 2].reduce((all, j) => all + at(a, row, j) * at(b, j, column), 0);
    return row === 3 ? sum + at(b, 3, column) : sum;
  });
}

interface Part {
  path: string;
  id: string;
  transform: Transform;
}

interface Solid {
  /** Corners of the solid's own triangles, nine numbers each, without those of its parts. */
  own: number[];
  parts: Part[];
}

interface Model {
  scale: number;
  objects: Map<string, Solid>;
  build: Part[];
}

/** Reads one model file of a 3MF. @param skipped  ranges of triangles, by object, that only modify how others are
 * printed */
function modelIn(text: string, path: string, skipped: ReadonlyMap<string, readonly [number, number][]>): Model {
  const objects = new Map<string, Solid>();
  const partOf = (tag: string): Part => ({
    path: attribute(tag, '(?:\\w+:)?path') || path,
    id: attribute(tag, 'objectid'),
    transform: transformOf(tag),
  });
  for (const [all, head = '', content = ''] of text.matchAll(/<object(\s[^>]*)>([^]*?)<\/object>/g)) {
    if (all === '' || /\stype="(?:support|other)"/.test(head)) continue;
    const points = Array.from(content.matchAll(/<vertex\s[^>]*>/g), ([tag]) =>
      ['x', 'y', 'z'].map((axis) => Number(attribute(tag, axis))),
    );
    const left = skipped.get(attribute(head, 'id')) ?? [];
    const triangles = Array.from(content.matchAll(/<triangle\s[^>]*>/g), ([tag]) => tag).filter(
      (_, k) => !left.some(([first, last]) => k >= first && k <= last),
    );
    const own = triangles.flatMap((tag) =>
      ['v1', 'v2', 'v3'].flatMap((corner) => points[Number(attribute(tag, corner))] ?? [NaN, NaN, NaN]),
    );
    objects.set(attribute(head, 'id'), { own, parts: (content.match(/<component\s[^>]*>/g) ?? []).map(partOf) });
  }
  const build = /<build[^>]*>([^]*?)<\/build>/.exec(text)?.[1] ?? '';
  const items = (build.match(/<item\s[^>]*>/g) ?? []).filter((tag) => attribute(tag, 'printable') !== '0');
  const unit = /<model\s[^>]*>/.exec(text)?.[0] ?? '';
  return { scale: millimetres[attribute(unit, 'unit')] ?? 1, objects, build: items.map(partOf) };
}

/** Ranges of modifiers by object, from PrusaSlicer's settings: it keeps modifiers among an object's triangles. */
function modifiersIn(config: string): Map<string, [number, number][]> {
  const found = new Map<string, [number, number][]>();
  for (const [, head = '', content = ''] of config.matchAll(/<object(\s[^>]*)>([^]*?)<\/object>/g)) {
    const ranges = Array.from(content.matchAll(/<volume(\s[^>]*)>([^]*?)<\/volume>/g)).flatMap(
      ([, tag = '', settings = '']): [number, number][] =>
        /key="volume_type" value="(?!ModelPart)|key="modifier" value="1"/.test(settings)
          ? [[Number(attribute(tag, 'firstid')), Number(attribute(tag, 'lastid'))]]
          : [],
    );
    found.set(attribute(head, 'id'), ranges);
  }
  return found;
}

/** Ids of modifiers in files of Bambu Studio and OrcaSlicer, which keep them as separate parts. */
const modifierParts = (config: string): Set<string> =>
  new Set(
    Array.from(config.matchAll(/<part(\s[^>]*)>/g), ([, tag = '']) => tag)
      .filter((tag) => !['normal_part', ''].includes(attribute(tag, 'subtype')))
      .map((tag) => attribute(tag, 'id')),
  );

/** Reads all printable parts of a 3MF. @throws StudioError InvalidFile, TooLarge; errors of `openZip` */
async function from3mf(bytes: Uint8Array<ArrayBuffer>, name: string): Promise<Mesh> {
  const entries = openZip(bytes);
  const textOf = async (entry: Entry | undefined): Promise<string> => {
    if (entry === undefined) return '';
    if (entry.size > 8 * mostBytes) throw new StudioError('TooLarge', { name });
    return new TextDecoder().decode(await entry.read());
  };
  const plain = (path: string): string => path.replace(/^\//, '');
  const skipped = modifiersIn(await textOf(entries.get('Metadata/Slic3r_PE_model.config')));
  const left = modifierParts(await textOf(entries.get('Metadata/model_settings.config')));
  const models = new Map<string, Model>();
  for (const [path, entry] of entries) {
    if (path.endsWith('.model')) models.set(path, modelIn(await textOf(entry), path, skipped));
  }
  const root = models.get('3D/3dmodel.model') ?? [...models.values()][0];
  if (root === undefined) throw broken(name);
  const corners: number[] = [];
  const add = ({ path, id, transform }: Part, depth: number): void => {
    const model = models.get(plain(path));
    const solid = model?.objects.get(id);
    if (model === undefined || solid === undefined || depth > deepest) return;
    const t = transform as number[];
    for (let k = 0; k < solid.own.length; k += 3) {
      const [x, y, z] = solid.own.slice(k, k + 3) as [number, number, number];
      for (let axis = 0; axis < 3; ++axis) {
        const [a, b, c, d] = [t[axis], t[3 + axis], t[6 + axis], t[9 + axis]] as [number, number, number, number];
        corners.push(model.scale * (x * a + y * b + z * c + d));
      }
    }
    for (const part of solid.parts) {
      if (!left.has(part.id)) add({ ...part, transform: joined(part.transform, transform) }, depth + 1);
    }
  };
  for (const item of root.build) add(item, 0);
  if (corners.length === 0) throw broken(name);
  return Float64Array.from(corners);
}

/** Reads a body from a file. @throws StudioError InvalidFile, TooLarge */
export async function readBody(file: File): Promise<Mesh> {
  const { name } = file;
  if (file.size > mostBytes) throw new StudioError('TooLarge', { name });
  let mesh: Mesh;
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    mesh = /\.3mf$/i.test(name) ? await from3mf(bytes, name) : fromStl(bytes, name);
  } catch (error) {
    if (error instanceof StudioError) throw error;
    throw broken(name);
  }
  if (!mesh.every((value) => Math.abs(value) <= 10_000)) throw broken(name);
  return mesh;
}
