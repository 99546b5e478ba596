// Strokes of a brush on somebody's print, as directions for the engine.
import type { Stroke } from '../model/plate.js';
import type { DirectionRaster } from '../model/raster.js';
import type { Box } from '../model/rebrush.js';
import { storeDegrees } from '../generators/angle.js';
import { modeNumber } from '../generators/modes.js';
import { withStrokes } from '../generators/strokes.js';
import { sizeFor } from '../generators/texels.js';

/** @param strokes  points and radii in mm on the bed @param angle  of what no stroke touches [degrees]
 * @param resolution  texels of the longer side */
export function handRaster(
  strokes: readonly Stroke[],
  { corner, size }: Box,
  angle: number,
  resolution: number,
): DirectionRaster {
  const { width, height } = sizeFor(size, resolution);
  const length = width * height;
  const source = {
    width,
    height,
    angle: new Uint16Array(length).fill(storeDegrees(angle)),
    mode: new Uint8Array(length).fill(modeNumber('constrained')),
  };
  const onBox = strokes.map((stroke) => ({
    ...stroke,
    points: stroke.points.map((value, k) => (value - (corner[k % 2] as number)) / (size[k % 2] as number)),
    radius: stroke.radius / size[0],
  }));
  return withStrokes(source, onBox, size);
}
