// How large the plate is, in millimetres or inches.
import { css, html, type TemplateResult } from 'lit';
import { t } from '../i18n/text.js';
import type { Units } from '../model/guest.js';
import type { Plate } from '../model/plate.js';
import { numberField, numberInput, type NumberField } from './fields.js';
import { icon } from './icons.js';
import type { Studio } from './studio.js';

const smallest = 1; // [mm]
const largest = 1000;
const inch = 25.4; // [mm]
const hundredth = (value: number): number => Math.round(value * 100) / 100;

/** A length in the visitor's units. */
export const inUnits = (length: number, units: Units): number => (units === 'in' ? length / inch : length);

/** A field of millimetres, shown in the visitor's units. */
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
    onInput: (value) => {
      field.onInput(value * inch);
    },
  };
}

/** For the panel that shows `sizeFields`. */
export const sizeStyle = css`
  .size {
    display: grid;
    grid-template-columns: 1fr auto 1fr;
    align-items: end;
    gap: 8px;
  }
  .size .measure {
    width: 100%;
    min-width: 0;
  }
  .size label {
    display: block;
    margin-bottom: 4px;
  }
`;

function resize(studio: Studio, change: (plate: Plate) => Partial<Plate>, gesture: string): void {
  studio.change((plate) => ({ ...plate, ...change(plate) }), gesture);
}

function sideField(studio: Studio, side: 'width' | 'height', locked: boolean): TemplateResult {
  const { plate, units } = studio.store.state;
  const other = side === 'width' ? 'height' : 'width';
  const field = {
    id: `size-${side}`,
    label: t(`size.${side}`),
    value: hundredth(plate[side]),
    min: smallest,
    max: largest,
    step: 0.1,
    onInput: (value: number) => {
      resize(
        studio,
        (now) => ({ [side]: value, ...(locked ? { [other]: hundredth((now[other] / now[side]) * value) } : {}) }),
        side,
      );
    },
    onSettle: () => {
      studio.settle();
    },
  };
  return html`<div class="field stacked">
    <label for=${field.id}>${field.label}</label>${numberInput(lengthField(field, units))}
    <p class="error" id="${field.id}-error" role="status" hidden></p>
  </div>`;
}

function diameterField(studio: Studio): TemplateResult {
  const { plate, units } = studio.store.state;
  const field = {
    id: 'size-width',
    label: t('size.diameter'),
    value: hundredth(plate.width),
    min: smallest,
    max: largest,
    step: 0.1,
    usual: [10, 200] as const,
    onInput: (value: number) => {
      resize(studio, () => ({ width: value, height: value }), 'width');
    },
    onSettle: () => {
      studio.settle();
    },
  };
  return numberField(lengthField(field, units));
}

export function sizeFields(studio: Studio): TemplateResult {
  const { keepRatio, plate } = studio.store.state;
  const { kind } = plate.shape;
  if (kind === 'disc') return diameterField(studio);
  const locked = keepRatio || kind === 'file'; // a file's proportions are its own
  return html`<div class="size">
    ${sideField(studio, 'width', locked)}
    <button
      type="button"
      class="square"
      aria-pressed=${String(locked)}
      aria-label=${t('size.lock')}
      title=${t('size.lock')}
      ?disabled=${kind === 'file'}
      @click=${() => {
        studio.store.set({ keepRatio: !keepRatio });
      }}
    >
      ${icon(locked ? 'lock' : 'unlock', 16)}
    </button>
    ${sideField(studio, 'height', locked)}
  </div>`;
}
