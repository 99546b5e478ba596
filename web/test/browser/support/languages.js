// The languages of the page, by the files of their words; a test in test/unit/i18n.test.ts holds these against the page's list.
import { readdirSync } from 'node:fs';

export const languages = readdirSync(new URL('../../../src/i18n/', import.meta.url))
  .filter((name) => /^..\.ts$/.test(name))
  .map((name) => name.slice(0, 2))
  .sort();
