// Base class of both views of a sliced print: properties, pointers and keys, size and frames.
import { html, LitElement, nothing, type CSSResultGroup, type TemplateResult } from 'lit';
import type { Cycle } from 'sillon';
import { property } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import type { Stroke } from 'sillon';
import type { Face, HandBrush } from '../model/rebrush.js';
import type { FilamentLook } from '../model/view.js';
import { bench } from '../controls/bench.js';
import { controls } from '../controls/controls.js';
import type { Outline } from '../views/print-page.js';
import { Gestures, onStillClick, type GestureEvents } from '../controls/gestures.js';
import { draws } from './hand-strokes.js';
import { icon } from '../controls/icons.js';
import { zoomButtons } from './style.js';

export const margin = 24; // [CSS pixels] around the print
export const closest = 400; // [CSS pixels per mm]

export abstract class PrintBench extends LitElement {
  static override styles: CSSResultGroup = [controls, bench, zoomButtons];

  @property({ attribute: false }) faces: readonly Face[] = [];
  @property({ attribute: false }) chosen: ReadonlySet<number> = new Set();
  /** New beads of each face, on its own page. */
  @property({ attribute: false }) laid: ReadonlyMap<number, readonly Cycle[]> = new Map<number, readonly Cycle[]>();
  /** Face that is highlighted from outside, by the list. */
  @property({ attribute: false }) marked: number | undefined;
  @property({ attribute: false }) filament!: FilamentLook;
  /** Brush for the chosen faces; undefined: the pointer moves the view and chooses faces. */
  @property({ attribute: false }) brush: HandBrush | undefined;
  /** Strokes without beads yet, on the bed. */
  @property({ attribute: false }) strokes: readonly Stroke[] = [];
  @property({ type: Boolean }) dark = false;

  protected outlines: readonly Outline[] = [];
  #gestures: Gestures | undefined;
  #observer: ResizeObserver | undefined;
  #frame = 0;

  protected abstract draw(): void;
  /** Sets the size of the canvases. @param width, height  [CSS pixels] */
  protected abstract resize(width: number, height: number): void;
  protected abstract zoom(factor: number, x?: number, y?: number): void;
  protected abstract fit(): void;
  /** Returns the keys of this view, in addition to those of every view. */
  protected abstract keys(shift: boolean): Record<string, () => void>;
  /** Returns the place on the page [mm]; undefined: beside the print. */
  protected abstract pageAt(x: number, y: number): readonly [number, number] | undefined;
  protected abstract release(): void;

  /** Listens to gestures, clicks and keys on a canvas. */
  protected watch(canvas: HTMLCanvasElement, events: GestureEvents): void {
    this.#gestures = new Gestures(canvas, events);
    onStillClick(canvas, (x, y) => {
      if (draws(this.brush)) return;
      const index = this.faceAt(x, y);
      if (index !== undefined) this.dispatchEvent(new CustomEvent('toggle-face', { detail: index }));
    });
    canvas.addEventListener('keydown', this.#onKey);
    this.#observer = new ResizeObserver(() => {
      const { width, height } = this.getBoundingClientRect();
      if (width > 0 && height > 0) this.resize(width, height);
    });
    this.#observer.observe(this);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    cancelAnimationFrame(this.#frame);
    this.#observer?.disconnect();
    this.#gestures?.dispose();
    this.release();
  }

  /** Draws with the next frame, once. */
  protected redraw(): void {
    if (this.#frame !== 0 || !this.isConnected) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      this.draw();
    });
  }

  /** Returns the uppermost face at a place. */
  protected faceAt(x: number, y: number): number | undefined {
    const place = this.pageAt(x, y);
    const context = new OffscreenCanvas(1, 1).getContext('2d');
    if (place === undefined || context === null) return undefined;
    const [u, v] = place;
    const hit = this.outlines.filter(({ parts }) =>
      parts.some(({ path, rule }) => context.isPointInPath(path, u, v, rule)),
    );
    return hit.at(-1)?.index;
  }

  protected button(
    name: Parameters<typeof icon>[0],
    label: string,
    run: () => void,
    pressed?: boolean,
  ): TemplateResult {
    return html`<button
      class="plain square"
      aria-label=${label}
      title=${label}
      aria-pressed=${pressed === undefined ? nothing : pressed}
      @click=${run}
    >
      ${icon(name, 16)}
    </button>`;
  }

  /** Returns the zoom buttons. @param more  further buttons of the view */
  protected buttons(more: unknown): TemplateResult {
    return html`<div class="zoom raft" role="group" aria-label=${t('section.view')}>
      ${this.button('minus', t('verb.zoomOut'), () => this.zoom(1 / 1.4))}
      ${this.button('plus', t('verb.zoomIn'), () => this.zoom(1.4))}
      ${this.button('fit', t('verb.fit'), () => this.fit())} ${more}
    </div>`;
  }

  /** Handles the keys of this view and those that zoom. */
  #onKey = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const keys: Record<string, () => void> = {
      ...this.keys(event.shiftKey),
      '+': () => this.zoom(1.25),
      '-': () => this.zoom(0.8),
      '0': () => this.fit(),
    };
    const run = keys[event.key === '=' ? '+' : event.key];
    if (run === undefined) return;
    run();
    event.preventDefault();
    event.stopPropagation();
  };
}
