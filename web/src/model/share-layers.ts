// The layers that a link can carry: those without files, and those whose files are small, or can be made so.
import { filesOfLayer, toldLayer } from './layer-list.js';
import { completeLayers } from './layers.js';
import type { Plate, PlateLayer, SourceFile } from './plate.js';

/** All layers together say at most so much, beside their files [characters]. */
const mostWords = 3000;

const svgType = 'image/svg+xml';

/** A file made small enough; undefined: it cannot be. @param most  [bytes] */
export type Small = (file: SourceFile, most: number) => Promise<Uint8Array | undefined>;

/** Drawings travel as they are, and colours that stand for directions, which grey pictures lack. */
const isWhole = ({ kind, by, file }: PlateLayer, one: SourceFile): boolean =>
  one.bytes.type === svgType || (kind === 'tones' && by === 'colours' && one === file);

/** Maps and pictures of modes would tell something else when they are small, and fonts have no small form. */
async function smallFile(
  layer: PlateLayer,
  file: SourceFile,
  most: number,
  shrink: Small,
): Promise<Uint8Array | undefined> {
  const exact = file === layer.font || file === layer.modeFile || (file === layer.file && layer.kind === 'map');
  if (exact) return undefined;
  if (!isWhole(layer, file)) return shrink(file, most);
  return file.bytes.size > most ? undefined : new Uint8Array(await file.bytes.arrayBuffer());
}

export interface ToldLayers {
  told: object[];
  /** Some had to stay behind. */
  lacks: boolean;
  /** Pictures among them were made smaller. */
  shrunk: boolean;
}

/** @param room  for files [bytes] @param toldFile  what stands for a file */
export async function toldLayers(
  plate: Plate,
  room: number,
  shrink: Small | undefined,
  toldFile: (name: string, bytes: Uint8Array) => object,
): Promise<ToldLayers> {
  const layers = completeLayers(plate);
  const found: ToldLayers = { told: [], lacks: layers.length < plate.layers.length, shrunk: false };
  let [left, waiting, words] = [room, layers.flatMap(filesOfLayer).length, 0];
  for (const layer of layers) {
    const files = new Map<SourceFile, object>();
    for (const file of filesOfLayer(layer)) {
      const bytes = shrink && (await smallFile(layer, file, left / waiting, shrink));
      --waiting;
      if (bytes === undefined) continue;
      left -= bytes.length;
      files.set(file, toldFile(file.name, bytes));
    }
    const whole = filesOfLayer(layer).every((file) => files.has(file));
    const length = JSON.stringify(toldLayer(layer, () => undefined)).length;
    if (!whole || words + length > mostWords) {
      found.lacks = true;
      continue;
    }
    words += length;
    found.shrunk ||= [...files.keys()].some((file) => !isWhole(layer, file));
    found.told.push(toldLayer(layer, (file) => files.get(file)));
  }
  return found;
}
