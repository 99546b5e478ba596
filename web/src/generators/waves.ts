import { storeDegrees } from './angle.js';
import type { SourceOf } from './source.js';
import { anglesOf, type Page, type Size } from './texels.js';

/** Lines that run along `angle` and swing by `amplitude` to both sides, once to and fro per `length`. */
export function wavesAngles(source: SourceOf<'waves'>, size: Size, page: Page): Uint16Array {
  const along = (source.angle * Math.PI) / 180;
  const turn = (2 * Math.PI) / source.length;
  const cos = Math.cos(along) * turn;
  const sin = Math.sin(along) * turn;
  return anglesOf(size, page, (x, y) => storeDegrees(source.angle + source.amplitude * Math.sin(x * cos + y * sin)));
}
