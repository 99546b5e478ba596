// The layers of a plate: the first values of each kind, the form that projects keep, and changes of the list.
import { defaultsOf } from './defaults.js';
import { mostLayers } from './facts.js';
import { hasFill, layerInput, type LayerKey, type LayerKind, type LayerValues } from './layers.js';
import { pageOf, type PageParts, type Plate, type PlateLayer, type SourceFile } from './plate.js';
import { layerTable } from './layer-table.js';

export { mostLayers };

export const layerKinds: readonly LayerKind[] = layerTable.kind.choices;

/** Tells font files by their endings, as the core does. */
export const isFontFile = (name: string): boolean => /\.(?:ttf|otf|ttc|woff2?)$/i.test(name);

const usual: LayerValues = {
  ...defaultsOf<LayerValues>(layerTable),
  file: null,
  pictures: [],
  maskFile: null,
  modeFile: null,
  colours: [],
  strokes: [],
};

export const layerKeys = Object.keys(usual) as LayerKey[];

/** A copy of the values that the core uses where none are given. */
export const layerDefaults = (): LayerValues => structuredClone(usual);

const tenths = (length: number): number => Math.round(10 * length) / 10;

/** First values of each kind, for a page of this size [mm]. A new layer shows at once against the directions below,
 * and is small enough to be moved. */
const first: Partial<Record<LayerKind, (page: readonly [number, number]) => Partial<LayerValues>>> = {
  direction: ([width, height]) => ({ angle: 45, size: [tenths(width / 2), tenths(height / 2)] }),
  picture: ([width, height]) => ({ size: width < height ? [tenths(0.6 * width), 0] : [0, tenths(0.6 * height)] }),
  text: (page) => ({ text: 'Abc', textSize: Math.max(4, Math.round(Math.min(...page) / 6)) }),
  code: (page) => ({ text: 'https://', size: [tenths(Math.min(...page) / 2), 0] }),
  pattern: () => ({ angle: 90 }),
  drawing: ([width, height]) => ({
    size: width < height ? [tenths(width / 2), 0] : [0, tenths(height / 2)],
  }),
  border: () => ({ fill: 'along' }),
  tones: () => ({ from: 60, to: 150 }),
};

/** A layer with the first values of its kind. @param given  values to use instead */
export const newLayer = (plate: PageParts, kind: LayerKind, given: Partial<LayerValues> = {}): LayerValues => ({
  ...layerDefaults(),
  kind,
  ...first[kind]?.(pageOf(plate)),
  ...given,
});

// --- Files and projects --------------------------------------------------------------------------------------------------

/** All files of a layer: content, pictures, mask, modes and font. */
export const filesOfLayer = ({ file, pictures, maskFile, modeFile, font }: PlateLayer): SourceFile[] =>
  [file, ...pictures.map((one) => one.file), maskFile, modeFile, font].filter(
    (one): one is SourceFile => one !== null && typeof one !== 'string',
  );

/** Values that differ from the defaults. The fill is kept beside an angle even at its default, since the core would
 * otherwise take the fill to be 'angle'. */
function differing(layer: PlateLayer, whole: Readonly<Record<string, unknown>>): object {
  const differs = (key: LayerKey): boolean => JSON.stringify(layer[key]) !== JSON.stringify(usual[key]);
  const angled = hasFill(layer) && differs('angle');
  const told = (key: string): boolean =>
    key === 'kind' || key === 'pictures' || differs(key as LayerKey) || (angled && key === 'fill');
  return Object.fromEntries(Object.entries(whole).filter(([key]) => told(key)));
}

/** A layer in the form that projects keep. @param content  as for `layerInput` */
export const projectLayer = (layer: PlateLayer, content: (file: SourceFile) => unknown): object =>
  differing(layer, layerInput(layer, content));

// --- The list ------------------------------------------------------------------------------------------------------------

export const layerOf = ({ layers }: Pick<Plate, 'layers'>, id: number | undefined): PlateLayer | undefined =>
  layers.find((layer) => layer.id === id);

/** The id of the next new layer. */
export const nextLayerId = ({ layers }: Pick<Plate, 'layers'>): number =>
  1 + layers.reduce((most, { id }) => Math.max(most, id), 0);

/** Adds a layer on top, with the id `nextLayerId`; the same plate where there is no room for it. */
export const withLayer = (plate: Plate, values: LayerValues): Plate =>
  plate.layers.length >= mostLayers
    ? plate
    : { ...plate, layers: [...plate.layers, { ...values, id: nextLayerId(plate) }] };

export const changeLayer = (plate: Plate, id: number, change: (layer: PlateLayer) => Partial<LayerValues>): Plate => ({
  ...plate,
  layers: plate.layers.map((layer) => (layer.id === id ? { ...layer, ...change(layer) } : layer)),
});

export const withoutLayer = (plate: Plate, id: number): Plate => ({
  ...plate,
  layers: plate.layers.filter((layer) => layer.id !== id),
});

/** Moves a layer up by `by` places; the same plate where it cannot go there. */
export function raised(plate: Plate, id: number, by: number): Plate {
  const from = plate.layers.findIndex((layer) => layer.id === id);
  const layer = plate.layers[from];
  const to = Math.min(plate.layers.length - 1, Math.max(0, from + by));
  if (layer === undefined || to === from) return plate;
  const layers = plate.layers.filter((one) => one !== layer);
  layers.splice(to, 0, layer);
  return { ...plate, layers };
}

/** Adds a copy above a layer, with the id `nextLayerId`. @param values  the copy's values */
export const duplicated = (plate: Plate, id: number, values: LayerValues): Plate => ({
  ...plate,
  layers: plate.layers.flatMap((layer) => (layer.id === id ? [layer, { ...values, id: nextLayerId(plate) }] : [layer])),
});

/** The middle of a layer's box or circle on the page [mm]. */
export function middleOf(plate: PageParts, { at }: Pick<PlateLayer, 'at'>): [number, number] {
  const [width, height] = pageOf(plate);
  return at ?? [width / 2, height / 2];
}
