// Where the light stands, and what moves it.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { live } from 'lit/directives/live.js';
import { t } from '../i18n/text.js';
import '../controls/dial.js';
import { StudioElement } from '../controls/element.js';
import type { LightMode } from '../studio/shown.js';

const lightModes: readonly LightMode[] = ['pointer', 'tilt', 'orbit', 'fixed'];

@customElement('sillon-light')
export class LightControl extends StudioElement {
  static override reads = ['light', 'lightMode', 'plate', 'lamp'] as const;

  static override styles = [
    ...StudioElement.styles,
    css`
      :host {
        display: grid;
        grid-template-columns: auto 1fr;
        align-items: center;
        gap: 2px 12px;
        width: max-content; /* as wide as the longest word of its select */
        min-width: 236px;
        padding: 8px 12px 8px 8px;
        border: 1px solid var(--line);
        border-radius: var(--radius-large);
        background: var(--surface);
        box-shadow: var(--lift);
      }
      sillon-dial {
        width: 58px;
        height: 58px;
        grid-row: span 2;
      }
      select {
        min-height: max(28px, var(--control));
        font-size: var(--note);
        border-color: var(--line);
      }
      @media (max-width: 720px) {
        :host {
          min-width: 196px;
        }
        sillon-dial {
          width: 46px;
          height: 46px;
        }
      }
      /* One row over the plate of a phone. */
      @container (width < 420px) {
        :host {
          min-width: 0;
          grid-template-columns: auto minmax(0, max-content) minmax(40px, 1fr);
          padding: 4px 8px 4px 4px;
        }
        sillon-dial {
          grid-row: auto;
          width: 44px;
          height: 44px;
        }
      }
    `,
  ];

  /** A finger does not float above the plate. */
  #label(mode: LightMode): string {
    if (mode !== 'pointer' || !matchMedia('(hover: none)').matches) return t(`light.${mode}`);
    return t(this.studio.keepsStill() ? 'light.stands' : 'light.sways');
  }

  override render(): TemplateResult {
    const { light, lightMode } = this.state;
    return html`
      <sillon-dial
        kind="light"
        .label=${t('light.azimuth')}
        .value=${Math.round(light.azimuth)}
        .min=${0}
        .max=${360}
        @turn=${(event: CustomEvent<number>) => {
          this.studio.setLight({ azimuth: event.detail % 360 });
        }}
      ></sillon-dial>
      <select
        aria-label=${t('light.title')}
        .value=${live(lightMode)}
        @change=${(event: Event) => {
          void this.studio.setLightMode((event.currentTarget as HTMLSelectElement).value as LightMode);
        }}
      >
        ${lightModes.map((mode) => html`<option value=${mode} ?selected=${mode === lightMode}>${this.#label(mode)}</option>`)}
      </select>
      <input
        type="range"
        min="5"
        max="90"
        step="1"
        aria-label=${t('light.elevation')}
        aria-valuetext="${Math.round(light.elevation)}°"
        .value=${live(String(light.elevation))}
        .style=${`--share: ${(light.elevation - 5) / 85}`}
        @input=${(event: Event) => {
          this.studio.setLight({ elevation: Number((event.currentTarget as HTMLInputElement).value) });
        }}
      />
    `;
  }
}
