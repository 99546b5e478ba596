// The bar under the plate: it tells which picture's lamp shines, and turns from one picture to the next.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { shownPictures } from '../model/lamp.js';
import type { LampPicture } from '../model/plate.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { thumbnail } from '../controls/thumbnail.js';
import { button } from '../controls/button.js';

@customElement('sillon-looks')
export class LooksBar extends StudioElement {
  static override reads = ['plate', 'lamp', 'aimed', 'flipping'] as const;

  static override styles = css`
    .bar {
      display: flex;
      flex-wrap: wrap;
      align-items: center;
      gap: 6px 8px;
      padding: 6px 8px;
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
    /* One row for a thumb: the word gives way to its sign. */
    @container (width < 1000px) {
      .turn .words {
        position: absolute;
        clip-path: inset(50%);
        width: 1px;
        overflow: hidden;
      }
    }
    @container (width < 700px) {
      .bar {
        padding: 4px;
        gap: 4px;
      }
      .turn {
        justify-content: center;
        width: 44px;
        height: 44px;
        padding: 0;
      }
    }
  `;

  override render(): TemplateResult | typeof nothing {
    const pictures = shownPictures(this.state.plate);
    if (pictures.length === 0 || (pictures.length === 1 && this.state.aimed === undefined)) return nothing;
    return html`<div class="bar raft">${this.#pictures(pictures)}</div>`;
  }

  /** Returns a button for each picture, and one that turns the lamp from one to the next. */
  #pictures(pictures: readonly LampPicture[]): TemplateResult {
    const { lamp, aimed, flipping } = this.state;
    return html`<div class="pictures" role="group" aria-label=${t('lamp.shown')}>
        ${pictures.map(({ file }, k) =>
          button(
            { name: `${t('lamp.show')}: ${file.name}`, pressed: k === lamp && aimed === undefined },
            thumbnail(file),
            () => this.studio.showLamp(k),
          ),
        )}
      </div>
      ${
        pictures.length === 1
          ? nothing
          : button(
              { look: 'turn', title: t('lamp.flip'), pressed: flipping },
              html`${icon(flipping ? 'pause' : 'turn')} <span class="words">${t('lamp.flip')}</span>`,
              () => this.studio.flip(),
            )
      }`;
  }
}
