// Edits an angle, by a protractor and by a number.
import { html, type TemplateResult } from 'lit';
import './dial.js';
import { aboutButton, errorText, helpText, numberInput, type NumberField } from './fields.js';

export interface AngleField extends Omit<NumberField, 'step' | 'unit' | 'usual' | 'integer'> {
  /** Kind of angle: a bead's line, which has no front, or a light, which has one. */
  kind?: 'line' | 'light';
}

/** Returns the field; the panel around it needs `panelStyle`. */
export function angleField(field: AngleField): TemplateResult {
  const { id, label, kind = 'line', value, min, max, help = '', onInput, onSettle } = field;
  return html`<div class="field angle">
    <span class="name"><label for=${id}>${label}</label>${aboutButton(id, label, help)}</span>
    <sillon-dial
      kind=${kind}
      .label=${label}
      .value=${value}
      .min=${min}
      .max=${max}
      @turn=${(event: CustomEvent<number>) => onInput(event.detail)}
      @settle=${onSettle}
    ></sillon-dial>
    ${numberInput({ ...field, unit: '°', step: 1 })} ${errorText(id)} ${helpText(id, help)}
  </div>`;
}
