// Under the plate: which picture's lamp shines, the turn from one to the other, and the picture itself over the plate.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { StudioElement } from './element.js';
import { icon } from './icons.js';
import { thumbnail } from './thumbnail.js';

@customElement('sillon-lamp-bar')
export class LampBar extends StudioElement {
  static override reads = ['plate', 'lamp', 'flipping', 'wipe'] as const;

  static override styles = [
    ...StudioElement.styles,
    css`
      :host {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 6px 12px;
        padding: 6px 10px;
        border: 1px solid var(--line);
        border-radius: var(--radius-large);
        background: var(--surface);
        box-shadow: var(--lift);
      }
      .pictures {
        display: flex;
        gap: 4px;
      }
      .pictures button {
        width: 44px;
        height: 44px;
        padding: 2px;
      }
      .pictures button[aria-pressed='true'] {
        border-color: var(--accent);
        outline: 2px solid var(--accent);
        outline-offset: -1px;
      }
      img {
        width: 100%;
        height: 100%;
        object-fit: cover;
        border-radius: 2px;
      }
      label {
        display: grid;
        gap: 2px;
        width: 130px;
      }
    `,
  ];

  override render(): TemplateResult | typeof nothing {
    const { plate, lamp, flipping, wipe } = this.state;
    const { directions } = plate;
    if (directions.kind !== 'lamp') return nothing;
    const several = directions.pictures.length > 1;
    return html`
      ${
        several
          ? html`<div class="pictures" role="group" aria-label=${t('lamp.shown')}>
                ${directions.pictures.map(
                  ({ file }, k) =>
                    html`<button
                      type="button"
                      aria-pressed=${String(k === lamp)}
                      aria-label="${t('lamp.show')}: ${file.name}"
                      title="${t('lamp.show')}: ${file.name}"
                      @click=${() => {
                        this.studio.showLamp(k);
                      }}
                    >
                      ${thumbnail(file)}
                    </button>`,
                )}
              </div>
              <button
                type="button"
                aria-pressed=${String(flipping)}
                @click=${() => {
                  this.studio.flip();
                }}
              >
                ${icon(flipping ? 'pause' : 'turn')} ${t('lamp.flip')}
              </button>`
          : nothing
      }
      <label
        ><span class="note">${t('lamp.wipe')}</span
        ><input
          type="range"
          min="0"
          max="100"
          step="1"
          aria-valuetext=${t('lamp.wiped', { percent: Math.round(100 * wipe) })}
          .value=${String(Math.round(100 * wipe))}
          .style=${`--share: ${wipe}`}
          @input=${(event: Event) => {
            this.studio.store.set({ wipe: Number((event.currentTarget as HTMLInputElement).value) / 100 });
          }}
      /></label>
    `;
  }
}
