// Layers drawn by the engine for the canvas, with a direction and a mode for each texel.
import type { DirectionRaster, Shape } from 'sillon';

export type { DirectionRaster };

/** Directions, stretched over the page of a shape. */
export interface Directions {
  raster: DirectionRaster;
  shape: Shape;
}

export interface Size {
  width: number;
  height: number;
}

/** Size of a raster in the page's proportions. @param page  [any unit] @param longest  texels of the longer side */
export function sizeFor([width, height]: readonly [number, number], longest: number): Size {
  const texels = (side: number): number => Math.max(1, Math.round((longest * side) / Math.max(width, height)));
  return { width: texels(width), height: texels(height) };
}

/** Texels of the longer side: fine for a plate at rest, coarse for what must keep up with a hand. */
export const fineResolution = 1024;
export const coarseResolution = 256;
