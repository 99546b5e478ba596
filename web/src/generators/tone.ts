import type { Picture } from 'sillon';
import { storeDegrees } from './angle.js';
import { blurred, tonesAt } from './grey.js';
import type { SourceOf } from './source.js';
import type { Size } from './texels.js';

/** Black runs at `from`, white at `to`. */
export function toneAngles(source: SourceOf<'tone'>, size: Size, picture: Picture): Uint16Array {
  const { from, to, invert, contrast, smoothing } = source;
  const tones = blurred(tonesAt(picture, size), size, smoothing * size.width);
  const angle = new Uint16Array(tones.length);
  for (let k = 0; k < angle.length; ++k) {
    const strong = Math.min(1, Math.max(0, ((tones[k] as number) - 0.5) * contrast + 0.5));
    angle[k] = storeDegrees(from + (invert ? 1 - strong : strong) * (to - from));
  }
  return angle;
}
