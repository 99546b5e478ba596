// The page's words. What a language lacks would be a type error.
import type { calibrateEn } from './calibrate-en.js';
import { en } from './en.js';
import type { drawingEn } from './drawing-en.js';
import type { helpEn } from './help-en.js';
import { languages, spoken } from './languages.js';
import type { rareEn } from './rare-en.js';
import type { rebrushEn } from './rebrush-en.js';

export type TextId = keyof typeof en;
/** A sentence, or its forms by the number `n` it speaks of. `{name}` stands for a value. */
export type Text = string | { readonly one: string; readonly other: string };
export type Dictionary = Readonly<Record<TextId, Text>>;
/** Of a language but English, whose words of views that are rarely opened are in files of their own. */
export type Translation = Dictionary &
  Readonly<
    Record<
      | keyof typeof calibrateEn
      | keyof typeof drawingEn
      | keyof typeof helpEn
      | keyof typeof rareEn
      | keyof typeof rebrushEn,
      Text
    >
  >;
export type Values = Readonly<Record<string, string | number>>;

let current = 'en';
let dictionary: Dictionary = en;
let plurals = new Intl.PluralRules('en');

export const language = (): string => current;

/** From now on `t` speaks this language. @param next  one of `spoken` */
export async function setLanguage(next: string): Promise<void> {
  dictionary = (await languages[next]?.words()) ?? en;
  current = next;
  plurals = new Intl.PluralRules(next);
}

/** The first of these that the page speaks, else English. @param wanted  as navigator.languages */
export function languageFor(wanted: readonly string[]): string {
  for (const tag of wanted) {
    const base = tag.toLowerCase().split('-')[0] ?? '';
    if (spoken.includes(base)) return base;
  }
  return 'en';
}

/** Numbers among the values are written as the language does, with at most two decimals. */
export const t = (id: TextId, values: Values = {}): string => filled(dictionary[id], values);

/** Of words that English has elsewhere; undefined: they are English. */
export const translated = (id: string): Text | undefined => (dictionary as Readonly<Record<string, Text>>)[id];

/** A text with its values, in the form that their number asks for. */
export function filled(text: Text, values: Values): string {
  const form = typeof text === 'string' ? text : plurals.select(Number(values['n'])) === 'one' ? text.one : text.other;
  return form.replace(/\{(\w+)\}/g, (whole, name: string) => {
    const value = values[name];
    if (value === undefined) return whole;
    return typeof value === 'number' ? formatNumber(value) : value;
  });
}

/** For names that come from elsewhere, as the engine's stages. */
export const hasText = (id: string): id is TextId => Object.hasOwn(en, id);

export function formatNumber(value: number, digits = 2): string {
  return new Intl.NumberFormat(current, { maximumFractionDigits: digits }).format(value);
}

/** "45 s", "12 min", "2 h 05 min" */
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
