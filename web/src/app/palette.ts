// The palette: all actions of the page by name, with their keys.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, query, state } from 'lit/decorators.js';
import { words } from '../i18n/en/help.js';
import { say } from '../i18n/text.js';
import { DialogElement } from '../controls/dialog.js';
import { icon } from '../controls/icons.js';
import { keysText } from '../controls/shortcut-list.js';
import { actionsOf, type Action } from './actions.js';

/** Normalises a text for the search: no accents, capitals or hyphens. */
const folded = (text: string): string =>
  text
    .normalize('NFD')
    .replace(/[\p{M}-]/gu, '')
    .toLowerCase();

@customElement('sillon-palette')
export class Palette extends DialogElement {
  static override styles = css`
    dialog {
      width: min(560px, calc(100vw - 24px));
      margin-top: min(12dvh, 96px);
    }
    .body {
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
  `;

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

  /** Returns the actions that match all typed words. */
  #found(): Action[] {
    const words = folded(this.words).split(/\s+/);
    const asked = words.some((word) => word !== '');
    const found = this.#actions.filter(({ group, label, also = '', rare = false }) => {
      const text = folded(`${group} ${label} ${also}`);
      return (asked || !rare) && words.every((word) => text.includes(word));
    });
    // Matches of the name come before matches of a synonym.
    const named = ({ group, label }: Action): boolean =>
      words.every((word) => folded(`${group} ${label}`).includes(word));
    return [...found.filter(named), ...found.filter((action) => !named(action))];
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
        @keydown=${(event: KeyboardEvent) => this.#onKey(event, found)}
      />
      <div role="listbox" id="found" aria-label=${say(words, 'palette.title')}>
        ${found.map(
          (action, k) =>
            html`<div
              role="option"
              id="action-${k}"
              aria-selected=${String(k === this.chosen)}
              aria-disabled=${String(action.disabled === true)}
              @click=${() => this.#run(action)}
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
