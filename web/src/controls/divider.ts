// The line between the plate and the layer over it; dragging it shows more of one or the other.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { live } from 'lit/directives/live.js';
import { words } from '../i18n/en/looks.js';
import { say, t } from '../i18n/text.js';
import { StudioElement } from './element.js';
import { icon } from './icons.js';

@customElement('sillon-divider')
export class Divider extends StudioElement {
  static override reads = ['wipe', 'over'] as const;

  /** Returns the share of the page's width at a horizontal place of the window [CSS pixels]. */
  @property({ attribute: false }) shareAt!: (x: number) => number;

  static override styles = css`
    :host {
      position: absolute;
      width: 0;
      pointer-events: none;
    }
    .line {
      position: absolute;
      inset: 0 -1px;
      background: var(--accent);
      box-shadow: 0 0 0 1px rgb(255 255 255 / 0.6);
    }
    .grip {
      position: absolute;
      top: 50%;
      left: -22px;
      display: grid;
      place-content: center;
      width: 44px;
      height: 44px;
      margin-top: -22px;
      border: 2px solid var(--accent);
      border-radius: 22px;
      background: var(--surface);
      color: var(--accent);
      box-shadow: var(--lift);
      cursor: ew-resize;
      pointer-events: auto;
      touch-action: none;
    }
    input {
      position: absolute;
      top: 50%;
      width: 1px;
      height: 1px;
      clip-path: inset(50%);
    }
    input:focus-visible ~ .grip {
      outline: 2px solid var(--accent);
      outline-offset: 2px;
    }
    .tag {
      position: absolute;
      bottom: 10px;
      left: 10px;
      white-space: nowrap;
    }
    .tag.other {
      left: auto;
      right: 10px;
    }
  `;

  override render(): TemplateResult | typeof nothing {
    const { wipe, over } = this.state;
    if (over === undefined) return nothing;
    const percent = Math.round(100 * wipe);
    return html`<span class="line"></span> <span class="tag other">${say(words, `looks.over.${over}`)}</span
      ><span class="tag">${t('view.yours')}</span>
      <input
        type="range"
        min="0"
        max="100"
        step="1"
        aria-label=${say(words, `looks.share.${over}`)}
        aria-valuetext=${t('progress.percent', { percent })}
        .value=${live(String(percent))}
        @input=${(event: Event) =>
          this.studio.store.set({ wipe: Number((event.currentTarget as HTMLInputElement).value) / 100 })}
      />
      <span class="grip" @pointerdown=${this.#onDown} @pointermove=${this.#onMove}>${icon('compare')}</span>`;
  }

  /** Places the line on the bench. @param left, top, height  [CSS pixels] */
  place(left: number, top: number, height: number): void {
    this.style.left = `${left}px`;
    this.style.top = `${top}px`;
    this.style.height = `${height}px`;
  }

  #onDown = (event: PointerEvent): void => {
    event.preventDefault();
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    this.renderRoot.querySelector('input')?.focus({ preventScroll: true });
  };

  #onMove = (event: PointerEvent): void => {
    if (!(event.currentTarget as HTMLElement).hasPointerCapture(event.pointerId)) return;
    this.studio.store.set({ wipe: Math.min(1, Math.max(0, this.shareAt(event.clientX))) });
  };
}
