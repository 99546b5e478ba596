// Finds where a box of letters or modules fits whole inside a shape.
import type { Size } from '../model/raster.js';

/** The inside of a shape on its page, 1 for each texel inside. Rows run from the top. */
export interface Room extends Size {
  /** Number of the room: rooms with equal keys are equal. */
  key: number;
  inside: Uint8Array;
}

export interface Place {
  /** Factor on the box, 0..1. */
  scale: number;
  /** Middle of the box in shares of the page, from the left and from the top. */
  x: number;
  y: number;
}

/** Sums up boxes of a picture by a summed-area table. @returns the sum over a number of columns and rows from a
 * place on */
export function adder(values: Uint8Array, { width, height }: Size) {
  // Entry (row, column) holds the sum over all texels above and to the left.
  const stride = width + 1;
  const sums = new Uint32Array(stride * (height + 1));
  for (let row = 0; row < height; ++row) {
    for (let column = 0, line = 0; column < width; ++column) {
      line += values[row * width + column] as number;
      sums[(row + 1) * stride + column + 1] = (sums[row * stride + column + 1] as number) + line;
    }
  }
  return (column: number, row: number, columns: number, rows: number): number => {
    const [top, low] = [row * stride + column, (row + rows) * stride + column];
    return (
      (sums[low + columns] as number) - (sums[low] as number) - (sums[top + columns] as number) + (sums[top] as number)
    );
  };
}

/** The largest box of these proportions that fits inside and is no larger than wanted; of several, the one nearest to
 * the page's middle.
 * @param wide, tall  wanted size in shares of the page; a margin of one texel stays free around it */
export function placeIn(wide: number, tall: number, { width, height, inside }: Room): Place {
  const sum = adder(inside, { width, height }); // a box is inside where its sum equals its area
  const find = (scale: number): Place | undefined => {
    const [columns, rows] = [Math.ceil(wide * scale * width) + 2, Math.ceil(tall * scale * height) + 2];
    let best: Place | undefined;
    let nearest = Infinity;
    for (let row = 0; row + rows <= height; ++row) {
      for (let column = 0; column + columns <= width; ++column) {
        if (sum(column, row, columns, rows) < rows * columns) continue;
        const [x, y] = [(column + columns / 2) / width, (row + rows / 2) / height];
        const away = Math.hypot(x - 0.5, ((y - 0.5) * height) / width);
        if (away >= nearest) continue;
        nearest = away;
        best = { scale, x, y };
      }
    }
    return best;
  };
  let found: Place | undefined = find(1);
  if (found !== undefined) return found;
  let low = 0;
  let high = 1;
  for (let k = 0; k < 9; ++k) {
    const scale: number = (low + high) / 2;
    const place: Place | undefined = find(scale);
    if (place === undefined) high = scale;
    else {
      low = scale;
      found = place;
    }
  }
  return found ?? { scale: 1, x: 0.5, y: 0.5 }; // nothing fits, so the box is cut wherever it lies
}
