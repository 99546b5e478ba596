// Places of texels on the page, in page widths: x right, y up, (0, 0) at the lower left.

export interface Size {
  width: number;
  height: number;
}

/** Of the page [any unit]: only the proportions count. */
export type Page = readonly [number, number];

/** @param longest  texels of the longer side */
export function sizeFor([width, height]: Page, longest: number): Size {
  const texels = (side: number): number => Math.max(1, Math.round((longest * side) / Math.max(width, height)));
  return { width: texels(width), height: texels(height) };
}

/** Angles of a field that is told by a formula. @param at  stored angle at a place */
export function anglesOf({ width, height }: Size, page: Page, at: (x: number, y: number) => number): Uint16Array {
  const angle = new Uint16Array(width * height);
  const tall = page[1] / page[0];
  for (let row = 0; row < height; ++row) {
    const y = (1 - (row + 0.5) / height) * tall;
    for (let column = 0; column < width; ++column) angle[row * width + column] = at((column + 0.5) / width, y);
  }
  return angle;
}

/** A place in the page's unit square, in page widths. */
export const inWidths = ([x, y]: readonly [number, number], page: Page): [number, number] => [
  x,
  (y * page[1]) / page[0],
];
