// The kinds of calibration prints, and the plate's setting that each one finds.
import type { CalibrationKind } from 'sillon';
import { calibrationKinds } from '../model/facts.js';
import type { Plate } from '../model/plate.js';
import { accepts, settingOf, withValue, type SettingId, type SettingValue } from '../model/settings.js';

/** Kinds in their order on the page. The coupon combines most of the others; each of those relies on the ones before
 * it. */
export const kinds: readonly CalibrationKind[] = ['coupon', ...calibrationKinds.filter((kind) => kind !== 'coupon')];

/** The result to type in: a setting's value, two widths, or nothing. */
export type Answer = { kind: 'setting'; setting: SettingId } | { kind: 'widths' | 'none' };

const settingFor: Partial<Record<CalibrationKind, SettingId>> = {
  coupon: 'print.flow',
  flow: 'print.flow',
  speed: 'printer.showSpeed',
  fan: 'printer.showFan',
};

export function answerOf(kind: CalibrationKind): Answer {
  const setting = settingFor[kind];
  if (setting !== undefined) return { kind: 'setting', setting };
  return { kind: kind === 'width' ? 'widths' : 'none' };
}

/** The plate with those values that its settings accept. */
const withAll = (plate: Plate, values: Partial<Record<SettingId, SettingValue>>): Plate =>
  Object.entries(values).reduce((now, [id, value]) => {
    const setting = settingOf(id as SettingId);
    return accepts(setting, value) ? withValue(now, setting, value) : now;
  }, plate);

/** The plate with the value that was found. @param constant  for `speed`: true where the half with constant flow
 * looked better */
export function withFound(plate: Plate, kind: CalibrationKind, value: number, constant: boolean): Plate {
  const answer = answerOf(kind);
  if (answer.kind !== 'setting') return plate;
  const more: Partial<Record<SettingId, SettingValue>> = kind === 'speed' ? { 'print.constantFlow': constant } : {};
  return withAll(plate, { [answer.setting]: value, ...more });
}

const hundredth = (value: number): number => Math.round(100 * value) / 100;

/** The spacing, and its variation, for beads that are closed and even between two widths [mm]: the geometric mean,
 * and half the logarithm of the ratio. */
export function spacingBetween(low: number, high: number): { spacing: number; variation: number } {
  return { spacing: hundredth(Math.sqrt(low * high)), variation: hundredth(Math.log(high / low) / 2) };
}

/** The plate with the spacing that suits beads between two widths [mm]. */
export function withWidths(plate: Plate, low: number, high: number): Plate {
  const { spacing, variation } = spacingBetween(low, high);
  return withAll(plate, { 'toolpath.spacing': spacing, 'toolpath.spacingVariation': variation });
}
