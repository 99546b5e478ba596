// Where the light stands, by what moves it.
import type { Light } from '../model/view.js';

export const swayPeriod = 9000; // [ms] of one turn
/** Elevations that a hand may give a lamp [degrees]: lower, it would light nothing of the plate. */
export const elevations = [5, 90] as const;

/** Unit vector towards the light. */
export function lampOf({ azimuth, elevation }: Light): [number, number, number] {
  const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  return [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
}

/** As if a pointer held the lamp above the plate. @param dx, dy  from its middle, ±1 at its edges, y up */
export function lightUnder(dx: number, dy: number): Light {
  const azimuth = (Math.atan2(dy, dx) * 180) / Math.PI;
  return { azimuth: (azimuth + 360) % 360, elevation: 90 - 75 * Math.min(1, Math.hypot(dx, dy)) };
}

const rests = 300; // [ms] in which a pointer that only passes has moved on

/** Remembers the light that a pointer has aimed: where it came to rest last, not where it left the plate. Times are [ms]. */
export class Aim {
  #last: { light: Light; at: number } | undefined;
  #light: Light | undefined;

  move(light: Light, now: number): void {
    this.#rest(now);
    this.#last = { light, at: now };
  }

  /** @returns undefined where the pointer has only passed */
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

/** A lamp that stands still above a phone, which lies at 40° in a hand. @param beta, gamma  of a DeviceOrientationEvent */
export function lightOfTilt(beta: number, gamma: number): Light {
  const x = Math.sin((gamma * Math.PI) / 180);
  const y = Math.sin(((beta - 40) * Math.PI) / 180);
  const azimuth = (Math.atan2(y, -x) * 180) / Math.PI;
  return { azimuth: (azimuth + 360) % 360, elevation: Math.max(10, 90 - 110 * Math.min(0.9, Math.hypot(x, y))) };
}

/** The shorter way round from a to b [degrees], -180..180. */
const arc = (a: number, b: number): number => ((((b - a) % 360) + 540) % 360) - 180;

/** @param share  0 is `a`, 1 is `b` */
export const between = (a: Light, b: Light, share: number): Light => ({
  azimuth: (a.azimuth + share * arc(a.azimuth, b.azimuth) + 360) % 360,
  elevation: a.elevation + share * (b.elevation - a.elevation),
});

/** @param most  [degrees] */
export const near = (a: Light, b: Light, most: number): boolean =>
  Math.abs(arc(a.azimuth, b.azimuth)) <= most && Math.abs(a.elevation - b.elevation) <= most;

const springs = 220; // [ms] in which two thirds of the way are gone

/** On the way to another place. @param elapsed  [ms] */
export const turned = (from: Light, to: Light, elapsed: number): Light =>
  between(from, to, 1 - Math.exp(-elapsed / springs));

/** Of a light that goes round. @param now  [ms] */
export const swayedElevation = (now: number): number => 38 + 8 * Math.sin(now / 2900);

const swaySpan = 25; // [degrees] to both sides

/** Of a light that moves by itself around its place. @param now  [ms] */
export const swayed = (home: Light, now: number): Light => ({
  azimuth: (home.azimuth + swaySpan * Math.sin((2 * Math.PI * now) / swayPeriod) + 360) % 360,
  elevation: Math.min(88, Math.max(8, home.elevation + 4 * Math.sin(now / 2900))),
});
