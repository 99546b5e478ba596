// A direction for each flat colour of a drawing.
import type { Picture } from 'sillon';
import { alike, clear, colourOf, colours, distance, farthest } from '../model/flat-colours.js';
import { storeDegrees } from './angle.js';
import { nearest } from './map.js';
import type { SourceOf } from './source.js';
import type { Size } from './texels.js';

const same = 4; // of 255 in any channel: rounding

/** Which of the listed colours each texel shows; -1 for edges and for what is not painted. */
function listed(all: Int32Array, { width, height }: Size, list: readonly number[]): Int8Array {
  const known = new Map<number, number>();
  const nearestOf = (colour: number): number => {
    const before = known.get(colour);
    if (before !== undefined) return before;
    let best = 0;
    for (let k = 1; k < list.length; ++k) {
      if (distance(list[k] as number, colour) < distance(list[best] as number, colour)) best = k;
    }
    known.set(colour, best);
    return best;
  };
  const out = new Int8Array(all.length).fill(-1);
  for (let y = 0, k = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x, ++k) {
      const colour = all[k] as number;
      if (colour === clear) continue;
      const best = nearestOf(colour);
      const beside = [
        x > 0 ? all[k - 1] : colour,
        x + 1 < width ? all[k + 1] : colour,
        y > 0 ? all[k - width] : colour,
        y + 1 < height ? all[k + width] : colour,
      ] as number[];
      const smooth = beside.every((other) => other !== clear && farthest(other, colour) <= alike);
      if (smooth || farthest(list[best] as number, colour) <= same) out[k] = best;
    }
  }
  return out;
}

/** Whatever is -1 takes what is nearest, by steps from texel to texel. */
function spread(values: Int8Array, { width, height }: Size): void {
  let front: number[] = [];
  values.forEach((value, k) => {
    if (value >= 0) front.push(k);
  });
  while (front.length > 0) {
    const next: number[] = [];
    const take = (k: number, from: number): void => {
      if ((values[k] as number) >= 0) return;
      values[k] = values[from] as number;
      next.push(k);
    };
    for (const k of front) {
      const x = k % width;
      if (x > 0) take(k - 1, k);
      if (x + 1 < width) take(k + 1, k);
      if (k >= width) take(k - width, k);
      if (k + width < width * height) take(k + width, k);
    }
    front = next;
  }
}

/** Without any colour: 0°. */
export function coloursAngles(source: SourceOf<'colours'>, size: Size, picture: Picture): Uint16Array {
  const angles = new Uint16Array(size.width * size.height).fill(storeDegrees(0));
  if (source.colours.length === 0) return angles;
  const all = nearest(colours(picture), picture, size);
  const which = listed(
    all,
    size,
    source.colours.map(({ colour }) => colourOf(colour)),
  );
  spread(which, size);
  const stored = source.colours.map(({ angle }) => storeDegrees(angle));
  which.forEach((one, k) => {
    if (one >= 0) angles[k] = stored[one] as number;
  });
  return angles;
}
