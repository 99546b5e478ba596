// The help sheet: what the studio is, and its keys.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/help.js';
import { words as aboutWords } from '../i18n/en/about.js';
import { say, t } from '../i18n/text.js';
import { DialogElement } from './dialog.js';
import { keysText, shortcuts } from './shortcut-list.js';

@customElement('sillon-help')
export class Help extends DialogElement {
  static override styles = css`
    ol {
      padding-left: 20px;
      display: grid;
      gap: 4px;
    }
    dl {
      display: grid;
      grid-template-columns: repeat(auto-fit, minmax(280px, 1fr));
      gap: 0 32px;
    }
    dl div {
      display: flex;
      justify-content: space-between;
      align-items: center;
      gap: 12px;
      padding: 6px 0;
      border-bottom: 1px solid var(--line);
    }
    dd {
      flex: none;
      display: flex;
      gap: 4px;
      white-space: nowrap;
    }
    ul {
      display: grid;
      gap: 4px;
    }
  `;

  protected override heading = (): string => t('help.title');

  protected override body(): TemplateResult {
    return html`
      <p>${say(words, 'help.intro')}</p>
      <ol>
        <li>${say(words, 'help.step1')}</li>
        <li>${say(words, 'help.step2')}</li>
        <li>${say(words, 'help.step3')}</li>
        <li>${say(words, 'help.step4')}</li>
      </ol>
      ${matchMedia('(pointer: coarse)').matches ? [this.#mouse(), this.#keys()] : [this.#keys(), this.#mouse()]}
      <p class="note">${say(aboutWords, 'app.local')}</p>
    `;
  }

  #keys(): TemplateResult {
    return html`<h3>${say(words, 'help.keys')}</h3>
      <dl>
        ${shortcuts.map(
          ({ shown, text }) =>
            html`<div>
              <dt>${say(words, text)}</dt>
              <dd>${shown.map((keys) => html`<kbd>${keysText(keys)}</kbd>`)}</dd>
            </div>`,
        )}
      </dl>`;
  }

  #mouse(): TemplateResult {
    return html`<h3>${say(words, 'help.mouse')}</h3>
      <ul>
        <li>${say(words, 'help.mouse.pan')}</li>
        <li>${say(words, 'help.mouse.zoom')}</li>
        <li>${say(words, 'help.mouse.light')}</li>
        <li>${say(words, 'help.mouse.layers')}</li>
      </ul>`;
  }
}
