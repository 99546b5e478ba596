// The field of the plate's thickness: a number, and buttons for those that people ask for.
import { html, type TemplateResult } from 'lit';
import { numberField } from '../controls/fields.js';
import { a } from '../i18n/shaping.js';
import { formatNumber } from '../i18n/text.js';
import { thicknessOf, usualThicknesses, withThickness } from '../model/thickness.js';
import type { Studio } from '../studio/studio.js';
import { lengthField } from './size-fields.js';

const largest = 50; // [mm] of a plate; settings of the print go further
const rounded = (length: number): number => Math.round(1000 * length) / 1000;

export function thicknessField(studio: Studio): TemplateResult {
  const { plate, units } = studio.store.state;
  const thickness = rounded(thicknessOf(plate));
  const { layerHeight } = plate.print;
  const set = (value: number, gesture?: string): void => {
    studio.change((now) => withThickness(now, value), gesture);
  };
  const field = lengthField(
    {
      id: 'thickness',
      label: a('thickness'),
      help: a('thickness.help'),
      value: thickness,
      min: rounded(thicknessOf({ print: { ...plate.print, base: 0 } })),
      max: largest,
      step: layerHeight,
      usual: [layerHeight, 6],
      onInput: (value) => {
        set(value, 'thickness');
      },
      onSettle: () => {
        studio.settle();
      },
    },
    units,
  );
  return html`${numberField(field)}
    <div class="buttons" role="group" aria-label=${a('thickness')}>
      ${usualThicknesses.map((value) => {
        const made = withThickness(plate, value);
        return html`<button
          type="button"
          aria-pressed=${String(made.print.base === plate.print.base)}
          @click=${() => {
            studio.settle();
            set(value);
          }}
        >
          ${formatNumber(rounded(thicknessOf(made)))} mm
        </button>`;
      })}
    </div>`;
}
