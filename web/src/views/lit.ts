// Look of beads without a graphics card: the shaders' formula (shaders.ts) for beads too fine to be told apart.
import { appearance } from '../model/appearance.js';
import { exposed, highlightOf, type Look } from './look.js';

export type Rgb = readonly [number, number, number];

const luminance = ([r, g, b]: Rgb): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** Tone-maps a channel as the shaders' `toned` does: unchanged
 * up to 0.8, with a soft shoulder above. @returns 0..255 */
function toned(value: number): number {
  const over = Math.max(value - 0.8, 0);
  const kept = Math.min(1, Math.max(0, Math.min(value, 0.8) + (0.2 * over) / (0.2 + over)));
  return 255 * (kept <= 0.0031308 ? 12.92 * kept : 1.055 * kept ** (1 / 2.4) - 0.055);
}

/** Returns a function from light to colour.
 * @param body  colour of the filament, linear 0..1
 * @returns sRGB 0..255 of a share of the brightest direction's light */
export function litColour(body: Rgb): (light: number) => Rgb {
  const tinted = body.map((one, k) => (0.15 + 0.85 * one) * ([1, 0.97, 0.92][k] as number));
  const most = 0.88 / Math.max(...tinted);
  const lit = tinted.map((one) => one * most) as unknown as Rgb;
  const share = luminance(lit) / Math.max(luminance(body), 1e-4);
  const channel = (k: 0 | 1 | 2, light: number): number =>
    toned(lit[k] * (1 - appearance.diffuse) * light + body[k] * share * appearance.diffuse);
  return (light) => [channel(0, light), channel(1, light), channel(2, light)];
}

/** Returns the light of a bead along a unit vector at a place
 * of the page [mm]; 1 is that of the brightest direction. */
export function lightBy(look: Omit<Look, 'body'>): (alongX: number, alongY: number, x: number, y: number) => number {
  const { lamp, variances, brightest } = exposed(look);
  const { page, fromAfar } = look;
  const away = 2.4 * Math.max(...page);
  return (alongX, alongY, x, y) => {
    const [eyeX, eyeY] = fromAfar ? [0, 0] : [(0.5 * page[0] - x) / away, (0.5 * page[1] - y) / away];
    const size = 1 / Math.hypot(eyeX, eyeY, 1);
    const tiltX = (lamp[0] + eyeX * size) / (lamp[2] + size);
    const tiltY = (lamp[1] + eyeY * size) / (lamp[2] + size);
    return highlightOf(tiltX * alongX + tiltY * alongY, alongX * tiltY - alongY * tiltX, variances) / brightest;
  };
}

/** Tone of a bead along a unit vector at a place of the page [mm], 0..1, and the colour of a tone. */
export interface Tones {
  of: (alongX: number, alongY: number, x: number, y: number) => number;
  colour: (tone: number) => Rgb;
}

const most = 1.2; // light of the brightest tone: at an angle, a bead may be brighter than the brightest direction

/** Returns tones that look evenly spaced: the eye tells dark
 * ones apart better than bright ones, hence the square root. */
export function tonesOf(look: Look): Tones {
  const light = lightBy(look);
  const colour = litColour(look.body);
  return { of: (...at) => Math.sqrt(light(...at) / most), colour: (tone) => colour(most * tone * tone) };
}
