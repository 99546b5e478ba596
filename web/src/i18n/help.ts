// What settings do, in the page's language.
import type { Setting } from '../model/settings.js';
import { helpEn } from './help-en.js';
import { filled, translated } from './text.js';

export function settingHelp({ id }: Setting): string {
  const text = `help.${id}` as const;
  return filled(translated(text) ?? helpEn[text], {});
}
