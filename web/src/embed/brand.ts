// The host's colour, corners and fonts. Anybody may have written its attributes, so colours, lengths and font names are
// parsed and written anew: no other style and no address can come in with them.
import { Unfit } from '../model/check.js';

/** Custom properties of src/controls/tokens.css by name; '': the style sheet's own value. */
export type Brand = Readonly<Record<string, string>>;

type Rgb = readonly [number, number, number];

const grounds = { light: [0xf4, 0xf3, 0xef], dark: [0x15, 0x18, 0x1b] } as const; // --surface
const enough = 4.5; // least contrast of text, WCAG 2 level AA
const mostRadius = 20; // [px]
const mostFonts = 4;
const generic = /^(?:serif|sans-serif|monospace|cursive|system-ui|ui-(?:serif|sans-serif|monospace|rounded))$/;

/** Returns the relative luminance of WCAG 2, 0..1. */
function luminance(colour: Rgb): number {
  const [red, green, blue] = colour.map((byte) => {
    const x = byte / 255;
    return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
  }) as [number, number, number];
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/** Returns the contrast ratio of WCAG 2, from 1 to 21. */
export function contrast(a: Rgb, b: Rgb): number {
  const [low = 0, high = 0] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

const mixed = (a: Rgb, b: Rgb, share: number): Rgb =>
  a.map((channel, k) => Math.round(channel + share * ((b[k] ?? 0) - channel))) as unknown as Rgb;

const hex = (colour: Rgb): string => `#${colour.map((byte) => byte.toString(16).padStart(2, '0')).join('')}`;

/** Returns the colour itself, or the nearest mix with black or white that is readable on that ground. */
function readable(colour: Rgb, ground: Rgb): Rgb {
  const far: Rgb = luminance(ground) > 0.5 ? [0, 0, 0] : [255, 255, 255];
  for (let share = 0; share < 1; share += 0.04) {
    const nearer = mixed(colour, far, share);
    if (contrast(nearer, ground) >= enough) return nearer;
  }
  return far;
}

/** Returns black or white, whichever is easier to read on the colour. */
const onColour = (colour: Rgb): Rgb =>
  contrast([255, 255, 255], colour) >= contrast([0, 0, 0], colour) ? [255, 255, 255] : [0, 0, 0];

/** Derives the accent colours of both themes from one hex colour. @throws Unfit */
function accent(text: string): Brand {
  const names = ['--accent', '--on-accent', '--accent-hover', '--tint'];
  if (text === '') return Object.fromEntries(names.map((name) => [name, '']));
  const digits = /^#([0-9a-f]{3}|[0-9a-f]{6})$/i.exec(text)?.[1];
  if (digits === undefined) throw new Unfit('accent', text);
  const full = digits.length === 3 ? digits.replace(/./g, '$&$&') : digits;
  const asked = [0, 2, 4].map((k) => parseInt(full.slice(k, k + 2), 16)) as unknown as Rgb;
  const of = (ground: Rgb): string[] => {
    const colour = readable(asked, ground);
    const over = onColour(colour);
    const away: Rgb = luminance(ground) > 0.5 ? [0, 0, 0] : [255, 255, 255];
    return [colour, over, mixed(colour, away, 0.15), mixed(ground, colour, 0.12)].map(hex);
  };
  const [light, dark] = [of(grounds.light), of(grounds.dark)];
  return Object.fromEntries(names.map((name, k) => [name, `light-dark(${light[k] ?? ''}, ${dark[k] ?? ''})`]));
}

/** Reads a corner radius in pixels. @throws Unfit */
function radius(text: string): Brand {
  if (text === '') return { '--radius': '', '--radius-large': '' };
  const pixels = Number(/^(\d{1,2}(?:\.\d{1,2})?)(?:px)?$/.exec(text)?.[1]);
  if (!(pixels <= mostRadius)) throw new Unfit('radius', text);
  return { '--radius': `${pixels}px`, '--radius-large': `${2 * pixels}px` };
}

/** Reads a list of font families and quotes each name. @throws Unfit */
function font(text: string): Brand {
  if (text === '') return { '--font': '' };
  const families = text.split(',').map((name) => name.trim().replace(/^(['"])(.*)\1$/, '$2'));
  if (families.length > mostFonts || !families.every((name) => /^[\p{L}\p{N}][\p{L}\p{N} _-]{0,39}$/u.test(name))) {
    throw new Unfit('font', text);
  }
  const quoted = families.map((name) => (generic.test(name) ? name : `'${name}'`));
  return { '--font': [...quoted, 'system-ui', 'sans-serif'].join(', ') };
}

const readers: Readonly<Record<string, (text: string) => Brand>> = { accent, radius, font };

/** Reads the brand from attributes. @param textOf  value of an attribute; undefined if it is not set @throws Unfit */
export function brandFrom(textOf: (attribute: string) => unknown): Brand {
  return Object.entries(readers).reduce<Brand>((brand, [attribute, read]) => {
    const text = textOf(attribute);
    if (text === undefined) return brand;
    if (typeof text !== 'string' || text.length > 200) throw new Unfit(attribute, text);
    return { ...brand, ...read(text.trim()) };
  }, {});
}

/** Sets the custom properties of the page. */
export function wear(brand: Brand): void {
  const { style } = document.documentElement;
  for (const [name, value] of Object.entries(brand)) {
    if (value === '') style.removeProperty(name);
    else style.setProperty(name, value);
  }
}
