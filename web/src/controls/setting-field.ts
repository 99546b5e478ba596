// A row of model/settings.ts as a control.
import { html, type TemplateResult } from 'lit';
import { settingHelp } from '../i18n/help.js';
import { choiceLabel, nullLabel, settingLabel, unitText } from '../i18n/say.js';
import { t } from '../i18n/text.js';
import {
  settingOf,
  valueOf,
  withValue,
  type PairSetting,
  type Setting,
  type SettingId,
  type SettingValue,
} from '../model/settings.js';
import { flag, numberField, numberInput, segments, select, textField } from './fields.js';
import type { Studio } from '../studio/studio.js';

function pairField(studio: Studio, setting: PairSetting, id: string, label: string, help: string): TemplateResult {
  const value = valueOf(studio.store.state.plate, setting) as [number, number] | null;
  const set = (next: [number, number] | null): void => {
    studio.change((plate) => withValue(plate, setting, next), setting.id);
  };
  const one = (k: 0 | 1, pair: [number, number]): TemplateResult =>
    numberInput(
      {
        id: `${id}-${k}`,
        label: `${label}, ${t(k === 0 ? 'unit.x' : 'unit.y')}`,
        value: pair[k],
        min: setting.min,
        max: setting.max,
        step: setting.step,
        integer: setting.integer,
        unit: setting.unit,
        onInput: (number) => {
          set(k === 0 ? [number, pair[1]] : [pair[0], number]);
        },
        onSettle: () => {
          studio.settle();
        },
      },
      false,
    );
  const automatic = (checked: boolean): void => {
    set(checked ? null : studio.centredPlace());
    studio.settle();
  };
  return html`<div role="group" aria-label=${label}>
    ${
      setting.nullable
        ? flag({
            id: `${id}-null`,
            label: t('setting.value', { label, value: nullLabel(setting) }),
            value: value === null,
            help,
            onChange: automatic,
          })
        : html`<span class="name">${label}</span>`
    }
    ${
      value === null
        ? ''
        : html`<div class="pair">${one(0, value)}<span aria-hidden="true">×</span>${one(1, value)}</div>
            <p class="error" role="status" hidden></p>`
    }
  </div>`;
}

export function settingField(studio: Studio, id: SettingId): TemplateResult {
  const setting: Setting = settingOf(id);
  const value = valueOf(studio.store.state.plate, setting);
  const label = settingLabel(setting);
  const help = settingHelp(setting);
  const field = id.replace('.', '-');
  const change = (next: SettingValue): void => {
    studio.change((plate) => withValue(plate, setting, next), id);
  };
  const settle = (): void => {
    studio.settle();
  };
  const choose = (next: SettingValue): void => {
    change(next);
    settle();
  };
  switch (setting.kind) {
    case 'number':
    case 'integer': {
      const { unit, min, max, step, usual, nullable } = setting;
      const row = (number: number): TemplateResult =>
        numberField({
          id: field,
          label,
          value: number,
          min,
          max,
          step,
          usual,
          unit: unitText(unit),
          help,
          integer: setting.kind === 'integer',
          onInput: change,
          onSettle: settle,
        });
      if (!nullable) return row(value as number);
      const own = value !== null;
      const fallback = studio.store.state.plate.toolpath.spacing;
      return html`${flag({
        id: `${field}-null`,
        label: t('setting.value', { label, value: nullLabel(setting) }),
        value: !own,
        help: own ? '' : help,
        onChange: (automatic) => {
          choose(automatic ? null : fallback);
        },
      })}
      ${own ? row(value as number) : ''}`;
    }
    case 'choice': {
      const options = setting.choices.map((choice) => ({ value: choice, label: choiceLabel(setting, choice) }));
      const props = { id: field, label, value: value as string, options, help, onChoose: choose };
      return options.every((option) => option.label.length < 14) ? segments(props) : select(props);
    }
    case 'flag':
      return flag({ id: field, label, value: value as boolean, help, onChange: choose });
    case 'text':
      return textField({
        id: field,
        label,
        value: value as string,
        maxLength: setting.maxBytes,
        long: setting.long,
        help,
        onInput: change,
        onSettle: settle,
      });
    case 'pair':
      return pairField(studio, setting, field, label, help);
  }
}
