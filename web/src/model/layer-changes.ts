// Changes of a layer when a hand scales its frame or crops its picture.
import { inFrame, onPage, placeIn, type Bounds, type Frame, type Point } from './layer-frame.js';
import { layerSettingOf } from './layer-settings.js';
import type { LayerKey, LayerValues } from './layers.js';
import type { PlateLayer } from './plate.js';

/** Rounds a length to 0.01 mm, which is finer than any printer. */
export const hundredth = (length: number): number => Math.round(100 * length) / 100;

export const rounded = ([x, y]: Point): [number, number] => [hundredth(x), hundredth(y)];

/** The nearest value that the setting allows. */
export function within(key: LayerKey, value: number): number {
  const setting = layerSettingOf(key);
  return 'min' in setting ? Math.min(setting.max, Math.max(setting.min, value)) : value;
}

const sized = (key: LayerKey, [width, height]: Point): [number, number] => [
  within(key, hundredth(width)),
  within(key, hundredth(height)),
];

/** Tells whether the layer must keep its proportions: letters are never stretched. */
export const keepsProportions = ({ kind }: Pick<PlateLayer, 'kind'>): boolean => kind === 'text' || kind === 'code';

/** Scales a layer. A text without a size of its own grows with its letters. Other layers get a size; a side that
 * follows the content still does where both sides scale alike.
 * @param scale  factor for each side; equal where the proportions are kept */
export function scaledLayer(layer: PlateLayer, { size }: Frame, scale: Point): Partial<LayerValues> {
  const alike = scale[0] === scale[1];
  const [wide, tall] = layer.size;
  if (layer.kind === 'text' && (wide + tall === 0 || layer.circle !== 0)) {
    return {
      textSize: within('textSize', hundredth(layer.textSize * scale[0])),
      circle: within('circle', hundredth(layer.circle * scale[0])),
    };
  }
  if (alike && wide + tall > 0) return { size: sized('size', [wide * scale[0], tall * scale[1]]) };
  return { size: sized('size', [size[0] * scale[0], size[1] * scale[1]]) };
}

// --- Files -----------------------------------------------------------------------------------------------------------------

export const uncropped = { cropMin: [0, 0], cropMax: [1, 1] } satisfies Partial<LayerValues>;

/** Gives the layer another file at about the same size. A picture fills the same box and is cropped to its proportions.
 * A drawing gets a box with the same diagonal, so that it stays within the same circle.
 * @param proportion  width divided by height of the file's content */
export function refilled(layer: PlateLayer, { size }: Frame, proportion: number): Partial<LayerValues> {
  if (layer.size[0] + layer.size[1] === 0) return uncropped;
  const [width, height] = size;
  if (layer.kind !== 'picture' && layer.kind !== 'map') {
    const diagonal = Math.hypot(width, height);
    return { size: sized('size', [(diagonal * proportion) / Math.hypot(proportion, 1), 0]) };
  }
  const used = width / height / proportion; // used share of the picture's width; above 1, its inverse is that of the height
  const cut: [number, number] = used < 1 ? [(1 - used) / 2, 0] : [0, (1 - 1 / used) / 2];
  return { size: sized('size', size), cropMin: cut, cropMax: [1 - cut[0], 1 - cut[1]] };
}

// --- Pictures --------------------------------------------------------------------------------------------------------------

type Cropped = Pick<PlateLayer, 'cropMin' | 'cropMax' | 'mirror'>;

/** Bounds of the whole picture, of which the box is a part, in the frame. */
export function wholePicture(frame: Frame, { cropMin, cropMax, mirror }: Cropped): Bounds {
  const wide = frame.size[0] / (cropMax[0] - cropMin[0]);
  const tall = frame.size[1] / (cropMax[1] - cropMin[1]);
  const [left, below] = placeIn(frame, [-1, -1]);
  const low: Point = [left - (mirror ? 1 - cropMax[0] : cropMin[0]) * wide, below - cropMin[1] * tall];
  return { low, high: [low[0] + wide, low[1] + tall] };
}

const leastShare = 0.02;
const share = (value: number): number => Math.min(1, Math.max(0, Math.round(1e4 * value) / 1e4));
const clamped = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));

/** Moves edges of the layer's box over the picture, which stays in place.
 * @param sides  edges that move: -1 the left or lower one, 1 the right or upper one, 0 neither
 * @param to  the hand's place on the page */
export function croppedTo(frame: Frame, layer: Cropped, sides: Point, to: Point): Partial<LayerValues> {
  const whole = wholePicture(frame, layer);
  const [low, high] = [[...placeIn(frame, [-1, -1])], [...placeIn(frame, [1, 1])]] as [number[], number[]];
  const hand = inFrame(frame, to);
  const shares = ([0, 1] as const).map((k): Point => {
    const length = whole.high[k] - whole.low[k];
    const least = leastShare * length;
    if (sides[k] < 0) low[k] = clamped(hand[k], whole.low[k], (high[k] as number) - least);
    if (sides[k] > 0) high[k] = clamped(hand[k], (low[k] as number) + least, whole.high[k]);
    const from = ((low[k] as number) - whole.low[k]) / length;
    const till = ((high[k] as number) - whole.low[k]) / length;
    return k === 0 && layer.mirror ? [1 - till, 1 - from] : [from, till];
  }) as [Point, Point];
  const moved = ([0, 1] as const).map((k) => ((low[k] as number) + (high[k] as number)) / 2) as [number, number];
  return {
    cropMin: [share(shares[0][0]), share(shares[1][0])],
    cropMax: [share(shares[0][1]), share(shares[1][1])],
    size: sized('size', [(high[0] as number) - (low[0] as number), (high[1] as number) - (low[1] as number)]),
    at: rounded(onPage(frame, moved)),
  };
}

/** Moves the layer's picture under its box. @param from, to  the hand's places before and now, on the page */
export function slid(frame: Frame, layer: Cropped, from: Point, to: Point): Partial<LayerValues> {
  const whole = wholePicture(frame, layer);
  const [before, now] = [inFrame(frame, from), inFrame(frame, to)];
  const moved = ([0, 1] as const).map((k) => {
    const by = ((now[k] - before[k]) / (whole.high[k] - whole.low[k])) * (k === 0 && layer.mirror ? -1 : 1);
    return clamped(-by, -layer.cropMin[k], 1 - layer.cropMax[k]);
  }) as [number, number];
  return {
    cropMin: [share(layer.cropMin[0] + moved[0]), share(layer.cropMin[1] + moved[1])],
    cropMax: [share(layer.cropMax[0] + moved[0]), share(layer.cropMax[1] + moved[1])],
  };
}
