// Makes the fields for the result of a calibration print, and the button that takes it over into the plate's setting.
import type { Calibration, CalibrationKind } from 'sillon';
import { html, nothing, type TemplateResult } from 'lit';
import { c } from '../i18n/calibrate.js';
import { settingLabel, valueText } from '../i18n/say.js';
import { formatNumber } from '../i18n/text.js';
import { answerOf, spacingBetween, withFound, withWidths } from './model.js';
import { settingOf, valueOf, type NumberSetting, type SettingId } from '../model/settings.js';
import { flag, numberField } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import type { Studio } from '../studio/studio.js';
import { button } from '../controls/button.js';

/** The visitor's results from a print: a value, constant flow or not, or the narrowest and widest good beads [mm]. */
export interface Found {
  value: number | undefined;
  constant: boolean;
  low: number | undefined;
  high: number | undefined;
}

type Change = (change: Partial<Found>) => void;

/** Makes the fields for the result that this kind of print has; none before the print is made. */
export function answerFields(
  studio: Studio,
  kind: CalibrationKind,
  calibration: Calibration | undefined,
  found: Found,
  change: Change,
): TemplateResult | typeof nothing {
  if (calibration === undefined) return nothing;
  const answer = answerOf(kind);
  switch (answer.kind) {
    case 'setting':
      return settingAnswer(studio, kind, answer.setting, calibration, found, change);
    case 'widths':
      return widthsAnswer(studio, calibration, found, change);
    case 'none':
      return html`<p>${c(kind === 'directions' ? 'best.directions' : 'best.swatch')}</p>`;
  }
}

/** The values tried on the print, labelled as beside its patches. */
function triedValues(
  calibration: Calibration,
  chosen: number | undefined,
  choose: (value: number) => void,
): TemplateResult {
  return html`<div class="tried" role="radiogroup" aria-label=${c('best.value')}>
    ${calibration.values.map(
      ({ label, value }) =>
        html`<label class="card board"
          ><input type="radio" name="tried" .checked=${value === chosen} @change=${() => choose(value)} /><span
            class="figures"
            >${label}</span
          ></label
        >`,
    )}
  </div>`;
}

/** Makes the fields for a print that finds one setting. */
function settingAnswer(
  studio: Studio,
  kind: CalibrationKind,
  id: SettingId,
  calibration: Calibration,
  { value, constant }: Found,
  change: Change,
): TemplateResult {
  const setting = settingOf(id) as NumberSetting;
  const label = settingLabel(setting);
  const { plate } = studio.store.state;
  // The present value comes from the plate, since a coupon's values are those of its discs.
  const now = valueOf(plate, setting) as number;
  const written = (number: number): string => valueText(setting, number);
  return html`${triedValues(calibration, value, (next) => change({ value: next }))}
  ${numberField({
    id: 'found',
    label,
    value: value ?? now,
    min: setting.min,
    max: setting.max,
    step: setting.step,
    unit: setting.unit,
    onInput: (next) => change({ value: next }),
  })}
  ${
    kind === 'speed'
      ? flag({
          id: 'constant',
          label: c('best.constant'),
          value: constant,
          onChange: (next) => change({ constant: next }),
        })
      : nothing
  }
  ${useButton(
    studio,
    value !== undefined && withFound(plate, kind, value, constant) !== plate,
    value === undefined ? '' : written(value),
    () => {
      if (value === undefined) return;
      studio.change((before) => withFound(before, kind, value, constant));
      studio.notify(c('used', { name: label, value: written(value) }));
    },
  )}`;
}

/** Makes the fields for a print that finds the narrowest and the widest good beads. */
function widthsAnswer(studio: Studio, calibration: Calibration, found: Found, change: Change): TemplateResult {
  const tried = calibration.values.map(({ value }) => value);
  const [low, high] = [Math.min(...tried), Math.max(...tried)];
  const field = (name: 'low' | 'high', label: string, value: number): TemplateResult =>
    numberField({
      id: name,
      label,
      value,
      min: low,
      max: high,
      step: 0.01,
      usual: [low, high],
      unit: 'mm',
      onInput: (next) => change({ [name]: next }),
    });
  const [from, to] = [found.low ?? low, found.high ?? high];
  const { spacing, variation } = spacingBetween(from, to);
  const text = c('best.spacing', { spacing: formatNumber(spacing), variation: formatNumber(variation) });
  const chosen = (found.low ?? found.high) !== undefined && from < to;
  return html`${field('low', c('best.lowest'), from)} ${field('high', c('best.widest'), to)}
    <p class="note">${text}</p>
    ${useButton(studio, chosen, `${formatNumber(spacing)}\u00a0mm`, () => {
      studio.change((before) => withWidths(before, from, to));
      studio.notify(text);
    })}`;
}

/** The button that takes the result over into the plate. */
function useButton(studio: Studio, usable: boolean, value: string, use: () => void): TemplateResult {
  return button(
    { look: 'use', disabled: !usable },
    html`${icon('check', 16)} ${usable || value === '' ? c('use', { value }) : c('inUse')}`,
    () => {
      studio.settle();
      use();
    },
  );
}
