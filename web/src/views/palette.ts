// Colours of directions: one turn of hue in OKLab (Ottosson 2020) over 180°. The command line's pictures use the same.

const lightness = 0.74;
const chroma = 0.122;
const firstHue = 0.13; // [turns] hue of direction 0

/** Returns the sRGB bytes of 256 directions in even steps, from 0° upwards. */
export function directionPalette(): Uint8Array {
  const bytes = new Uint8Array(3 * 256);
  for (let k = 0; k < 256; ++k) {
    const hue = 2 * Math.PI * (firstHue + k / 256);
    const a = chroma * Math.cos(hue);
    const b = chroma * Math.sin(hue);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
    const linear = [
      4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
      -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
      -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
    ];
    for (const [channel, value] of linear.entries()) {
      const clamped = Math.min(1, Math.max(0, value));
      const encoded = clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * clamped ** (1 / 2.4) - 0.055;
      bytes[3 * k + channel] = Math.round(encoded * 255);
    }
  }
  return bytes;
}

const stops = [
  [41, 61, 140],
  [41, 158, 140],
  [250, 191, 64],
] as const;

/** Returns the colour of a value from 0 to 1: dark blue over
 * green to amber, even in lightness, as `ramp` in shaders.ts. */
export function rampColour(value: number): [number, number, number] {
  const at = 2 * Math.min(1, Math.max(0, value));
  const [from, to] = at < 1 ? [stops[0], stops[1]] : [stops[1], stops[2]];
  const share = at < 1 ? at : at - 1;
  const mixed = (k: 0 | 1 | 2): number => Math.round(from[k] + (to[k] - from[k]) * share);
  return [mixed(0), mixed(1), mixed(2)];
}

/** Colours of marks, the places to look at; beads are grey behind
 * them. Marks differ in lightness, too, not in hue alone. */
export const markColours = {
  turn: '#d18a1f',
  narrow: '#3f7fd6',
  wide: '#c8443a',
  gap: '#772277',
  lost: '#00bfe0',
  kept: '#3f9d6b',
} as const;
