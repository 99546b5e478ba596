// Directions of the lamp, by what moves it: a pointer, a tilted phone or time.
import type { Light } from '../model/view.js';

export const swayPeriod = 9000; // [ms] duration of one turn
/** Elevations that the user may give a lamp [degrees]: a lower lamp would light nothing of the plate. */
export const elevations = [5, 90] as const;

/** Returns the unit vector towards the light. */
export function lampOf({ azimuth, elevation }: Light): [number, number, number] {
  const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  return [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
}

/** Returns the light of a lamp that a pointer holds above the plate. @param dx, dy  offset from the plate's middle,
 * ±1 at its edges, y up */
export function lightUnder(dx: number, dy: number): Light {
  const azimuth = (Math.atan2(dy, dx) * 180) / Math.PI;
  return { azimuth: (azimuth + 360) % 360, elevation: 90 - 75 * Math.min(1, Math.hypot(dx, dy)) };
}

const rests = 300; // [ms] shortest stay of a pointer that has come to rest

/** Remembers the light that a pointer aimed: where it last
 * came to rest, not where it left the plate. Times are in ms. */
export class Aim {
  #last: { light: Light; at: number } | undefined;
  #light: Light | undefined;

  move(light: Light, now: number): void {
    this.#rest(now);
    this.#last = { light, at: now };
  }

  /** Ends the aiming. @returns undefined if the pointer only passed over the plate */
  leave(now: number): Light | undefined {
    this.#rest(now);
    const light = this.#light;
    this.#last = this.#light = undefined;
    return light;
  }

  #rest(now: number): void {
    if (this.#last !== undefined && now - this.#last.at >= rests) this.#light = this.#last.light;
  }
}

/** Returns the light of a lamp that stands still above a phone, held
 * at 40°. @param beta, gamma  angles of a DeviceOrientationEvent */
export function lightOfTilt(beta: number, gamma: number): Light {
  const x = Math.sin((gamma * Math.PI) / 180);
  const y = Math.sin(((beta - 40) * Math.PI) / 180);
  const azimuth = (Math.atan2(y, -x) * 180) / Math.PI;
  return { azimuth: (azimuth + 360) % 360, elevation: Math.max(10, 90 - 110 * Math.min(0.9, Math.hypot(x, y))) };
}

/** Returns the shorter way round from a to b [degrees], -180..180. */
const arc = (a: number, b: number): number => ((((b - a) % 360) + 540) % 360) - 180;

/** Interpolates between two lights along the shorter way round. @param share  0: `a`, 1: `b` */
export const between = (a: Light, b: Light, share: number): Light => ({
  azimuth: (a.azimuth + share * arc(a.azimuth, b.azimuth) + 360) % 360,
  elevation: a.elevation + share * (b.elevation - a.elevation),
});

/** Tells whether two lights differ by no more than an angle, in azimuth and in elevation. @param most  [degrees] */
export const near = (a: Light, b: Light, most: number): boolean =>
  Math.abs(arc(a.azimuth, b.azimuth)) <= most && Math.abs(a.elevation - b.elevation) <= most;

const springs = 220; // [ms] time constant: after it, two thirds of the way are done

/** Returns the light on its way to another place. @param elapsed  time since the start [ms] */
export const turned = (from: Light, to: Light, elapsed: number): Light =>
  between(from, to, 1 - Math.exp(-elapsed / springs));

/** Returns the elevation of a light that goes round [degrees]. @param now  [ms] */
export const swayedElevation = (now: number): number => 38 + 8 * Math.sin(now / 2900);

const swaySpan = 25; // [degrees] sway to both sides

/** Returns a light that sways by itself around its home. @param now  [ms] */
export const swayed = (home: Light, now: number): Light => ({
  azimuth: (home.azimuth + swaySpan * Math.sin((2 * Math.PI * now) / swayPeriod) + 360) % 360,
  elevation: Math.min(88, Math.max(8, home.elevation + 4 * Math.sin(now / 2900))),
});
