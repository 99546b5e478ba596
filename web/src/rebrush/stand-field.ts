// Edits the place of a lamp or a light, in degrees.
import { html, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import { r } from '../i18n/rebrush.js';
import { t } from '../i18n/text.js';
import '../controls/dial.js';

/** Returns a dial for the azimuth and a slider for the elevation.
 * @param lowest, highest  limits of the elevation [degrees] */
export function standField(
  name: 'lamp' | 'light',
  azimuth: number,
  elevation: number,
  lowest: number,
  highest: number,
  set: (light: [number, number]) => void,
): TemplateResult {
  return html`<div class="stands">
    <sillon-dial
      kind="light"
      .label=${r(name)}
      .value=${azimuth}
      .min=${0}
      .max=${360}
      @turn=${(event: CustomEvent<number>) => set([event.detail % 360, elevation])}
    ></sillon-dial>
    <span
      ><span
        >${name === 'lamp' ? t('lamp.stands', { azimuth, elevation }) : r('light.stands', { azimuth, elevation })}</span
      ><input
        type="range"
        min=${lowest}
        max=${highest}
        step="1"
        aria-label=${r('height')}
        aria-valuetext="${elevation}°"
        .value=${live(String(elevation))}
        .style=${`--share: ${(elevation - lowest) / (highest - lowest)}`}
        @input=${(event: Event) => set([azimuth, Number((event.currentTarget as HTMLInputElement).value)])}
    /></span>
  </div>`;
}
