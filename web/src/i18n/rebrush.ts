// Words of the view that re-brushes sliced prints, so that a first visit in English need not load them.
import { words as faces } from './en/core/faces.js';
import { words } from './en/rebrush.js';
import { sayer } from './text.js';

export const r = sayer('rebrush.', { ...words, ...faces });
export type RebrushTextId = Parameters<typeof r>[0];
