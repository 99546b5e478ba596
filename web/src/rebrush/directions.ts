// Chooses the directions of the new beads of a sliced print, and the lamp under which they are shown.
import { html, nothing, type TemplateResult } from 'lit';
import { r } from '../i18n/rebrush.js';
import { fits, type HandBrush } from '../model/rebrush.js';
import type { Light } from '../model/view.js';
import '../controls/dial.js';
import { numberInput, segments, select } from '../controls/fields.js';
import { handFields } from './hand-fields.js';
import { pictureFields } from './picture-fields.js';
import { standField } from './stand-field.js';
import type { PrintWork } from './work.js';

/** State of the page beside the work. */
interface PageFields {
  brush: HandBrush;
  /** Light under which the beads are shown. */
  light: Light;
  onBrush: (change: Partial<HandBrush>) => void;
  onLight: (light: Light) => void;
  onPickPicture: () => void;
}

/** Returns the section of the directions. */
export function directionFields(work: PrintWork, page: PageFields): TemplateResult {
  const { way, fit } = work.wish;
  return html`<section>
    ${segments({
      id: 'way',
      label: r('directions'),
      value: way,
      options: [
        { value: 'angle', label: r('way.angle'), icon: 'angle' },
        { value: 'hand', label: r('way.hand'), icon: 'comb' },
        { value: 'plate', label: r('way.plate'), icon: 'directions' },
        { value: 'picture', label: r('way.picture'), icon: 'lamp' },
      ],
      onChoose: (next) => work.want({ way: next }),
    })}
    ${way === 'angle' || way === 'hand' ? angleField(work) : nothing}
    ${way === 'hand' ? handFields(work, page.brush, page.onBrush) : nothing}
    ${way === 'plate' ? html`<p class="note">${r('plate.help')}</p>` : nothing}
    ${way === 'picture' ? pictureFields(work, page.onPickPicture) : nothing}
    ${
      way === 'plate' || way === 'picture'
        ? select({
            id: 'fit',
            label: r('fit'),
            value: fit,
            options: fits.map((value) => ({ value, label: r(`fit.${value}`) })),
            onChoose: (next) => work.want({ fit: next }),
          })
        : nothing
    }
    ${way === 'picture' ? lampField(work) : lightField(page)}
  </section>`;
}

function angleField(work: PrintWork): TemplateResult {
  const { angle } = work.wish;
  const set = (value: number): void => work.want({ angle: value });
  const field = { id: 'angle', label: r('angle'), value: angle, min: -360, max: 360, step: 1, unit: '°' };
  return html`<div class="field angle">
    <sillon-dial
      .label=${r('angle')}
      .value=${angle}
      @turn=${(event: CustomEvent<number>) => set(event.detail)}
    ></sillon-dial>
    <label for="angle">${r('angle')}</label>
    ${numberInput({ ...field, onInput: set })}
    <p class="error" id="angle-error" role="status" hidden></p>
  </div>`;
}

/** Edits the picture's lamp, for which the beads are solved. */
function lampField(work: PrintWork): TemplateResult {
  const [azimuth, elevation] = work.wish.lamp;
  return standField('lamp', azimuth, elevation, 15, 80, (lamp) => work.want({ lamp }));
}

/** Edits the light in the view alone; the beads stay as they are. */
function lightField({ light, onLight }: PageFields): TemplateResult {
  return standField('light', light.azimuth, light.elevation, 5, 90, ([azimuth, elevation]) =>
    onLight({ azimuth, elevation }),
  );
}
