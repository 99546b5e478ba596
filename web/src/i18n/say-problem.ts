// More exact words for some problems than their code has, loaded with the first problem. Where the engine knows what a value
// may be, as that depends on others, it says so in its own sentence alone.
import { settings } from '../model/settings.js';
import { pageOf, type Plate } from '../model/plate.js';
import type { Problem } from '../model/problem.js';
import { settingLabel } from './say.js';
import { rare } from './rare.js';
import { t } from './text.js';

export interface ExactWords {
  message: string;
  hint: string;
  /** A way out at once. */
  action?: { label: string; change: (plate: Plate) => Plate };
}

const numbersIn = (detail: string, pattern: RegExp): number[] | undefined => pattern.exec(detail)?.slice(1).map(Number);

function outOfRange(detail: string): ExactWords | undefined {
  const [, id, value, min, max] =
    /^(\w+\.\w+)(?:\.[xy])? is (-?[\d.]+)[^;]*; it must be (-?[\d.]+) to (-?[\d.]*\d)/.exec(detail) ?? [];
  const setting = settings.find((one) => one.id === id);
  if (setting === undefined) return undefined;
  return {
    message: t('setting.outOfRange', { name: settingLabel(setting), min: Number(min), max: Number(max) }),
    hint: rare('problem.outOfRange', { value: Number(value) }),
  };
}

function tallCopies(detail: string): ExactWords | undefined {
  const found = numbersIn(detail, /^the plates are ([\d.]+) mm high; several on one bed.* at most (\d+)/);
  if (found === undefined) return undefined;
  const [height = 0, max = 0] = found;
  return { message: rare('problem.tallCopies', { height, max }), hint: rare('problem.tallCopies.hint') };
}

function doesNotFit(detail: string): ExactWords | undefined {
  const heights = numbersIn(detail, /^the job is ([\d.]+) mm high .*maxZ is ([\d.]+) mm/);
  if (heights !== undefined) {
    const [height = 0, max = 0] = heights;
    return { message: rare('problem.tooTall', { height, max }), hint: rare('problem.tooTall.hint') };
  }
  if (detail.startsWith('the plates of '))
    return { message: rare('problem.copies'), hint: rare('problem.copies.hint') };
  const [percent] = numbersIn(detail, /fits when it is scaled to (\d+) %/) ?? [];
  if (percent === undefined) return undefined;
  return {
    message: t('problem.DoesNotFit'),
    hint: rare('problem.scales', { percent }),
    action: { label: rare('problem.scale', { percent }), change: (plate) => scaled(plate, percent / 100) },
  };
}

/** In the middle of the bed, where the engine has found that it fits. */
function scaled(plate: Plate, scale: number): Plate {
  const [width, height] = pageOf(plate);
  const { shape, print } = plate;
  return {
    ...plate,
    width: width * scale,
    height: height * scale,
    shape: shape.kind === 'rounded' ? { ...shape, radius: shape.radius * scale } : shape,
    print: { ...print, place: null },
  };
}

/** Of a file of no kind that the page knows. */
function otherFile({ name = '', format }: Problem['values']): ExactWords | undefined {
  if (format === undefined) return undefined;
  return format === 'empty'
    ? { message: rare('problem.emptyFile', { name }), hint: rare('problem.emptyFile.hint') }
    : { message: rare('problem.otherFile', { name, format }), hint: rare('problem.otherFile.hint') };
}

/** undefined: the code has all that is known. */
export function exactWords({ code, values, detail }: Problem): ExactWords | undefined {
  if (code === 'UnknownFile') return otherFile(values);
  if (code === 'InvalidArgument') return outOfRange(detail) ?? tallCopies(detail);
  return code === 'DoesNotFit' ? doesNotFit(detail) : undefined;
}
