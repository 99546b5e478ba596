// The flat colours of a drawing, and the first directions given to them.
import type { ColourAngle, Picture } from 'sillon';

/** Colour of pixels that nobody painted. */
export const clear = -1;
const faintest = 16; // alpha, of 255, below which a pixel is unpainted; above it faint paint is solid, as in the shape
export const alike = 10; // largest difference, of 255, between neighbours in a gradient; beyond it is an edge
const merged = 36; // distance in RGB below which colours are one
const leastShare = 0.004; // share of the painted pixels; rarer colours are left out
export const mostColours = 12;

/** Colour 0xrrggbb of each pixel, or `clear`. */
export function colours({ width, height, channels, samples }: Picture): Int32Array {
  const scale = samples instanceof Uint16Array ? 1 / 257 : 1;
  const out = new Int32Array(width * height);
  for (let pixel = 0, k = 0; pixel < out.length; ++pixel, k += channels) {
    const byte = (channel: number): number => Math.round((samples[k + channel] as number) * scale);
    if (channels % 2 === 0 && byte(channels - 1) < faintest) {
      out[pixel] = clear;
      continue;
    }
    const grey = channels < 3;
    out[pixel] = (byte(0) << 16) | (byte(grey ? 0 : 1) << 8) | byte(grey ? 0 : 2);
  }
  return out;
}

const red = (colour: number): number => colour >> 16;
const green = (colour: number): number => (colour >> 8) & 255;
const blue = (colour: number): number => colour & 255;

/** Largest difference in any one channel, 0..255. */
export const farthest = (a: number, b: number): number =>
  Math.max(Math.abs(red(a) - red(b)), Math.abs(green(a) - green(b)), Math.abs(blue(a) - blue(b)));
/** Euclidean distance in RGB. */
export const distance = (a: number, b: number): number =>
  Math.hypot(red(a) - red(b), green(a) - green(b), blue(a) - blue(b));
const tone = (colour: number): number => 0.2126 * red(colour) + 0.7152 * green(colour) + 0.0722 * blue(colour);

export const colourOf = (text: string): number => Number.parseInt(text.slice(1), 16);
const textOf = (colour: number): string => `#${colour.toString(16).padStart(6, '0')}`;

/** The flat colours of a picture as '#rrggbb', from dark to light. Pixels on an edge between two areas are not
 * counted; gradients give a few steps. */
export function flatColours(picture: Picture): string[] {
  const { width, height } = picture;
  const all = colours(picture);
  const counts = new Map<number, number>();
  let painted = 0;
  for (let y = 1; y < height; ++y) {
    for (let x = 1, k = y * width + 1; x < width; ++x, ++k) {
      const colour = all[k] as number;
      const [left, above] = [all[k - 1] as number, all[k - width] as number];
      if (colour === clear || left === clear || above === clear) continue;
      if (farthest(colour, left) > alike || farthest(colour, above) > alike) continue;
      counts.set(colour, (counts.get(colour) ?? 0) + 1);
      ++painted;
    }
  }
  const found: { colour: number; count: number }[] = [];
  for (const [colour, count] of [...counts].sort((a, b) => b[1] - a[1])) {
    const near = found.find((one) => distance(one.colour, colour) < merged);
    if (near !== undefined) near.count += count;
    else if (found.length < 4 * mostColours) found.push({ colour, count });
  }
  return found
    .filter(({ count }) => count >= leastShare * painted)
    .sort((a, b) => b.count - a.count)
    .slice(0, mostColours)
    .sort((a, b) => tone(a.colour) - tone(b.colour))
    .map(({ colour }) => textOf(colour));
}

/** Spreads directions from dark to light, so that the usual light shows the drawing's dark and light areas as they are.
 * @param before  directions already chosen, kept for colours that are still there */
export function directionsFor(found: readonly string[], before: readonly ColourAngle[] = []): ColourAngle[] {
  const [dark, light] = [60, 150];
  const share = (k: number): number => (found.length > 1 ? k / (found.length - 1) : 1);
  return found.map((colour, k) => ({
    colour,
    angle: before.find((one) => one.colour === colour)?.angle ?? Math.round(dark + (light - dark) * share(k)),
  }));
}
