// The plate and all that lies around it on the bench.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import type { ColourBy, ViewName } from '../model/view.js';
import './canvas.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import './light-control.js';
import '../controls/notices.js';
import { offers } from '../studio/shown.js';
import './status-bar.js';
import './tool-palette.js';

const views: readonly ViewName[] = ['directions', 'toolpath', 'appearance', 'quality'];
const colours: readonly ColourBy[] = ['direction', 'width', 'speed', 'order', 'delay'];

/** Parts that the first view does not need at once. */
const loadBars = (): Promise<unknown> =>
  Promise.all([import('./looks-bar.js'), import('../quality/legend.js'), import('./player.js')]);

@customElement('sillon-stage')
export class StageElement extends StudioElement {
  static override reads = [
    'view',
    'colourBy',
    'compare',
    'recording',
    'result',
    'mode',
    'controls',
    'plate',
    'welcome',
  ] as const;

  static override styles = [
    ...StudioElement.styles,
    css`
      /* Words have a row of their own, so that they never lie over a button; the plate goes on behind them, and stays. On a
         wide bench there is room for them at its right, and nothing has to move. */
      :host {
        display: grid;
        grid-template: minmax(0, 1fr) minmax(0, auto) auto / minmax(0, 1fr);
        container-type: size;
        min-width: 0;
        min-height: 0;
      }
      sillon-canvas {
        grid-area: 1 / 1 / 3 / 2;
      }
      .bench {
        grid-area: 1 / 1;
        position: relative;
        container-type: size;
        pointer-events: none;
      }
      .bench > :not(.bottom, .captions) {
        pointer-events: auto;
      }
      sillon-notices {
        grid-area: 2 / 1;
      }
      @container (width > 640px) and (height >= 400px) {
        .bench,
        sillon-notices {
          grid-area: 1 / 1 / 3 / 2;
        }
        sillon-notices {
          align-self: start;
          max-height: calc(100% - 250px);
          margin: 78px 52px 0 0;
        }
      }
      @container (width >= 1000px) and (height >= 400px) {
        sillon-notices {
          max-height: calc(100% - 180px);
          margin: 70px 0 0;
        }
      }
      sillon-status {
        grid-area: 3 / 1;
      }
      .views,
      .actions,
      .bottom,
      sillon-tools {
        position: absolute;
        z-index: 1;
      }
      .views {
        top: 32px;
        left: 50%;
        transform: translateX(-50%);
        display: flex;
        gap: 2px;
        padding: 3px;
        border: 1px solid var(--line);
        border-radius: var(--radius-large);
        background: var(--surface);
        box-shadow: var(--lift);
      }
      .views button {
        min-height: calc(var(--control) - 2px);
        padding: 0 14px;
        border-color: transparent;
        background: none;
        color: var(--soft);
      }
      .views button[aria-selected='true'] {
        background: var(--tint);
        color: var(--accent);
      }
      .actions {
        top: 32px;
        right: 12px;
        display: flex;
        gap: 6px;
      }
      .actions button {
        background: var(--surface);
        box-shadow: var(--lift);
      }
      .actions button[aria-pressed='true'] {
        background: var(--tint);
      }
      sillon-tools {
        top: 32px;
        left: 32px;
      }
      .bottom {
        left: 32px;
        right: 12px;
        bottom: 12px;
        display: flex;
        flex-wrap: wrap;
        align-items: end;
        justify-content: space-between;
        gap: 8px;
      }
      .bottom > * {
        pointer-events: auto;
      }
      sillon-player {
        flex: 1;
        max-width: 460px;
        min-width: 200px;
      }
      .colour {
        display: flex;
        align-items: center;
        gap: 8px;
        padding: 4px 4px 4px 12px;
        border: 1px solid var(--line);
        border-radius: var(--radius-large);
        background: var(--surface);
        box-shadow: var(--lift);
        white-space: nowrap;
      }
      .colour select {
        width: auto;
        border-color: transparent;
        background-color: transparent;
        font-weight: 500;
      }
      .captions span {
        position: absolute;
        top: 76px;
        padding: 2px 8px;
        border-radius: var(--radius);
        background: var(--surface);
        color: var(--soft);
        font-size: var(--note);
        transform: translateX(-50%);
      }
      .captions span:first-child {
        left: 27%;
      }
      .captions span:last-child {
        left: 75%;
      }
      .light {
        margin-left: auto;
      }
      /* Beside the views there is no room for words; what counts is the bench, not the window. */
      @container (width < 1000px) {
        .actions {
          top: 78px;
          flex-direction: column;
        }
        .actions .words {
          position: absolute;
          clip-path: inset(50%);
        }
        .actions button {
          width: calc(var(--control) + 4px);
          min-height: calc(var(--control) + 4px);
          padding: 0;
        }
      }
      @container (width < 420px) {
        .views {
          top: 26px;
          left: 26px;
          right: 6px;
          overflow-x: auto; /* of letters twice as large */
          transform: none;
        }
        .views button {
          flex: auto; /* the longest word has the most room */
          min-width: max-content;
          padding: 0 4px;
          font-size: var(--note);
        }
        /* In a row: a column would lie over the plate. */
        sillon-tools {
          top: 78px;
          left: 26px;
          flex-direction: row;
        }
        /* A first plate is looked at, and needs the room. */
        sillon-tools.welcome {
          display: none;
        }
        .actions {
          top: 78px;
          right: 6px;
        }
        .light {
          flex: auto;
          width: auto;
        }
        .bottom {
          left: 26px;
          right: 6px;
          bottom: 6px;
        }
      }
      @media (pointer: coarse) {
        .views button {
          min-height: var(--control);
        }
        @container (width < 420px) and (height <= 450px) {
          .actions {
            display: none;
          }
        }
        @container (width < 420px) {
          sillon-tools,
          .actions {
            top: 84px;
          }
        }
      }
      /* Beside the tools, where the middle is too near to them. */
      @container (420px <= width <= 640px) {
        .views {
          left: 90px;
          max-width: calc(100% - 96px);
          overflow-x: auto;
          transform: none;
        }
        .views button {
          padding: 0 9px;
        }
      }
      /* A low bench is for the plate. */
      @container (width <= 640px) and (height <= 450px) {
        .colour,
        sillon-legend {
          display: none;
        }
      }
      @container (height <= 340px) {
        sillon-tools,
        .actions,
        .bottom {
          display: none;
        }
      }
      @container (height <= 170px) {
        .views {
          display: none;
        }
      }
    `,
  ];

  override render(): TemplateResult {
    const { view, compare, mode, welcome } = this.state;
    if (mode === 'view') {
      return html`<sillon-canvas .studio=${this.studio}></sillon-canvas>
        <div class="bench">
          <div class="bottom"><sillon-light class="light" .studio=${this.studio}></sillon-light></div>
        </div>
        <sillon-notices .studio=${this.studio}></sillon-notices>`;
    }
    return html`
      <sillon-canvas .studio=${this.studio}></sillon-canvas>
      <div class="bench">
        <div class="views" role="tablist" aria-label=${t('view.title')} @keydown=${this.#onTabKey}>
          ${views.map(
            (name, k) =>
              html`<button
                type="button"
                role="tab"
                id="tab-${name}"
                aria-selected=${String(view === name)}
                aria-keyshortcuts=${k + 1}
                title="${t(`view.${name}.help`)} (${k + 1})"
                tabindex=${view === name ? 0 : -1}
                @click=${() => {
                  this.studio.setView(name);
                }}
              >
                ${t(`view.${name}`)}
              </button>`,
          )}
        </div>
        ${
          offers(this.state, 'layers')
            ? html`<sillon-tools
                class=${welcome ? 'welcome' : ''}
                .studio=${this.studio}
                role="toolbar"
                aria-label=${t('tool.title')}
              ></sillon-tools>`
            : nothing
        }
        ${view === 'appearance' ? this.#looks() : nothing}
        <div class="bottom">
          ${view === 'toolpath' ? this.#colourBy() : nothing} ${this.lazy(loadBars) ? this.#bars(view) : nothing}
          ${view === 'appearance' ? html`<sillon-light class="light" .studio=${this.studio}></sillon-light>` : nothing}
        </div>
        ${
          view === 'appearance' && compare
            ? html`<div class="captions"><span>${t('view.yours')}</span><span>${t('view.zigzag')}</span></div>`
            : nothing
        }
      </div>
      <sillon-notices .studio=${this.studio}></sillon-notices>
      <sillon-status .studio=${this.studio}></sillon-status>
    `;
  }

  #bars(view: ViewName): TemplateResult {
    if (view === 'appearance') return html`<sillon-looks .studio=${this.studio}></sillon-looks>`;
    return view === 'toolpath'
      ? html`<sillon-player .studio=${this.studio}></sillon-player>`
      : html`<sillon-legend .studio=${this.studio}></sillon-legend>`;
  }

  #onTabKey = (event: KeyboardEvent): void => {
    const by = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (by === 0) return;
    event.preventDefault();
    const next = views[(views.indexOf(this.state.view) + by + views.length) % views.length] as ViewName;
    this.studio.setView(next);
    void this.updateComplete.then(() => this.renderRoot.querySelector<HTMLElement>(`#tab-${next}`)?.focus());
  };

  #looks(): TemplateResult {
    const { compare } = this.state;
    return html`<div class="actions">
      <button
        type="button"
        aria-pressed=${String(compare)}
        title="${t('view.compare.help')} (C)"
        @click=${() => {
          this.studio.store.set({ compare: !compare, over: undefined });
        }}
      >
        ${icon('compare')} <span class="words">${t('view.zigzag')}</span>
      </button>
      ${offers(this.state, 'download') ? this.#captures() : nothing}
    </div>`;
  }

  #captures(): TemplateResult {
    const { recording } = this.state;
    return html`<button
        type="button"
        class="square"
        aria-label=${t('capture.picture')}
        title=${t('capture.picture')}
        @click=${() => {
          void this.studio.save('png');
        }}
      >
        ${icon('camera')}
      </button>
      <button
        type="button"
        class="square"
        aria-pressed=${String(recording)}
        aria-label=${t(recording ? 'capture.recording' : 'capture.video')}
        title=${t(recording ? 'capture.recording' : 'capture.video')}
        ?disabled=${recording}
        @click=${() => {
          void this.studio.saveVideo();
        }}
      >
        ${icon('video')}
      </button> `;
  }

  #colourBy(): TemplateResult {
    const { colourBy } = this.state;
    return html`<div class="colour">
      <label for="colour" class="note">${t('colour.title')}</label>
      <select
        id="colour"
        .value=${colourBy}
        @change=${(event: Event) => {
          this.studio.store.set({ colourBy: (event.currentTarget as HTMLSelectElement).value as ColourBy });
        }}
      >
        ${colours.map((name) => html`<option value=${name} ?selected=${name === colourBy}>${t(`colour.${name}`)}</option>`)}
      </select>
      ${this.lazy(loadBars) ? html`<sillon-legend class="within" .studio=${this.studio}></sillon-legend>` : nothing}
    </div>`;
  }
}
