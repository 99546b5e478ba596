// The words of the view that re-brushes sliced prints: no first visit has to fetch them in English.
import { words as faces } from './en/core/faces.js';
import { words } from './en/rebrush.js';
import { sayer } from './text.js';

export const r = sayer('rebrush.', { ...words, ...faces });
export type RebrushTextId = Parameters<typeof r>[0];
