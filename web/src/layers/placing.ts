// Places new layers where there is room, or where a hand has dropped them.
import type { Taken } from '../model/free-place.js';
import { boundsOf, frameOf, type Frame, type KnownBox, type Point } from '../model/layer-frame.js';
import { rounded, scaledLayer } from '../model/layer-changes.js';
import { nextLayerId } from '../model/layer-list.js';
import { drawnLayers, type LayerKind, type LayerValues } from '../model/layers.js';
import { pageOf, type Plate, type PlateLayer } from '../model/plate.js';
import type { Studio } from '../studio/studio.js';
import { fillsPage, isMovable } from './arranging.js';

/** Kinds that get a free place. The others are meant to lie over what is there, unless they are copies. */
const placed: readonly LayerKind[] = ['text', 'code', 'drawing', 'picture'];

const patience = 1000; // [ms] to wait for the engine, which may be busy with a plate
const legible = 10; // beads; lower capital letters could not be read
const leastShare = 0.5;
const mostOfPage = 0.8;

/** Boxes of the layers from the engine, or the last known ones where it takes too long. */
async function boxesOf(studio: Studio, plate: Plate): Promise<ReadonlyMap<number, KnownBox>> {
  const late = new Promise<undefined>((resolve) => setTimeout(resolve, patience));
  const told = await Promise.race([studio.services.layerBoxes(plate).catch(() => undefined), late]);
  const known = plate.layers.flatMap((layer): [number, KnownBox][] => {
    const size = told?.get(layer.id)?.size;
    return size === undefined ? [] : [[layer.id, { layer, size }]];
  });
  return new Map([...studio.store.state.layerBoxes, ...known]);
}

/** Radius that letters on a circle leave free about its middle [mm]. */
function freeWithin({ kind, circle, textSize }: PlateLayer): number {
  if (kind !== 'text' || circle === 0) return 0;
  return Math.max(0, circle > 0 ? circle - 0.3 * textSize : -circle - 1.3 * textSize);
}

/** Frames that a new layer should not cover; those that cover the page do not count. */
function takenIn(plate: Plate, layers: readonly PlateLayer[], boxes: ReadonlyMap<number, KnownBox>): Taken[] {
  const page = pageOf(plate);
  return layers
    .filter((layer) => isMovable(plate, layer))
    .map((layer) => ({ ...frameOf(plate, layer, boxes.get(layer.id)), free: freeWithin(layer) }))
    .filter((frame) => !fillsPage(frame, page));
}

/** Width of the strip under a border or rim [mm], where nothing could be read. */
const edgeOf = ({ print, layers }: Plate): number =>
  Math.max(
    print.rim > 0 ? print.rimWidth : 0,
    ...layers.map(({ kind, visible, width }) => (kind === 'border' && visible ? width : 0)),
  );

const spanOf = (frame: Frame): Point => {
  const { low, high } = boundsOf(frame);
  return [high[0] - low[0], high[1] - low[1]];
};

/** Places layers beside those that are there, and reduces them where they must be smaller. The first layer of a plate
 * goes to the middle.
 * @param at  place on the page where a hand has dropped the first of them [mm] */
export async function withPlaces(studio: Studio, values: readonly LayerValues[], at?: Point): Promise<LayerValues[]> {
  const { plate } = studio.store.state;
  const first = nextLayerId(plate);
  const fresh = values.map((value, k): PlateLayer => ({ ...value, id: first + k }));
  const page = pageOf(plate);
  /** Tells whether a layer stays where it is: over the whole page or its middle, along the edge, or around another
   * layer's drawing. */
  const stays = (layer: PlateLayer): boolean => {
    if (placed.includes(layer.kind)) return false;
    const echoes = layer.kind === 'pattern' && layer.pattern === 'echo';
    return echoes || layer.kind === 'border' || layer.at === null || fillsPage(frameOf(plate, layer, undefined), page);
  };
  const others = drawnLayers(plate);
  const fits = fresh.every(
    ({ kind, text, textSize }) => kind !== 'text' || text.length * textSize <= mostOfPage * page[0],
  );
  const alone = at === undefined && fresh.length === 1 && fits;
  if (fresh.every(stays) || (alone && takenIn(plate, others, studio.store.state.layerBoxes).length === 0)) {
    return [...values];
  }
  const boxes = await boxesOf(studio, { ...plate, layers: [...plate.layers, ...fresh] });
  const taken = takenIn(plate, others, boxes);
  const done: LayerValues[] = [];
  for (const layer of fresh) {
    const { id, ...value } = layer;
    if (stays(layer)) {
      done.push(value);
      continue;
    }
    const whole = frameOf(plate, layer, boxes.get(id));
    const span = spanOf(whole);
    const most = Math.min(1, ...([0, 1] as const).map((k) => (mostOfPage * page[k]) / span[k]));
    const size: Point = [most * span[0], most * span[1]];
    const put = (middle: Point, scale: number): void => {
      const changes = scale < 1 ? scaledLayer(layer, whole, [scale, scale]) : {};
      done.push({ ...value, ...changes, at: rounded(middle) });
      const side: Point = [scale * whole.size[0], scale * whole.size[1]];
      taken.push({ ...whole, middle, size: side, free: scale * freeWithin(layer) });
    };
    if (done.length === 0 && at !== undefined) put(at, most);
    else if (taken.length === 0) put(whole.middle, most);
    else {
      const least = layer.kind === 'text' ? (legible * plate.toolpath.spacing) / (most * layer.textSize) : leastShare;
      const wanted = {
        size,
        gap: Math.max(2 * plate.toolpath.spacing, 0.03 * Math.min(...page)),
        edge: edgeOf(plate),
        least: Math.min(1, least),
      };
      const { middle, scale } = await studio.services.freePlace(plate, taken, wanted);
      put(middle, most * scale);
    }
  }
  return done;
}
