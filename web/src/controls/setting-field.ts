// Shows a row of model/settings.ts as a control.
import { html, type TemplateResult } from 'lit';
import { settingHelp } from '../i18n/help.js';
import { choiceLabel, nullLabel, settingLabel, unitText } from '../i18n/say.js';
import { t } from '../i18n/text.js';
import {
  settingOf,
  valueOf,
  withValue,
  type AnySetting,
  type SettingId,
  type SettingValue,
} from '../model/settings.js';
import { flag, numberField, numberInput, segments, select, textField } from './fields.js';
import type { Studio } from '../studio/studio.js';

export interface ValueField {
  setting: AnySetting;
  id: string;
  label: string;
  help: string;
  value: SettingValue;
  /** Value that replaces null. */
  fallback: number | [number, number];
  /** Names of null and of each choice. */
  nullLabel: string;
  choiceLabel: (choice: string) => string;
  /** Called while the user drags or types. */
  onInput: (value: SettingValue) => void;
  onSettle: () => void;
}

/** Sets a value at once, without a drag. */
function choose({ onInput, onSettle }: ValueField, value: SettingValue): void {
  onInput(value);
  onSettle();
}

/** Returns a switch between null and a value. */
const nullFlag = (field: ValueField, help: string): TemplateResult =>
  flag({
    id: `${field.id}-null`,
    label: t('setting.value', { label: field.label, value: field.nullLabel }),
    value: field.value === null,
    help,
    onChange: (isNull) => choose(field, isNull ? null : field.fallback),
  });

/** Returns the two numbers of a pair, such as a place on the bed. */
function pairField(field: ValueField, setting: Extract<AnySetting, { kind: 'pair' }>): TemplateResult {
  const { id, label, help, onInput } = field;
  const value = field.value as [number, number] | null;
  const one = (k: 0 | 1, pair: [number, number]): TemplateResult =>
    numberInput(
      {
        ...setting,
        ...field,
        id: `${id}-${k}`,
        label: `${label}, ${t(k === 0 ? 'unit.x' : 'unit.y')}`,
        value: pair[k],
        onInput: (number) => onInput(k === 0 ? [number, pair[1]] : [pair[0], number]),
      },
      false,
    );
  return html`<div role="group" aria-label=${label}>
    ${setting.nullable ? nullFlag(field, help) : html`<span class="name">${label}</span>`}
    ${
      value === null
        ? ''
        : html`<div class="pair">${one(0, value)}<span aria-hidden="true">×</span>${one(1, value)}</div>
            <p class="error" role="status" hidden></p>`
    }
  </div>`;
}

/** Returns the control for the setting's kind of value. */
export function valueField(field: ValueField): TemplateResult {
  const { setting, help, value } = field;
  switch (setting.kind) {
    case 'number':
    case 'integer': {
      const { kind, unit, nullable } = setting;
      const row = (number: number): TemplateResult =>
        numberField({ ...setting, ...field, value: number, unit: unitText(unit), integer: kind === 'integer' });
      if (!nullable) return row(value as number);
      const own = value !== null;
      return html`${nullFlag(field, own ? '' : help)} ${own ? row(value as number) : ''}`;
    }
    case 'choice': {
      const options = setting.choices.map((choice) => ({ value: choice, label: field.choiceLabel(choice) }));
      const onChoose = (chosen: string): void => choose(field, chosen);
      const props = { ...field, value: value as string, options, onChoose };
      return options.every((option) => option.label.length < 14) ? segments(props) : select(props);
    }
    case 'flag':
      return flag({
        ...field,
        value: value as boolean,
        onChange: (on) => choose(field, on),
      });
    case 'text':
      return textField({ ...setting, ...field, value: value as string, maxLength: setting.maxBytes });
    case 'pair':
      return pairField(field, setting);
  }
}

/** Returns the control of a setting of the plate. */
export function settingField(studio: Studio, id: SettingId): TemplateResult {
  const setting = settingOf(id);
  const { plate } = studio.store.state;
  return valueField({
    setting,
    id: id.replace('.', '-'),
    label: settingLabel(setting),
    help: settingHelp(setting),
    value: valueOf(plate, setting),
    fallback: setting.kind === 'pair' ? studio.centredPlace() : plate.toolpath.spacing,
    nullLabel: 'nullable' in setting ? nullLabel(setting) : '',
    choiceLabel: (choice) => (setting.kind === 'choice' ? choiceLabel(setting, choice) : ''),
    onInput: (value) => studio.change((now) => withValue(now, setting, value), id),
    onSettle: () => studio.settle(),
  });
}
