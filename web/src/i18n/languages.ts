// Languages of the page: each has a line here, and its words in a file of this folder (docs/guide/translate.md).
// English is always loaded, the others when they are chosen.
import { en } from './en.js';
import type { Dictionary } from './text.js';

interface Language {
  /** The language's own name for itself. */
  readonly name: string;
  readonly words: () => Promise<Dictionary>;
}

export const languages: Readonly<Record<string, Language>> = {
  en: { name: 'English', words: () => Promise.resolve(en) },
  fr: { name: 'Français', words: async () => (await import('./fr.js')).fr },
  de: { name: 'Deutsch', words: async () => (await import('./de.js')).de },
};

/** Tags of the languages, as in `?lang=`. */
export const spoken: readonly string[] = Object.keys(languages);
