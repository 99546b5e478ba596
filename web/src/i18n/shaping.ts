// The words for what is done to a shape: no first view has to fetch them in English.
import { words } from './en/shaping.js';
import { sayer } from './text.js';

export const a = sayer('shaping.', words);
