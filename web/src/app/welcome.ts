// The first screen says what this is and what to do, until the visitor has done anything.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';

@customElement('sillon-welcome')
export class Welcome extends StudioElement {
  static override reads = ['welcome'] as const;

  static override styles = [
    ...StudioElement.styles,
    css`
      .bar {
        position: relative;
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 6px 18px;
        padding: 8px 52px 8px 20px;
        border-bottom: 1px solid var(--line);
        background: var(--tint);
      }
      p {
        flex: 1 1 380px;
      }
      b {
        color: var(--accent);
        font-size: var(--lead);
        font-weight: 600;
        white-space: nowrap;
      }
      .buttons {
        display: flex;
        flex-wrap: wrap;
        gap: 6px;
      }
      .close {
        position: absolute;
        top: 8px;
        right: 12px;
      }
      /* Nothing can be dropped by touch. */
      @media (hover: none) {
        b {
          display: none;
        }
      }
      @media (max-width: 720px) {
        .bar {
          padding: 8px 12px;
        }
        p {
          flex-basis: 100%;
          padding-right: 40px;
        }
        .close {
          top: 4px;
          right: 6px;
        }
      }
    `,
  ];

  override render(): TemplateResult | typeof nothing {
    if (!this.state.welcome) return nothing;
    return html`<section class="bar" aria-label=${t('welcome.title')}>
      <p>${t('welcome.what')} <b>${t('welcome.drop')}</b></p>
      <div class="buttons">
        <button type="button" class="main" @click=${() => void this.#choose()}>
          ${icon('open')} ${t('welcome.choose')}
        </button>
        <button
          type="button"
          @click=${() => {
            this.studio.show('gallery');
          }}
        >
          ${t('welcome.examples')}
        </button>
        <button
          type="button"
          @click=${() => {
            this.studio.show('first');
          }}
        >
          ${t('verb.first')}
        </button>
        <button
          type="button"
          @click=${() => {
            void this.studio.attempt(async () => (await import('./pick-sliced.js')).pickSliced(this.studio));
          }}
        >
          ${t('verb.rebrush')}
        </button>
      </div>
      <button
        type="button"
        class="plain square close"
        aria-label=${t('verb.dismiss')}
        title=${t('verb.dismiss')}
        @click=${() => {
          this.studio.endWelcome();
        }}
      >
        ${icon('close')}
      </button>
    </section>`;
  }

  async #choose(): Promise<void> {
    await this.studio.open(await this.studio.pick());
  }
}
