// Shows how pictures on one plate disturb each other: where one
// lacks the light that it asks for, and where it gets too much.
import type { Conflict } from 'sillon';

const lacking = [232, 120, 32] as const; // amber: light is missing
const extra = [36, 190, 200] as const; // teal: light of another picture
const least = 4; // [percent of the way from dark to white] largest difference that nobody sees
const full = 40; // [percent] difference from which the colour is at full strength

const drawn = new WeakMap<Conflict, OffscreenCanvas[]>();

/** Returns the tinted error of one picture, transparent where the plate shows it as intended.
 * @param picture  index of the picture
 * @returns undefined if there is no such picture */
export function conflictPicture(conflict: Conflict, picture: number): OffscreenCanvas | undefined {
  const known = drawn.get(conflict) ?? [];
  drawn.set(conflict, known);
  const missing = conflict.missing[picture];
  if (missing === undefined) return undefined;
  return (known[picture] ??= tinted(conflict, missing));
}

function tinted({ width, height }: Conflict, missing: Int8Array): OffscreenCanvas {
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext('2d')?.putImageData(new ImageData(conflictPixels(missing), width, height), 0, 0);
  return canvas;
}

/** Returns RGBA of each cell. */
export function conflictPixels(missing: Int8Array): Uint8ClampedArray<ArrayBuffer> {
  const pixels = new Uint8ClampedArray(4 * missing.length);
  for (const [k, percent] of missing.entries()) {
    const [red, green, blue] = percent > 0 ? lacking : extra;
    const strength = Math.min(1, Math.max(0, (Math.abs(percent) - least) / (full - least)));
    pixels.set([red, green, blue, Math.round(230 * strength)], 4 * k);
  }
  return pixels;
}
