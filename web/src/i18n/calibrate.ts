// Words of the calibration page, the visitor's own spools and the first print, so that a first visit in English need
// not load them.
import { words } from './en/calibrate.js';
import { sayer } from './text.js';

export const c = sayer('calibrate.', words);
export type CalibrateTextId = Parameters<typeof c>[0];
