// A row of directions as a control.
import type { TemplateResult } from 'lit';
import { t, type TextId } from '../i18n/text.js';
import { angleField } from '../controls/angle-field.js';
import { flag, numberField, select, textField } from '../controls/fields.js';
import type { SourceRow } from './source-rows.js';
import type { Studio } from '../studio/studio.js';

export function sourceField(studio: Studio, row: SourceRow): TemplateResult {
  const label = t(row.label as TextId);
  const id = `source-${row.key}`;
  const { plate: shown } = studio.store.state;
  const value = row.get(shown);
  const set = (next: unknown): void => {
    studio.change((plate) => row.with(plate, next), `${shown.directions.kind}.${row.key}`);
  };
  const onSettle = (): void => {
    studio.settle();
  };
  const choose = (next: unknown): void => {
    set(next);
    onSettle();
  };
  switch (row.control) {
    case 'number':
      return numberField({ ...row, id, label, value: value as number, onInput: set, onSettle });
    case 'angle':
      return angleField({ ...row, id, label, value: value as number, onInput: set, onSettle });
    case 'flag':
      return flag({ id, label, value: value as boolean, onChange: choose });
    case 'text':
      return textField({
        id,
        label,
        value: value as string,
        maxLength: row.max,
        long: row.long,
        onInput: set,
        onSettle,
      });
    case 'choice':
      return select({
        id,
        label,
        value: value as string,
        options: row.choices.map((choice) => ({ value: choice.value, label: t(choice.label as TextId) })),
        onChoose: choose,
      });
  }
}
