// Rarely changed settings of the view: comparison, size on the screen, motion of the light, and captures.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { live } from 'lit/directives/live.js';
import { words } from '../i18n/en/looks.js';
import { say, t } from '../i18n/text.js';
import { pictureOf } from '../model/lamp.js';
import { elevations } from '../views/light.js';
import { StudioElement } from '../controls/element.js';
import { select } from '../controls/fields.js';
import { icon, type IconName } from '../controls/icons.js';
import { offers, type LightMode, type Over, type Sizing } from '../studio/shown.js';
import { button } from '../controls/button.js';

const [lowest, highest] = elevations;
const lightModes: readonly LightMode[] = ['pointer', 'tilt', 'orbit', 'fixed'];
type Beside = Over | 'none' | 'beside';

@customElement('sillon-view-options')
export class ViewOptions extends StudioElement {
  static override reads = [
    'plate',
    'result',
    'lamp',
    'over',
    'compare',
    'sizing',
    'light',
    'lightMode',
    'flipping',
    'recording',
    'view',
  ] as const;

  static override styles = css`
    :host {
      display: grid;
      grid-template-columns: minmax(0, 1fr);
      gap: 12px;
    }
    .row {
      display: flex;
      gap: 6px;
    }
  `;

  override render(): TemplateResult {
    return html`${this.state.view === 'appearance' ? this.#look() : nothing}
      <div class="row" role="group" aria-label=${t('section.view')}>
        ${this.#button('minus', t('verb.zoomOut'), () => this.studio.stage?.zoom(1 / 1.4))}
        ${this.#button('plus', t('verb.zoomIn'), () => this.studio.stage?.zoom(1.4))}
        ${this.#button('fit', t('verb.fit'), () => this.studio.stage?.fit())}
        ${this.state.view === 'appearance' && offers(this.state, 'download') ? this.#captures() : nothing}
      </div>`;
  }

  /** Returns the settings of the view of the finished look. */
  #look(): TemplateResult {
    const { plate, result, lamp, over, compare, sizing, lightMode, light } = this.state;
    const besides: Beside[] = [
      'none',
      ...(pictureOf(plate, lamp) === undefined ? [] : ['picture' as const]),
      'zigzag',
      ...(result?.conflict === undefined ? [] : ['conflict' as const]),
      'beside',
    ];
    const sizings: Sizing[] = ['whole', 'life', 'arm', ...(sizing === 'free' ? ['free' as const] : [])];
    return html`${select<Beside>({
        id: 'compare',
        label: say(words, 'looks.over'),
        value: compare ? 'beside' : (over ?? 'none'),
        options: besides.map((value) => ({
          value,
          label: value === 'beside' ? t('view.zigzag') : say(words, `looks.over.${value}`),
        })),
        onChoose: (value) =>
          this.studio.store.set({
            compare: value === 'beside',
            over: value === 'none' || value === 'beside' ? undefined : value,
          }),
      })}
      ${select<Sizing>({
        id: 'sizing',
        label: say(words, 'looks.size'),
        value: sizing,
        options: sizings.map((value) => ({ value, label: say(words, `looks.size.${value}`) })),
        onChoose: (value) => this.studio.store.set({ sizing: value }),
      })}
      ${select<LightMode>({
        id: 'light-mode',
        label: t('light.title'),
        value: lightMode,
        options: lightModes.map((value) => ({ value, label: this.#label(value) })),
        onChoose: (value) => void this.studio.setLightMode(value),
      })}
      <div class="field">
        <span class="name"><label for="elevation">${t('light.elevation')}</label></span>
        <span class="note figures">${Math.round(light.elevation)}°</span>
        <input
          type="range"
          id="elevation"
          min=${lowest}
          max=${highest}
          step="1"
          aria-valuetext="${Math.round(light.elevation)}°"
          .value=${live(String(light.elevation))}
          .style=${`--share: ${(light.elevation - lowest) / (highest - lowest)}`}
          @input=${(event: Event) =>
            this.studio.setLight({ elevation: Number((event.currentTarget as HTMLInputElement).value) })}
        />
      </div>`;
  }

  /** Returns the name of a light mode: 'pointer' differs while the
   * lamp turns, and on touch screens, where no pointer floats. */
  #label(mode: LightMode): string {
    if (mode === 'pointer' && this.state.flipping) return t('light.turns');
    if (mode !== 'pointer' || !matchMedia('(hover: none)').matches) return t(`light.${mode}`);
    return t(this.studio.keepsStill() ? 'light.stands' : 'light.sways');
  }

  #captures(): TemplateResult {
    const { recording } = this.state;
    return html`${this.#button('camera', t('capture.picture'), () => void this.studio.save('png'))}
    ${button(
      {
        look: 'square',
        name: t(recording ? 'capture.making' : 'capture.loop'),
        disabled: recording,
        pressed: recording,
      },
      icon('video'),
      () => void this.studio.save('loop'),
    )}`;
  }

  #button(name: IconName, label: string, run: () => void): TemplateResult {
    return button({ look: 'square', name: label }, icon(name, 16), run);
  }
}
