// Words for the engine's messages, by their codes: warnings, findings, notes and reasons.
import type { GcodeFinding, GcodeWarning, ImportNote } from 'sillon';
import type { Problem } from '../model/problem.js';
import { settings } from '../model/settings.js';
import { words as findings } from './en/core/findings.js';
import { words as importNotes } from './en/core/import-notes.js';
import { words as reasons } from './en/core/reasons.js';
import { words as warnings } from './en/core/warnings.js';
import { words as problems } from './en/problems.js';
import { settingLabel } from './say.js';
import { formatNumber, say, t, type Text, type Values } from './text.js';

/** Values in the page's language: numbers with up to three decimals, settings as their labels in quotes. */
const shown = (values: Values): Values =>
  Object.fromEntries(
    Object.entries(values).map(([name, value]) => {
      if (/^-?\d+(\.\d+)?$/.test(String(value))) return [name, formatNumber(Number(value), 3)];
      const setting = settings.find(({ id }) => id === value);
      return [name, setting === undefined ? value : t('brought.name', { name: settingLabel(setting) })];
    }),
  );

/** The sentence of an id; undefined where there is none. */
const sentence = (english: Readonly<Record<string, Text>>, id: string, values: Values): string | undefined =>
  Object.hasOwn(english, id) ? say(english, id, shown(values)) : undefined;

/** A note of `importPrinter` in the page's language, or the engine's own text for an unknown code. */
export const importNoteText = ({ code, values, message }: ImportNote): string =>
  sentence(importNotes, `note.${code}`, values) ?? reasonText(code, values) ?? message;

/** A warning of `GcodeSummary` in the page's language, or the engine's own text for an unknown code. */
export function warningText({ code, values, message }: GcodeWarning): string {
  const { layer, ...own } = values;
  // Sentences about drawings do not name the layer, so it is added.
  if (layer === undefined || !code.startsWith('Drawing'))
    return sentence(warnings, `warning.${code}`, values) ?? message;
  const what = sentence(warnings, `warning.${code}`, own);
  return what === undefined ? message : say(problems, 'check.ofLayer', { what, layer });
}

/** The reason why a plate is refused; some are also warnings. Undefined for reasons whose sentences are made
 * elsewhere. */
export const reasonText = (reason: string, values: Values): string | undefined =>
  sentence(reasons, `reason.${reason}`, values) ?? sentence(warnings, `warning.${reason}`, values);

/** A finding of `GcodeCheck` in the page's language with its line, or the engine's own text for an unknown code. */
export function findingText({
  code,
  line,
  count,
  values,
  message,
}: Pick<GcodeFinding, 'code' | 'line' | 'count' | 'values' | 'message'>): string {
  const what = sentence(findings, `finding.${code}`, values) ?? message;
  if (line === 0) return what;
  return say(problems, count > 1 ? 'check.places' : 'check.place', { what, line, n: count - 1 });
}

export interface StartLine {
  line: number;
  /** The line's text in the start block. */
  code: string;
  /** The fault in the engine's words. */
  what: string;
}

/** Lines of the start block that a problem or warnings name. */
export function startLines(
  warnings: readonly GcodeWarning[],
  problem: Problem | undefined,
  startGcode: string,
): StartLine[] {
  const lines = startGcode.split('\n');
  const refused = problem?.values.reason === 'StartLine' ? [problem.values] : [];
  const warned = warnings.flatMap(({ code, values }) => (code === 'StartLine' ? [values] : []));
  return [...refused, ...warned].flatMap(({ line, what }) => {
    const code = lines[Number(line) - 1];
    return code === undefined ? [] : [{ line: Number(line), code: code.trim(), what: String(what) }];
  });
}
