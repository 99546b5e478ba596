// Layers as the engine draws them for the canvas: a direction and a mode per texel.
import type { DirectionRaster, Shape } from 'sillon';

export type { DirectionRaster };

/** Stretched over the page of a shape. */
export interface Directions {
  raster: DirectionRaster;
  shape: Shape;
}

export interface Size {
  width: number;
  height: number;
}

/** @param page  [any unit] @param longest  texels of the longer side */
export function sizeFor([width, height]: readonly [number, number], longest: number): Size {
  const texels = (side: number): number => Math.max(1, Math.round((longest * side) / Math.max(width, height)));
  return { width: texels(width), height: texels(height) };
}

/** Texels of the longer side, for a plate that rests and for what must keep up with a hand. */
export const fineResolution = 1024;
export const coarseResolution = 256;
