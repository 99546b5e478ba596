// Settings that another page may ask for when it shows the studio in a frame. They come as text, in attributes or an
// address, and may have been written by anybody.
import { oneOf, Unfit } from './check.js';
import { printers, type PrinterKey } from './printers.js';
import { settings, type SettingId } from './settings.js';
import type { Theme } from './state.js';

/** Extent of the studio: 'edit' is all of it, 'customize' only what `controls` name, 'view' only the plate under its
 * light. */
export type Mode = 'edit' | 'customize' | 'view';
/** Unit of the plate's size; beads, printers and files are in mm everywhere. */
export type Units = 'mm' | 'in';

export const sections = ['layers', 'shape', 'print', 'quality'] as const;
export type Section = (typeof sections)[number];

const parts = ['name', 'size', 'source', 'filament', 'printer', 'download'] as const;
/** A whole section, one setting, or one part of a plate; `source` stands for the fields of the plate's fill. */
export type Control = Section | SettingId | (typeof parts)[number];
const controls: readonly Control[] = [...sections, ...parts, ...settings.map(({ id }) => id)];

export interface GuestSettings {
  mode: Mode;
  /** Controls that mode 'customize' shows. */
  controls: readonly Control[];
  language: string;
  theme: Theme;
  units: Units;
  printer: PrinterKey;
  threads: 'auto' | 'off' | number;
  /** Name under which the visitor's changes are kept, separately for each host. */
  autosave: string;
}

const readers: {
  [Name in keyof GuestSettings]: [
    attribute: string,
    read: (text: string, languages: readonly string[]) => GuestSettings[Name],
  ];
} = {
  mode: ['mode', (text) => oneOf(text, 'mode', ['edit', 'customize', 'view'])],
  controls: [
    'controls',
    (text) =>
      text
        .split(/[\s,]+/)
        .filter((name) => name !== '')
        .map((name) => oneOf(name, 'controls', controls)),
  ],
  language: ['lang', (text, languages) => oneOf(text.toLowerCase().split('-')[0], 'lang', languages)],
  theme: ['theme', (text) => oneOf(text, 'theme', ['auto', 'light', 'dark'])],
  units: ['units', (text) => oneOf(text, 'units', ['mm', 'in'])],
  printer: [
    'printer',
    (text) =>
      oneOf(
        text,
        'printer',
        printers.map(({ key }) => key),
      ),
  ],
  threads: [
    'threads',
    (text) => {
      if (text === 'auto' || text === 'off') return text;
      const count = Number(text);
      if (!/^\d{1,2}$/.test(text) || count < 1 || count > 64) throw new Unfit('threads', text);
      return count;
    },
  ],
  autosave: [
    'autosave',
    (text) => {
      if (!/^[\w-]{0,64}$/.test(text)) throw new Unfit('autosave', text);
      return text;
    },
  ],
};

/** Reads the settings that a page asks for.
 * @param textOf  an attribute's text; undefined where it is not set
 * @param languages  languages that the studio speaks
 * @returns the valid settings, and an error for each invalid one */
export function guestSettings(
  textOf: (attribute: string) => unknown,
  languages: readonly string[],
): {
  given: Partial<GuestSettings>;
  wrong: Unfit[];
} {
  const given: Partial<Record<keyof GuestSettings, unknown>> = {};
  const wrong: Unfit[] = [];
  for (const [name, [attribute, read]] of Object.entries(readers)) {
    const text = textOf(attribute);
    if (text === undefined) continue;
    try {
      if (typeof text !== 'string' || text.length > 1000) throw new Unfit(attribute, text);
      given[name as keyof GuestSettings] = read(text, languages);
    } catch (error) {
      if (!(error instanceof Unfit)) throw error;
      wrong.push(error);
    }
  }
  return { given: given as Partial<GuestSettings>, wrong };
}
