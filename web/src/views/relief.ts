// Draws a print from above: its heights, lit from one side.
import type { PrintRelief } from 'sillon';

const lightAt = [-0.53, 0.53, 0.66] as const; // from the upper left, as on maps
const steepest = 1.5; // rise over run; steeper cliffs get no brighter
const darkest = 0.62; // brightness of the lowest places, relative to the highest

/** Returns RGBA pixels of the relief, row 0 on top, transparent where nothing lies. @param body  sRGB of the plastic */
export function shadedRelief(
  { columns, rows, cell, heights }: PrintRelief,
  body: readonly [number, number, number],
): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(4 * columns * rows);
  let highest = 0;
  for (const height of heights) highest = Math.max(highest, height);
  const at = (x: number, y: number, otherwise: number): number => {
    const inside = x >= 0 && y >= 0 && x < columns && y < rows;
    return (inside ? heights[y * columns + x] : 0) || Math.max(0, otherwise - cell);
  };
  const slope = (rise: number): number => Math.min(steepest, Math.max(-steepest, rise / (2 * cell)));
  for (let y = 0, k = 0; y < rows; ++y) {
    for (let x = 0; x < columns; ++x, ++k) {
      const height = heights[k] as number;
      if (height === 0) continue;
      const dx = slope(at(x + 1, y, height) - at(x - 1, y, height));
      const dy = slope(at(x, y - 1, height) - at(x, y + 1, height));
      const lit = (lightAt[2] - dx * lightAt[0] - dy * lightAt[1]) / Math.sqrt(1 + dx * dx + dy * dy);
      const deep = darkest + (1 - darkest) * (height / highest);
      const bright = deep * (0.35 + 0.85 * Math.max(0, lit));
      pixels[4 * k] = body[0] * bright;
      pixels[4 * k + 1] = body[1] * bright;
      pixels[4 * k + 2] = body[2] * bright;
      pixels[4 * k + 3] = 255;
    }
  }
  return pixels;
}
