// The page: header, sections of settings, plate. In narrow windows,
// the sections are a sheet over the lower half of the plate.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { isBare } from '../model/fills.js';
import { sections, type Section } from '../model/guest.js';
import '../print/brought-bar.js';
import { StudioElement } from '../controls/element.js';
import './header.js';
import { icon, type IconName } from '../controls/icons.js';
import type { Handed, PointerPlace } from './take-in.js';
import { composes, offers, ownControls, type Dialog } from '../studio/shown.js';
import { onShortcut, typesText } from './shortcuts.js';
import '../stage/stage.js';
import { button } from '../controls/button.js';

type Tab = [name: Section | 'own', image: IconName, label: string];

declare global {
  interface HTMLElementTagNameMap {
    'sillon-app': App;
  }
}

/** The element of a part, and the function that loads it; rare parts are loaded on first use. */
type Part = [tag: string, load?: () => Promise<unknown>];

const loadPrinterSheet = (): Promise<unknown> => import('./printer-sheet.js');

const dialogs: Record<Dialog, Part> = {
  gallery: ['sillon-gallery', () => import('../plates/gallery.js')],
  palette: ['sillon-palette', () => import('./palette.js')],
  plates: ['sillon-plates', () => import('../plates/plates-dialog.js')],
  help: ['sillon-help', () => import('../controls/help.js')],
  files: ['sillon-files', () => import('../plates/files-dialog.js')],
  share: ['sillon-share', () => import('../plates/share-dialog.js')],
  brought: ['sillon-blocks', () => import('../print/blocks-dialog.js')],
  blocks: ['sillon-blocks', () => import('../print/blocks-dialog.js')],
  rebrush: ['sillon-rebrush', () => import('../rebrush/view.js')],
  zones: ['sillon-zones', () => import('../zones/zones-dialog.js')],
  calibrate: ['sillon-calibrate', () => import('../calibrate/dialog.js')],
  spools: ['sillon-calibrate', () => import('../calibrate/dialog.js')],
  first: ['sillon-first', () => import('./first-print.js')],
  printer: ['sillon-printer-sheet', loadPrinterSheet],
  firstFile: ['sillon-printer-sheet', loadPrinterSheet],
  card: ['sillon-lamp-card', () => import('./lamp-card.js')],
};

const loadFacts = (): Promise<unknown> => import('./plate-facts.js');
const loadTargets = (): Promise<unknown> => import('./drop-targets.js');

const panels: Record<string, Part> = {
  own: ['sillon-own-panel', () => import('./own-panel.js')],
  shape: ['sillon-shape-panel', () => import('../shape/shape-panel.js')],
  layers: ['sillon-layers-panel', () => import('../layers/layers-panel.js')],
  print: ['sillon-print-panel', () => import('../print/print-panel.js')],
  quality: ['sillon-quality-panel', () => import('../quality/quality-panel.js')],
};

const addresses = 'text/uri-list';
const plainText = 'text/plain';

const isSvgText = (text: string): boolean => /^\s*(<\?xml[^>]*>\s*)?(<!--.*?-->\s*)*<svg[\s>]/s.test(text);

/** Chromium's API for file handles of dropped files. */
interface Handing {
  getAsFileSystemHandle?(): Promise<FileSystemHandle | null>;
}

@customElement('sillon-app')
export class App extends StudioElement {
  static override reads = ['plate', 'panel', 'dialog', 'dropping', 'mode', 'controls'] as const;

  static override styles = css`
    :host {
      display: grid;
      grid-template: auto auto minmax(0, 1fr) / minmax(0, 1fr);
      height: 100%;
    }
    .skip {
      position: fixed;
      top: 8px;
      left: 8px;
      z-index: 5;
    }
    .skip:not(:focus) {
      top: -80px;
    }
    .work {
      grid-row: 3;
      position: relative;
      display: grid;
      grid-template-columns: 5rem auto minmax(0, 1fr);
      min-height: 0;
    }
    nav {
      display: flex;
      flex-direction: column;
      gap: 4px;
      padding: 10px 6px;
      border-right: 1px solid var(--line);
      background: var(--surface);
    }
    nav button {
      position: relative;
      flex-direction: column;
      gap: 4px;
      min-height: 60px;
      padding: 6px 2px;
      border-color: transparent;
      background: none;
      color: var(--soft);
      font-size: var(--small);
    }
    nav button[aria-expanded='true'] {
      background: var(--tint);
      color: var(--accent);
    }
    .panel {
      width: min(20.75rem, 40vw);
      border-right: 1px solid var(--line);
      background: var(--surface);
      overflow: auto;
      overscroll-behavior: contain;
      scrollbar-width: thin;
      scrollbar-color: var(--line) transparent;
    }
    sillon-stage {
      grid-column: 3; /* where it is without the panel, too */
    }
    .only {
      grid-area: 1 / 1 / -1 / 2;
    }
    .grip {
      display: none;
    }
    @media (max-width: 980px) {
      .panel {
        width: clamp(300px, 40vw, 18.75rem);
      }
    }
    /* A low window keeps the sections at its side; where it is narrow, too, an open one leaves the bench what is left. */
    @media (max-height: 479px) {
      .work {
        grid-template-columns: 3.5rem auto minmax(0, 1fr);
      }
      nav {
        gap: 0;
        padding: 4px 2px;
        overflow-y: auto;
      }
      nav button {
        min-height: max(44px, var(--control));
        padding: 2px;
      }
    }
    @media (max-width: 720px) and (max-height: 479px) {
      .panel {
        width: min(20rem, 100vw - 3.5rem);
      }
    }
    @media (max-width: 720px) and (min-height: 480px) {
      .work {
        grid-template: minmax(0, 1fr) auto auto / minmax(0, 1fr);
      }
      sillon-stage {
        grid-area: 1 / 1;
      }
      .panel {
        grid-row: 2;
        width: auto;
        height: min(46dvh, 420px, 100dvh - 228px); /* the rest: head, sections, status, and a word */
        border-right: 0;
        border-top: 1px solid var(--line);
        border-radius: 14px 14px 0 0;
        position: relative;
        z-index: 2;
        box-shadow: 0 -6px 20px var(--shade);
      }
      .grip {
        position: sticky;
        top: 0;
        z-index: 3;
        display: flex;
        justify-content: center;
        width: 100%;
        min-height: 24px;
        border: 0;
        border-radius: 14px 14px 0 0;
        background: var(--surface);
      }
      .grip::before {
        content: '';
        width: 40px;
        height: 4px;
        border-radius: 2px;
        background: var(--edge);
      }
      nav {
        grid-row: 3;
        /* Alike, but none narrower than its word: some fonts are wide, and some people need large ones. */
        display: grid;
        grid-auto-columns: minmax(max-content, 1fr);
        grid-auto-flow: column;
        overflow-x: auto;
        gap: 0;
        padding: 4px 4px calc(4px + env(safe-area-inset-bottom));
        border-right: 0;
        border-top: 1px solid var(--line);
        z-index: 2;
      }
      nav button {
        min-height: 52px;
      }
    }
    /* On paper, controls are of no use: there is the lamp card, or else the plate. */
    @media print {
      sillon-header,
      sillon-brought,
      nav,
      .panel,
      .work:has(~ sillon-lamp-card) {
        display: none;
      }
    }
  `;

  override render(): TemplateResult {
    const { panel, dialog, dropping, mode, plate } = this.state;
    if (mode === 'view') {
      this.#shown = {};
      return html`<sillon-stage class="only" role="main" .studio=${this.studio}></sillon-stage>`;
    }
    return html`
      ${button('skip', t('app.skip'), this.#skip)}
      <sillon-header role="banner" .studio=${this.studio}></sillon-header>
      <sillon-brought .studio=${this.studio}></sillon-brought>
      <div class="work">
        <nav aria-label=${t('app.settings')}>
          ${this.#sections().map(
            ([name, image, label]) =>
              html`<button
                aria-expanded=${String(panel === name)}
                aria-controls="panel"
                @click=${() => this.studio.setPanel(panel === name ? '' : name)}
              >
                ${icon(image, 22)} <span>${label}</span>
              </button>`,
          )}
        </nav>
        <aside
          class="panel"
          id="panel"
          aria-label=${panel === '' ? nothing : t(`section.${panel as Tab[0]}`)}
          ?hidden=${panel === ''}
          tabindex="-1"
        >
          ${button({ look: 'grip', label: t('verb.close') }, html``, () => this.studio.setPanel(''))}
          ${this.#part('panel', panels[panel])}
          ${
            panel === 'layers' && mode === 'edit' && isBare(plate) && this.lazy(loadFacts)
              ? html`<sillon-plate-facts .studio=${this.studio}></sillon-plate-facts>`
              : nothing
          }
        </aside>
        <sillon-stage role="main" .studio=${this.studio}></sillon-stage>
      </div>
      ${this.#part('dialog', dialog && dialogs[dialog], dialog)}
      ${dropping && this.lazy(loadTargets) ? html`<sillon-drop .studio=${this.studio}></sillon-drop>` : nothing}
    `;
  }

  #sections(): Tab[] {
    // Section 'quality' has no tab: its findings are in the view of that name.
    const offered = sections
      .filter((name) => name !== 'quality' && offers(this.state, name))
      .map((name): Tab => [name, name, t(`section.${name}`)]);
    return ownControls(this.state).length > 0 ? [['own', 'shuffle', t('section.own')], ...offered] : offered;
  }

  /** Elements of the shown parts; an element is reused as long as its part is shown. */
  #shown: { panel?: HTMLElement | undefined; dialog?: HTMLElement | undefined } = {};

  /** Returns the element of a part, once it is loaded.
   * @param purpose  one of the purposes of a dialog that has several */
  #part(place: 'panel' | 'dialog', part: Part | undefined, purpose = ''): HTMLElement | typeof nothing {
    const [tag, load] = part ?? [];
    if (tag === undefined || (load !== undefined && !this.lazy(load))) {
      this.#shown = { ...this.#shown, [place]: undefined };
      return nothing;
    }
    const shown = this.#shown[place];
    const element = shown?.localName === tag ? shown : document.createElement(tag);
    return (this.#shown[place] = Object.assign(element, { studio: this.studio, purpose }));
  }

  #skip = (): void => {
    this.studio.stage?.focus();
  };

  // --- Files and keys ---------------------------------------------------------------------------------------------------

  #leaving: ReturnType<typeof setTimeout> | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    this.listen('dragover', this.#onDragOver);
    this.listen('drop', this.#onDrop);
    this.listen('paste', this.#onPaste);
    this.listen('pointermove', this.#onPointer);
    this.listen('keydown', this.#onKey);
  }

  /** Last place of the pointer: content that is pasted may be meant for it. */
  #pointer: PointerPlace | undefined;

  #onPointer = ({ clientX, clientY }: PointerEvent): void => {
    this.#pointer = { clientX, clientY };
  };

  /** Tells whether a drag brings content that the page takes. */
  #brings(event: DragEvent, ...kinds: string[]): boolean {
    const { types } = event.dataTransfer ?? {};
    return types?.includes('Files') === true || (!typesText(event) && kinds.some((kind) => types?.includes(kind)));
  }

  #texts = (): string[] => (offers(this.state, 'layers') ? [plainText] : []);

  #onDragOver = (event: DragEvent): void => {
    if (!this.#brings(event, addresses, ...this.#texts())) return;
    event.preventDefault(); // otherwise the browser would leave the page and open the file
    if (!this.#brings(event, ...this.#texts()) || !this.#takesFiles()) return;
    // Enter and leave events come for every element; if no dragover comes for a moment, the files are gone.
    clearTimeout(this.#leaving);
    this.#leaving = setTimeout(() => this.studio.store.set({ dropping: false }), 300);
    if (!this.state.dropping) this.studio.store.set({ dropping: true });
  };

  #onDrop = (event: DragEvent): void => {
    const { dataTransfer } = event;
    if (dataTransfer === null || !this.#brings(event, addresses, ...this.#texts())) return;
    event.preventDefault();
    const onShape = this.renderRoot.querySelector('sillon-drop')?.isShape(event) ?? false;
    this.studio.store.set({ dropping: false });
    if (!this.#takesFiles()) return;
    // The browser may lend a handle to save a project back in place; it must be requested during the event.
    const { files, items } = dataTransfer;
    const [item] = items as unknown as Iterable<Handing>;
    const handle = files.length === 1 ? item?.getAsFileSystemHandle?.().catch(() => null) : undefined;
    this.#take(dataTransfer, dataTransfer.getData(addresses), { at: event, onShape, handle });
  };

  #take(transfer: DataTransfer, address: string, how: Pick<Handed, 'at'> & Partial<Handed>): void {
    const handed = { files: [...transfer.files], text: transfer.getData(plainText), address, ...how };
    void this.studio.attempt(async () => {
      await (await import('./take-in.js')).takeIn(this.studio, handed);
    });
  }

  #takesFiles = (): boolean => !this.hidden && (offers(this.state, 'shape') || offers(this.state, 'layers'));

  #onPaste = (event: ClipboardEvent): void => {
    const { clipboardData } = event;
    if (clipboardData === null || !this.#takesFiles()) return;
    const means = clipboardData.files.length > 0 || isSvgText(clipboardData.getData(plainText));
    if (!means && typesText(event)) return;
    if (means || composes(this.state)) event.preventDefault();
    this.#take(clipboardData, '', { at: this.#pointer });
  };

  #onKey = (event: KeyboardEvent): void => {
    if (!this.hidden && onShortcut(this.studio, event)) event.preventDefault();
  };
}
