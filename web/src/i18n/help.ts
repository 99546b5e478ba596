// What settings do, in the page's language.
import type { Setting } from '../model/settings.js';
import { words } from './en/core/setting-help.js';
import { say } from './text.js';

export const settingHelp = ({ id }: Setting): string => say(words, `help.${id}`);
