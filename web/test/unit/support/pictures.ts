import type { Picture } from 'sillon';
import type { SourceFile } from '../../../src/model/plate.js';

/** A grey picture by a formula. @param at  0..1 at a texel */
export function greyPicture(width: number, height: number, at: (x: number, y: number) => number): Picture {
  const samples = Uint8Array.from({ length: width * height }, (_, k) =>
    Math.round(255 * at(k % width, Math.floor(k / width))),
  );
  return { width, height, channels: 1, samples };
}

/** A picture of red, green and blue by a formula. @param at  0..1 each at a texel */
export function colourPicture(width: number, height: number, at: (x: number, y: number) => readonly number[]): Picture {
  const pixels = Array.from({ length: width * height }, (_, k) => at(k % width, Math.floor(k / width)));
  return { width, height, channels: 3, samples: Uint8Array.from(pixels.flat(), (share) => Math.round(255 * share)) };
}

export const fileOf = (name: string, content: BlobPart = name): SourceFile => ({
  id: `id of ${name}`,
  name,
  bytes: new Blob([content]),
});

/** mulberry32: 0..1, the same in every run. */
export function chances(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Between beads [degrees], 0..90. */
export function between(a: number, b: number): number {
  const turn = (((a - b) % 180) + 180) % 180;
  return Math.min(turn, 180 - turn);
}

/** Of an angle as rasters store it. */
export const degreesOf = (stored: number): number => (stored / 65535) * 180 - 90;

/** As rasters store it. */
export const storeDegrees = (degrees: number): number => {
  const turn = (((degrees + 90) % 180) + 180) % 180;
  return Math.round((turn / 180) * 65535);
};
