// Where the light stands, by what moves it.
import type { Light } from './scene.js';

export const swayPeriod = 9000; // [ms] of one turn

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

/** A lamp that stands still above a phone, which lies at 40° in a hand. @param beta, gamma  of a DeviceOrientationEvent */
export function lightOfTilt(beta: number, gamma: number): Light {
  const x = Math.sin((gamma * Math.PI) / 180);
  const y = Math.sin(((beta - 40) * Math.PI) / 180);
  const azimuth = (Math.atan2(y, -x) * 180) / Math.PI;
  return { azimuth: (azimuth + 360) % 360, elevation: Math.max(10, 90 - 110 * Math.min(0.9, Math.hypot(x, y))) };
}

/** Of a light that moves by itself. @param now  [ms] */
export const swayedElevation = (now: number): number => 38 + 8 * Math.sin(now / 2900);
