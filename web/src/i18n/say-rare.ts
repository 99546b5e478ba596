// Words for what the engine says of files: warnings, findings, notes.
import type { GcodeFinding, GcodeWarning, ImportNote } from 'sillon';
import { hasRare, rare } from './rare.js';
import type { Problem } from '../model/problem.js';
import { t } from './text.js';

/** A note of importPrinter in the page's language; one of an unknown code as the engine says it. */
export function importNoteText({ code, values, message }: ImportNote): string {
  const id = `note.${code}`;
  return hasRare(id) ? rare(id, values) : message;
}

const findingRules = [
  'commands',
  'layers',
  'grammar',
  'homing',
  'heating',
  'modes',
  'bounds',
  'height',
  'extrusion',
  'flow',
  'speed',
  'rate',
  'retraction',
  'cycle',
  'coverage',
  'noise',
  'settings',
  'totals',
  'end',
] as const;

/** A finding of GcodeCheck in the page's language, with its line; one of an unknown rule as the engine says it. */
export function findingText({
  rule,
  line,
  count,
  message,
}: Pick<GcodeFinding, 'rule' | 'line' | 'count' | 'message'>): string {
  const known = findingRules.find((name) => name === rule);
  const what = known === undefined ? message : rare(`finding.${known}`);
  if (line === 0) return what;
  return rare(count > 1 ? 'check.places' : 'check.place', { what, line, n: count - 1 });
}

export interface StartLine {
  line: number;
  /** As it stands in the start block. */
  code: string;
  /** In the engine's words. */
  what: string;
}

/** The lines of the start block that a problem and warnings name. */
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

/** A warning of GcodeSummary in the page's language. */
export function warningText({ code, values }: GcodeWarning): string {
  const { block } = values;
  return rare(`warning.${code}`, {
    ...values,
    ...(block === 'startGcode' || block === 'endGcode' ? { block: t(`setting.printer.${block}`) } : {}),
  });
}
