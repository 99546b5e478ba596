// The plate and everything around it on the bench.
import { css, html, nothing, type TemplateResult } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import type { ColourBy, ViewName } from '../model/view.js';
import './canvas.js';
import { StudioElement } from '../controls/element.js';
import { icon } from '../controls/icons.js';
import './lamp-handle.js';
import '../controls/notices.js';
import { offers } from '../studio/shown.js';
import { isRuled } from './plate-scene.js';
import './status-bar.js';
import './tool-palette.js';
import { button } from '../controls/button.js';

/** Tabs of the views; the directions belong to the tab of the beads that follow them. */
const tabs = ['appearance', 'toolpath', 'quality'] as const;
const tabOf = (view: ViewName): (typeof tabs)[number] => (view === 'directions' ? 'toolpath' : view);
const colours: readonly ColourBy[] = ['direction', 'width', 'speed', 'order', 'delay', 'lean'];

/** Loads bars that the first view does not need at once. */
const loadBars = (): Promise<unknown> =>
  Promise.all([import('./looks-bar.js'), import('../quality/legend.js'), import('./player.js')]);
const loadOptions = (): Promise<unknown> => import('./view-options.js');

@customElement('sillon-stage')
export class StageElement extends StudioElement {
  static override reads = [
    'view',
    'colourBy',
    'compare',
    'result',
    'mode',
    'controls',
    'plate',
    'marks',
    'tool',
    'panel',
    'notices',
    'problem',
    'welcome',
  ] as const;

  static override styles = css`
    /* Words have a row of their own, so that they never lie over a button; the plate goes on behind them, and stays. On a
         wide bench there is room for them at its right, and nothing has to move. */
    :host {
      display: grid;
      position: relative;
      grid-template: minmax(0, 1fr) minmax(0, auto) auto / minmax(0, 1fr);
      container-type: size;
      min-width: 0;
      min-height: 0;
    }
    sillon-canvas {
      grid-area: 1 / 1 / 3 / 2;
    }
    .bench {
      --edge-left: 12px;
      --edge-top: 12px;
      grid-area: 1 / 1;
      position: relative;
      container-type: size;
      pointer-events: none;
    }
    /* Beside the rulers. */
    .bench.ruled {
      --edge-left: 32px;
      --edge-top: 32px;
    }
    .bench > :not(.bottom, .captions, sillon-lamp) {
      pointer-events: auto;
    }
    /* Between the bars: under one of them a hand could not take the lamp. */
    sillon-lamp {
      position: absolute;
      inset: 56px 0;
    }
    .bench.bare sillon-lamp {
      inset: 0;
    }
    sillon-notices {
      grid-area: 2 / 1;
    }
    sillon-status {
      grid-area: 3 / 1;
    }
    /* Figures stand in the corner of a low window. */
    @media (max-height: 479px) {
      sillon-notices.some {
        margin-bottom: 48px;
      }
    }
    .views,
    .bottom,
    sillon-tools {
      position: absolute;
      z-index: 1;
    }
    .views {
      top: var(--edge-top);
      left: 50%;
      transform: translateX(-50%);
      display: flex;
      gap: 2px;
      padding: 3px;
    }
    .views button {
      min-height: calc(var(--control) - 2px);
      padding: 0 18px;
      border-color: transparent;
      background: none;
      color: var(--soft);
    }
    .views button[aria-selected='true'] {
      background: var(--tint);
      color: var(--accent);
    }
    @media (pointer: coarse) {
      .views button {
        min-height: var(--control);
      }
    }
    sillon-tools {
      top: var(--edge-top);
      left: var(--edge-left);
    }
    .bottom {
      left: var(--edge-left);
      right: 12px;
      bottom: 12px;
      display: flex;
      flex-wrap: wrap;
      align-items: end;
      gap: 8px;
    }
    .bottom > * {
      pointer-events: auto;
    }
    .options {
      width: calc(var(--control) + 4px);
      min-height: calc(var(--control) + 4px);
      margin-left: auto;
      padding: 0;
      background: var(--surface);
      box-shadow: var(--lift);
    }
    #options {
      inset: auto 12px 60px auto;
      width: 264px;
      max-height: calc(100dvh - 80px);
      margin: 0;
      padding: 14px 16px;
      color: var(--ink);
      overflow: auto;
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
      top: 56px;
      transform: translateX(-50%);
    }
    .captions span:first-child {
      left: 27%;
    }
    .captions span:last-child {
      left: 75%;
    }
    @container (width > 640px) and (height >= 480px) {
      .bench,
      sillon-notices {
        grid-area: 1 / 1 / 3 / 2;
      }
      sillon-notices {
        align-self: start;
        max-height: calc(100% - 180px);
        margin: 12px 0 0;
      }
    }
    @container (640px < width < 1000px) and (height >= 480px) {
      sillon-notices {
        margin-top: 78px; /* below the views */
      }
    }
    @container (width < 420px) {
      .bench.ruled {
        --edge-left: 26px;
        --edge-top: 26px;
      }
      .bottom {
        right: 8px;
        bottom: 8px;
      }
    }
    @container (width < 420px) and (height >= 440px) {
      sillon-lamp {
        inset: calc(2 * var(--control) + 44px) 0 64px;
      }
      /* In a row: a column would lie over the plate. */
      sillon-tools {
        top: calc(var(--edge-top) + var(--control) + 18px);
        flex-direction: row;
      }
    }
    /* A low bench is for the plate: beside it stand the views, and the line of figures lies over the bench. */
    @container (height < 440px) {
      .views {
        left: auto;
        right: 8px;
        top: 8px;
        flex-direction: column;
        transform: none;
      }
      .views button {
        padding: 0 8px;
      }
      sillon-tools {
        display: grid;
        grid-template-columns: auto auto;
      }
      .bottom {
        bottom: 8px;
      }
      .colour,
      sillon-legend,
      sillon-player {
        max-width: 132px;
        min-width: 0;
      }
      .colour .note,
      .colour sillon-legend {
        display: none;
      }
      .colour {
        padding: 4px;
      }
      .colour select {
        max-width: 122px;
      }
      .bottom {
        right: 96px; /* below the views stands the button alone */
      }
      .options {
        margin-right: -88px;
      }
      .captions {
        display: none;
      }
      sillon-lamp {
        inset: 0 92px 0 116px;
      }
      /* Above the figures. */
      sillon-looks,
      sillon-player,
      .colour {
        margin-bottom: 44px;
      }
    }
    @container (height < 240px) {
      sillon-looks {
        display: none; /* the lamp turns by hand */
      }
    }
    /* Words or an open section have taken the room, until they go. */
    @container (height < 200px) or (width < 220px) {
      sillon-tools,
      sillon-lamp,
      .bottom {
        display: none;
      }
    }
    @container (height < 150px) or (width < 220px) {
      .views {
        display: none;
      }
    }
  `;

  override render(): TemplateResult {
    const { view, compare, mode, welcome, panel, notices, problem } = this.state;
    const looks = view === 'appearance';
    const lamp = looks ? html`<sillon-lamp .studio=${this.studio}></sillon-lamp>` : nothing;
    if (mode === 'view') {
      return html`<sillon-canvas .studio=${this.studio}></sillon-canvas>
        <div class="bench bare">${lamp}</div>
        <sillon-notices .studio=${this.studio}></sillon-notices>`;
    }
    return html`
      <sillon-canvas .studio=${this.studio}></sillon-canvas>
      <div class=${isRuled(this.state) ? 'bench ruled' : 'bench'}>
        ${lamp}
        <div class="views raft" role="tablist" aria-label=${t('view.title')} @keydown=${this.#onTabKey}>
          ${tabs.map(
            (tab, k) =>
              html`<button
                role="tab"
                id="tab-${tab}"
                aria-selected=${String(tabOf(view) === tab)}
                aria-keyshortcuts=${k + 1}
                title="${t(`view.${tab}.help`)} (${k + 1})"
                tabindex=${tabOf(view) === tab ? 0 : -1}
                @click=${() => this.studio.setView(tab)}
              >
                ${t(`view.${tab}`)}
              </button>`,
          )}
        </div>
        ${
          offers(this.state, 'layers') && !welcome
            ? html`<sillon-tools
                class="raft"
                .studio=${this.studio}
                role="toolbar"
                aria-label=${t('tool.title')}
              ></sillon-tools>`
            : nothing
        }
        <div class="bottom">
          ${
            welcome && panel === ''
              ? button('main', html`${icon('plus')} ${t('start.own')}`, () => this.studio.setPanel('layers'))
              : nothing
          }
          ${tabOf(view) === 'toolpath' ? this.#colourBy() : nothing}
          ${!welcome && this.lazy(loadBars) ? this.#bars(view) : nothing} ${this.#options()}
        </div>
        ${
          looks && compare
            ? html`<div class="captions">
                <span class="tag">${t('view.yours')}</span><span class="tag">${t('view.zigzag')}</span>
              </div>`
            : nothing
        }
      </div>
      <sillon-notices class=${notices.length > 0 || problem ? 'some' : ''} .studio=${this.studio}></sillon-notices>
      <sillon-status .studio=${this.studio}></sillon-status>
    `;
  }

  #bars(view: ViewName): TemplateResult | typeof nothing {
    if (view === 'appearance') return html`<sillon-looks .studio=${this.studio}></sillon-looks>`;
    if (view === 'toolpath') return html`<sillon-player class="raft" .studio=${this.studio}></sillon-player>`;
    if (view === 'quality' && this.state.marks.length === 0) return nothing;
    return html`<sillon-legend class="raft" .studio=${this.studio}></sillon-legend>`;
  }

  #onTabKey = (event: KeyboardEvent): void => {
    const by = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (by === 0) return;
    event.preventDefault();
    const next = tabs[(tabs.indexOf(tabOf(this.state.view)) + by + tabs.length) % tabs.length] as ViewName;
    this.studio.setView(next);
    void this.updateComplete.then(() => this.renderRoot.querySelector<HTMLElement>(`#tab-${next}`)?.focus());
  };

  @state() private unfolded = false;

  /** Returns the button and panel of rarely changed view settings;
   * the panel's element is loaded when it is first opened. */
  #options(): TemplateResult {
    return html`<button
        class="options"
        popovertarget="options"
        aria-label=${t('view.options')}
        title=${t('view.options')}
      >
        ${icon('tune')}
      </button>
      <div
        id="options"
        class="raft"
        popover
        role="group"
        aria-label=${t('view.options')}
        @beforetoggle=${() => {
          this.unfolded = true;
        }}
      >
        ${
          this.unfolded && this.lazy(loadOptions)
            ? html`<sillon-view-options .studio=${this.studio}></sillon-view-options>`
            : nothing
        }
      </div>`;
  }

  #colourBy(): TemplateResult {
    const { colourBy, view } = this.state;
    return html`<div class="colour raft">
      <label for="colour" class="note">${t('colour.title')}</label>
      <select
        id="colour"
        .value=${view === 'directions' ? view : colourBy}
        @change=${(event: Event) => {
          const chosen = (event.currentTarget as HTMLSelectElement).value as ColourBy | 'directions';
          if (chosen === 'directions') this.studio.setView(chosen);
          else this.studio.store.set({ colourBy: chosen, view: 'toolpath' });
        }}
      >
        <option value="directions" ?selected=${view === 'directions'}>${t('view.directions')}</option>
        ${colours.map(
          (name) =>
            html`<option value=${name} ?selected=${view !== 'directions' && name === colourBy}>
              ${t(`colour.${name}`)}
            </option>`,
        )}
      </select>
      ${this.lazy(loadBars) ? html`<sillon-legend class="within" .studio=${this.studio}></sillon-legend>` : nothing}
    </div>`;
  }
}
