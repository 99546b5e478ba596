// Lamp positions of each frame of a moving-light loop, computed as in the core (look/loop.cpp) with the same constants.
import { loop } from '../model/loop.js';
import type { Light } from '../model/view.js';
import { between } from './light.js';

export interface LoopLight {
  light: Light;
  milliseconds: number;
}

/** Returns the frames of a loop: one lamp goes round once; several are held in turn, with a quick move to the next.
 * @param lamps  not empty */
export function loopLights(lamps: readonly Light[]): LoopLight[] {
  const { turnFrames, turnTime, holdTime, crossFrames, crossTime } = loop;
  const [first] = lamps as [Light];
  if (lamps.length === 1) {
    return Array.from({ length: turnFrames }, (_, k) => ({
      light: { ...first, azimuth: (first.azimuth + (360 * k) / turnFrames) % 360 },
      milliseconds: turnTime,
    }));
  }
  return lamps.flatMap((lamp, k) => {
    const next = lamps[k + 1] ?? first;
    const crossing = Array.from({ length: crossFrames }, (_, step) => {
      const share = (step + 1) / (crossFrames + 1);
      return { light: between(lamp, next, share * share * (3 - 2 * share)), milliseconds: crossTime };
    });
    return [{ light: lamp, milliseconds: holdTime }, ...crossing];
  });
}
