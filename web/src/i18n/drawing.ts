// The words for how a drawing is read: no first visit has to fetch them in English.
import { drawingEn } from './drawing-en.js';
import { filled, translated } from './text.js';

type Unprefixed<Id> = Id extends `drawing.${infer Rest}` ? Rest : never;

/** As `t`. */
export function d(name: Unprefixed<keyof typeof drawingEn>): string {
  const id = `drawing.${name}` as const;
  return filled(translated(id) ?? drawingEn[id], {});
}
