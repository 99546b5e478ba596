import type { DirectionMode, Picture } from 'sillon';
import { greys, nearest } from './map.js';
import type { Size } from './texels.js';

/** In the order of the raster's numbers. */
export const modeNames: readonly DirectionMode[] = ['parallel', 'orthogonal', 'smoothest', 'constrained'];

export const modeNumber = (mode: DirectionMode): number => modeNames.indexOf(mode);

/** @param picture  of modes, which then counts alone; as the engine reads it. */
export function modesOn(base: DirectionMode, size: Size, picture?: Picture): Uint8Array {
  if (picture === undefined) return new Uint8Array(size.width * size.height).fill(modeNumber(base));
  const grey = greys(picture);
  const modes = new Uint8Array(grey.length);
  for (let k = 0; k < modes.length; ++k) modes[k] = Math.floor((6 * (grey[k] as number) + 65535) / (2 * 65535));
  return nearest(modes, picture, size);
}
