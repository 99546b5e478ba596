// Words about the parts of a plate that a link cannot carry.
import type { Untold } from '../model/untold.js';
import { words } from './en/links.js';
import { language, say } from './text.js';

/** Lists parts in a sentence. @param parts  parts that a link cannot carry */
const listed = (parts: readonly Untold[]): string =>
  new Intl.ListFormat(language(), { type: 'conjunction' }).format(
    parts.map((part) => say(words, `link.untold.${part}`)),
  );

/** Text for the sender of a link. */
export const untoldText = (parts: readonly Untold[]): string =>
  parts.length === 0 ? say(words, 'link.complete') : say(words, 'link.untold', { parts: listed(parts) });

/** Text for whoever opens a link; empty where nothing is missing. */
export const missingText = (parts: readonly Untold[]): string =>
  parts.length === 0 ? '' : say(words, 'link.missing', { parts: listed(parts) });
