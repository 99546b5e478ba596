import type { Picture } from 'sillon';
import { storeDegrees } from './angle.js';
import { parted, tonesAt } from './grey.js';
import type { SourceOf } from './source.js';
import type { Size } from './texels.js';

export function levelsAngles(source: SourceOf<'levels'>, size: Size, picture: Picture): Uint16Array {
  const dark = storeDegrees(source.invert ? source.light : source.dark);
  const light = storeDegrees(source.invert ? source.dark : source.light);
  return parted(tonesAt(picture, size), source.threshold, dark, light);
}
