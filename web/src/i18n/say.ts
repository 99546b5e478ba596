// Words for the data of the model: settings, problems, verdicts, warnings of the engine.
import type { EngineInfo, GcodeFinding } from 'sillon';
import type { Filament } from '../model/filaments.js';
import type { PrinterChoice } from '../model/printers.js';
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
  { threads, reason }: EngineInfo,
  asked: 'auto' | 'off' | number,
): { count: string; why: string } {
  const count = t('threads.count', { n: threads });
  if (threads > 1) return { count, why: '' };
  if (asked === 'off') return { count, why: t('threads.off') };
  if (reason === '') return { count, why: t('threads.one') };
  if (!reason.includes('isolated')) return { count, why: t('threads.givenUp') };
  const framed = globalThis.parent !== (globalThis.window as typeof globalThis.window | undefined);
  return { count, why: t(framed ? 'threads.frame' : 'threads.isolation') };
}

// The engine's warnings, with the numbers in them.
const warnings: readonly [RegExp, (found: string[]) => string][] = [
  [
    /^acceleration is (\d+) mm\/s2; it is held at machineAcceleration, (\d+)/,
    ([asked = '', held = '']) => t('warning.acceleration', { asked: Number(asked), held: Number(held) }),
  ],
  [
    /^(?:speed|firstLayerSpeed|travelSpeed) is (\S+) mm\/s; it is held at machineSpeed, (\S+)/,
    ([asked = '', held = '']) => t('warning.speed', { asked: Number(asked), held: Number(held) }),
  ],
  [/^the plate is mirrored but shown from above/, () => t('warning.backwards')],
  [
    /^startGcode leaves the nozzle at (\d+) degrees; the first layer is meant for (\d+)/,
    ([hot = '', meant = '']) => t('warning.startTemperature', { hot: Number(hot), meant: Number(meant) }),
  ],
  [
    /^line (\d+) of startGcode: (.*)$/,
    ([line = '', what = '']) => t('warning.startLine', { line: Number(line), what }),
  ],
  [/^line (\d+) of endGcode: (.*)$/, ([line = '', what = '']) => t('warning.endLine', { line: Number(line), what })],
  [/^endGcode leaves the nozzle or the bed hot/, () => t('warning.endHot')],
  [/^the plate leaves no room for a purge line/, () => t('warning.purge')],
  [/^a print of (\S+) mm stands on the bed/, ([height]) => t('warning.above', { height: Number(height) })],
  [/^nothing is printed beside a print/, () => t('warning.unprimed')],
  [
    /^(startGcode|endGcode) moves along the bed at Z (\S+); what stands there is (\S+) mm high/,
    ([block, z, height]) =>
      t('warning.low', {
        block: t(block === 'endGcode' ? 'setting.printer.endGcode' : 'setting.printer.startGcode'),
        z: Number(z),
        height: Number(height),
      }),
  ],
  [/^the skirt does not fit the bed/, () => t('warning.skirt')],
  [/^the base layers cover only (\S+) %/, ([percent]) => t('warning.base', { percent: Number(percent) })],
  [/^filamentDiameter is (\S+) mm/, ([value]) => t('warning.diameter', { value: Number(value) })],
  [/^layerHeight is (\S+) mm/, ([value]) => t('warning.layerHeight', { value: Number(value) })],
  [/^(?:flow|baseFlow) is ([\d.]+);/, ([value]) => t('warning.flow', { value: Number(value) })],
  [
    /^(\d+) points have beads no wider than the layer is high \((\S+) mm\)/,
    ([n, value]) => t('warning.flat', { n: Number(n), value: Number(value) }),
  ],
  [/^the beads cover (\S+) %/, ([percent]) => t('warning.fill', { percent: Number(percent) })],
  [/^pressure advance is 0 after the print/, () => t('warning.pressureAdvance')],
  [/^(\d+) points of the path lie more than/, ([n]) => t('warning.outside', { n: Number(n) })],
  [
    /^(\S+) % of the path is printed with a width held at (\S+) or (\S+) mm/,
    ([percent, low, high]) => t('warning.held', { percent: Number(percent), low: Number(low), high: Number(high) }),
  ],
  [/^maxFlow slows (\S+) %/, ([percent]) => t('warning.maxFlow', { percent: Number(percent) })],
  [/^maxSegmentsPerSecond slows (\S+) %/, ([percent]) => t('warning.segments', { percent: Number(percent) })],
  [/^the file has (\d+) moves/, ([n]) => t('warning.moves', { n: Number(n) })],
  [/^the file has (\d+) MB/, ([mb]) => t('warning.bytes', { mb: Number(mb) })],
];

const findingRules = [
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
export function findingText({ rule, line, count, message }: GcodeFinding): string {
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

/** The lines of the start block that the engine's sentences name. */
export function startLines(sentences: readonly string[], startGcode: string): StartLine[] {
  const lines = startGcode.split('\n');
  return sentences.flatMap((sentence) => {
    const [, number = '', what = ''] = /^line (\d+) of startGcode: (.*)$/.exec(sentence) ?? [];
    const line = Number(number);
    const code = lines[line - 1];
    return code === undefined ? [] : [{ line, code: code.trim(), what }];
  });
}

/** A warning of GcodeSummary in the page's language; one that is not known stays as it is. */
export function warningText(warning: string): string {
  for (const [pattern, say] of warnings) {
    const found = pattern.exec(warning);
    if (found !== null) return say(found.slice(1));
  }
  return warning;
}
