// The page's head: what the plate is called, back and forth, out of the door.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { languages } from '../i18n/languages.js';
import { t } from '../i18n/text.js';
import { weaknessesOf } from '../model/lamp.js';
import type { Plate } from '../model/plate.js';
import type { Theme } from '../model/state.js';
import { StudioElement } from './element.js';
import { icon, mark, type IconName } from './icons.js';
import { offers } from './shown.js';
import type { Product } from './studio.js';

const products: readonly (readonly [Product, IconName])[] = [
  ['gcode', 'print'],
  ['body', 'body'],
  ['svg', 'toolpath'],
  ['png', 'camera'],
  ['view', 'sun'],
  ['project', 'file'],
];
const themes: readonly Theme[] = ['auto', 'light', 'dark'];

@customElement('sillon-header')
export class Header extends StudioElement {
  static override reads = ['plate', 'made', 'theme', 'mode', 'controls', 'host'] as const;

  static override styles = [
    ...StudioElement.styles,
    css`
      :host {
        display: flex;
        align-items: center;
        gap: 6px;
        height: var(--bar);
        padding: 0 12px 0 14px;
        border-bottom: 1px solid var(--line);
        background: var(--surface);
      }
      h1 {
        display: flex;
        align-items: center;
        gap: 9px;
        font-size: var(--lead);
        font-weight: 600;
        letter-spacing: 0.01em;
      }
      h1 .mark {
        color: var(--accent);
      }
      input.name {
        width: 20ch;
        min-width: 0;
        margin: 0 6px 0 10px;
        border-color: transparent;
        background: none;
        color: var(--soft);
        text-overflow: ellipsis;
      }
      input.name:hover,
      input.name:focus {
        border-color: var(--edge);
        color: var(--ink);
      }
      .space {
        flex: 1;
      }
      .rule {
        width: 1px;
        height: 22px;
        margin: 0 4px;
        background: var(--line);
      }
      .main {
        margin-left: 4px;
        padding: 0 14px;
        min-height: 34px;
      }
      [popover] {
        position: fixed;
        inset: calc(var(--bar) + 2px) 10px auto auto;
        width: 292px;
        max-height: calc(100dvh - var(--bar) - 20px);
        margin: 0;
        padding: 6px;
        border: 1px solid var(--line);
        border-radius: var(--radius-large);
        background: var(--surface);
        color: var(--ink);
        box-shadow: var(--lift);
        overflow: auto;
      }
      [popover] button {
        display: grid;
        grid-template-columns: auto 1fr;
        justify-items: start;
        gap: 0 12px;
        width: 100%;
        padding: 8px 10px;
        border-color: transparent;
        background: none;
        text-align: left;
      }
      [popover] button:hover {
        background: var(--hover);
      }
      [popover] button .icon {
        grid-row: span 2;
        color: var(--accent);
      }
      [popover] button:disabled .icon {
        color: inherit;
      }
      [popover] hr {
        margin: 6px 10px;
        border: 0;
        border-top: 1px solid var(--line);
      }
      [popover] .field {
        padding: 8px 10px;
        gap: 6px;
      }
      .weak {
        display: flex;
        align-items: start;
        color: var(--bad);
      }
      .narrow {
        display: none;
      }
      @media (max-width: 980px) {
        .wide {
          display: none !important;
        }
        .narrow {
          display: inline-flex;
        }
        .always {
          width: var(--control);
          padding: 0;
        }
        .always .words {
          position: absolute;
          clip-path: inset(50%);
          width: 1px; /* else words would reach out of the page */
          overflow: hidden;
        }
      }
      @media (max-width: 400px) {
        .main {
          width: 44px;
          padding: 0;
        }
        .main .words {
          position: absolute;
          clip-path: inset(50%);
          width: 1px; /* else words would reach out of the page */
          overflow: hidden;
        }
      }
      @media (max-width: 560px) {
        :host {
          padding: 0 6px 0 10px;
          gap: 2px;
        }
        h1 .word,
        input.name {
          display: none;
        }
        .main {
          padding: 0 12px;
        }
      }
    `,
  ];

  override render(): TemplateResult {
    const { store } = this.studio;
    const { plate, mode } = this.state;
    const edits = mode === 'edit';
    return html`
      <h1>${mark()}<span class="word">Sillon</span></h1>
      ${edits ? this.#name(plate) : nothing}
      ${this.#button(
        'undo',
        t('verb.undo'),
        'Ctrl+Z',
        () => {
          store.undo();
        },
        !store.canUndo,
      )}
      ${this.#button(
        'redo',
        t('verb.redo'),
        'Ctrl+Shift+Z',
        () => {
          store.redo();
        },
        !store.canRedo,
      )}
      <span class="space"></span>
      ${edits ? this.#all() : nothing}
      ${
        offers(this.state, 'download')
          ? html`<button type="button" class="main" popovertarget="export">
                ${icon('download')} <span class="words">${t('verb.download')}</span></button
              >${this.#exports()}`
          : nothing
      }
    `;
  }

  #name(plate: Plate): TemplateResult {
    return html`<input
      class="name"
      type="text"
      aria-label=${t('app.plate')}
      placeholder=${t('app.untitled')}
      maxlength="80"
      spellcheck="false"
      .value=${plate.name}
      @change=${(event: Event) => {
        const name = (event.currentTarget as HTMLInputElement).value.trim();
        this.studio.change((now) => (now.name === name ? now : { ...now, name }));
      }}
    />`;
  }

  /** What only those who may change everything need. */
  #all(): TemplateResult {
    return html`${this.#worded('gallery', t('section.gallery'), 'always', () => {
        this.studio.show('gallery');
      })}
      ${this.#worded('open', t('verb.open'), 'always', () => {
        void this.#open();
      })}
      ${this.#worded('share', t('verb.share'), 'wide', () => {
        this.studio.show('share');
      })}
      <span class="rule wide"></span>
      <button
        type="button"
        class="plain square"
        aria-label=${t('app.menu')}
        title=${t('app.menu')}
        popovertarget="menu"
      >
        ${icon('more')}
      </button>
      ${this.#button(
        'help',
        t('verb.help'),
        '?',
        () => {
          this.studio.show('help');
        },
        false,
        'wide',
      )}
      ${this.#menu()}`;
  }

  async #open(): Promise<void> {
    await this.studio.open(await this.studio.pick());
  }

  #button(name: IconName, label: string, keys: string, run: () => void, disabled = false, where = ''): TemplateResult {
    return html`<button
      type="button"
      class="plain square ${where}"
      aria-label=${label}
      aria-keyshortcuts=${keys.replace('Ctrl', 'Control')}
      title="${label} (${keys})"
      ?disabled=${disabled}
      @click=${run}
    >
      ${icon(name)}
    </button>`;
  }

  /** @param where  'always': as a picture alone where there is little room; 'wide': in the menu there */
  #worded(name: IconName, label: string, where: 'always' | 'wide', run: () => void): TemplateResult {
    return html`<button type="button" class="plain ${where}" title=${label} @click=${run}>
      ${icon(name)} <span class="words">${label}</span>
    </button>`;
  }

  #hide(): void {
    for (const open of this.renderRoot.querySelectorAll<HTMLElement>('[popover]:popover-open')) open.hidePopover();
  }

  #item(
    name: IconName,
    label: string,
    help: string,
    run: () => void,
    { where = '', disabled = false }: { where?: string; disabled?: boolean } = {},
  ): TemplateResult {
    return html`<button
      type="button"
      class=${where}
      ?disabled=${disabled}
      @click=${() => {
        this.#hide();
        run();
      }}
    >
      ${icon(name, 20)}<span>${label}</span>${help === '' ? nothing : html`<span class="note">${help}</span>`}
    </button>`;
  }

  #exports(): TemplateResult {
    const { plate, made } = this.state;
    return html`<div id="export" popover role="group" aria-label=${t('section.export')}>
      ${weaknessesOf(plate, made?.plate.directions === plate.directions ? made.report.pictures : undefined).map(
        (weakness) => html`<p class="note field weak">${icon('warn', 16)} ${t(`lamp.weak.${weakness}`)}</p>`,
      )}
      ${products.map(([product, name]) => {
        const missing = product === 'body' && this.state.plate.print.base === 0;
        const help = t(missing ? 'export.body.none' : `export.${product}.help`);
        const save = (): void => void this.studio.save(product);
        return this.#item(name, t(`export.${product}`), help, save, { disabled: missing });
      })}
      <hr />
      ${this.#item('share', t('verb.share'), t('export.link.help'), () => {
        this.studio.show('share');
      })}
    </div>`;
  }

  #menu(): TemplateResult {
    const { theme, language, host } = this.state;
    return html`<div id="menu" popover role="group" aria-label=${t('app.menu')}>
      ${this.#item('plus', t('verb.new'), '', () => {
        this.studio.services.newPlate();
      })}
      ${this.#item(
        'share',
        t('verb.share'),
        '',
        () => {
          this.studio.show('share');
        },
        { where: 'narrow' },
      )}
      ${this.#item('help', t('help.title'), '', () => {
        this.studio.show('help');
      })}
      <hr />
      <div class="field">
        <label for="language">${t('language.title')}</label>
        <select
          id="language"
          @change=${(event: Event) => {
            void this.studio.setLanguage((event.currentTarget as HTMLSelectElement).value);
          }}
        >
          ${Object.entries(languages).map(
            ([key, { name }]) => html`<option value=${key} lang=${key} ?selected=${key === language}>${name}</option>`,
          )}
        </select>
        <label for="theme">${t('theme.title')}</label>
        <select
          id="theme"
          @change=${(event: Event) => {
            this.studio.setTheme((event.currentTarget as HTMLSelectElement).value as Theme);
          }}
        >
          ${themes.map((key) => html`<option value=${key} ?selected=${key === theme}>${t(`theme.${key}`)}</option>`)}
        </select>
      </div>
      <hr />
      ${
        host === ''
          ? html`<p class="note field">${t('app.local')}</p>`
          : html`<p class="note field">${t('app.host', { host })}</p>
              ${this.#item('open', t('app.open'), '', () => {
                void this.studio.attempt(async () => {
                  const { url } = await this.studio.services.link(this.state.plate);
                  open(url, '_blank', 'noopener');
                });
              })}`
      }
    </div>`;
  }
}
