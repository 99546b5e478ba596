// Makes the fields of the plate's size, in millimetres or inches.
import { html, type TemplateResult } from 'lit';
import { a } from '../i18n/shaping.js';
import type { Units } from '../model/guest.js';
import { isRoundKind, type Plate } from '../model/plate.js';
import { numberField, numberInput, type NumberField } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import type { Studio } from '../studio/studio.js';
import { inch } from './units.js';
import { button } from '../controls/button.js';

const smallest = 1; // [mm]
const largest = 1000;
const hundredth = (value: number): number => Math.round(value * 100) / 100;

/** Converts a field in millimetres to the visitor's units. */
export function lengthField(field: NumberField, units: Units): NumberField {
  if (units === 'mm') return { ...field, unit: 'mm' };
  const shown = (value: number): number => Math.round((value / inch) * 1000) / 1000;
  return {
    ...field,
    unit: 'in',
    value: shown(field.value),
    min: shown(field.min),
    max: shown(field.max),
    step: 0.01,
    usual: field.usual === undefined ? undefined : [shown(field.usual[0]), shown(field.usual[1])],
    onInput: (value) => field.onInput(value * inch),
  };
}

/** Makes the field of one side. @param sizes  the plate's changes for another length of that side */
function sideField(
  studio: Studio,
  side: 'width' | 'height',
  label: string,
  sizes: (plate: Plate, value: number) => Partial<Plate>,
): NumberField {
  const { plate, units } = studio.store.state;
  return lengthField(
    {
      id: `size-${side}`,
      label,
      value: hundredth(plate[side]),
      min: smallest,
      max: largest,
      step: 0.1,
      usual: [10, 200],
      onInput: (value) => studio.change((now) => ({ ...now, ...sizes(now, value) }), side),
      onSettle: () => studio.settle(),
    },
    units,
  );
}

/** The fields of the plate's size: one for round shapes, otherwise width and height. */
export function sizeNumbers(studio: Studio): readonly NumberField[] {
  const { keepRatio, plate } = studio.store.state;
  const { kind } = plate.shape;
  if (isRoundKind(kind))
    return [sideField(studio, 'width', a('size.diameter'), (_, value) => ({ width: value, height: value }))];
  const locked = keepRatio || kind === 'file'; // a file's proportions are fixed
  return [['width', 'height'] as const, ['height', 'width'] as const].map(([side, other]) =>
    sideField(studio, side, a(`size.${side}`), (now, value) => ({
      [side]: value,
      ...(locked ? { [other]: hundredth((now[other] / now[side]) * value) } : {}),
    })),
  );
}

/** A number below its label. */
export const stacked = (field: NumberField): TemplateResult =>
  html`<div class="field stacked">
    <label for=${field.id}>${field.label}</label>${numberInput(field)}
    <p class="error" id="${field.id}-error" role="status" hidden></p>
  </div>`;

/** The fields of the plate's size, with a lock for its proportions between them. */
export function sizeFields(studio: Studio): TemplateResult {
  const { keepRatio, plate } = studio.store.state;
  const [first, second] = sizeNumbers(studio);
  if (first === undefined || second === undefined) return html`${first && numberField(first)}`;
  const isFile = plate.shape.kind === 'file';
  const locked = keepRatio || isFile;
  return html`<div class="size">
    ${stacked(first)}
    ${button(
      { look: 'square', name: a('size.lock'), disabled: isFile, pressed: locked },
      icon(locked ? 'lock' : 'unlock', 16),
      () => studio.store.set({ keepRatio: !keepRatio }),
    )}
    ${stacked(second)}
  </div>`;
}
