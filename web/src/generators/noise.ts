import { storeDegrees } from './angle.js';
import type { SourceOf } from './source.js';
import { anglesOf, type Page, type Size } from './texels.js';

/** -1..1, the same for the same seed and knot everywhere. */
function chance(seed: number, x: number, y: number): number {
  let hash = Math.imul(seed ^ Math.floor(seed / 2 ** 32), 0x9e3779b1);
  hash = Math.imul(hash ^ x, 0x85ebca6b);
  hash = Math.imul(hash ^ (hash >>> 15) ^ y, 0xc2b2ae35);
  hash = Math.imul(hash ^ (hash >>> 13), 0x27d4eb2f);
  return ((hash ^ (hash >>> 16)) >>> 0) / 2 ** 31 - 1;
}

/** Two derivatives are 0 at 0 and 1: knots do not show as creases. */
const eased = (t: number): number => t * t * t * (t * (t * 6 - 15) + 10);

/** `angle` and up to `amplitude` to both sides, smoothly by chance; knots lie `scale` apart. */
export function noiseAngles(source: SourceOf<'noise'>, size: Size, page: Page): Uint16Array {
  const { seed, scale, amplitude, angle } = source;
  return anglesOf(size, page, (x, y) => {
    const left = Math.floor(x / scale);
    const below = Math.floor(y / scale);
    const across = eased(x / scale - left);
    const up = eased(y / scale - below);
    const between = (row: number): number => {
      const from = chance(seed, left, row);
      return from + across * (chance(seed, left + 1, row) - from);
    };
    const low = between(below);
    return storeDegrees(angle + amplitude * (low + up * (between(below + 1) - low)));
  });
}
