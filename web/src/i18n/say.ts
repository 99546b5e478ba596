// Words for the model's data: settings, problems, printers and progress.
import type { PrinterValues } from 'sillon';
import { countLines, unusualHeat } from '../model/brought.js';
import { printerDefaults } from '../model/defaults.js';
import { isGeneric, profileOf, type PrinterChoice } from '../model/printers.js';
import type { Problem } from '../model/problem.js';
import type { ChoiceSetting, NumberSetting, PairSetting, Setting, SettingValue, Unit } from '../model/settings.js';
import type { Progress } from '../model/state.js';
import { formatDuration, formatNumber, hasText, t } from './text.js';

export const settingLabel = ({ id }: Pick<Setting, 'id'>): string => t(`setting.${id}`);

export function choiceLabel({ id }: ChoiceSetting, choice: string): string {
  const text = `choice.${id}.${choice}`;
  return hasText(text) ? t(text) : choice;
}

export const unitText = (unit: Unit): string => (unit === 'spacing' ? t('unit.spacing') : unit);

/** Meaning of the value null; empty where it has none. */
export function nullLabel({ id }: NumberSetting | PairSetting): string {
  const text = `null.${id}`;
  return hasText(text) ? t(text) : '';
}

/** A value with its unit, in the page's language. */
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
  /** Advice on how to solve the problem. */
  hint: string;
  /** Message of the engine or the browser in English; may be empty. */
  detail: string;
}

export const problemWords = ({ code, values, detail }: Problem): ProblemWords => ({
  message: code === 'InvalidFile' && 'name' in values ? t('file.unreadable', values) : t(`problem.${code}`, values),
  hint: t(`hint.${code}`, values),
  detail,
});

export const printerLabel = (printer: PrinterChoice | undefined): string => {
  if (printer === undefined) return t('printer.own');
  const text = `printer.${printer.key}`;
  return hasText(text) ? t(text) : printer.label;
};

/** Name by which people know a machine; empty where it is no particular one. */
export function machineName(printer: PrinterValues): string {
  const profile = profileOf(printer);
  if (profile !== undefined) return isGeneric(profile) ? '' : printerLabel(profile);
  return printer.name === printerDefaults.name ? '' : printer.name;
}

/** A list of the printer's temperatures that are higher than usual. */
export function heatText(printer: PrinterValues): string {
  const { nozzle, bed } = unusualHeat(printer);
  const list = [
    ...(nozzle === 0 ? [] : [t('brought.nozzle', { degrees: nozzle })]),
    ...(bed === 0 ? [] : [t('brought.bed', { degrees: bed })]),
  ];
  return list.join(', ');
}

/** Sentence about the printer that a design from elsewhere brings, and the one that is used instead. */
export function broughtText(brought: PrinterValues, own: PrinterValues): string {
  const start = countLines(brought.startGcode);
  const end = countLines(brought.endGcode);
  const heat = heatText(brought);
  const list = [
    brought.name === '' ? t('printer.own') : t('brought.name', { name: brought.name }),
    ...(start === 0 ? [] : [t('brought.start', { n: start })]),
    ...(end === 0 ? [] : [t('brought.end', { n: end })]),
    ...(heat === '' ? [] : [heat]),
    ...(brought.generalHeatLimits ? [t('brought.generalHeatLimits')] : []),
  ];
  const mine = profileOf(own);
  return t('brought.what', {
    list: list.join(', '),
    mine: mine === undefined ? own.name || t('printer.own') : printerLabel(mine),
  });
}

export interface ProgressWords {
  job: string;
  stage: string;
  /** Time left; empty where it is unknown. */
  left: string;
}

export function progressWords({ job, stage, secondsLeft }: Progress): ProgressWords {
  const id = `stage.${stage}`;
  return {
    job: t(`job.${job}`),
    stage: hasText(id) ? t(id) : stage,
    left: secondsLeft === undefined ? '' : t('progress.left', { time: formatDuration(secondsLeft) }),
  };
}
