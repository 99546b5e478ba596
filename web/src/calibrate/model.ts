// Calibration prints: which there are, and which of a plate's settings each is about.
import type { CalibrationKind } from 'sillon';
import { calibrationKinds } from '../model/facts.js';
import type { Plate } from '../model/plate.js';
import { accepts, settingOf, withValue, type SettingId, type SettingValue } from '../model/settings.js';

/** The coupon has most of the others in it; each of these relies on those before it. */
export const kinds: readonly CalibrationKind[] = ['coupon', ...calibrationKinds.filter((kind) => kind !== 'coupon')];

/** The answer to type back: a setting's own value, two widths, or nothing. */
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

const withAll = (plate: Plate, values: Partial<Record<SettingId, SettingValue>>): Plate =>
  Object.entries(values).reduce((now, [id, value]) => {
    const setting = settingOf(id as SettingId);
    return accepts(setting, value) ? withValue(now, setting, value) : now;
  }, plate);

/** The plate with what was found. @param constant  of `speed`: whether the half with constant flow looked better */
export function withFound(plate: Plate, kind: CalibrationKind, value: number, constant: boolean): Plate {
  const answer = answerOf(kind);
  if (answer.kind !== 'setting') return plate;
  const more: Partial<Record<SettingId, SettingValue>> = kind === 'speed' ? { 'print.constantFlow': constant } : {};
  return withAll(plate, { [answer.setting]: value, ...more });
}

const hundredth = (value: number): number => Math.round(100 * value) / 100;

/** Between two widths [mm] beads are closed and even: a spacing between them, and how far beads may depart from it. */
export function spacingBetween(low: number, high: number): { spacing: number; variation: number } {
  return { spacing: hundredth(Math.sqrt(low * high)), variation: hundredth(Math.log(high / low) / 2) };
}

export function withWidths(plate: Plate, low: number, high: number): Plate {
  const { spacing, variation } = spacingBetween(low, high);
  return withAll(plate, { 'toolpath.spacing': spacing, 'toolpath.spacingVariation': variation });
}
