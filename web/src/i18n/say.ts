// Words for the data of the model: settings, problems, verdicts, warnings of the engine.
import type { EngineInfo, GcodeFinding, GcodeWarning, ImportNote, PrinterValues } from 'sillon';
import type { Filament } from '../model/filaments.js';
import { countLines, unusualHeat } from '../model/brought.js';
import { profileOf, type PrinterChoice } from '../model/printers.js';
import type { Problem } from '../model/problem.js';
import type { ChoiceSetting, NumberSetting, PairSetting, Setting, SettingValue, Unit } from '../model/settings.js';
import type { Untold } from '../model/share.js';
import type { Progress } from '../model/state.js';
import type { Verdict } from '../model/verdicts.js';
import { formatDuration, formatNumber, hasText, language, t } from './text.js';

export const settingLabel = ({ id }: Setting): string => t(`setting.${id}`);
export const settingHelp = ({ id }: Setting): string => t(`help.${id}`);

export function choiceLabel({ id }: ChoiceSetting, choice: string): string {
  const text = `choice.${id}.${choice}`;
  return hasText(text) ? t(text) : choice;
}

export const unitText = (unit: Unit): string => (unit === 'spacing' ? t('unit.spacing') : unit);

/** What null means. */
export function nullLabel({ id }: NumberSetting | PairSetting): string {
  const text = `null.${id}`;
  return hasText(text) ? t(text) : '';
}

export function valueText(setting: Setting, value: SettingValue): string {
  const measured = (number: number, unit: Unit): string =>
    `${formatNumber(number, 3)}${unit === '' ? '' : unit === '°' ? '°' : `\u00a0${unitText(unit)}`}`;
  switch (setting.kind) {
    case 'number':
    case 'integer':
      return typeof value === 'number' ? measured(value, setting.unit) : nullLabel(setting);
    case 'pair':
      return Array.isArray(value)
        ? `${formatNumber(value[0], 3)}; ${measured(value[1], setting.unit)}`
        : nullLabel(setting);
    case 'choice':
      return choiceLabel(setting, String(value));
    case 'flag':
      return t(value === true ? 'verb.yes' : 'verb.no');
    case 'text':
      return String(value);
  }
}

export interface ProblemWords {
  message: string;
  /** What to do about it. */
  hint: string;
  /** In English, from the engine or the browser; may be empty. */
  detail: string;
}

export const problemWords = ({ code, values, detail }: Problem): ProblemWords => ({
  message: code === 'InvalidFile' && 'name' in values ? t('file.unreadable', values) : t(`problem.${code}`, values),
  hint: t(`hint.${code}`, values),
  detail,
});

export const verdictText = ({ text, values }: Verdict): string => t(`verdict.${text}`, values);

export const printerLabel = (printer: PrinterChoice | undefined): string => {
  if (printer === undefined) return t('printer.own');
  const text = `printer.${printer.key}`;
  return hasText(text) ? t(text) : printer.label;
};

/** A note of importPrinter in the page's language; one of an unknown code as the engine says it. */
export function importNoteText({ code, values, message }: ImportNote): string {
  const id = `note.${code}`;
  return hasText(id) ? t(id, values) : message;
}

/** Temperatures of a printer, where they are higher than usual. */
export function heatText(printer: PrinterValues): string {
  const { nozzle, bed } = unusualHeat(printer);
  const list = [
    ...(nozzle === 0 ? [] : [t('brought.nozzle', { degrees: nozzle })]),
    ...(bed === 0 ? [] : [t('brought.bed', { degrees: bed })]),
  ];
  return list.join(', ');
}

/** What a design from elsewhere brings for the printer, and which printer is used instead. */
export function broughtText(brought: PrinterValues, own: PrinterValues): string {
  const start = countLines(brought.startGcode);
  const end = countLines(brought.endGcode);
  const heat = heatText(brought);
  const list = [
    brought.name === '' ? t('printer.own') : t('brought.name', { name: brought.name }),
    ...(start === 0 ? [] : [t('brought.start', { n: start })]),
    ...(end === 0 ? [] : [t('brought.end', { n: end })]),
    ...(heat === '' ? [] : [heat]),
    ...(brought.anyTemperature ? [t('brought.anyTemperature')] : []),
  ];
  const mine = profileOf(own);
  return t('brought.what', {
    list: list.join(', '),
    mine: mine === undefined ? own.name || t('printer.own') : printerLabel(mine),
  });
}

export const filamentLabel = ({ key }: Filament): string => t(`filament.${key}`);

export function untoldText(parts: readonly Untold[]): string {
  if (parts.length === 0) return t('link.complete');
  const list = new Intl.ListFormat(language(), { type: 'conjunction' });
  return t('link.untold', { parts: list.format(parts.map((part) => t(`link.untold.${part}`))) });
}

export interface ProgressWords {
  job: string;
  stage: string;
  percent: string;
  /** Empty where nothing is known. */
  left: string;
}

export function progressWords({ job, stage, fraction, secondsLeft }: Progress): ProgressWords {
  const id = `stage.${stage}`;
  return {
    job: t(`job.${job}`),
    stage: hasText(id) ? t(id) : stage,
    percent: t('progress.percent', { percent: Math.floor(100 * fraction) }),
    left: secondsLeft === undefined ? '' : t('progress.left', { time: formatDuration(secondsLeft) }),
  };
}

/** Of the chip that tells how many threads work. @param asked  what the engine was started with */
export function threadsWords(
  { threads, reasonCode }: EngineInfo,
  asked: 'auto' | 'off' | number,
): { count: string; why: string } {
  const count = t('threads.count', { n: threads });
  if (threads > 1) return { count, why: '' };
  if (asked === 'off') return { count, why: t('threads.off') };
  if (reasonCode === '') return { count, why: t('threads.one') };
  if (reasonCode === 'GivenUp') return { count, why: t('threads.givenUp') };
  const framed = globalThis.parent !== (globalThis.window as typeof globalThis.window | undefined);
  return { count, why: t(framed ? 'threads.frame' : 'threads.isolation') };
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
  const what = known === undefined ? message : t(`finding.${known}`);
  if (line === 0) return what;
  return t(count > 1 ? 'check.places' : 'check.place', { what, line, n: count - 1 });
}

export interface StartLine {
  line: number;
  /** As it stands in the start block. */
  code: string;
  /** In the engine's words. */
  what: string;
}

/** The lines of the start block that warnings name, and an error's sentence: errors carry no values. */
export function startLines(warnings: readonly GcodeWarning[], error: string, startGcode: string): StartLine[] {
  const lines = startGcode.split('\n');
  const [, refused, why = ''] = /^line (\d+) of startGcode: (.*)$/.exec(error) ?? [];
  const named = warnings.flatMap(({ code, values: { line, what } }) => (code === 'StartLine' ? [{ line, what }] : []));
  if (refused !== undefined) named.unshift({ line: refused, what: why });
  return named.flatMap(({ line, what }) => {
    const code = lines[Number(line) - 1];
    return code === undefined ? [] : [{ line: Number(line), code: code.trim(), what: String(what) }];
  });
}

/** A warning of GcodeSummary in the page's language. */
export function warningText({ code, values }: GcodeWarning): string {
  const { block } = values;
  return t(
    `warning.${code}`,
    block === 'startGcode' || block === 'endGcode' ? { ...values, block: t(`setting.printer.${block}`) } : values,
  );
}
