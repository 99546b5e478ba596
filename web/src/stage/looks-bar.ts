// Under the plate: which picture's lamp shines, the turn from one to the other, what lies over the plate to compare it with,
// and the size it is seen at.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { live } from 'lit/directives/live.js';
import { words } from '../i18n/en/looks.js';
import { say, t } from '../i18n/text.js';
import { pictureOf, shownPictures } from '../model/lamp.js';
import type { LampPicture } from '../model/plate.js';
import { StudioElement } from '../controls/element.js';
import { icon, type IconName } from '../controls/icons.js';
import type { Over, Sizing } from '../studio/shown.js';
import { thumbnail } from '../controls/thumbnail.js';

interface Choice {
  value: string;
  label: string;
}

@customElement('sillon-looks')
export class LooksBar extends StudioElement {
  static override reads = ['plate', 'result', 'lamp', 'aimed', 'flipping', 'over', 'sizing'] as const;

  static override styles = [
    ...StudioElement.styles,
    css`
      :host {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 6px 8px;
        padding: 6px 8px;
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
      .pick {
        position: relative;
        display: flex;
        align-items: center;
        gap: 2px;
        padding-left: 6px;
        color: var(--soft);
      }
      .pick.on {
        color: var(--accent);
      }
      select {
        width: auto;
        max-width: 10rem;
        border-color: transparent;
        background-color: transparent;
        font-weight: 500;
      }
      /* One row for a thumb: words give way to signs, which open the same lists. */
      @container (width < 700px) {
        :host {
          padding: 4px;
          gap: 4px;
        }
        .pick,
        .turn {
          justify-content: center;
          width: 44px;
          height: 44px;
          padding: 0;
        }
        .pick {
          border: 1px solid var(--line);
          border-radius: var(--radius);
        }
        .pick:focus-within {
          outline: 2px solid var(--accent);
        }
        .pick select {
          position: absolute;
          inset: -1px; /* the border is a part of it for a thumb */
          width: 44px;
          height: 44px;
          min-height: 0;
          opacity: 0;
        }
      }
      /* Beside the light, so that the plate has the height of a row more. */
      @container (width < 1000px) {
        select {
          max-width: 9rem;
          text-overflow: ellipsis;
        }
        .turn .words {
          position: absolute;
          clip-path: inset(50%);
          width: 1px;
          overflow: hidden;
        }
      }
    `,
  ];

  override render(): TemplateResult {
    const { plate, result, lamp, aimed, over, sizing } = this.state;
    const pictures = shownPictures(plate);
    const overs: (Over | '')[] = [
      '',
      ...(pictureOf(plate, lamp) === undefined ? [] : ['picture' as const]),
      'zigzag',
      ...(result?.conflict === undefined ? [] : ['conflict' as const]),
    ];
    const sizings: Sizing[] = ['whole', 'life', 'arm', ...(sizing === 'free' ? ['free' as const] : [])];
    return html`
      ${pictures.length > 0 && (pictures.length > 1 || aimed !== undefined) ? this.#pictures(pictures) : nothing}
      ${this.#pick(
        'compare',
        say(words, 'looks.over'),
        over ?? '',
        overs.map((value) => ({ value, label: say(words, `looks.over.${value || 'none'}`) })),
        (value) => {
          this.studio.store.set({ over: (value || undefined) as Over | undefined, compare: false });
        },
      )}
      ${this.#pick(
        'fit',
        say(words, 'looks.size'),
        sizing,
        sizings.map((value) => ({ value, label: say(words, `looks.size.${value}`) })),
        (value) => {
          this.studio.store.set({ sizing: value as Sizing });
        },
      )}
    `;
  }

  #pictures(pictures: readonly LampPicture[]): TemplateResult {
    const { lamp, aimed, flipping } = this.state;
    return html`<div class="pictures" role="group" aria-label=${t('lamp.shown')}>
        ${pictures.map(
          ({ file }, k) =>
            html`<button
              type="button"
              aria-pressed=${String(k === lamp && aimed === undefined)}
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
      ${
        pictures.length === 1
          ? nothing
          : html`<button
              type="button"
              class="turn"
              aria-pressed=${String(flipping)}
              title=${t('lamp.flip')}
              @click=${() => {
                this.studio.flip();
              }}
            >
              ${icon(flipping ? 'pause' : 'turn')} <span class="words">${t('lamp.flip')}</span>
            </button>`
      }`;
  }

  #pick(
    name: IconName,
    label: string,
    value: string,
    choices: readonly Choice[],
    onChoose: (value: string) => void,
  ): TemplateResult {
    const usual = value === choices[0]?.value;
    return html`<label class="pick ${usual ? '' : 'on'}" title=${label}
      >${icon(name)}<select
        aria-label=${label}
        .value=${live(value)}
        @change=${(event: Event) => {
          onChoose((event.currentTarget as HTMLSelectElement).value);
        }}
      >
        ${choices.map((one) => html`<option value=${one.value} ?selected=${one.value === value}>${one.label}</option>`)}
      </select></label
    >`;
  }
}
