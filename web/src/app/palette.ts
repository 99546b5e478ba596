// Every action of the page by its name, with its key.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, query, state } from 'lit/decorators.js';
import { languages } from '../i18n/languages.js';
import { words } from '../i18n/en/help.js';
import { say, t } from '../i18n/text.js';
import { sections } from '../model/guest.js';
import { shownPictures } from '../model/lamp.js';
import { DialogElement } from '../controls/dialog.js';
import { icon, type IconName } from '../controls/icons.js';
import { keysText } from '../controls/shortcut-list.js';
import type { Product, Studio } from '../studio/studio.js';

interface Action {
  /** Where it belongs; empty: nowhere. */
  group: string;
  label: string;
  icon: IconName;
  keys?: string;
  disabled?: boolean;
  run: () => void;
}

const views = ['directions', 'toolpath', 'appearance', 'quality'] as const;
const tools = [
  ['pan', 'hand', 'V'],
  ['comb', 'comb', 'B'],
  ['mode', 'mode', 'M'],
  ['erase', 'erase', 'E'],
] as const;
const products: readonly (readonly [Product, IconName, string?])[] = [
  ['gcode', 'print', 'Ctrl Shift S'],
  ['body', 'body'],
  ['zones', 'body'],
  ['svg', 'toolpath'],
  ['png', 'camera'],
  ['view', 'sun'],
  ['project', 'file', 'Ctrl S'],
];

function actionsOf(studio: Studio): Action[] {
  const { store } = studio;
  const { plate, compare } = store.state;
  const lamps = shownPictures(plate).length > 0;
  return [
    {
      group: '',
      label: t('verb.open'),
      icon: 'open',
      keys: 'Ctrl O',
      run: () => void studio.pick().then((files) => studio.open(files)),
    },
    {
      group: '',
      label: t('verb.new'),
      icon: 'plus',
      run: () => {
        studio.services.newPlate();
      },
    },
    {
      group: '',
      label: t('verb.plates'),
      icon: 'gallery',
      run: () => {
        studio.show('plates');
      },
    },
    {
      group: '',
      label: t('section.gallery'),
      icon: 'gallery',
      run: () => {
        studio.show('gallery');
      },
    },
    {
      group: '',
      label: t('verb.undo'),
      icon: 'undo',
      keys: 'Ctrl Z',
      disabled: !store.canUndo,
      run: () => {
        store.undo();
      },
    },
    {
      group: '',
      label: t('verb.redo'),
      icon: 'redo',
      keys: 'Ctrl Shift Z',
      disabled: !store.canRedo,
      run: () => {
        store.redo();
      },
    },
    {
      group: '',
      label: t('verb.share'),
      icon: 'share',
      run: () => {
        studio.show('share');
      },
    },
    ...(['first', 'calibrate'] as const).map((dialog) => ({
      group: '',
      label: t(`verb.${dialog}`),
      icon: dialog === 'first' ? ('print' as const) : ('tune' as const),
      run: () => {
        studio.show(dialog);
      },
    })),
    {
      group: '',
      label: t('help.title'),
      icon: 'help',
      keys: '?',
      run: () => {
        studio.show('help');
      },
    },
    ...products.map(([product, name, keys = '']) => ({
      group: t('verb.download'),
      label: t(`export.${product}`),
      icon: name,
      keys,
      disabled: product === 'body' && plate.print.base === 0,
      run: () => void studio.save(product),
    })),
    ...views.map((view, k) => ({
      group: t('view.title'),
      label: t(`view.${view}`),
      icon: 'light' as const,
      keys: String(k + 1),
      run: () => {
        studio.setView(view);
      },
    })),
    ...sections.map((section) => ({
      group: t('app.settings'),
      label: t(`section.${section}`),
      icon: section,
      run: () => {
        studio.setPanel(section);
      },
    })),
    ...tools.map(([tool, name, keys]) => ({
      group: t('tool.title'),
      label: t(`tool.${tool}`),
      icon: name,
      keys,
      disabled: lamps,
      run: () => {
        studio.setTool(tool);
      },
    })),
    { group: '', label: t('verb.fit'), icon: 'fit', keys: '0', run: () => studio.stage?.fit() },
    { group: '', label: t('verb.zoomIn'), icon: 'plus', keys: '+', run: () => studio.stage?.zoom(1.4) },
    { group: '', label: t('verb.zoomOut'), icon: 'minus', keys: '-', run: () => studio.stage?.zoom(1 / 1.4) },
    {
      group: '',
      label: say(words, 'keys.compare'),
      icon: 'compare',
      keys: 'C',
      run: () => {
        store.set({ compare: !compare, view: 'appearance' });
      },
    },
    {
      group: '',
      label: say(words, 'keys.play'),
      icon: 'play',
      keys: 'P',
      run: () => {
        studio.togglePlay();
      },
    },
    ...(['pointer', 'orbit', 'fixed'] as const).map((mode) => ({
      group: t('light.title'),
      label: t(`light.${mode}`),
      icon: 'sun' as const,
      run: () => void studio.setLightMode(mode),
    })),
    ...(['auto', 'light', 'dark'] as const).map((theme) => ({
      group: t('theme.title'),
      label: t(`theme.${theme}`),
      icon: 'half' as const,
      run: () => {
        studio.setTheme(theme);
      },
    })),
    ...Object.entries(languages).map(([key, { name }]) => ({
      group: t('language.title'),
      label: name,
      icon: 'share' as const,
      run: () => void studio.setLanguage(key),
    })),
  ];
}

/** Without accents and capitals. */
const folded = (text: string): string => text.normalize('NFD').replace(/\p{M}/gu, '').toLowerCase();

@customElement('sillon-palette')
export class Palette extends DialogElement {
  static override styles = [
    ...DialogElement.styles,
    css`
      dialog {
        width: min(560px, calc(100vw - 24px));
        margin-top: min(12dvh, 96px);
      }
      .body {
        display: grid;
        grid-template-rows: auto minmax(0, 1fr);
        gap: 8px;
      }
      [role='listbox'] {
        display: grid;
        max-height: min(56dvh, 460px);
        overflow: auto;
        scrollbar-width: thin;
      }
      [role='option'] {
        display: flex;
        align-items: center;
        gap: 12px;
        min-height: max(36px, var(--control));
        padding: 2px 10px;
        border-radius: var(--radius);
        cursor: pointer;
      }
      [role='option'][aria-selected='true'] {
        background: var(--tint);
        color: var(--accent);
      }
      [role='option'][aria-disabled='true'] {
        opacity: 0.5;
      }
      .label {
        flex: 1;
        min-width: 0;
      }
      .group {
        color: var(--soft);
      }
      kbd {
        padding: 1px 6px;
        border: 1px solid var(--line);
        border-bottom-width: 2px;
        border-radius: var(--radius);
        background: var(--raised);
        color: var(--soft);
        font: inherit;
        font-size: var(--note);
        white-space: nowrap;
      }
    `,
  ];

  @state() private words = '';
  @state() private chosen = 0;
  @query('input') private input!: HTMLInputElement;
  readonly #actions: Action[] = [];

  protected override heading = (): string => say(words, 'palette.title');

  override connectedCallback(): void {
    super.connectedCallback();
    this.#actions.push(...actionsOf(this.studio));
  }

  override firstUpdated(): void {
    super.firstUpdated();
    this.input.focus();
  }

  #found(): Action[] {
    const words = folded(this.words).split(/\s+/);
    return this.#actions.filter(({ group, label }) => {
      const text = folded(`${group} ${label}`);
      return words.every((word) => text.includes(word));
    });
  }

  protected override body(): TemplateResult {
    const found = this.#found();
    return html`
      <input
        type="text"
        class="wide"
        role="combobox"
        aria-expanded="true"
        aria-controls="found"
        aria-activedescendant=${found.length > 0 ? `action-${this.chosen}` : nothing}
        aria-label=${say(words, 'palette.title')}
        placeholder=${say(words, 'palette.what')}
        spellcheck="false"
        .value=${this.words}
        @input=${() => {
          this.words = this.input.value;
          this.chosen = 0;
        }}
        @keydown=${(event: KeyboardEvent) => {
          this.#onKey(event, found);
        }}
      />
      <div role="listbox" id="found" aria-label=${say(words, 'palette.title')}>
        ${found.map(
          (action, k) =>
            html`<div
              role="option"
              id="action-${k}"
              aria-selected=${String(k === this.chosen)}
              aria-disabled=${String(action.disabled === true)}
              @click=${() => {
                this.#run(action);
              }}
            >
              ${icon(action.icon, 16)}
              <span class="label"
                >${action.group === '' ? nothing : html`<span class="group">${action.group}: </span>`}${action.label}</span
              >
              ${action.keys === undefined || action.keys === '' ? nothing : html`<kbd>${keysText(action.keys)}</kbd>`}
            </div>`,
        )}
      </div>
      ${found.length === 0 ? html`<p class="note" role="status">${say(words, 'palette.none')}</p>` : nothing}
    `;
  }

  #onKey(event: KeyboardEvent, found: readonly Action[]): void {
    const by = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
    const action = found[this.chosen];
    if (by !== 0 && found.length > 0) {
      this.chosen = (this.chosen + by + found.length) % found.length;
      void this.updateComplete.then(() =>
        this.renderRoot.querySelector(`#action-${this.chosen}`)?.scrollIntoView({ block: 'nearest' }),
      );
    } else if (event.key === 'Enter' && action !== undefined) this.#run(action);
    else return;
    event.preventDefault();
  }

  #run(action: Action): void {
    if (action.disabled === true) return;
    this.close(action.run);
  }
}
