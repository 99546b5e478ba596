// A sliced print from above: its relief, the outlines of its faces, and the new beads under the light. It is moved by
// pointer, wheel and keys; a click chooses a face, a brush draws.
import { css, html, nothing, type PropertyValues, type TemplateResult } from 'lit';
import type { PrintRelief, Toolpath } from 'sillon';
import { customElement, property, query } from 'lit/decorators.js';
import { r } from '../i18n/rebrush.js';
import { appearance } from '../model/appearance.js';
import { printerDefaults } from '../model/defaults.js';
import type { Light } from '../model/view.js';
import { PageCamera } from '../views/camera.js';
import { lightUnder } from '../views/light.js';
import { drawOutlines, drawStrokes, reliefPicture } from '../views/print-drawing.js';
import { joinedBeads, outlinesOf, pageOf, type Page } from '../views/print-page.js';
import { createRenderer } from '../views/renderer.js';
import type { Renderer } from '../views/scene.js';
import { draws, strokeOf, strokesOnPage } from './hand-strokes.js';
import { drawBrush } from '../stage/overlay.js';
import { Pen } from '../stage/pen.js';
import { closest, margin, PrintBench } from './print-bench.js';

const beyond = 0.4; // share of the page by which the view may leave it

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
  /** Light while no pointer moves it. */
  @property({ attribute: false }) home: Light = { azimuth: 60, elevation: 35 };
  /** Pictures are shown, which are solved for an eye far above. */
  @property({ type: Boolean }) lit = false;
  /** The print can also be shown at an angle. */
  @property({ type: Boolean }) tilts = false;
  @query('.ground') private ground!: HTMLCanvasElement;
  @query('.beads') private beads!: HTMLCanvasElement;
  @query('.overlay') private overlay!: HTMLCanvasElement;

  #renderer: Renderer | undefined;
  readonly #camera = new PageCamera(
    this,
    () => this.#page.size,
    () => this.redraw(),
    { most: closest, across: 8 },
  );
  /** Pen of the brush, on the page [mm]. */
  readonly #pen = new Pen(
    () => this.#page.size,
    () => this.redraw(),
    (points) => this.#endStroke(points),
  );
  #pointed: number | undefined;
  #light: Light | undefined;
  #page: Page = { corner: [0, 0], size: [1, 1] };
  #picture: OffscreenCanvas | undefined;
  #toolpath: Toolpath | undefined;

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
      this.#renderer = undefined; // outlines and relief are drawn without it
    }
    this.watch(this.overlay, {
      draws: () => this.#draws(),
      pan: (dx, dy) => this.#camera.pan(dx, dy, beyond),
      zoom: (factor, x, y) => this.zoom(factor, x, y),
      hover: (place) => this.#hover(place),
      begin: (place) => this.#pen.begin(this.#camera.toPage(place)),
      draw: (place) => this.#pen.draw(this.#camera.toPage(place)),
      end: () => this.#pen.lift(),
      abandon: () => {
        this.#pen.points = undefined;
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

  // --- Drawing ------------------------------------------------------------------------------------------------------------

  /** Places the page and the outlines on it. */
  #lay(): void {
    this.#page = pageOf(this.relief, this.faces);
    this.outlines = outlinesOf(this.faces, this.relief, this.#page);
    if (this.#camera.fitted) this.fit();
  }

  /** Draws the relief for `draw`. */
  #shade(): void {
    this.#picture = this.relief === undefined ? undefined : reliefPicture(this.relief, this.dark);
  }

  /** Collects the beads of the chosen faces. */
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
      this.#camera.now,
    );
    this.#drawOutlines();
    this.#drawStrokes();
  }

  /** Returns the page's lower left corner in device pixels, and the scale in pixels per mm. */
  #place(): { left: number; bottom: number; scale: number } {
    const { x, y, scale } = this.#camera.now;
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

  /** Draws strokes without beads, and the brush. */
  #drawStrokes(): void {
    const context = this.overlay.getContext('2d');
    if (context === null || this.brush === undefined) return;
    const { left, bottom, scale } = this.#place();
    const strokes = strokesOnPage(this.strokes, this.#page.corner, this.#pen.points, this.brush);
    context.setTransform(scale, 0, 0, -scale, left, bottom);
    drawStrokes(context, strokes, getComputedStyle(this).getPropertyValue('--accent'));
    const { cursor } = this.#pen;
    if (!this.#draws() || cursor === undefined) return;
    const at = { x: left + cursor.x * scale, y: bottom - cursor.y * scale };
    context.setTransform(1, 0, 0, 1, 0, 0);
    drawBrush(context, at, (this.brush.across / 2) * scale, this.brush.soft);
  }

  // --- Brush ----------------------------------------------------------------------------------------------------------------

  #draws(): boolean {
    return draws(this.brush);
  }

  #endStroke(points: readonly number[]): void {
    const detail = this.brush && strokeOf(this.brush, points, this.#page.corner);
    if (detail !== undefined) this.dispatchEvent(new CustomEvent('stroke', { detail }));
  }

  // --- Camera and pointer ---------------------------------------------------------------------------------------------------

  protected override resize(width: number, height: number): void {
    const [columns, rows] = [Math.round(width * devicePixelRatio), Math.round(height * devicePixelRatio)];
    for (const canvas of [this.ground, this.overlay]) {
      canvas.width = columns;
      canvas.height = rows;
    }
    this.#renderer?.resize(columns, rows);
    if (this.#camera.fitted) this.fit();
    this.draw();
  }

  protected override fit(): void {
    const { width, height } = this.getBoundingClientRect();
    const room = (length: number): number => Math.max(1, length - 2 * Math.min(margin, length * 0.06));
    const scale = Math.min(room(width) / this.#page.size[0], room(height) / this.#page.size[1]);
    this.#camera.now = { x: this.#page.size[0] / 2, y: this.#page.size[1] / 2, scale: scale * devicePixelRatio };
    this.#camera.fitted = true;
    this.redraw();
  }

  /** Returns the place on the page [mm], also beside the print. */
  protected override pageAt(x: number, y: number): [number, number] {
    const at = this.#camera.toPage({ x, y });
    return [at.x, at.y];
  }

  protected override zoom(factor: number, x?: number, y?: number): void {
    this.#camera.zoom(factor, x, y);
  }

  protected override keys(shift: boolean): Record<string, () => void> {
    const step = shift ? 80 : 24;
    const go = (x: number, y: number) => (): void => {
      if (!this.#draws()) this.#camera.pan(-x, y, beyond);
      else this.#pen.move(x / this.#camera.cssScale, y / this.#camera.cssScale);
      this.redraw();
    };
    return {
      ArrowLeft: go(-step, 0),
      ArrowRight: go(step, 0),
      ArrowUp: go(0, step),
      ArrowDown: go(0, -step),
      ...(this.#draws() && {
        ' ': () => this.#pen.toggle(),
      }),
      ...(this.#pen.points !== undefined && {
        Escape: () => this.#pen.lift(),
      }),
    };
  }

  /** Highlights the face under the pointer, and moves the light with it. */
  #hover(place: { x: number; y: number } | undefined): void {
    const { width, height } = this.getBoundingClientRect();
    const draws = this.#draws();
    this.#pen.cursor = place === undefined || !draws ? undefined : this.#camera.toPage(place);
    this.#pointed = place === undefined || draws ? undefined : this.faceAt(place.x, place.y);
    // The light stands still under a brush.
    this.#light =
      place === undefined || draws
        ? undefined
        : lightUnder((place.x - width / 2) / (width / 2), (height / 2 - place.y) / (height / 2));
    this.overlay.classList.toggle('hits', this.#pointed !== undefined);
    this.overlay.classList.toggle('draws', draws);
    this.redraw();
  }
}
