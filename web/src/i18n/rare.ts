// The words of rare-en.ts in the page's language.
import type { Untold } from '../model/share.js';
import { rareEn } from './rare-en.js';
import { filled, language, translated, type Values } from './text.js';

type Unprefixed<Id> = Id extends `rare.${infer Rest}` ? Rest : never;
export type RareTextId = Unprefixed<keyof typeof rareEn>;

/** As `t`. */
export function rare(name: RareTextId, values: Values = {}): string {
  const id = `rare.${name}` as const;
  return filled(translated(id) ?? rareEn[id], values);
}

/** @param parts  what a link cannot carry */
const listed = (parts: readonly Untold[]): string =>
  new Intl.ListFormat(language(), { type: 'conjunction' }).format(parts.map((part) => rare(`link.untold.${part}`)));

/** For who sends the link. */
export const untoldText = (parts: readonly Untold[]): string =>
  parts.length === 0 ? rare('link.complete') : rare('link.untold', { parts: listed(parts) });

/** For who opens it; empty where nothing is missing. */
export const missingText = (parts: readonly Untold[]): string =>
  parts.length === 0 ? '' : rare('link.missing', { parts: listed(parts) });

/** For names that come from elsewhere. */
export const hasRare = (id: string): id is RareTextId => Object.hasOwn(rareEn, `rare.${id}`);
