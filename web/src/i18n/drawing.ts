// Words of the fields for reading a drawing, so that a first visit in English need not load them.
import { words } from './en/drawing.js';
import { sayer } from './text.js';

export const d = sayer('drawing.', words);
