import { storeDegrees } from './angle.js';
import type { SourceOf } from './source.js';
import { anglesOf, inWidths, type Page, type Size } from './texels.js';

const degrees = 180 / Math.PI;

/** Rays from the centre, all turned by `angle`: 90° makes rings. */
export function radialAngles(source: SourceOf<'radial'>, size: Size, page: Page): Uint16Array {
  const [cx, cy] = inWidths(source.centre, page);
  return anglesOf(size, page, (x, y) => storeDegrees(Math.atan2(y - cy, x - cx) * degrees + source.angle));
}
