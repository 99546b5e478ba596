// The words for how a drawing is read: no first visit has to fetch them in English.
import { words } from './en/drawing.js';
import { sayer } from './text.js';

export const d = sayer('drawing.', words);
