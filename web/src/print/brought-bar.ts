// Bar that announces the printer settings of a design from elsewhere before any of them is used.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { broughtText } from '../i18n/say.js';
import { t } from '../i18n/text.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import { button } from '../controls/button.js';

@customElement('sillon-brought')
export class BroughtBar extends StudioElement {
  static override reads = ['plate'] as const;

  static override styles = css`
    .bar {
      display: flex;
      flex-wrap: wrap;
      align-items: center;
      gap: 8px 14px;
      padding: 8px 16px;
      border-bottom: 1px solid var(--line);
      background: var(--tint);
    }
    .bar > .icon {
      flex: none;
      color: var(--accent);
    }
    p {
      flex: 1 1 300px;
      margin: 0;
      overflow-wrap: anywhere;
    }
    @media (max-width: 720px) {
      .bar > .icon {
        display: none;
      }
    }
  `;

  override render(): TemplateResult | typeof nothing {
    const { brought, printer } = this.state.plate;
    if (brought === undefined) return nothing;
    return html`<div class="bar" role="region" aria-label=${t('brought.title')}>
      ${icon('warn')}
      <p>${broughtText(brought, printer)}</p>
      <div class="buttons">
        ${button('', t('brought.show'), this.studio.opens('brought'))}
        ${button('', t('verb.use'), () => this.studio.useBrought(false))}
        ${button('main', t('brought.keep'), () => this.studio.keepOwnPrinter())}
      </div>
    </div>`;
  }
}
