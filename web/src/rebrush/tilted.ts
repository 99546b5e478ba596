// A sliced print at an angle, with its layers, or from below. It is turned and moved by pointer, wheel and keys; a
// click chooses a face, a brush draws.
import { css, html, type PropertyValues, type TemplateResult } from 'lit';
import type { PrintRelief, Toolpath } from 'sillon';
import { customElement, property, query, state } from 'lit/decorators.js';
import { r } from '../i18n/rebrush.js';
import type { Side } from '../model/rebrush.js';
import type { Light } from '../model/view.js';
import { fitted, isBelow, magnified, orbited, placeUnder, shifted, turnedOver, type Orbit } from '../views/orbit.js';
import { bodyOf, drawOutlines, drawStrokes, reliefPicture } from '../views/print-drawing.js';
import { joinedBeads, outlinesOf, pageOf } from '../views/print-page.js';
import { createTilted, type TiltedRenderer } from '../views/relief-3d.js';
import type { Place } from '../controls/gestures.js';
import { draws, strokeOf, strokesOnPage } from './hand-strokes.js';
import { closest, margin, PrintBench } from './print-bench.js';

const perPixel = Math.PI / 500; // [radians] per pixel of a drag
const perKey = Math.PI / 24;
const moveKey = 40; // [CSS pixels]
const start = { turn: -Math.PI / 7, tilt: Math.PI / 3.4 };

@customElement('sillon-rebrush-tilted')
export class RebrushTilted extends PrintBench {
  static override styles = [
    PrintBench.styles,
    css`
      .print {
        cursor: grab;
      }
      .print:focus-visible {
        outline-offset: -3px;
      }
    `,
  ];

  @property({ attribute: false }) relief!: PrintRelief;
  /** Side whose faces can be chosen; bottoms alone are shown from below at first. */
  @property() side: Side = 'top';
  @property({ attribute: false }) light: Light = { azimuth: 60, elevation: 35 };
  /** Stroke being drawn, on the page [mm]. */
  @state() private points: readonly number[] | undefined;
  @state() private below = false;

  @query('.print') private canvas!: HTMLCanvasElement;

  #renderer: TiltedRenderer | undefined;
  /** View, in CSS pixels. */
  #orbit: Orbit = { ...start, scale: 1, x: 0, y: 0 };
  /** The user has neither moved nor zoomed the print: it fits whatever size the view gets. */
  #fitted = true;
  /** Last place of the pointer that turns the print. */
  #held: Place | undefined;
  #picture: OffscreenCanvas | undefined;
  #beads: Toolpath | undefined;

  override render(): TemplateResult {
    return html`<canvas class="print" tabindex="0" role="application" aria-label=${r('tilted')}></canvas>
      ${this.buttons(
        html`${this.button('mirror', r('below'), this.#turnOver, this.below)}${this.button('shape', r('flat'), () =>
          this.dispatchEvent(new CustomEvent('tilt')),
        )}`,
      )}`;
  }

  override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has('side') && this.side !== 'both' && this.below !== (this.side === 'bottom')) this.#turnOver();
  }

  override firstUpdated(): void {
    try {
      this.#renderer = createTilted(this.canvas);
    } catch {
      this.dispatchEvent(new CustomEvent('tilt')); // the view from above stands in
      return;
    }
    this.watch(this.canvas, {
      // With other buttons or with Shift, and by two fingers, the print is moved instead.
      draws: ({ button, shiftKey }) => button === 0 && !shiftKey,
      pan: (dx, dy) => this.#move(dx, dy),
      zoom: (factor, x, y) => this.zoom(factor, x, y),
      hover: () => undefined,
      begin: (place) => {
        this.#held = place;
        if (draws(this.brush)) this.points = this.pageAt(place.x, place.y);
      },
      draw: (place) => {
        const from = this.#held ?? place;
        this.#held = place;
        if (this.points !== undefined) this.points = [...this.points, ...(this.pageAt(place.x, place.y) ?? [])];
        else this.#turn((place.x - from.x) * perPixel, (from.y - place.y) * perPixel);
      },
      end: () => this.#endStroke(),
      abandon: () => {
        this.points = undefined;
      },
    });
    this.canvas.focus({ preventScroll: true });
  }

  override updated(changed: Map<PropertyKey, unknown>): void {
    const { relief, chosen, laid, filament, light, dark, below } = this;
    const faces = this.faces.filter(({ side }) => (side === 'bottom') === below);
    const others = changed.has('relief') || changed.has('faces') || changed.has('below');
    if (others) this.outlines = outlinesOf(faces, relief, pageOf(relief, faces));
    if (changed.has('relief') || changed.has('dark')) this.#picture = reliefPicture(relief, dark);
    if (others || changed.has('laid') || changed.has('chosen')) {
      const shown = faces.filter(({ index }) => chosen.has(index));
      this.#beads = joinedBeads(shown, laid, relief, pageOf(relief, faces));
    }
    const styles = getComputedStyle(this);
    const [accent, soft] = [styles.getPropertyValue('--accent'), styles.getPropertyValue('--soft')];
    const [wide, tall] = [relief.columns * relief.cell, relief.rows * relief.cell];
    this.#renderer?.set({
      relief,
      layer: this.faces.find(({ side }) => side === 'top')?.height ?? faces[0]?.height ?? 0.2,
      beads: this.#beads,
      paint: (context, pixel) => {
        if (this.#picture !== undefined && !below) {
          context.save();
          context.scale(1, -1);
          context.drawImage(this.#picture, 0, -tall, wide, tall);
          context.restore();
        }
        const pointed = [this.marked];
        drawOutlines(context, { outlines: this.outlines, chosen, laid, pointed, accent, soft }, 2 * pixel, 2);
        if (this.brush === undefined) return;
        drawStrokes(context, strokesOnPage(this.strokes, relief.corner, this.points, this.brush), accent);
      },
      body: bodyOf(dark),
      filament,
      light,
    });
    this.redraw();
  }

  protected override release(): void {
    this.#renderer?.dispose();
  }

  protected override draw(): void {
    const { scale, x, y, ...way } = this.#orbit;
    const ratio = devicePixelRatio;
    this.#renderer?.draw({ ...way, scale: scale * ratio, x: x * ratio, y: y * ratio });
  }

  protected override resize(width: number, height: number): void {
    this.#renderer?.resize(Math.round(width * devicePixelRatio), Math.round(height * devicePixelRatio));
    if (this.#fitted) this.#fitTo(this.#orbit);
    this.redraw();
  }

  protected override fit(): void {
    this.#fitTo(this.below ? turnedOver(start) : start);
  }

  #fitTo(way: Pick<Orbit, 'turn' | 'tilt'>): void {
    const { width, height } = this.getBoundingClientRect();
    const { columns, rows, cell, heights } = this.relief;
    const highest = heights.reduce((most, one) => Math.max(most, one), 0);
    this.#orbit = fitted(way, [columns * cell, rows * cell, highest], [width, height], margin);
    this.#fitted = true;
    this.redraw();
  }

  /** Shows the print from the other side. */
  #turnOver = (): void => {
    this.#orbit = turnedOver(this.#orbit);
    this.below = isBelow(this.#orbit);
    this.points = undefined;
    if (this.#fitted && this.hasUpdated) this.#fitTo(this.#orbit);
  };

  #turn(turn: number, tilt: number): void {
    this.#orbit = orbited(this.#orbit, turn, tilt);
    if (this.#fitted) this.#fitTo(this.#orbit);
    this.redraw();
  }

  #move(dx: number, dy: number): void {
    const { width, height } = this.getBoundingClientRect();
    this.#orbit = shifted(this.#orbit, dx, dy, [width, height]);
    this.#fitted = false;
    this.redraw();
  }

  #endStroke(): void {
    const [points, brush] = [this.points, this.brush];
    this.points = undefined;
    this.#held = undefined;
    const detail =
      points === undefined || brush === undefined ? undefined : strokeOf(brush, points, this.relief.corner);
    if (detail !== undefined) this.dispatchEvent(new CustomEvent('stroke', { detail }));
  }

  protected override zoom(factor: number, x?: number, y?: number): void {
    const { width, height } = this.getBoundingClientRect();
    const least = width / (8 * Math.max(this.relief.columns, this.relief.rows) * this.relief.cell);
    this.#orbit = magnified(this.#orbit, factor, x ?? width / 2, y ?? height / 2, least, closest);
    this.#fitted = false;
    this.redraw();
  }

  protected override keys(shift: boolean): Record<string, () => void> {
    const go = (x: number, y: number) => (): void => {
      if (shift) this.#move(moveKey * x, moveKey * y);
      else this.#turn(perKey * x, -perKey * y);
    };
    return {
      ArrowLeft: go(-1, 0),
      ArrowRight: go(1, 0),
      ArrowUp: go(0, -1),
      ArrowDown: go(0, 1),
    };
  }

  protected override pageAt(x: number, y: number): [number, number] | undefined {
    return placeUnder(this.#orbit, this.relief, x, y);
  }
}
