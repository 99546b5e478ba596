// The ground of a plate: its lowest layer, where that fills the page. Lists the fills that it can have and how each
// begins.
import { layerDefaults, nextLayerId } from './layer-list.js';
import { lackOf, type LayerValues } from './layers.js';
import { mostLayers } from './facts.js';
import { pageOf, type PageParts, type Plate, type PlateLayer, type SourceFile } from './plate.js';
import { without } from './without.js';

/** Fills whose directions come from pictures. */
export const pictureFills = ['picture', 'brightness', 'edges', 'levels', 'colours', 'map'] as const;
export const patternFills = ['direction', 'radial', 'spiral', 'waves', 'noise'] as const;
export type PictureFill = (typeof pictureFills)[number];
export type Fill = PictureFill | (typeof patternFills)[number];

export const isPictureFill = (fill: Fill): fill is PictureFill => (pictureFills as readonly Fill[]).includes(fill);

/** The fill of a layer. @returns undefined for layers that have a form of their own */
export function fillOf({ kind, pattern, by }: Pick<PlateLayer, 'kind' | 'pattern' | 'by'>): Fill | undefined {
  switch (kind) {
    case 'picture':
    case 'map':
    case 'direction':
      return kind;
    case 'tones':
      return by;
    case 'pattern':
      return pattern === 'echo' ? undefined : pattern;
    default:
      return undefined;
  }
}

/** The plate's ground. @returns undefined where the lowest layer does not fill the page */
export function groundOf({ layers }: Pick<Plate, 'layers'>): PlateLayer | undefined {
  const [lowest] = layers;
  if (lowest === undefined || fillOf(lowest) === undefined) return undefined;
  const { at, size, rotation, mask } = lowest;
  const whole = size[0] + size[1] === 0 && (mask === 'page' || (mask === 'own' && at === null && rotation === 0));
  return whole ? lowest : undefined;
}

export const groundFill = (plate: Pick<Plate, 'layers'>): Fill | undefined => {
  const ground = groundOf(plate);
  return ground && fillOf(ground);
};

/** Tells whether there is no layer to choose, to order or to show again: the plate has nothing but a visible ground,
 * or no layer. */
export const isBare = (plate: Pick<Plate, 'layers'>): boolean =>
  plate.layers.length === 0 || (plate.layers.length === 1 && groundOf(plate)?.visible === true);

/** Files that the layer's directions come from. */
export const toldFrom = ({ file, pictures }: PlateLayer): readonly SourceFile[] =>
  file === null ? pictures.map((one) => one.file) : [file];

/** Pictures of the ground that are solved for lamps; empty where it has none. */
export function groundPictures(plate: Pick<Plate, 'layers'>): PlateLayer['pictures'] {
  const ground = groundOf(plate);
  return ground?.kind === 'picture' && ground.visible && lackOf(ground) === undefined ? ground.pictures : [];
}

const hundredth = (length: number): number => Math.round(100 * length) / 100;

/** Angles [degrees] for black and white. Under the light from 60°, which the appearance begins with, beads at 150°
 * are bright. */
/** First values of each fill, for a page of this width [mm]. */
const dark = 60;
const bright = 150;

const first: Partial<Record<Fill, (width: number) => Partial<LayerValues>>> = {
  brightness: (width) => ({ from: dark, to: bright, smoothing: hundredth(0.004 * width) }),
  edges: (width) => ({ smoothing: hundredth(0.01 * width) }),
  levels: () => ({ from: 0, to: 90 }),
  spiral: (width) => ({ waveLength: hundredth(width / 3) }),
  waves: (width) => ({ amplitude: 40, waveLength: hundredth(0.35 * width) }),
  noise: (width) => ({ amplitude: 90, waveLength: hundredth(0.2 * width) }),
};

/** The kind of layer that has this fill, with the value that tells it from other fills of that kind. */
const kindOf = (fill: Fill): Partial<LayerValues> & Pick<LayerValues, 'kind'> => {
  switch (fill) {
    case 'picture':
    case 'map':
    case 'direction':
      return { kind: fill };
    case 'brightness':
    case 'edges':
    case 'levels':
    case 'colours':
      return { kind: 'tones', by: fill };
    default:
      return { kind: 'pattern', pattern: fill };
  }
};

/** A layer with the first values of this fill. @param given  values to use instead, usually its files */
export const newFill = (plate: PageParts, fill: Fill, given: Partial<LayerValues> = {}): LayerValues => ({
  ...layerDefaults(),
  ...first[fill]?.(pageOf(plate)[0]),
  ...given,
  ...kindOf(fill),
});

/** Replaces the plate's ground, or adds one below the other layers; the same plate where there is no room for it. */
export function withGround(plate: Plate, values: LayerValues): Plate {
  const ground = groundOf(plate);
  const others = plate.layers.filter((layer) => layer !== ground);
  if (ground === undefined && others.length >= mostLayers) return plate;
  return { ...plate, layers: [{ ...values, id: ground?.id ?? nextLayerId(plate) }, ...others] };
}

/** Fills the plate with something else and keeps the ground's `mode` and its file.
 * @param given  as for `newFill` */
export function filledWith(plate: Plate, fill: Fill, given: Partial<LayerValues> = {}): Plate {
  const ground = groundOf(plate);
  const kept = ground && { mode: ground.mode, modeFile: ground.modeFile };
  return withGround(plate, newFill(plate, fill, { ...kept, ...given }));
}

/** Changes some values of the ground; the same plate where there is none. */
export const changeGround = (plate: Plate, change: Partial<LayerValues>): Plate => {
  const ground = groundOf(plate);
  return ground === undefined ? plate : withGround(plate, { ...without(ground, 'id'), ...change });
};
