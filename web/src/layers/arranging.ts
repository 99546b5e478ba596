// Decides when a hand over the plate arranges layers, and which layer lies under it.
import { contains, frameOf, type Frame, type Point } from '../model/layer-frame.js';
import { groundOf } from '../model/fills.js';
import { layerOf } from '../model/layer-list.js';
import { pageOf, type Plate, type PlateLayer } from '../model/plate.js';
import { offers, type Shown } from '../studio/shown.js';

/** Tells whether hands arrange layers: the panel is open, or a layer is still chosen where a narrow window has
 * closed the panel. Brushes come first. */
export const arranges = (state: Readonly<Shown>): boolean =>
  offers(state, 'layers') &&
  state.tool === 'pan' &&
  (state.panel === 'layers' || (state.panel === '' && state.layer !== undefined));

export const chosenLayer = ({ plate, layer }: Readonly<Shown>): PlateLayer | undefined => layerOf(plate, layer);

export const frameIn = ({ plate, layerBoxes }: Readonly<Shown>, layer: PlateLayer): Frame =>
  frameOf(plate, layer, layerBoxes.get(layer.id));

/** Tells whether a hand may move the layer. Borders, strokes and the ground have no place of their own. */
export const isMovable = (plate: Plate, layer: PlateLayer): boolean =>
  layer.kind !== 'border' && layer.kind !== 'strokes' && layer !== groundOf(plate);

/** Tells whether the frame covers the whole page. */
export const fillsPage = ({ size }: Frame, page: Point): boolean => size[0] >= page[0] && size[1] >= page[1];

/** The topmost layer whose box contains the place. Layers that cover the page come last, since they are everywhere.
 * @param reach  margin around a box that counts, too [mm] */
export function layerAt(state: Readonly<Shown>, place: Point, reach: number): PlateLayer | undefined {
  const page = pageOf(state.plate);
  const found = [...state.plate.layers]
    .reverse()
    .filter((layer) => layer.visible && (isMovable(state.plate, layer) || layer.kind === 'border'))
    .filter((layer) => contains(frameIn(state, layer), place, reach));
  return found.find((layer) => !fillsPage(frameIn(state, layer), page)) ?? found[0];
}
