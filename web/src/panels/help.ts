// What this is, and its keys.
import { css, html, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { DialogElement } from './dialog.js';
import { shortcuts } from './shortcuts.js';

const keyNames = { Ctrl: 'key.ctrl', Shift: 'key.shift', Esc: 'key.escape' } as const;
const keyName = (key: string): string => (key in keyNames ? t(keyNames[key as keyof typeof keyNames]) : key);

@customElement('sillon-help')
export class Help extends DialogElement {
  static override styles = [
    ...DialogElement.styles,
    css`
      .body {
        display: grid;
        gap: 14px;
      }
      ol {
        margin: 0;
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
      kbd {
        display: inline-block;
        min-width: 22px;
        padding: 1px 6px;
        border: 1px solid var(--line);
        border-bottom-width: 2px;
        border-radius: var(--radius);
        background: var(--raised);
        font: inherit;
        font-size: var(--note);
        text-align: center;
      }
      ul {
        display: grid;
        gap: 4px;
      }
    `,
  ];

  protected override heading = (): string => t('help.title');

  protected override body(): TemplateResult {
    return html`
      <p>${t('help.intro')}</p>
      <ol>
        <li>${t('help.step1')}</li>
        <li>${t('help.step2')}</li>
        <li>${t('help.step3')}</li>
        <li>${t('help.step4')}</li>
      </ol>
      <h3>${t('help.keys')}</h3>
      <dl>
        ${shortcuts.map(
          ({ shown, text }) =>
            html`<div>
              <dt>${t(text)}</dt>
              <dd>${shown.map((keys) => html`<kbd>${keys.split(' ').map(keyName).join(' ')}</kbd>`)}</dd>
            </div>`,
        )}
      </dl>
      <h3>${t('help.mouse')}</h3>
      <ul>
        <li>${t('help.mouse.pan')}</li>
        <li>${t('help.mouse.zoom')}</li>
        <li>${t('help.mouse.light')}</li>
      </ul>
      <p class="note">${t('app.local')}</p>
    `;
  }
}
