// Vectors known at some texels, spread over those where little is known: from coarse levels to fine ones, each smoothed
// while it is held to what is known.
import { resampled } from './grey.js';
import type { Size } from './texels.js';

/** At each texel a vector and how much it counts, 0 or more. */
export interface WeightedVectors {
  x: Float32Array;
  y: Float32Array;
  weight: Float32Array;
}

const sweeps = 4;
const smallestSide = 2;

/** Half as many texels each way: weights add up to means, vectors to means by weight. */
function halved({ x, y, weight }: WeightedVectors, from: Size, to: Size): WeightedVectors {
  const weighted = (values: Float32Array): Float32Array => values.map((value, k) => value * (weight[k] as number));
  const less = resampled(weight, from, to);
  const mean = (values: Float32Array): Float32Array =>
    resampled(weighted(values), from, to).map((value, k) =>
      (less[k] as number) > 0 ? value / (less[k] as number) : 0,
    );
  return { x: mean(x), y: mean(y), weight: less };
}

/** Each texel becomes the mean of its neighbours and, as far as it counts, of what it was told to be. */
function sweep(values: Float32Array, told: Float32Array, weight: Float32Array, { width, height }: Size): void {
  for (let y = 0; y < height; ++y) {
    const up = y > 0 ? -width : 0;
    const down = y < height - 1 ? width : 0;
    for (let x = 0, k = y * width; x < width; ++x, ++k) {
      const left = x > 0 ? -1 : 0;
      const right = x < width - 1 ? 1 : 0;
      const around =
        (values[k + up] as number) +
        (values[k + down] as number) +
        (values[k + left] as number) +
        (values[k + right] as number);
      const pull = 8 * (weight[k] as number);
      values[k] = (around + pull * (told[k] as number)) / (4 + pull);
    }
  }
}

export function diffused(told: WeightedVectors, size: Size): { x: Float32Array; y: Float32Array } {
  const smaller = { width: Math.ceil(size.width / 2), height: Math.ceil(size.height / 2) };
  const coarsest = Math.max(size.width, size.height) <= smallestSide;
  const guess = coarsest ? told : diffused(halved(told, size, smaller), smaller);
  const settled = (wanted: Float32Array, begin: Float32Array): Float32Array => {
    const values = coarsest ? begin.slice() : resampled(begin, smaller, size);
    for (let k = 0; k < values.length; ++k) {
      const certain = Math.min(1, told.weight[k] as number);
      values[k] = (values[k] as number) * (1 - certain) + (wanted[k] as number) * certain;
    }
    for (let round = 0; round < sweeps; ++round) sweep(values, wanted, told.weight, size);
    return values;
  };
  return { x: settled(told.x, guess.x), y: settled(told.y, guess.y) };
}
