// Asks the engine for the boxes of a plate's layers.
import type { Engine, LayerInput, PlacedLayer } from 'sillon';
import { sectionsOf } from '../model/input.js';
import { completeLayers } from '../model/layers.js';
import { pageOf, type Plate } from '../model/plate.js';

/** Returns the boxes by layer id; incomplete layers have none.
 * @throws errors of the engine */
export async function layerBoxes(plate: Plate, engine: Engine): Promise<Map<number, PlacedLayer>> {
  const layers = completeLayers(plate);
  if (layers.length === 0) return new Map();
  const [, height] = pageOf(plate);
  const { shape, layers: given } = sectionsOf({ ...plate, height }, ({ bytes }) => bytes);
  const boxes = await engine.placeLayers({ shape, layers: given as LayerInput[] }, { spacing: plate.toolpath.spacing });
  return new Map(layers.flatMap(({ id }, k) => (boxes[k] === undefined ? [] : [[id, boxes[k]] as const])));
}
