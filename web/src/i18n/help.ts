// Help on settings, in the page's language.
import type { AnySetting } from '../model/settings.js';
import { words } from './en/core/setting-help.js';
import { say } from './text.js';

export const settingHelp = ({ id }: Pick<AnySetting, 'id'>): string => say(words, `help.${id}`);
