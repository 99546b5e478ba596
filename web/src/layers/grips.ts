// The parts of a layer's frame that a hand can hold. Places on the screen are in CSS pixels.
import type { Place } from '../controls/gestures.js';
import { contains, corners, onPage, placeIn, type Frame, type Point } from '../model/layer-frame.js';
import type { PlateLayer } from '../model/plate.js';

/** The page's position and scale on the screen. */
export interface PageView {
  toPage: (place: Place) => Point;
  toScreen: (point: Point) => Place;
  /** Scale in CSS pixels per mm. */
  scale: number;
}

export type Grip =
  /** The box itself, which is moved; in a crop, the picture under it. */
  | { kind: 'box' }
  | { kind: 'turn' }
  /** The direction of waves within the box. */
  | { kind: 'angle' }
  /** A corner by its signs; in a crop also an edge. */
  | { kind: 'side'; side: Point };

const stem = 26; // [CSS pixels] from the frame to the knob that turns it

const arm = 44; // [CSS pixels] from the middle to the knob that turns waves

/** Facts that decide which handles a frame has. */
export interface Handles {
  cropping: boolean;
  /** Angle of waves in the frame [degrees]; undefined where there are none. */
  angle: number | undefined;
}

export const handlesOf = (layer: PlateLayer | undefined, cropping: boolean): Handles => ({
  cropping,
  angle: !cropping && layer?.kind === 'pattern' && layer.pattern === 'waves' ? layer.angle : undefined,
});

/** Places of the handles on the box. A crop has them on its edges, too. */
export const sidesOf = (cropping: boolean): readonly Point[] =>
  cropping ? [...corners, [0, -1], [1, 0], [0, 1], [-1, 0]] : corners;

export const sidePlace = (frame: Frame, view: PageView, side: Point): Place =>
  view.toScreen(onPage(frame, placeIn(frame, side)));

/** Place of the knob that turns the frame. */
export function knobPlace(frame: Frame, view: PageView): Place {
  const [x, y] = placeIn(frame, [0, 1]);
  return view.toScreen(onPage(frame, [x, y + stem / view.scale]));
}

/** Place of the knob that turns waves, on the side to which they run. */
export function anglePlace(frame: Frame, view: PageView, angle: number): Place {
  const along = (angle * Math.PI) / 180;
  const reach = arm / view.scale;
  return view.toScreen(onPage(frame, [reach * Math.cos(along), reach * Math.sin(along)]));
}

const distance = (a: Place, b: Place): number => Math.hypot(a.x - b.x, a.y - b.y);

/** The grip at a place on the screen.
 * @param reach  radius of a fingertip, or of a pointer
 * @returns undefined where there is none */
export function gripAt(
  frame: Frame,
  view: PageView,
  place: Place,
  reach: number,
  { cropping, angle }: Handles,
): Grip | undefined {
  if (!cropping && distance(knobPlace(frame, view), place) <= reach) return { kind: 'turn' };
  // On a small box the corners must leave its middle free for dragging.
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

/** The cursor's name, by the direction in which the hand would move. */
export function cursorOf(grip: Grip | undefined, frame: Frame): string {
  if (grip === undefined) return '';
  if (grip.kind === 'box') return 'move';
  if (grip.kind === 'turn' || grip.kind === 'angle') return 'grab';
  const angle = (Math.atan2(grip.side[1], grip.side[0]) * 180) / Math.PI + frame.turn;
  return resizing[((Math.round(angle / 45) % 4) + 4) % 4] ?? 'move';
}
