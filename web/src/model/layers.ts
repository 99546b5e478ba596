// The layers of a plate that the engine draws.
import type { Layer } from 'sillon';
import { kindsOf } from './layer-kinds.js';
import type { Plate, PlateLayer, SourceFile } from './plate.js';
import { without } from './without.js';

export type LayerKind = Layer['kind'];
export type LayerValues = Omit<PlateLayer, 'id'>;
export type LayerKey = keyof LayerValues;

/** Tells whether the layer's directions come from its file. */
export const needsFile = ({ kind, pattern }: Pick<PlateLayer, 'kind' | 'pattern'>): boolean =>
  kind === 'map' ||
  kind === 'picture' ||
  kind === 'tones' ||
  kind === 'drawing' ||
  (kind === 'pattern' && pattern === 'echo');

/** An echo without a file follows letters. */
const echoesText = ({ kind, text }: Pick<PlateLayer, 'kind' | 'text'>): boolean => kind === 'pattern' && text !== '';

export const needsText = ({ kind }: Pick<PlateLayer, 'kind'>): boolean => kind === 'text' || kind === 'code';

/** Tells whether the layer has a fill, as the core's hasFill; the others have their own directions. */
export const hasFill = ({ kind }: Pick<PlateLayer, 'kind'>): boolean =>
  kind === 'text' || kind === 'drawing' || kind === 'border';

export const needsMask = ({ mask }: Pick<PlateLayer, 'mask'>): boolean => mask === 'inside' || mask === 'outside';

/** The first thing that a layer lacks to be drawn; the core refuses plates with such layers. */
export function lackOf(layer: PlateLayer): 'file' | 'text' | 'mask' | undefined {
  if (needsFile(layer) && layer.file === null && !echoesText(layer)) return 'file';
  if (needsText(layer) && layer.text === '') return 'text';
  return needsMask(layer) && layer.maskFile === null ? 'mask' : undefined;
}

export const completeLayers = ({ layers }: Pick<Plate, 'layers'>): readonly PlateLayer[] =>
  layers.filter((layer) => lackOf(layer) === undefined);

/** These change the path. */
export const drawnLayers = (plate: Pick<Plate, 'layers'>): readonly PlateLayer[] =>
  completeLayers(plate).filter(({ visible }) => visible);

export function sameLayers(a: Pick<Plate, 'layers'>, b: Pick<Plate, 'layers'>): boolean {
  if (a.layers === b.layers) return true;
  const [one, other] = [drawnLayers(a), drawnLayers(b)];
  return one.length === other.length && one.every((layer, k) => layer === other[k]);
}

/** Pictures among the layers are solved for, as those under lamps are. */
export const showsPictures = (plate: Pick<Plate, 'layers'>): boolean =>
  drawnLayers(plate).some(({ kind }) => kind === 'picture');

/** Tells whether layers of a kind have a value of the core's. */
const isOfKind = (kind: LayerKind, key: string): boolean => (kindsOf[key] ?? kind).split(' ').includes(kind);

/** A layer as the core has it: what its kind has. @param content  the stand-in for a file */
export function layerInput<Content>(layer: PlateLayer, content: (file: SourceFile) => Content) {
  const { kind, file, lamp, others } = layer;
  const lit = file === null ? [] : [{ file, lamp }, ...others];
  const whole = {
    ...without(layer, 'id', 'kind', 'file', 'lamp', 'others', 'maskFile', 'modeFile', 'font'),
    font: typeof layer.font === 'string' ? layer.font : content(layer.font),
    ...(file !== null && { file: content(file) }),
    pictures: lit.map((one) => ({ file: content(one.file), lamp: one.lamp })),
    ...(layer.maskFile !== null && { maskFile: content(layer.maskFile) }),
    ...(layer.modeFile !== null && { modeFile: content(layer.modeFile) }),
  };
  const own = Object.fromEntries(Object.entries(whole).filter(([key]) => isOfKind(kind, key))) as Partial<typeof whole>;
  return { kind, ...own };
}
