// The menu of the page: rare actions, language and theme, and links to the project.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { words } from '../i18n/en/about.js';
import { languages } from '../i18n/languages.js';
import { say, t } from '../i18n/text.js';
import type { Theme } from '../model/state.js';
import { StudioElement } from '../controls/element.js';
import { icon, type IconName } from '../controls/icons.js';
import { menuStyle } from '../controls/menu-style.js';
import { button } from '../controls/button.js';

/** Set by the build from addresses.json and the version. An empty address has no link. */
declare const publicLinks: Readonly<Record<'documentation' | 'source' | 'report', string>>;
declare const publicVersion: string;

const themes: readonly Theme[] = ['auto', 'light', 'dark'];

@customElement('sillon-menu')
export class Menu extends StudioElement {
  static override reads = ['plate', 'theme', 'host'] as const;

  static override styles = [
    menuStyle,
    css`
      :host {
        display: block;
      }
      .field {
        padding: 8px 10px;
        gap: 6px;
      }
      .about {
        display: flex;
        flex-wrap: wrap;
        align-items: baseline;
        gap: 4px 16px;
        margin: 0;
        padding: 8px 10px;
        list-style: none;
      }
      .about a {
        display: inline-block;
        padding: 4px 0;
        color: var(--accent);
      }
    `,
  ];

  override render(): TemplateResult {
    const { theme, language, host } = this.state;
    return html`${this.#item('plus', t('verb.new'), () => this.studio.services.newPlate())}
      ${this.#item('open', t('verb.open'), () => void this.studio.openPicked())}
      ${host === '' ? this.#item('gallery', t('verb.plates'), this.studio.opens('plates')) : nothing}
      ${this.#item('share', t('verb.share'), this.studio.opens('share'))}
      ${this.#item('print', t('verb.first'), this.studio.opens('first'))}
      ${this.#item(
        'comb',
        t('verb.rebrush'),
        () => void this.studio.attempt(async () => (await import('./pick-sliced.js')).pickSliced(this.studio)),
      )}
      ${this.#item('tune', t('verb.calibrate'), this.studio.opens('calibrate'))}
      ${this.#item('help', t('help.title'), this.studio.opens('help'))}
      ${
        host === '' && isSecureContext
          ? this.#item(
              'download',
              say(words, 'offline.keep'),
              () => void this.studio.attempt(async () => (await import('./offline.js')).keepAll(this.studio)),
            )
          : nothing
      }
      <hr />
      <div class="field">
        <label for="language">${t('language.title')}</label>
        <select
          id="language"
          @change=${(event: Event) => void this.studio.setLanguage((event.currentTarget as HTMLSelectElement).value)}
        >
          ${Object.entries(languages).map(
            ([key, { name }]) => html`<option value=${key} lang=${key} ?selected=${key === language}>${name}</option>`,
          )}
        </select>
        <label for="theme">${t('theme.title')}</label>
        <select
          id="theme"
          @change=${(event: Event) => this.studio.setTheme((event.currentTarget as HTMLSelectElement).value as Theme)}
        >
          ${themes.map((key) => html`<option value=${key} ?selected=${key === theme}>${t(`theme.${key}`)}</option>`)}
        </select>
      </div>
      <hr />
      ${
        host === ''
          ? html`<p class="note field">${say(words, 'app.local')}</p>`
          : html`<p class="note field">${say(words, 'app.host', { host })}</p>
              ${this.#item(
                'open',
                say(words, 'app.open'),
                () =>
                  void this.studio.attempt(async () => {
                    const { url } = await this.studio.services.link(this.state.plate);
                    open(url, '_blank', 'noopener');
                  }),
              )}`
      }
      <hr />
      <ul class="about">
        ${this.#link(publicLinks.documentation, say(words, 'about.documentation'))}
        ${this.#link(publicLinks.source, say(words, 'about.source'))}
        ${this.#link(publicLinks.report, say(words, 'about.report'))}
        ${this.#link('licences.txt', say(words, 'about.licences'))}
        <li class="note">${say(words, 'about.version', { version: publicVersion })}</li>
      </ul>`;
  }

  #link(address: string, label: string): TemplateResult | typeof nothing {
    if (address === '') return nothing;
    return html`<li><a href=${address} target="_blank" rel="noopener">${label}</a></li>`;
  }

  #item(name: IconName, label: string, run: () => void): TemplateResult {
    return button('item', html`${icon(name, 20)}<span>${label}</span>`, () => {
      this.dispatchEvent(new Event('done'));
      run();
    });
  }
}
