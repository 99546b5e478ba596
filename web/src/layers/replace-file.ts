// Replaces the files of layers.
import { refilled, uncropped } from '../model/layer-changes.js';
import { isExample, type PlateLayer, type SourceFile } from '../model/plate.js';
import type { Studio } from '../studio/studio.js';
import { frameIn } from './arranging.js';
import { changeIn } from './layer-field.js';

const side = 100; // [mm], wide enough to measure proportions

/** Width divided by height of what the engine finds in the layer's file.
 * @returns undefined where it finds nothing, which is reported where the plate is made */
async function proportionOf(studio: Studio, layer: PlateLayer): Promise<number | undefined> {
  const wide: PlateLayer = { ...layer, ...uncropped, size: [side, 0] };
  try {
    const boxes = await studio.services.layerBoxes({ ...studio.store.state.plate, layers: [wide] });
    const [width, height] = boxes.get(layer.id)?.size ?? [0, 0];
    return width > 0 && height > 0 ? width / height : undefined;
  } catch {
    return undefined;
  }
}

/** Replaces a layer's file. An echo follows the drawing of another layer, so layers of other kinds with the same
 * file change, too. */
export async function replaceFile(studio: Studio, layer: PlateLayer, file: SourceFile): Promise<void> {
  const before = layer.file;
  const proportion = await proportionOf(studio, { ...layer, file });
  const { state } = studio.store;
  const goes = ({ id, kind, file: theirs }: PlateLayer): boolean =>
    id === layer.id || (before !== null && kind !== layer.kind && theirs?.id === before.id);
  const filled = (one: PlateLayer): PlateLayer => ({
    ...one,
    file,
    ...(before === null || proportion === undefined ? uncropped : refilled(one, frameIn(state, one), proportion)),
    ...(before !== null && isExample(before) && { rotation: 0 }), // the tilt was the example's own
  });
  studio.settle();
  studio.change((plate) => ({ ...plate, layers: plate.layers.map((one) => (goes(one) ? filled(one) : one)) }));
}

/** Replaces one picture of a layer. The layer's box has the proportions of its first picture. */
export async function replacePicture(studio: Studio, layer: PlateLayer, k: number, file: SourceFile): Promise<void> {
  const before = layer.pictures[k]?.file;
  const pictures = layer.pictures.map((one, other) => (other === k ? { ...one, file } : one));
  const proportion = k > 0 ? undefined : await proportionOf(studio, { ...layer, pictures });
  const { state } = studio.store;
  studio.settle();
  changeIn(studio, layer, (one) => ({
    pictures,
    ...(proportion !== undefined && refilled(one, frameIn(state, one), proportion)),
    ...(k === 0 && before !== undefined && isExample(before) && { rotation: 0 }),
  }));
}
