// What is wrong with files of no kind that the page knows, loaded with the first problem.
import type { Problem } from '../model/problem.js';
import { rare } from './rare.js';

export interface ExactWords {
  message: string;
  hint: string;
}

/** undefined: the code has all that is known. */
export function exactWords({ code, values }: Problem): ExactWords | undefined {
  const { name = '', format } = values;
  if (code !== 'UnknownFile' || format === undefined) return undefined;
  return format === 'empty'
    ? { message: rare('problem.emptyFile', { name }), hint: rare('problem.emptyFile.hint') }
    : { message: rare('problem.otherFile', { name, format }), hint: rare('problem.otherFile.hint') };
}
