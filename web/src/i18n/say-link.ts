// Words for what a link to a plate cannot carry.
import type { Untold } from '../model/untold.js';
import { words } from './en/links.js';
import { language, say } from './text.js';

/** @param parts  what a link cannot carry */
const listed = (parts: readonly Untold[]): string =>
  new Intl.ListFormat(language(), { type: 'conjunction' }).format(
    parts.map((part) => say(words, `link.untold.${part}`)),
  );

/** For who sends the link. */
export const untoldText = (parts: readonly Untold[]): string =>
  parts.length === 0 ? say(words, 'link.complete') : say(words, 'link.untold', { parts: listed(parts) });

/** For who opens it; empty where nothing is missing. */
export const missingText = (parts: readonly Untold[]): string =>
  parts.length === 0 ? '' : say(words, 'link.missing', { parts: listed(parts) });
