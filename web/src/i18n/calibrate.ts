// The words of the calibration page, of own spools and of the first print: no first visit has to fetch them in English.
import { words } from './en/calibrate.js';
import { sayer } from './text.js';

export const c = sayer('calibrate.', words);
export type CalibrateTextId = Parameters<typeof c>[0];
