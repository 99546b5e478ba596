// The words of the view that re-brushes sliced prints: no first visit has to fetch them in English.
import { rebrushEn } from './rebrush-en.js';
import { filled, translated, type Values } from './text.js';

type Unprefixed<Id> = Id extends `rebrush.${infer Rest}` ? Rest : never;
export type RebrushTextId = Unprefixed<keyof typeof rebrushEn>;

/** As `t`. */
export function r(name: RebrushTextId, values: Values = {}): string {
  const id = `rebrush.${name}` as const;
  return filled(translated(id) ?? rebrushEn[id], values);
}
