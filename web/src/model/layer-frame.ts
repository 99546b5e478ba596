// Where layers lie on the page: boxes that turn about a place, in mm with y up.
import { middleOf } from './layers.js';
import { pageOf, type Plate, type PlateLayer } from './plate.js';

export type Point = readonly [number, number];

/** A layer's box as the engine has placed it, before it turns [mm]. */
export interface LayerBox {
  /** Its middle. */
  at: [number, number];
  size: [number, number];
  /** The narrowest stroke of letters or of a drawing; null: of others. */
  thinnest: number | null;
  /** What is wrong with it, in English. */
  problem?: string;
}

/** The box of a layer that was like this. */
export interface PlacedLayer extends LayerBox {
  layer: PlateLayer;
}

export interface Frame {
  /** What it turns about. */
  pivot: Point;
  /** The middle of the box from there, before it turns. */
  offset: Point;
  size: Point;
  /** [degrees] counter-clockwise */
  turn: number;
}

type Page = Pick<Plate, 'width' | 'height'>;

/** Kinds that fill the page where nobody has given them a size. */
const fillsPage = ({ kind, pattern }: PlateLayer): boolean =>
  kind === 'direction' || kind === 'map' || kind === 'border' || (kind === 'pattern' && pattern !== 'echo');

/** What a text has grown by since its box was told: all of it grows with its capitals. */
const grown = (now: PlateLayer, then: PlateLayer): number =>
  now.kind === 'text' && now.size[0] + now.size[1] === 0 ? now.textSize / then.textSize : 1;

/** @param placed  what the engine has told last of this layer, which may have changed since */
export function frameOf(page: Page, layer: PlateLayer, placed: PlacedLayer | undefined): Frame {
  const pivot = middleOf(page, layer);
  const { size, rotation: turn } = layer;
  const frame = { pivot, offset: [0, 0] as const, turn };
  if (layer.kind === 'border') return { ...frame, pivot: middleOf(page, { at: null }), size: pageOf(page), turn: 0 };
  if (placed === undefined) {
    const [wide, tall] = fillsPage(layer) ? pageOf(page) : [size[0] || size[1], size[1] || size[0]];
    return { ...frame, size: [size[0] || wide || layer.textSize, size[1] || tall || layer.textSize] };
  }
  const before = middleOf(page, placed.layer);
  const factor = grown(layer, placed.layer);
  const offset = [factor * (placed.at[0] - before[0]), factor * (placed.at[1] - before[1])] as const;
  const ratio = placed.size[1] / (placed.size[0] || 1);
  const [wide, tall] = placed.size;
  return {
    ...frame,
    offset,
    size: [
      size[0] || (size[1] > 0 && ratio > 0 ? size[1] / ratio : factor * wide),
      size[1] || (size[0] > 0 ? size[0] * ratio : factor * tall),
    ],
  };
}

const turned = ([x, y]: Point, degrees: number): Point => {
  const angle = (degrees * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c * x - s * y, s * x + c * y];
};

/** A place of the frame, from its pivot and before it turns, on the page. */
export function onPage({ pivot, turn }: Frame, place: Point): Point {
  const [x, y] = turned(place, turn);
  return [pivot[0] + x, pivot[1] + y];
}

/** A place of the page, in the frame. */
export const inFrame = ({ pivot, turn }: Frame, [x, y]: Point): Point => turned([x - pivot[0], y - pivot[1]], -turn);

/** Signs of the corners: lower left, lower right, upper right, upper left. */
export const corners: readonly Point[] = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, 1],
];

/** A place of the box by its share of the half sides, in the frame. */
export const placeIn = ({ offset, size }: Frame, [x, y]: Point): Point => [
  offset[0] + (x * size[0]) / 2,
  offset[1] + (y * size[1]) / 2,
];

export const cornersOf = (frame: Frame): Point[] => corners.map((corner) => onPage(frame, placeIn(frame, corner)));

/** @param reach  so far around it counts, too [mm] */
export function contains(frame: Frame, place: Point, reach = 0): boolean {
  const [x, y] = inFrame(frame, place);
  const { offset, size } = frame;
  return Math.abs(x - offset[0]) <= size[0] / 2 + reach && Math.abs(y - offset[1]) <= size[1] / 2 + reach;
}

export interface Bounds {
  low: Point;
  high: Point;
}

/** The upright box around a frame. */
export function boundsOf(frame: Frame): Bounds {
  const [xs, ys] = [0, 1].map((k) => cornersOf(frame).map((corner) => corner[k] as number)) as [number[], number[]];
  return { low: [Math.min(...xs), Math.min(...ys)], high: [Math.max(...xs), Math.max(...ys)] };
}

// --- What a hand does with a frame -----------------------------------------------------------------------------------------

const smallest = 1; // [mm] of a side that a hand makes smaller

/** The factors by which a corner that is dragged scales the box, and where the pivot goes: the corner across stays.
 * @param free  either side by itself; else both alike */
export function resized(frame: Frame, corner: Point, to: Point, free: boolean): { scale: Point; pivot: Point } {
  const { size } = frame;
  const fixed = placeIn(frame, [-corner[0], -corner[1]]);
  const span: Point = [corner[0] * size[0], corner[1] * size[1]];
  const [x, y] = inFrame(frame, to);
  const way: Point = [x - fixed[0], y - fixed[1]];
  const least = [smallest / size[0], smallest / size[1]] as const;
  const alike = (way[0] * span[0] + way[1] * span[1]) / (span[0] ** 2 + span[1] ** 2);
  const scale: Point = free
    ? [Math.max(least[0], way[0] / span[0]), Math.max(least[1], way[1] / span[1])]
    : [Math.max(alike, ...least), Math.max(alike, ...least)];
  const before = onPage(frame, fixed);
  const after = onPage(frame, [scale[0] * fixed[0], scale[1] * fixed[1]]);
  return {
    scale,
    pivot: [frame.pivot[0] + before[0] - after[0], frame.pivot[1] + before[1] - after[1]],
  };
}

const wrapped = (degrees: number): number => ((((degrees + 180) % 360) + 360) % 360) - 180;
const stepOfTurns = 15; // [degrees]

/** The rotation after a hand that was at one place has gone to another, above -180 and up to 180 degrees.
 * @param steps  at multiples of 15 degrees only */
export function rotated({ pivot, turn }: Frame, from: Point, to: Point, steps: boolean): number {
  const towards = ([x, y]: Point): number => (Math.atan2(y - pivot[1], x - pivot[0]) * 180) / Math.PI;
  const angle = turn + towards(to) - towards(from);
  const snapped = steps ? Math.round(angle / stepOfTurns) * stepOfTurns : Math.round(10 * angle) / 10;
  const within = wrapped(snapped);
  return within === -180 ? 180 : Math.round(10 * within) / 10;
}
