// The look of beads without a graphics card: the shaders' formula (shaders.ts), for beads too fine to be told apart.
import { appearance } from '../model/appearance.js';
import { exposed, highlightOf, type Look } from './look.js';

export type Rgb = readonly [number, number, number];

const luminance = ([r, g, b]: Rgb): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** The shaders' `toned`: as it is up to 0.8, with a soft shoulder above. @returns 0..255 */
function toned(value: number): number {
  const over = Math.max(value - 0.8, 0);
  const kept = Math.min(1, Math.max(0, Math.min(value, 0.8) + (0.2 * over) / (0.2 + over)));
  return 255 * (kept <= 0.0031308 ? 12.92 * kept : 1.055 * kept ** (1 / 2.4) - 0.055);
}

/** @param body  of the filament, linear 0..1
 * @returns sRGB 0..255 of so much of the brightest direction's light */
export function litColour(body: Rgb): (light: number) => Rgb {
  const tinted = body.map((one, k) => (0.15 + 0.85 * one) * ([1, 0.97, 0.92][k] as number));
  const most = 0.88 / Math.max(...tinted);
  const lit = tinted.map((one) => one * most) as unknown as Rgb;
  const share = luminance(lit) / Math.max(luminance(body), 1e-4);
  const channel = (k: 0 | 1 | 2, light: number): number =>
    toned(lit[k] * (1 - appearance.diffuse) * light + body[k] * share * appearance.diffuse);
  return (light) => [channel(0, light), channel(1, light), channel(2, light)];
}

/** @returns the light of a bead along a unit vector at a place of the page [mm], 1: that of the brightest direction */
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

/** A tone of a bead along a unit vector at a place of the page [mm], 0..1, and the colour of a tone. */
export interface Tones {
  of: (alongX: number, alongY: number, x: number, y: number) => number;
  colour: (tone: number) => Rgb;
}

const most = 1.2; // light of the brightest tone: seen from aside a bead may be brighter than the brightest direction

/** Tones are even to the eye, which tells dark ones apart better than bright ones. */
export function tonesOf(look: Look): Tones {
  const light = lightBy(look);
  const colour = litColour(look.body);
  return { of: (...at) => Math.sqrt(light(...at) / most), colour: (tone) => colour(most * tone * tone) };
}
