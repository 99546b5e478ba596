// Exact words for a problem beyond its code: why the engine refuses a plate, or what an unknown file is. Loaded with
// the first problem.
import type { ErrorReason } from 'sillon';
import type { Problem } from '../model/problem.js';
import { settings } from '../model/settings.js';
import { words } from './en/problems.js';
import { reasonText } from './say-core.js';
import { problemWords, settingLabel, unitText } from './say.js';
import { formatNumber, language, say, t } from './text.js';

export interface ExactWords {
  message: string;
  /** Advice; left out where that of the code fits. */
  hint?: string;
}

type Values = Problem['values'];

const shown = (value: number | string | undefined): string =>
  typeof value === 'number' ? formatNumber(value, 3) : String(value);

/** Words for a value out of its range, such as "“Layer height” is 0.5 mm." */
function outOfRange({ setting, value, low, high, unit: other = '' }: Values): ExactWords {
  const known = settings.find(({ id }) => id === setting);
  const own = known !== undefined && 'unit' in known ? unitText(known.unit) : String(other).replace('degrees', '°');
  const unit = own === '' ? '' : own === '°' ? own : `\u00a0${own}`;
  const measured = (number: number | string | undefined): string => shown(number) + unit;
  return {
    message: say(words, 'reason.SettingOutOfRange', {
      label: known === undefined ? String(setting) : t('brought.name', { name: settingLabel(known) }),
      value: measured(value),
      low: shown(low),
      high: measured(high),
    }),
    hint: say(words, 'reason.SettingOutOfRange.hint'),
  };
}

/** Words for a plate over the edge of the bed, by how much on each side. */
function overBedEdge(values: Values): ExactWords {
  const sides = (['left', 'right', 'front', 'back'] as const)
    .filter((side) => values[side] !== undefined)
    .map((side) => say(words, `reason.${side}`, { mm: shown(values[side]) }));
  const list = new Intl.ListFormat(language(), { type: 'conjunction' }).format(sides);
  return { message: say(words, 'reason.OverBedEdge', { sides: list }) };
}

/** Words for a plate too large for its spacing, with the spacing or the size that would do. */
function plateTooLarge({ spacing, leastSpacing, percent }: Values): ExactWords {
  const ways = [
    ...(leastSpacing === undefined ? [] : [say(words, 'reason.leastSpacing', { mm: shown(leastSpacing) })]),
    ...(percent === undefined ? [] : [say(words, 'reason.percent', { percent: shown(percent) })]),
  ];
  return {
    message: say(words, 'reason.PlateTooLarge', { mm: shown(spacing) }),
    ...(ways.length === 0 ? {} : { hint: ways.join(' ') }),
  };
}

function otherReason(reason: string, values: Values): ExactWords | undefined {
  const message = reasonText(reason, values);
  if (message === undefined) return undefined;
  return { message, ...(reason === 'CopiesTooHigh' ? { hint: say(words, 'reason.CopiesTooHigh.hint') } : {}) };
}

/** Puts before a sentence in which layer, element or file the fault is. */
function placed(what: string, { layer, element = '', elementLine = '', place = '' }: Values): string {
  const inside =
    element !== ''
      ? say(words, 'reason.inElement', { what, element, line: elementLine })
      : layer === undefined
        ? what
        : say(words, 'check.ofLayer', { what, layer });
  return place === '' || what.includes(String(place)) ? inside : say(words, 'reason.inPlace', { what: inside, place });
}

function reasonWords(reason: ErrorReason | 'OffBody', values: Values): ExactWords | undefined {
  switch (reason) {
    case 'SettingOutOfRange':
      return outOfRange(values);
    case 'OverBedEdge':
      return overBedEdge(values);
    case 'PlateTooLarge':
      return plateTooLarge(values);
    case 'OffBody':
      return {
        message: say(words, 'reason.OffBody', { name: String(values['name']) }),
        hint: say(words, 'reason.OffBody.hint'),
      };
    default:
      return otherReason(reason, values);
  }
}

/** Exact words for a problem; undefined where its code says everything. */
export function exactWords({ code, values }: Problem): ExactWords | undefined {
  const { name = '', format, reason, elements, megabytes, most = '' } = values;
  if (reason !== undefined) {
    // The engine calls a file that is handed over alone "file"; the page knows its name.
    const named = code === 'InvalidFile' && name !== '' ? { place: name, ...values, file: name } : values;
    const told = reasonWords(reason as ErrorReason, named);
    return told && { ...told, message: placed(told.message, named) };
  }
  if (elements !== undefined || megabytes !== undefined) {
    return {
      message:
        elements === undefined
          ? say(words, 'problem.longDrawing', { name, megabytes: megabytes ?? '', most })
          : say(words, 'problem.manyElements', { name, elements, most }),
      hint: say(words, 'problem.largeDrawing.hint'),
    };
  }
  if (code !== 'UnknownFile' || format === undefined) return undefined;
  return format === 'empty'
    ? { message: say(words, 'problem.emptyFile', { name }), hint: say(words, 'problem.emptyFile.hint') }
    : { message: say(words, 'problem.otherFile', { name, format }), hint: say(words, 'problem.otherFile.hint') };
}

/** Words for a place without room for details. Where the page has no exact words, the engine's own are added. */
export function wholeWords(problem: Problem): Required<ExactWords> {
  const { message, hint, detail } = problemWords(problem);
  return { message: `${message} ${detail}`.trim(), hint, ...exactWords(problem) };
}
