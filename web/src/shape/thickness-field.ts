// Makes the field of the plate's thickness: a number, and buttons for common thicknesses.
import { html, type TemplateResult } from 'lit';
import { numberField, type NumberField } from '../controls/fields.js';
import { a } from '../i18n/shaping.js';
import { formatNumber } from '../i18n/text.js';
import { thicknessOf, usualThicknesses, withThickness } from '../model/thickness.js';
import type { Studio } from '../studio/studio.js';
import { lengthField } from './size-fields.js';
import { button } from '../controls/button.js';

const largest = 50; // [mm], limit of this field; the print's own settings go further
const rounded = (length: number): number => Math.round(1000 * length) / 1000;

const setThickness = (studio: Studio, value: number, gesture?: string): void =>
  studio.change((now) => withThickness(now, value), gesture);

/** The number field, whose steps are layers. */
export function thicknessNumber(studio: Studio): NumberField {
  const { plate, units } = studio.store.state;
  const { layerHeight } = plate.print;
  return lengthField(
    {
      id: 'thickness',
      label: a('thickness'),
      help: a('thickness.help'),
      value: rounded(thicknessOf(plate)),
      min: rounded(thicknessOf({ print: { ...plate.print, base: 0 } })),
      max: largest,
      step: layerHeight,
      usual: [layerHeight, 6],
      onInput: (value) => setThickness(studio, value, 'thickness'),
      onSettle: () => studio.settle(),
    },
    units,
  );
}

/** The number field, and buttons for the usual thicknesses. */
export function thicknessField(studio: Studio): TemplateResult {
  const { plate } = studio.store.state;
  return html`${numberField(thicknessNumber(studio))}
    <div class="buttons" role="group" aria-label=${a('thickness')}>
      ${usualThicknesses.map((value) => {
        const made = withThickness(plate, value);
        return button(
          { pressed: made.print.base === plate.print.base },
          html`${formatNumber(rounded(thicknessOf(made)))} mm`,
          () => {
            studio.settle();
            setThickness(studio, value);
          },
        );
      })}
    </div>`;
}
