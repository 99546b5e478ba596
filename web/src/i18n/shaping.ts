// Words of the fields that change a shape, so that a first view in English need not load them.
import { words } from './en/shaping.js';
import { sayer } from './text.js';

export const a = sayer('shaping.', words);
