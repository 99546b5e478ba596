// The page's head: what the plate is called, back and forth, out of the door.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import type { Plate } from '../model/plate.js';
import { StudioElement } from '../controls/element.js';
import { typing } from '../controls/fields.js';
import { icon, mark, type IconName } from '../controls/icons.js';
import { offers } from '../studio/shown.js';

const loadDownloads = (): Promise<unknown> => import('../print/downloads.js');
const loadMenu = (): Promise<unknown> => import('./menu.js');

@customElement('sillon-header')
export class Header extends StudioElement {
  static override reads = ['plate', 'mode', 'controls'] as const;

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
        field-sizing: content;
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
      @supports (field-sizing: content) {
        input.name {
          width: auto;
          max-width: 40ch;
        }
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
        min-height: max(34px, var(--control));
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
      @media (max-width: 980px) {
        .wide {
          display: none !important;
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
        h1 .word {
          position: absolute;
          clip-path: inset(50%); /* still heard: a heading needs its word */
        }
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
      title=${plate.name}
      placeholder=${t('app.untitled')}
      maxlength="80"
      spellcheck="false"
      .value=${plate.name}
      @input=${({ currentTarget }: Event) => {
        const input = currentTarget as HTMLInputElement;
        typing.add(input);
        this.#rename(input.value); // what is saved meanwhile has it already
      }}
      @change=${({ currentTarget }: Event) => {
        const input = currentTarget as HTMLInputElement;
        typing.delete(input);
        this.#rename(input.value.trim());
        this.studio.settle();
      }}
      @keydown=${({ key, currentTarget }: KeyboardEvent) => {
        if (key !== 'Escape') return;
        const input = currentTarget as HTMLInputElement;
        typing.delete(input);
        this.studio.store.abandon();
        input.value = this.state.plate.name;
      }}
    />`;
  }

  #rename(name: string): void {
    this.studio.store.change((now) => (now.name === name ? now : { ...now, name }), 'name');
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

  /** Gives the focus back to the button that opened it: browsers lose it, and what is opened next comes back to it. */
  #onToggle = ({ currentTarget, newState }: ToggleEvent): void => {
    const popover = currentTarget as HTMLElement;
    if (newState === 'closed' && popover.matches(':focus-within'))
      this.renderRoot.querySelector<HTMLElement>(`[popovertarget=${popover.id}]`)?.focus();
  };

  /** Its contents are loaded when it is first opened. */
  #exports(): TemplateResult {
    return html`<div
      id="export"
      popover
      role="group"
      aria-label=${t('section.export')}
      @beforetoggle=${(event: ToggleEvent) => {
        this.#onToggle(event);
        this.#opened = true;
        this.requestUpdate();
      }}
    >
      ${
        this.#opened && this.lazy(loadDownloads)
          ? html`<sillon-downloads
              .studio=${this.studio}
              @done=${() => {
                this.#hide();
              }}
            ></sillon-downloads>`
          : nothing
      }
    </div>`;
  }

  #opened = false;
  #menuOpened = false;

  /** Its content comes when it is first opened. */
  #menu(): TemplateResult {
    return html`<div
      id="menu"
      popover
      role="group"
      aria-label=${t('app.menu')}
      @beforetoggle=${(event: ToggleEvent) => {
        this.#onToggle(event);
        this.#menuOpened = true;
        this.requestUpdate();
      }}
    >
      ${
        this.#menuOpened && this.lazy(loadMenu)
          ? html`<sillon-menu
              .studio=${this.studio}
              @done=${() => {
                this.#hide();
              }}
            ></sillon-menu>`
          : nothing
      }
    </div>`;
  }
}
