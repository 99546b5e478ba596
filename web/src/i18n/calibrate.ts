// The words of the calibration page, of own spools and of the first print: no first visit has to fetch them in English.
import { calibrateEn } from './calibrate-en.js';
import { filled, translated, type Values } from './text.js';

type Unprefixed<Id> = Id extends `calibrate.${infer Rest}` ? Rest : never;
export type CalibrateTextId = Unprefixed<keyof typeof calibrateEn>;

/** As `t`. */
export function c(name: CalibrateTextId, values: Values = {}): string {
  const id = `calibrate.${name}` as const;
  return filled(translated(id) ?? calibrateEn[id], values);
}
