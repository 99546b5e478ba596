// Places the camera so that a whole plate is visible between the buttons that lie over it. Lengths are CSS pixels.
import type { Camera } from './scene.js';

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** Returns the part of an area that boxes leave free: each box takes the side of the area where it costs least. */
export function freeOf(area: Box, boxes: readonly Box[]): Box {
  const free = { ...area };
  for (const { left, top, right, bottom } of boxes) {
    const covers = left < free.right && right > free.left && top < free.bottom && bottom > free.top;
    if (right === left || !covers) continue;
    const [wide, tall] = [free.right - free.left, free.bottom - free.top];
    const costs = [
      (bottom - free.top) * wide,
      (free.bottom - top) * wide,
      (right - free.left) * tall,
      (free.right - left) * tall,
    ];
    const side = costs.indexOf(Math.min(...costs));
    if (side === 0) free.top = bottom;
    else if (side === 1) free.bottom = top;
    else if (side === 2) free.left = right;
    else free.right = left;
  }
  return free;
}

/** Returns the camera that centres a plate in a box of an element.
 * @param plate  sides of the plate [mm]
 * @param element  sides of the element
 * @param scale  pixels per mm; undefined: the plate fills the box */
export function seenIn(
  { left, top, right, bottom }: Box,
  plate: readonly [number, number],
  element: readonly [number, number],
  scale?: number,
): Camera {
  const [wide, tall] = plate;
  const [width, height] = element;
  const pixels = scale ?? Math.max(0.01, Math.min((right - left) / wide, (bottom - top) / tall));
  return {
    x: wide / 2 + (width - left - right) / 2 / pixels,
    y: tall / 2 - (height - top - bottom) / 2 / pixels,
    scale: pixels,
  };
}
