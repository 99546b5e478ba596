// Frames of layers: boxes on the page that turn about their middles, in mm with y up.
import { fillOf } from './fills.js';
import { middleOf } from './layer-list.js';
import { pageOf, type PageParts, type PlateLayer } from './plate.js';

export type Point = readonly [number, number];

/** Size of a layer's box as the engine has last reported it, with the layer as it was then [mm]. */
export interface KnownBox {
  layer: PlateLayer;
  size: Point;
}

export interface Frame {
  /** Middle of the box, about which it turns. */
  middle: Point;
  size: Point;
  /** Rotation counter-clockwise [degrees]. */
  turn: number;
}

/** Tells whether the layer fills the page: strokes always do, and fills do until they are given a size. */
const fillsPage = (layer: PlateLayer): boolean =>
  layer.kind === 'strokes' || (fillOf(layer) !== undefined && layer.size[0] + layer.size[1] === 0);

/** Returns the factor by which a text has grown since its box was reported: the ratio of its capitals, or the
 * smallest ratio of its given sides. */
function grown(now: PlateLayer, then: PlateLayer): number {
  const sides = [0, 1] as const;
  const given = sides.filter((k) => now.circle === 0 && now.size[k] > 0 && then.size[k] > 0);
  if (given.length === 0) return now.textSize / then.textSize;
  return Math.min(...given.map((k) => now.size[k] / then.size[k]));
}

/** Returns the size of a layer's box. One missing side follows from the content's proportions; if both are missing,
 * the reported box counts. A text scales its reported box, or is guessed from its number of letters and lines. */
function sizeOf(layer: PlateLayer, page: Point, known: KnownBox | undefined): Point {
  const [width, height] = layer.size;
  if (layer.kind === 'text') {
    const factor = known === undefined ? layer.textSize : grown(layer, known.layer);
    const lines = layer.text.split('\n');
    const [wide, tall] = known?.size ?? [Math.max(...lines.map(({ length }) => length)), lines.length];
    return [factor * wide, factor * tall];
  }
  const [wide, tall] = known?.size ?? (fillsPage(layer) ? page : [1, 1]);
  if (width > 0 && height > 0) return [width, height];
  if (width > 0) return [width, (width * tall) / wide];
  if (height > 0) return [(height * wide) / tall, height];
  // A box that the engine has not reported yet is drawn as a square of half the page's shorter side.
  const factor = known === undefined && !fillsPage(layer) ? Math.min(...page) / 2 : 1;
  return [wide * factor, tall * factor];
}

/** Frame of a layer on the page. @param known  the box that the engine has last reported; the layer may have changed
 * since */
export function frameOf(page: PageParts, layer: PlateLayer, known: KnownBox | undefined): Frame {
  if (layer.kind === 'border') return { middle: middleOf(page, { at: null }), size: pageOf(page), turn: 0 };
  return { middle: middleOf(page, layer), size: sizeOf(layer, pageOf(page), known), turn: layer.rotation };
}

const turned = ([x, y]: Point, degrees: number): Point => {
  const angle = (degrees * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c * x - s * y, s * x + c * y];
};

/** Converts a place in the frame, relative to its middle and before it turns, to the page. */
export function onPage({ middle, turn }: Frame, place: Point): Point {
  const [x, y] = turned(place, turn);
  return [middle[0] + x, middle[1] + y];
}

/** Converts a place on the page to the frame. */
export const inFrame = ({ middle, turn }: Frame, [x, y]: Point): Point => turned([x - middle[0], y - middle[1]], -turn);

/** Signs of the corners: lower left, lower right, upper right, upper left. */
export const corners: readonly Point[] = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, 1],
];

/** Place in the frame at these shares of the half sides, each from -1 to 1. */
export const placeIn = ({ size }: Frame, [x, y]: Point): Point => [(x * size[0]) / 2, (y * size[1]) / 2];

export const cornersOf = (frame: Frame): Point[] => corners.map((corner) => onPage(frame, placeIn(frame, corner)));

/** Tells whether a place on the page lies in the frame. @param reach  margin around it that counts, too [mm] */
export function contains(frame: Frame, place: Point, reach = 0): boolean {
  const [x, y] = inFrame(frame, place);
  return Math.abs(x) <= frame.size[0] / 2 + reach && Math.abs(y) <= frame.size[1] / 2 + reach;
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

// --- Resizing and turning by hand ------------------------------------------------------------------------------------------

const shortestSide = 1; // shortest side that dragging can make [mm]

/** Drags a corner of the box; the opposite corner stays. Returns the factors that scale the box, and its new middle.
 * @param free  scales each side on its own; otherwise both by the same factor */
export function resized(frame: Frame, corner: Point, to: Point, free: boolean): { scale: Point; middle: Point } {
  const { size } = frame;
  const fixed = placeIn(frame, [-corner[0], -corner[1]]);
  const span: Point = [corner[0] * size[0], corner[1] * size[1]];
  const [x, y] = inFrame(frame, to);
  const way: Point = [x - fixed[0], y - fixed[1]];
  const least = [shortestSide / size[0], shortestSide / size[1]] as const;
  const uniform = (way[0] * span[0] + way[1] * span[1]) / (span[0] ** 2 + span[1] ** 2);
  const scale: Point = free
    ? [Math.max(least[0], way[0] / span[0]), Math.max(least[1], way[1] / span[1])]
    : [Math.max(uniform, ...least), Math.max(uniform, ...least)];
  const middle = onPage(frame, [fixed[0] * (1 - scale[0]), fixed[1] * (1 - scale[1])]);
  return { scale, middle };
}

const wrapped = (degrees: number): number => ((((degrees + 180) % 360) + 360) % 360) - 180;
const turnStep = 15; // [degrees]

/** The rotation after a hand has moved from one place to another, above -180° and up to 180°.
 * @param steps  rounds to multiples of 15°, otherwise to 0.1° */
export function rotated({ middle, turn }: Frame, from: Point, to: Point, steps: boolean): number {
  const towards = ([x, y]: Point): number => (Math.atan2(y - middle[1], x - middle[0]) * 180) / Math.PI;
  const angle = turn + towards(to) - towards(from);
  const snapped = steps ? Math.round(angle / turnStep) * turnStep : Math.round(10 * angle) / 10;
  const within = wrapped(snapped);
  return within === -180 ? 180 : Math.round(10 * within) / 10;
}
