// The header of the page: name of the plate, undo and redo, gallery and downloads.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { machineName } from '../i18n/say.js';
import { t } from '../i18n/text.js';
import type { Plate } from '../model/plate.js';
import { StudioElement } from '../controls/element.js';
import { typing } from '../controls/fields.js';
import { icon, mark, type IconName } from '../controls/icons.js';
import { offers } from '../studio/shown.js';
import { button } from '../controls/button.js';

const loadDownloads = (): Promise<unknown> => import('../print/downloads.js');
const loadMenu = (): Promise<unknown> => import('./menu.js');

type Popover = 'menu' | 'export';

@customElement('sillon-header')
export class Header extends StudioElement {
  static override reads = ['plate', 'mode', 'controls'] as const;

  static override styles = css`
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
    .files {
      display: flex;
      flex: none;
      gap: 1px;
      margin-left: 4px;
    }
    .main {
      padding: 0 14px;
      min-height: max(34px, var(--control));
      border-radius: var(--radius) 0 0 var(--radius);
    }
    .main .long {
      max-width: 15rem;
    }
    .main .short {
      display: none;
    }
    .main.all {
      min-width: calc(var(--control) - 4px);
      padding: 0 7px;
      border-radius: 0 var(--radius) var(--radius) 0;
    }
    @media (pointer: coarse) {
      .main.all {
        min-width: var(--control);
      }
    }
    [popover] {
      position: fixed;
      inset: calc(var(--bar) + 2px) 10px auto auto;
      width: 292px;
      max-height: calc(100dvh - var(--bar) - 20px);
      margin: 0;
      padding: 6px;
      color: var(--ink);
      overflow: auto;
    }
    #menu {
      inset-inline: 10px auto;
    }
    @media (max-width: 1120px) {
      .main .long {
        max-width: 9rem;
      }
    }
    @media (max-width: 980px) {
      .examples {
        width: var(--control);
        padding: 0;
      }
      .examples .words {
        position: absolute;
        clip-path: inset(50%);
        width: 1px; /* else words would reach out of the page */
        overflow: hidden;
      }
    }
    @media (max-width: 820px) {
      .main .long {
        display: none;
      }
      .main .short {
        display: inline;
      }
    }
    @media (max-width: 400px) {
      .main:not(.all) {
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
    @media (max-height: 479px) {
      button {
        min-height: calc(var(--bar) - 6px) !important;
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
        padding: 0 10px;
      }
      .main.all {
        padding: 0 4px;
      }
    }
  `;

  override render(): TemplateResult {
    const { plate, mode } = this.state;
    const edits = mode === 'edit';
    return html`
      ${edits ? this.#menu() : nothing}
      <h1>${mark()}<span class="word">Sillon</span></h1>
      ${edits ? this.#name(plate) : nothing} ${this.#steps()}
      <span class="space"></span>
      ${
        edits
          ? button(
              { look: 'plain examples', title: t('section.gallery') },
              html`${icon('gallery')} <span class="words">${t('section.gallery')}</span>`,
              this.studio.opens('gallery'),
            )
          : nothing
      }
      ${offers(this.state, 'download') ? this.#download(plate) : nothing}
    `;
  }

  /** Returns the buttons of undo and redo, which appear with the first change. */
  #steps(): TemplateResult | typeof nothing {
    const { store } = this.studio;
    if (!store.canUndo && !store.canRedo) return nothing;
    return html`${this.#button('undo', t('verb.undo'), 'Ctrl+Z', !store.canUndo, () => store.undo())}
    ${this.#button('redo', t('verb.redo'), 'Ctrl+Shift+Z', !store.canRedo, () => store.redo())}`;
  }

  /** Returns the field of the plate's name; Escape restores the name. */
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

  #button(name: IconName, label: string, keys: string, disabled: boolean, run: () => void): TemplateResult {
    const how = { look: 'plain square', label, title: `${label} (${keys})`, keys: keys.replace('Ctrl', 'Control') };
    return button({ ...how, disabled }, icon(name), run);
  }

  #hide = (): void => {
    for (const open of this.renderRoot.querySelectorAll<HTMLElement>('[popover]:popover-open')) open.hidePopover();
  };

  readonly #opened = new Set<Popover>();

  /** Notes a popover that opens. When it closes, the focus returns to the button that opened it: browsers lose it, and
   * later dialogs return it there. */
  #onToggle = ({ currentTarget, newState }: ToggleEvent): void => {
    const popover = currentTarget as HTMLElement;
    if (newState === 'closed' && popover.matches(':focus-within'))
      this.renderRoot.querySelector<HTMLElement>(`[popovertarget=${popover.id}]`)?.focus();
    this.#opened.add(popover.id as Popover);
    this.requestUpdate();
  };

  #opener(popover: Popover, label: string, look: string, name: IconName): TemplateResult {
    return html`<button class=${look} aria-label=${label} title=${label} popovertarget=${popover}>
      ${icon(name)}
    </button>`;
  }

  /** Returns a popover, whose content is loaded when it is first opened. */
  #popover(id: Popover, label: string, load: () => Promise<unknown>, content: TemplateResult): TemplateResult {
    return html`<div id=${id} popover class="raft" role="group" aria-label=${label} @beforetoggle=${this.#onToggle}>
      ${this.#opened.has(id) && this.lazy(load) ? content : nothing}
    </div>`;
  }

  /** Returns a button for G-code and, beside it, one for the list of all files. */
  #download({ printer }: Plate): TemplateResult {
    const name = machineName(printer);
    const label = name === '' ? t('export.gcode') : t('export.gcodeFor', { printer: name });
    return html`<div class="files" role="group" aria-label=${t('section.export')}>
        ${button(
          { look: 'main', name: label },
          html`${icon('download')}<span class="words long cut">${name === '' ? t('export.gcode') : label}</span
            ><span class="words short">${t('export.gcode')}</span>`,
          () => void this.studio.save('gcode'),
        )}
        ${this.#opener('export', t('verb.download'), 'main all', 'fold')}
      </div>
      ${this.#popover(
        'export',
        t('section.export'),
        loadDownloads,
        html`<sillon-downloads .studio=${this.studio} @done=${this.#hide}></sillon-downloads>`,
      )}`;
  }

  #menu(): TemplateResult {
    const menu = html`<sillon-menu .studio=${this.studio} @done=${this.#hide}></sillon-menu>`;
    return html`${this.#opener('menu', t('app.menu'), 'plain square', 'menu')}
    ${this.#popover('menu', t('app.menu'), loadMenu, menu)}`;
  }
}
