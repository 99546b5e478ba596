import { storeDegrees } from './angle.js';
import type { SourceOf } from './source.js';
import { anglesOf, inWidths, type Page, type Size } from './texels.js';

const degrees = 180 / Math.PI;

/** Rays that turn on their way out: through all directions (180°) `turns` times per page width. Equal directions, and so
 * equal brightness, lie on spirals. */
export function spiralAngles(source: SourceOf<'spiral'>, size: Size, page: Page): Uint16Array {
  const [cx, cy] = inWidths(source.centre, page);
  return anglesOf(size, page, (x, y) => {
    const away = Math.hypot(x - cx, y - cy);
    return storeDegrees(Math.atan2(y - cy, x - cx) * degrees + source.angle + 180 * source.turns * away);
  });
}
