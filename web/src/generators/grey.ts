// Pictures as tones 0..1 on the raster's texels, and what can be done to tones.
import type { Picture } from 'sillon';
import type { Size } from './texels.js';

// Rec. 709, as the engine weighs them.
const red = 13933 / 65536;
const green = 46871 / 65536;
const blue = 4732 / 65536;

/** Of every pixel; what is transparent shows white paper. */
function tonesOf({ width, height, channels, samples }: Picture): Float32Array {
  const tones = new Float32Array(width * height);
  const most = samples instanceof Uint16Array ? 65535 : 255;
  for (let pixel = 0, k = 0; pixel < tones.length; ++pixel, k += channels) {
    let tone = samples[k] as number;
    if (channels >= 3) tone = red * tone + green * (samples[k + 1] as number) + blue * (samples[k + 2] as number);
    const cover = channels % 2 === 0 ? (samples[k + channels - 1] as number) / most : 1;
    tones[pixel] = (tone / most) * cover + (1 - cover);
  }
  return tones;
}

/** Which source texels a texel of a stretched row covers, and how much of each. */
function spans(from: number, to: number): { first: Int32Array; weights: Float32Array[] } {
  const first = new Int32Array(to);
  const weights: Float32Array[] = [];
  const step = from / to;
  const half = Math.max(step, 1) / 2; // enlarged: a box as wide as a source texel, which interpolates
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

/** Values on other texels: means of what each covers. The same array where nothing changes. */
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

// Sliders ask for the same picture at the same size again and again.
const known = new WeakMap<Picture, { size: Size; tones: Float32Array }>();

/** A picture's tones stretched over the raster; not to be changed. */
export function tonesAt(picture: Picture, size: Size): Float32Array {
  const before = known.get(picture);
  if (before?.size.width === size.width && before.size.height === size.height) return before.tones;
  const tones = resampled(tonesOf(picture), picture, size);
  known.set(picture, { size, tones });
  return tones;
}

/** Means over `reach` values to both sides of each in a row; the ends go on for ever. */
function blurRow(values: Float32Array, out: Float32Array, begin: number, count: number, reach: number): void {
  const end = begin + count - 1;
  const scale = 1 / (2 * reach + 1);
  const first = values[begin] as number;
  const last = values[end] as number;
  let sum = first * (reach + 1);
  for (let k = 1; k <= reach; ++k) sum += values[Math.min(end, begin + k)] as number;
  for (let k = begin; k <= end; ++k) {
    out[k] = sum * scale;
    const enters = k + reach + 1 <= end ? (values[k + reach + 1] as number) : last;
    const leaves = k - reach >= begin ? (values[k - reach] as number) : first;
    sum += enters - leaves;
  }
}

/** The same down all columns at once: rows are read in order. */
function blurColumns(values: Float32Array, out: Float32Array, { width, height }: Size, reach: number): void {
  const scale = 1 / (2 * reach + 1);
  const sums = new Float64Array(width);
  const rowAt = (row: number): number => Math.min(height - 1, Math.max(0, row)) * width;
  for (let row = -reach; row <= reach; ++row) {
    for (let x = 0, k = rowAt(row); x < width; ++x, ++k) sums[x] = (sums[x] as number) + (values[k] as number);
  }
  for (let y = 0; y < height; ++y) {
    const enters = rowAt(y + reach + 1);
    const leaves = rowAt(y - reach);
    for (let x = 0; x < width; ++x) {
      const sum = sums[x] as number;
      out[y * width + x] = sum * scale;
      sums[x] = sum + (values[enters + x] as number) - (values[leaves + x] as number);
    }
  }
}

/** A Gaussian blur, near enough: three boxes. @param sigma  [texels] */
export function blurred(values: Float32Array, size: Size, sigma: number): Float32Array {
  // Three boxes of w texels have the variance (w² - 1) / 4; three sizes make up for w being odd.
  const wide = Math.sqrt(4 * sigma * sigma + 1);
  const small = Math.floor((wide - 1) / 2);
  const largeOnes = Math.round(((wide - 1) / 2 - small) * 3);
  const out = values.slice();
  const between = new Float32Array(values.length);
  for (let pass = 0; pass < 3; ++pass) {
    const reach = pass < largeOnes ? small + 1 : small;
    if (reach === 0) continue;
    for (let y = 0; y < size.height; ++y) blurRow(out, between, y * size.width, size.width, reach);
    blurColumns(between, out, size, reach);
  }
  return out;
}

export function parted(tones: Float32Array, threshold: number, below: number, above: number): Uint16Array {
  const angle = new Uint16Array(tones.length);
  for (let k = 0; k < angle.length; ++k) angle[k] = (tones[k] as number) < threshold ? below : above;
  return angle;
}
