// The page's words. A word that a language lacks is a type error.
import { en } from './en.js';
import type { words as about } from './en/about.js';
import type { words as blocks } from './en/blocks.js';
import type { words as calibrate } from './en/calibrate.js';
import type { words as colours } from './en/colours.js';
import type { words as faces } from './en/core/faces.js';
import type { words as findings } from './en/core/findings.js';
import type { words as importNotes } from './en/core/import-notes.js';
import type { words as layerSettings } from './en/core/layer-settings.js';
import type { words as reasons } from './en/core/reasons.js';
import type { words as settingHelp } from './en/core/setting-help.js';
import type { words as warnings } from './en/core/warnings.js';
import type { words as verdicts } from './en/verdicts.js';
import type { words as doubts } from './en/doubts.js';
import type { words as drawing } from './en/drawing.js';
import type { words as exports } from './en/export.js';
import type { words as files } from './en/files.js';
import type { words as help } from './en/help.js';
import type { words as layers } from './en/layers.js';
import type { words as links } from './en/links.js';
import type { words as looks } from './en/looks.js';
import type { words as plates } from './en/plates.js';
import type { words as presets } from './en/presets.js';
import type { words as printer } from './en/printer.js';
import type { words as problems } from './en/problems.js';
import type { words as quality } from './en/quality.js';
import type { words as rebrush } from './en/rebrush.js';
import type { words as shaping } from './en/shaping.js';
import type { words as synonyms } from './en/synonyms.js';
import type { words as zones } from './en/zones.js';
import { languages, spoken } from './languages.js';

/** A sentence, or its forms for one and for several, chosen by the value `n`. `{name}` stands for a value. */
export type Text = string | { readonly one: string; readonly other: string };
export type TextId = keyof typeof en;
export type Dictionary = Readonly<Record<TextId, Text>>;

type Late =
  | typeof about
  | typeof blocks
  | typeof calibrate
  | typeof colours
  | typeof doubts
  | typeof drawing
  | typeof exports
  | typeof faces
  | typeof files
  | typeof findings
  | typeof help
  | typeof importNotes
  | typeof layerSettings
  | typeof layers
  | typeof links
  | typeof looks
  | typeof plates
  | typeof presets
  | typeof printer
  | typeof problems
  | typeof quality
  | typeof reasons
  | typeof rebrush
  | typeof settingHelp
  | typeof shaping
  | typeof synonyms
  | typeof verdicts
  | typeof warnings
  | typeof zones;
type IdOf<Words> = Words extends unknown ? keyof Words : never;
/** Words of a language other than English, which are all in one file. */
export type Translation = Dictionary & Readonly<Record<IdOf<Late>, Text>>;
export type Values = Readonly<Record<string, string | number>>;

let current = 'en';
let dictionary: Dictionary = en;
let plurals = new Intl.PluralRules('en');

export const language = (): string => current;

/** Switches the page to a language. @param next  one of `spoken` */
export async function setLanguage(next: string): Promise<void> {
  dictionary = (await languages[next]?.words()) ?? en;
  current = next;
  plurals = new Intl.PluralRules(next);
}

/** The first wanted language that the page speaks, else English. @param wanted  tags as in navigator.languages */
export function languageFor(wanted: readonly string[]): string {
  for (const tag of wanted) {
    const base = tag.toLowerCase().split('-')[0] ?? '';
    if (spoken.includes(base)) return base;
  }
  return 'en';
}

/** The text of an id. Numbers among the values are written in the language's way, with at most two decimals. */
export const t = (id: TextId, values: Values = {}): string => filled(dictionary[id], values);

/** The text of an id in words that are loaded later. @param english  words of one file of en/ */
export const say = <Id extends string>(english: Readonly<Record<Id, Text>>, id: Id, values: Values = {}): string =>
  filled((dictionary as Readonly<Record<string, Text>>)[id] ?? english[id], values);

type Rest<Id, Prefix extends string> = Id extends `${Prefix}${infer Name}` ? Name : never;

/** Makes a `say` for words whose ids share a prefix. */
export const sayer =
  <Prefix extends string, Id extends `${Prefix}${string}`>(prefix: Prefix, english: Readonly<Record<Id, Text>>) =>
  (name: Rest<Id, Prefix>, values: Values = {}): string =>
    say(english, `${prefix}${name}` as Id, values);

/** A text with its values filled in, in the form that `n` requires. */
function filled(text: Text, values: Values): string {
  const form = typeof text === 'string' ? text : plurals.select(Number(values['n'])) === 'one' ? text.one : text.other;
  return form.replace(/\{(\w+)\}/g, (whole, name: string) => {
    const value = values[name];
    if (value === undefined) return whole;
    return typeof value === 'number' ? formatNumber(value) : value;
  });
}

/** Tells whether an id that comes from elsewhere, such as a stage of the engine, has a text. */
export const hasText = (id: string): id is TextId => Object.hasOwn(en, id);

export function formatNumber(value: number, digits = 2): string {
  return new Intl.NumberFormat(current, { maximumFractionDigits: digits }).format(value);
}

/** A duration such as "45 s", "12 min" or "2 h 05 min". */
export function formatDuration(seconds: number): string {
  if (seconds < 59.5) return t('duration.seconds', { s: Math.max(1, Math.round(seconds)) });
  const minutes = Math.round(seconds / 60);
  if (minutes < 60) return t('duration.minutes', { m: minutes });
  return t('duration.hours', { h: Math.floor(minutes / 60), m: String(minutes % 60).padStart(2, '0') });
}

export function formatBytes(bytes: number): string {
  if (bytes < 1000) return t('bytes.b', { b: bytes });
  if (bytes < 1e6) return t('bytes.kb', { kb: Math.round(bytes / 1000) });
  return t('bytes.mb', { mb: Math.round(bytes / 1e5) / 10 });
}
