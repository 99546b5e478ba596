// Where the engine puts each layer of a plate.
import type { Engine, PlateInput } from 'sillon';
import { sectionsOf } from '../model/input.js';
import type { LayerBox } from '../model/layer-frame.js';
import { completeLayers } from '../model/layers.js';
import { pageOf, type Plate } from '../model/plate.js';

/** The engine's call. @returns a box for each of the layers, in their order */
interface ReadsLayers {
  readLayers(plate: PlateInput): Promise<LayerBox[]>;
}

/** By the layers' ids; layers that lack something have none. Hidden ones have theirs.
 * @throws what the engine refuses */
export async function layerBoxes(plate: Plate, engine: Engine): Promise<Map<number, LayerBox>> {
  const layers = completeLayers(plate).map((layer) => ({ ...layer, visible: true }));
  if (layers.length === 0) return new Map();
  const [, height] = pageOf(plate);
  const { shape, layers: given = [] } = sectionsOf({ ...plate, height, layers }, ({ bytes }) => bytes);
  const boxes = await (engine as Engine & ReadsLayers).readLayers({ shape, layers: given });
  return new Map(layers.flatMap(({ id }, k) => (boxes[k] === undefined ? [] : [[id, boxes[k]] as const])));
}
