// The parts of a layer's frame that a hand can take hold of. Places on the screen are CSS pixels.
import type { Place } from '../controls/gestures.js';
import { contains, corners, onPage, placeIn, type Frame, type Point } from '../model/layer-frame.js';
import type { PlateLayer } from '../model/plate.js';

/** The page as it lies on the screen. */
export interface PageView {
  toPage: (place: Place) => Point;
  toScreen: (point: Point) => Place;
  /** CSS pixels per mm. */
  scale: number;
}

export type Grip =
  /** The box itself: moved, or in a crop the picture under it. */
  | { kind: 'box' }
  | { kind: 'turn' }
  /** The way that waves run, within the box. */
  | { kind: 'angle' }
  /** Signs of the corner, or in a crop of the edges that go. */
  | { kind: 'side'; side: Point };

const stem = 26; // [CSS pixels] of the knob that turns

const arm = 44; // [CSS pixels] from the middle to the knob that turns waves

/** Facts beside a layer's frame that decide on its handles. */
export interface Handles {
  cropping: boolean;
  /** The angle of waves, in the frame [degrees]; undefined: there are none. */
  angle: number | undefined;
}

export const handlesOf = (layer: PlateLayer | undefined, cropping: boolean): Handles => ({
  cropping,
  angle: !cropping && layer?.kind === 'pattern' && layer.pattern === 'waves' ? layer.angle : undefined,
});

/** A crop can be dragged by its edges, too. */
export const sidesOf = (cropping: boolean): readonly Point[] =>
  cropping ? [...corners, [0, -1], [1, 0], [0, 1], [-1, 0]] : corners;

export const sidePlace = (frame: Frame, view: PageView, side: Point): Place =>
  view.toScreen(onPage(frame, placeIn(frame, side)));

/** The knob turns the frame. @returns its place */
export function knobPlace(frame: Frame, view: PageView): Place {
  const [x, y] = placeIn(frame, [0, 1]);
  return view.toScreen(onPage(frame, [x, y + stem / view.scale]));
}

/** The knob that turns waves lies where they run to. */
export function anglePlace(frame: Frame, view: PageView, angle: number): Place {
  const along = (angle * Math.PI) / 180;
  const reach = arm / view.scale;
  return view.toScreen(onPage(frame, [reach * Math.cos(along), reach * Math.sin(along)]));
}

const distance = (a: Place, b: Place): number => Math.hypot(a.x - b.x, a.y - b.y);

/** @param reach  of a fingertip, or of a pointer
 * @returns what is there to be taken hold of; undefined: nothing */
export function gripAt(
  frame: Frame,
  view: PageView,
  place: Place,
  reach: number,
  { cropping, angle }: Handles,
): Grip | undefined {
  if (!cropping && distance(knobPlace(frame, view), place) <= reach) return { kind: 'turn' };
  // On a small box the corners must leave its middle to be dragged.
  const room = Math.max(5, (Math.min(...frame.size) * view.scale) / 3);
  const inside = contains(frame, view.toPage(place));
  const near = sidesOf(cropping)
    .map((side) => ({ side, away: distance(sidePlace(frame, view, side), place) }))
    .sort((a, b) => a.away - b.away)[0];
  if (near !== undefined && near.away <= (inside ? Math.min(reach, room) : reach)) {
    return { kind: 'side', side: near.side };
  }
  if (angle !== undefined && distance(anglePlace(frame, view, angle), place) <= reach) return { kind: 'angle' };
  return inside ? { kind: 'box' } : undefined;
}

const resizing = ['ew-resize', 'nesw-resize', 'ns-resize', 'nwse-resize'] as const;

/** The cursor's name, by the way that the hand would go. */
export function cursorOf(grip: Grip | undefined, frame: Frame): string {
  if (grip === undefined) return '';
  if (grip.kind === 'box') return 'move';
  if (grip.kind === 'turn' || grip.kind === 'angle') return 'grab';
  const angle = (Math.atan2(grip.side[1], grip.side[0]) * 180) / Math.PI + frame.turn;
  return resizing[((Math.round(angle / 45) % 4) + 4) % 4] ?? 'move';
}
