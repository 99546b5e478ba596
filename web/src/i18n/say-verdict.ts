// Verdicts in words, loaded with the panel that shows them.
import type { Verdict } from '../model/verdicts.js';
import { words as english } from './en/verdicts.js';
import { say } from './text.js';

export const verdictText = ({ text, values }: Verdict): string => say(english, `verdict.${text}`, values);
