import type { Picture } from 'sillon';
import { storeDoubles } from './angle.js';
import { diffused } from './diffuse.js';
import { blurred, resampled, tonesAt } from './grey.js';
import type { SourceOf } from './source.js';
import type { Page, Size } from './texels.js';

const noiseBlur = 1; // [texels] before slopes are taken
const most = 512; // [texels] of the longer side: the field is smooth, finer ones only take longer

/** Slopes as double-angle vectors: of `x`, `y` the direction of steepest ascent, twice; as long as the slope is steep,
 * squared. @param tall  height of a texel over its width */
function slopes(tones: Float32Array, { width, height }: Size, tall: number): { x: Float32Array; y: Float32Array } {
  const x = new Float32Array(tones.length);
  const y = new Float32Array(tones.length);
  for (let row = 0; row < height; ++row) {
    const above = Math.max(0, row - 1) * width;
    const below = Math.min(height - 1, row + 1) * width;
    for (let column = 0, k = row * width; column < width; ++column, ++k) {
      const before = row * width + Math.max(0, column - 1);
      const after = row * width + Math.min(width - 1, column + 1);
      const right = ((tones[after] as number) - (tones[before] as number)) / (after - before || 1);
      const rows = (below - above) / width || 1;
      const up = ((tones[above + column] as number) - (tones[below + column] as number)) / (rows * tall);
      x[k] = right * right - up * up;
      y[k] = 2 * right * up;
    }
  }
  return { x, y };
}

/** Along what the picture shows: the main direction of its structure tensor, carried from strong edges into flat areas.
 * Without any edges: 0°. */
export function edgesAngles(source: SourceOf<'edges'>, size: Size, page: Page, picture: Picture): Uint16Array {
  const scale = Math.min(1, most / Math.max(size.width, size.height));
  const coarse = {
    width: Math.max(1, Math.round(size.width * scale)),
    height: Math.max(1, Math.round(size.height * scale)),
  };
  const tall = page[1] / coarse.height / (page[0] / coarse.width);
  const tones = blurred(tonesAt(picture, coarse), coarse, noiseBlur);
  const raw = slopes(tones, coarse, tall);
  const sigma = source.smoothing * coarse.width;
  const x = blurred(raw.x, coarse, sigma);
  const y = blurred(raw.y, coarse, sigma);

  let sum = 0;
  for (let k = 0; k < x.length; ++k) sum += Math.hypot(x[k] as number, y[k] as number);
  const mean = sum / x.length;
  const weight = new Float32Array(x.length);
  const sign = source.across ? 1 : -1; // an edge runs square to its slope; twice square is opposite
  for (let k = 0; k < x.length; ++k) {
    const length = Math.hypot(x[k] as number, y[k] as number);
    if (length <= 1e-9) continue; // rounding of flat areas
    weight[k] = (length * length) / (length * length + mean * mean);
    x[k] = (sign * (x[k] as number)) / length;
    y[k] = (sign * (y[k] as number)) / length;
  }
  const field = diffused({ x, y, weight }, coarse);
  const fineX = resampled(field.x, coarse, size);
  const fineY = resampled(field.y, coarse, size);
  return storeDoubles(fineX, fineY);
}
