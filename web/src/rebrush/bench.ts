// A sliced print from above: its relief, the outlines of its faces, and the new beads under the light. Moved by hand, wheel
// and keys; a click chooses a face, a brush draws.
import { css, html, nothing, type PropertyValues, type TemplateResult } from 'lit';
import type { PrintRelief, Toolpath } from 'sillon';
import { customElement, property, query } from 'lit/decorators.js';
import { r } from '../i18n/rebrush.js';
import { appearance } from '../model/appearance.js';
import { printerDefaults } from '../model/defaults.js';
import type { Light } from '../model/view.js';
import { panned, zoomed } from '../views/camera.js';
import { lightUnder } from '../views/light.js';
import { drawOutlines, drawStrokes, reliefPicture } from '../views/print-drawing.js';
import { joinedBeads, outlinesOf, pageOf, type Page } from '../views/print-page.js';
import { createRenderer } from '../views/renderer.js';
import type { Camera, Renderer } from '../views/scene.js';
import { draws, strokeOf, strokesOnPage } from './hand-strokes.js';
import { drawBrush } from '../stage/overlay.js';
import { closest, margin, PrintBench } from './print-bench.js';

@customElement('sillon-rebrush-bench')
export class RebrushBench extends PrintBench {
  static override styles = [
    PrintBench.styles,
    css`
      .overlay.hits {
        cursor: pointer;
      }
      .overlay.draws {
        cursor: none;
      }
    `,
  ];

  @property({ attribute: false }) relief: PrintRelief | undefined;
  /** Where the light rests. */
  @property({ attribute: false }) home: Light = { azimuth: 60, elevation: 35 };
  /** Pictures are solved for an eye far above. */
  @property({ type: Boolean }) lit = false;
  /** Whether the print can be seen from aside. */
  @property({ type: Boolean }) tilts = false;
  @query('.ground') private ground!: HTMLCanvasElement;
  @query('.beads') private beads!: HTMLCanvasElement;
  @query('.overlay') private overlay!: HTMLCanvasElement;

  #renderer: Renderer | undefined;
  #camera: Camera = { x: 0, y: 0, scale: 1 };
  #pointed: number | undefined;
  #light: Light | undefined;
  #page: Page = { corner: [0, 0], size: [1, 1] };
  #picture: OffscreenCanvas | undefined;
  #toolpath: Toolpath | undefined;
  /** Where the brush is, and the stroke that it draws, on the page [mm]. */
  #cursor: { x: number; y: number } | undefined;
  #points: number[] | undefined;

  override render(): TemplateResult {
    return html`<canvas class="ground" aria-hidden="true"></canvas><canvas class="beads" aria-hidden="true"></canvas
      ><canvas class="overlay" tabindex="0" role="application" aria-label=${r('bench')}></canvas> ${this.buttons(
        this.tilts ? this.button('body', r('tilt'), () => this.dispatchEvent(new CustomEvent('tilt'))) : nothing,
      )}`;
  }

  override firstUpdated(): void {
    try {
      this.#renderer = createRenderer(this.beads);
    } catch {
      this.#renderer = undefined; // outlines and relief are there without it
    }
    this.watch(this.overlay, {
      draws: () => this.#draws(),
      pan: (dx, dy) => {
        this.#move(dx, dy);
      },
      zoom: (factor, x, y) => {
        this.zoom(factor, x, y);
      },
      hover: (place) => {
        this.#hover(place);
      },
      begin: (place) => {
        this.#points = [];
        this.#addPoint(place);
      },
      draw: (place) => {
        this.#addPoint(place);
      },
      end: () => {
        this.#endStroke();
      },
      abandon: () => {
        this.#points = undefined;
        this.redraw();
      },
    });
  }

  override updated(changed: PropertyValues<this>): void {
    if (changed.has('relief') || changed.has('faces')) this.#lay();
    if (changed.has('dark') || changed.has('relief')) this.#shade();
    if (changed.has('laid') || changed.has('chosen') || changed.has('faces') || changed.has('relief')) this.#join();
    this.redraw();
  }

  protected override release(): void {
    this.#renderer?.dispose();
  }

  // --- What is shown ------------------------------------------------------------------------------------------------------

  /** Places the page, and the outlines on it. */
  #lay(): void {
    this.#page = pageOf(this.relief, this.faces);
    this.outlines = outlinesOf(this.faces, this.relief, this.#page);
    if (this.fitted) this.fit();
  }

  #shade(): void {
    this.#picture = this.relief === undefined ? undefined : reliefPicture(this.relief, this.dark);
  }

  #join(): void {
    const chosen = this.faces.filter(({ index }) => this.chosen.has(index));
    this.#toolpath = joinedBeads(chosen, this.laid, this.relief, this.#page);
  }

  protected override draw(): void {
    this.#drawGround();
    this.#renderer?.draw(
      {
        page: this.#page.size,
        toolpath: this.#toolpath,
        directions: undefined,
        view: 'appearance',
        colourBy: 'direction',
        lampSlope: appearance.softbox,
        fromAfar: this.lit,
        feed: { printer: printerDefaults, layerHeight: 1 },
        progress: 1,
        compare: false,
        light: this.#light ?? this.home,
        filament: this.filament,
        marks: [],
        dark: this.dark,
      },
      this.#camera,
    );
    this.#drawOutlines();
    this.#drawStrokes();
  }

  /** Device pixels of a place on the page, y up. */
  #place(): { left: number; bottom: number; scale: number } {
    const { x, y, scale } = this.#camera;
    return { left: this.overlay.width / 2 - x * scale, bottom: this.overlay.height / 2 + y * scale, scale };
  }

  #drawGround(): void {
    const context = this.ground.getContext('2d');
    if (context === null) return;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.ground.width, this.ground.height);
    if (this.#picture === undefined) return;
    const { left, bottom, scale } = this.#place();
    context.imageSmoothingQuality = 'high';
    const [wide, tall] = this.#page.size;
    context.drawImage(this.#picture, left, bottom - tall * scale, wide * scale, tall * scale);
  }

  #drawOutlines(): void {
    const context = this.overlay.getContext('2d');
    if (context === null) return;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.overlay.width, this.overlay.height);
    const { left, bottom, scale } = this.#place();
    context.setTransform(scale, 0, 0, -scale, left, bottom);
    const styles = getComputedStyle(this);
    drawOutlines(
      context,
      {
        outlines: this.outlines,
        chosen: this.chosen,
        laid: this.laid,
        pointed: [this.#pointed, this.marked],
        accent: styles.getPropertyValue('--accent'),
        soft: styles.getPropertyValue('--soft'),
      },
      devicePixelRatio / scale,
      devicePixelRatio,
    );
  }

  /** Strokes that are not beads yet, and the brush. */
  #drawStrokes(): void {
    const context = this.overlay.getContext('2d');
    if (context === null || this.brush === undefined) return;
    const { left, bottom, scale } = this.#place();
    const strokes = strokesOnPage(this.strokes, this.#page.corner, this.#points, this.brush);
    context.setTransform(scale, 0, 0, -scale, left, bottom);
    drawStrokes(context, strokes, getComputedStyle(this).getPropertyValue('--accent'));
    if (!this.#draws() || this.#cursor === undefined) return;
    const at = { x: left + this.#cursor.x * scale, y: bottom - this.#cursor.y * scale };
    context.setTransform(1, 0, 0, 1, 0, 0);
    drawBrush(context, at, (this.brush.across / 2) * scale, this.brush.softness);
  }

  // --- Brush ----------------------------------------------------------------------------------------------------------------

  #draws(): boolean {
    return draws(this.brush);
  }

  #addPoint(place: { x: number; y: number }): void {
    this.#points?.push(...this.pageAt(place.x, place.y));
    this.redraw();
  }

  #endStroke(): void {
    const [points, brush] = [this.#points, this.brush];
    this.#points = undefined;
    if (points === undefined || brush === undefined) return;
    const detail = strokeOf(brush, points, this.#page.corner);
    if (detail === undefined) return;
    this.dispatchEvent(new CustomEvent('stroke', { detail }));
  }

  /** With keys a brush is led as with a pointer; the space bar puts it down and takes it up. */
  #moveBrush(dx: number, dy: number): void {
    const scale = this.#camera.scale / devicePixelRatio;
    const from = this.#cursor ?? { x: this.#page.size[0] / 2, y: this.#page.size[1] / 2 };
    const within = (value: number, length: number): number => Math.min(length, Math.max(0, value));
    this.#cursor = {
      x: within(from.x + dx / scale, this.#page.size[0]),
      y: within(from.y + dy / scale, this.#page.size[1]),
    };
    this.#points?.push(this.#cursor.x, this.#cursor.y);
    this.redraw();
  }

  #togglePen(): void {
    if (this.#points !== undefined) {
      this.#endStroke();
      return;
    }
    this.#cursor ??= { x: this.#page.size[0] / 2, y: this.#page.size[1] / 2 };
    this.#points = [this.#cursor.x, this.#cursor.y];
    this.redraw();
  }

  // --- Camera and pointer ---------------------------------------------------------------------------------------------------

  protected override resize(width: number, height: number): void {
    const [columns, rows] = [Math.round(width * devicePixelRatio), Math.round(height * devicePixelRatio)];
    for (const canvas of [this.ground, this.overlay]) {
      canvas.width = columns;
      canvas.height = rows;
    }
    this.#renderer?.resize(columns, rows);
    if (this.fitted) this.fit();
    this.draw();
  }

  protected override fit(): void {
    const { width, height } = this.getBoundingClientRect();
    const room = (length: number): number => Math.max(1, length - 2 * Math.min(margin, length * 0.06));
    const scale = Math.min(room(width) / this.#page.size[0], room(height) / this.#page.size[1]);
    this.#camera = { x: this.#page.size[0] / 2, y: this.#page.size[1] / 2, scale: scale * devicePixelRatio };
    this.fitted = true;
    this.redraw();
  }

  /** Also beside the print. */
  protected override pageAt(x: number, y: number): [number, number] {
    const { left, bottom, scale } = this.#place();
    return [(x * devicePixelRatio - left) / scale, (bottom - y * devicePixelRatio) / scale];
  }

  protected override zoom(factor: number, x?: number, y?: number): void {
    const { width, height } = this.getBoundingClientRect();
    const [atX, atY] = this.pageAt(x ?? width / 2, y ?? height / 2);
    const least = (width * devicePixelRatio) / (8 * Math.max(...this.#page.size));
    const at = { x: atX, y: atY };
    this.#camera = zoomed(this.#camera, at, factor, least, closest * devicePixelRatio);
    this.fitted = false;
    this.redraw();
  }

  #move(dx: number, dy: number): void {
    const ratio = devicePixelRatio;
    this.#camera = panned(this.#camera, dx * ratio, dy * ratio, this.#page.size, 0.4);
    this.fitted = false;
    this.redraw();
  }

  protected override keys(shift: boolean): Record<string, () => void> {
    const step = shift ? 80 : 24;
    const go = (x: number, y: number) => (): void => {
      if (this.#draws()) this.#moveBrush(x, y);
      else this.#move(-x, y);
    };
    return {
      ArrowLeft: go(-step, 0),
      ArrowRight: go(step, 0),
      ArrowUp: go(0, step),
      ArrowDown: go(0, -step),
      ...(this.#draws() && {
        ' ': () => {
          this.#togglePen();
        },
      }),
      ...(this.#points !== undefined && {
        Escape: () => {
          this.#endStroke();
        },
      }),
    };
  }

  #hover(place: { x: number; y: number } | undefined): void {
    const { width, height } = this.getBoundingClientRect();
    const draws = this.#draws();
    const at = place === undefined ? undefined : this.pageAt(place.x, place.y);
    this.#cursor = at === undefined || !draws ? undefined : { x: at[0], y: at[1] };
    this.#pointed = place === undefined || draws ? undefined : this.faceAt(place.x, place.y);
    // It stands still under a brush.
    this.#light =
      place === undefined || draws
        ? undefined
        : lightUnder((place.x - width / 2) / (width / 2), (height / 2 - place.y) / (height / 2));
    this.overlay.classList.toggle('hits', this.#pointed !== undefined);
    this.overlay.classList.toggle('draws', draws);
    this.redraw();
  }
}
