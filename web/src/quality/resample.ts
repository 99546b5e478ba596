// Resamples the values of a grid to another grid.
import type { Size } from '../model/raster.js';

/** Source texels that each texel of a resized row covers, and the weight of each. */
function spans(from: number, to: number): { first: Int32Array; weights: Float32Array[] } {
  const first = new Int32Array(to);
  const weights: Float32Array[] = [];
  const step = from / to;
  const half = Math.max(step, 1) / 2; // enlarged rows use a box as wide as a source texel, which interpolates
  for (let k = 0; k < to; ++k) {
    const middle = (k + 0.5) * step;
    const begin = Math.max(0, middle - half);
    const end = Math.min(from, middle + half);
    const low = Math.floor(begin);
    const row = new Float32Array(Math.max(1, Math.ceil(end) - low));
    for (let t = 0; t < row.length; ++t) {
      row[t] = Math.max(0, Math.min(end, low + t + 1) - Math.max(begin, low + t)) / (end - begin);
    }
    first[k] = low;
    weights.push(row);
  }
  return { first, weights };
}

/** Resamples by area: each new texel is the mean of what it covers. Returns the same array where the size does not
 * change. */
export function resampled(values: Float32Array, from: Size, to: Size): Float32Array {
  if (from.width === to.width && from.height === to.height) return values;
  const columns = spans(from.width, to.width);
  const rows = spans(from.height, to.height);
  const narrow = new Float32Array(to.width * from.height);
  for (let y = 0; y < from.height; ++y) {
    for (let x = 0; x < to.width; ++x) {
      const weights = columns.weights[x] as Float32Array;
      let k = y * from.width + (columns.first[x] as number);
      let sum = 0;
      for (const weight of weights) sum += weight * (values[k++] as number);
      narrow[y * to.width + x] = sum;
    }
  }
  const out = new Float32Array(to.width * to.height);
  for (let y = 0; y < to.height; ++y) {
    let source = (rows.first[y] as number) * to.width;
    for (const weight of rows.weights[y] as Float32Array) {
      for (let x = 0, k = y * to.width; x < to.width; ++x, ++k) {
        out[k] = (out[k] as number) + weight * (narrow[source + x] as number);
      }
      source += to.width;
    }
  }
  return out;
}
