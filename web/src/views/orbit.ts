// Maps places of a print, seen at an angle without perspective, to the screen and back.
import type { PrintRelief } from 'sillon';

export interface Orbit {
  /** [radians] turn of the print, counter-clockwise as seen from above. */
  turn: number;
  /** [radians] angle between the eye and straight above: 0..steepest, or π-steepest..π from below. */
  tilt: number;
  /** Pixels per mm. */
  scale: number;
  /** Middle of the page on the screen [pixels], y down. */
  x: number;
  y: number;
}

/** Largest tilt [radians]: 5° above the horizon. */
export const steepest = (85 * Math.PI) / 180;

/** Tells whether the eye is below the print. */
export const isBelow = ({ tilt }: Pick<Orbit, 'tilt'>): boolean => tilt > Math.PI / 2;

/** Turns the view to the other side of the print, at the same steepness. */
export const turnedOver = <Way extends Pick<Orbit, 'tilt'>>(way: Way): Way => ({ ...way, tilt: Math.PI - way.tilt });

/** Turns and tilts the view; the eye stays on its side of the print. */
export function orbited(orbit: Orbit, turn: number, tilt: number): Orbit {
  const whole = 2 * Math.PI;
  const [least, most] = isBelow(orbit) ? [Math.PI - steepest, Math.PI] : [0, steepest];
  return {
    ...orbit,
    turn: (((orbit.turn + turn) % whole) + whole) % whole,
    tilt: Math.min(most, Math.max(least, orbit.tilt + tilt)),
  };
}

/** Zooms by a factor around (x, y), which stays in place. @param least, most  limits of the scale [pixels per mm] */
export function magnified(orbit: Orbit, factor: number, x: number, y: number, least: number, most: number): Orbit {
  const scale = Math.min(most, Math.max(least, orbit.scale * factor));
  const share = scale / orbit.scale;
  return { ...orbit, scale, x: x + (orbit.x - x) * share, y: y + (orbit.y - y) * share };
}

/** Moves the print on the screen; the middle of its page never leaves the screen. */
export function shifted(orbit: Orbit, dx: number, dy: number, screen: readonly [number, number]): Orbit {
  const within = (value: number, length: number): number => Math.min(length, Math.max(0, value));
  return { ...orbit, x: within(orbit.x + dx, screen[0]), y: within(orbit.y + dy, screen[1]) };
}

/** Returns the view in which a box of this size fits between margins, at any turn.
 * @param size  sides of the page and height of the print [mm] */
export function fitted(
  { turn, tilt }: Pick<Orbit, 'turn' | 'tilt'>,
  size: readonly [number, number, number],
  screen: readonly [number, number],
  margin: number,
): Orbit {
  const across = Math.hypot(size[0], size[1]);
  const tall = across * Math.abs(Math.cos(tilt)) + size[2] * Math.sin(tilt);
  const room = screen.map((length) => Math.max(1, length - 2 * Math.min(margin, length * 0.06)));
  const scale = Math.min((room[0] as number) / across, (room[1] as number) / tall);
  return { turn, tilt, scale, x: screen[0] / 2, y: screen[1] / 2 + (scale * size[2] * Math.sin(tilt)) / 2 };
}

/** Projects a place onto the screen. @param at  x and y from the middle of the page, y up, and the height [mm] */
export function seenAt({ turn, tilt, scale, x, y }: Orbit, at: readonly [number, number, number]): [number, number] {
  const across = Math.cos(turn) * at[0] - Math.sin(turn) * at[1];
  const away = Math.sin(turn) * at[0] + Math.cos(turn) * at[1];
  return [x + scale * across, y - scale * (away * Math.cos(tilt) + at[2] * Math.sin(tilt))];
}

/** Returns the place where the ray under a pointer first meets the print (its bottom, if the eye is below), in mm
 * from the page's lower left corner; undefined if the ray misses the print. */
export function placeUnder(orbit: Orbit, relief: PrintRelief, x: number, y: number): [number, number] | undefined {
  const { columns, rows, cell, heights } = relief;
  let highest = 0;
  if (!isBelow(orbit)) for (const height of heights) highest = Math.max(highest, height);
  const [c, s] = [Math.cos(orbit.turn), Math.sin(orbit.turn)];
  const across = (x - orbit.x) / orbit.scale;
  const up = (orbit.y - y) / orbit.scale;
  const [cosine, sine] = [Math.cos(orbit.tilt), Math.sin(orbit.tilt)];
  // The ray is followed downwards in steps of half a cell; at each
  // height z its place on the bed follows from the projection.
  const flat = sine === 0 || highest === 0;
  const slope = Math.sign(cosine) * Math.max(Math.abs(cosine), 0.05);
  const way = flat ? 0 : highest * (sine / slope);
  const steps = Math.max(1, Math.ceil(way / (cell / 2)), flat ? 1 : 200);
  for (let k = 0; k <= steps; ++k) {
    const z = highest * (1 - k / steps);
    const away = (up - z * sine) / slope;
    const place = [c * across + s * away, c * away - s * across] as const;
    const [u, v] = [place[0] + (columns * cell) / 2, place[1] + (rows * cell) / 2];
    const [column, row] = [Math.floor(u / cell), rows - 1 - Math.floor(v / cell)];
    if (column < 0 || row < 0 || column >= columns || row >= rows) continue;
    const height = heights[row * columns + column] as number;
    if (height > 0 && height >= z - cell) return [u, v];
  }
  return undefined;
}
