// The layers that the engine draws, and what each needs for that.
import type { Layer } from 'sillon';
import { kindsOf } from './layer-kinds.js';
import type { Plate, PlateLayer, SourceFile } from './plate.js';
import { without } from './without.js';

export type LayerKind = Layer['kind'];
export type LayerValues = Omit<PlateLayer, 'id'>;
export type LayerKey = keyof LayerValues;

type Content = Pick<PlateLayer, 'kind' | 'pattern'>;

/** Tells whether the layer's directions come from its file. */
export const needsFile = ({ kind, pattern }: Content): boolean =>
  kind === 'map' || kind === 'tones' || kind === 'drawing' || (kind === 'pattern' && pattern === 'echo');

/** Tells whether the layer is an echo of letters, which needs no file. */
const echoesText = ({ kind, text }: Pick<PlateLayer, 'kind' | 'text'>): boolean => kind === 'pattern' && text !== '';

export const needsText = ({ kind }: Pick<PlateLayer, 'kind'>): boolean => kind === 'text' || kind === 'code';

/** Tells whether the layer has a fill, as the core's `hasFill` does. The others have directions of their own. */
export const hasFill = ({ kind }: Pick<PlateLayer, 'kind'>): boolean =>
  kind === 'text' || kind === 'drawing' || kind === 'border';

export const needsMask = ({ mask }: Pick<PlateLayer, 'mask'>): boolean => mask === 'inside' || mask === 'outside';

/** The first thing that a layer lacks before it can be drawn; the core refuses plates with such layers. */
export function lackOf(layer: PlateLayer): 'file' | 'text' | 'mask' | undefined {
  const lacksFile = layer.kind === 'picture' ? layer.pictures.length === 0 : needsFile(layer) && layer.file === null;
  if (lacksFile && !echoesText(layer)) return 'file';
  if (needsText(layer) && layer.text === '') return 'text';
  return needsMask(layer) && layer.maskFile === null ? 'mask' : undefined;
}

/** Layers that lack nothing, in the order in which the engine has them. */
export const completeLayers = ({ layers }: Pick<Plate, 'layers'>): readonly PlateLayer[] =>
  layers.filter((layer) => lackOf(layer) === undefined);

/** Layers that change the path: complete and visible. */
export const drawnLayers = (plate: Pick<Plate, 'layers'>): readonly PlateLayer[] =>
  completeLayers(plate).filter(({ visible }) => visible);

export function sameLayers(a: Pick<Plate, 'layers'>, b: Pick<Plate, 'layers'>): boolean {
  if (a.layers === b.layers) return true;
  const [one, other] = [drawnLayers(a), drawnLayers(b)];
  return one.length === other.length && one.every((layer, k) => layer === other[k]);
}

/** Layers with pictures that the engine solves for. */
export const pictureLayers = (plate: Pick<Plate, 'layers'>): readonly PlateLayer[] =>
  drawnLayers(plate).filter(({ kind }) => kind === 'picture');

/** Tells whether layers of this kind have the value `key` in the core. */
const isOfKind = (kind: LayerKind, key: string): boolean => (kindsOf[key] ?? kind).split(' ').includes(kind);

/** A layer in the core's form, with only the values that its kind has. @param content  replaces a file by what
 * stands for it */
export function layerInput<Content>(layer: PlateLayer, content: (file: SourceFile) => Content) {
  const { kind, file, maskFile, modeFile, font } = layer;
  const whole = {
    ...without(layer, 'id', 'kind', 'file', 'pictures', 'maskFile', 'modeFile', 'font'),
    font: typeof font === 'string' ? font : content(font),
    ...(file !== null && { file: content(file) }),
    pictures: layer.pictures.map((one) => ({ file: content(one.file), lamp: one.lamp })),
    ...(maskFile !== null && { maskFile: content(maskFile) }),
    ...(modeFile !== null && { modeFile: content(modeFile) }),
  };
  const own = Object.fromEntries(Object.entries(whole).filter(([key]) => isOfKind(kind, key))) as Partial<typeof whole>;
  return { kind, ...own };
}
