// The plate on its bench: drawn by the renderer, moved by hand, wheel and keys, combed by brushes; rulers along two sides.
import { css, html, nothing, type TemplateResult } from 'lit';
import type { Shape } from 'sillon';
import { customElement, query } from 'lit/decorators.js';
import { t } from '../i18n/text.js';
import { appearance } from '../model/appearance.js';
import { lookOf } from '../model/filaments.js';
import { pictureOf } from '../model/lamp.js';
import { drawnLayers } from '../model/layers.js';
import { pageOf, type Plate, type Stroke } from '../model/plate.js';
import { problemOf, StudioError } from '../model/problem.js';
import { bench } from '../controls/bench.js';
import { panned, zoomed } from '../views/camera.js';
import { freeOf, seenIn, type Box } from '../views/fit.js';
import { between, lightOfTilt } from '../views/light.js';
import { createRenderer } from '../views/renderer.js';
import type { Camera, Renderer, Scene } from '../views/scene.js';
import { StudioElement } from '../controls/element.js';
import { drawOverlay, rulerWidth, type Cursor, type Overlay } from './overlay.js';
import { Gestures, onStillClick, type Place } from '../controls/gestures.js';
import type { LayerStage } from '../layers/stage.js';
import { MovingLight } from './moving-light.js';
import type { Divider } from '../controls/divider.js';
import type { Over, Shown } from '../studio/shown.js';
import type { Stage } from '../studio/studio.js';

const gap = 0.08; // between plate and zigzag, share of the page's width
const margin = 40; // around the plate [CSS pixels]
const toolsWidth = 60;
const narrow = 640; // [CSS pixels] where buttons lie over the plate
const clear = 8;
const armLength = 600; // [mm]
const handLength = 350; // of a phone

const loadDivider = (): Promise<unknown> => import('../controls/divider.js');
const loadAhead = () => import('../views/ahead.js');
const loadConflict = () => import('../views/conflict.js');

@customElement('sillon-canvas')
export class PlateCanvas extends StudioElement implements Stage {
  static override styles = [
    ...StudioElement.styles,
    bench,
    css`
      .overlay.draws {
        cursor: none;
      }
      .overlay:active {
        cursor: grabbing;
      }
      .overlay.draws:active {
        cursor: none;
      }
    `,
  ];

  static override reads = ['tool', 'over', 'view'] as const;

  @query('.drawing') private drawing!: HTMLCanvasElement;
  @query('.overlay') private overlay!: HTMLCanvasElement;

  #renderer: Renderer | undefined;
  /** Pixels of the screen. */
  camera: Camera = { x: 0, y: 0, scale: 1 };
  #fitted = true;
  #frame = 0;
  #cursor: Cursor | undefined;
  /** What is being drawn, page units. */
  #points: number[] | undefined;
  /** The same, as it lies in the plate. */
  #stroke: Stroke | undefined;
  #observer: ResizeObserver | undefined;
  #motion!: MovingLight;
  #flipTimer: ReturnType<typeof setTimeout> | undefined;
  readonly #coarse = matchMedia('(pointer: coarse)');
  readonly #darkScheme = matchMedia('(prefers-color-scheme: dark)');
  #gestures: Gestures | undefined;

  override render(): TemplateResult {
    return html`<canvas class="drawing" aria-hidden="true"></canvas
      ><canvas
        class="overlay ${this.state.tool === 'pan' ? '' : 'draws'}"
        tabindex="0"
        role="application"
        aria-roledescription=${t('app.plate')}
        aria-label=${t('view.canvas')}
      ></canvas
      >${
        this.#over() === undefined || !this.lazy(loadDivider)
          ? nothing
          : html`<sillon-divider .studio=${this.studio} .shareAt=${this.#shareAt}></sillon-divider>`
      }`;
  }

  #over = (): Over | undefined => (this.state.view === 'appearance' ? this.state.over : undefined);

  #shareAt = (x: number): number =>
    this.#toPage({ x: x - this.getBoundingClientRect().left, y: 0 }).x / this.#page().page[0];

  #placeDivider(): void {
    const divider = this.renderRoot.querySelector<Divider>('sillon-divider');
    if (divider === null) return;
    const { left, top, width, height } = this.plateBox();
    divider.place(left + this.state.wipe * width, top, height);
  }

  override focus(): void {
    this.overlay.focus();
  }

  override firstUpdated(): void {
    this.studio.stage = this;
    this.#motion = new MovingLight(this.studio);
    try {
      this.#renderer = createRenderer(this.drawing, this.lazy);
    } catch (error) {
      this.studio.fail(problemOf(error instanceof StudioError ? error : new StudioError('NoWebGl', {}, String(error))));
    }
    this.#gestures = new Gestures(this.overlay, {
      draws: (event, place) =>
        this.state.tool === 'pan' ? this.#layers?.takes(place, event) === true : event.button === 0 && !event.altKey,
      pan: (dx, dy) => {
        this.#move(dx, dy);
      },
      zoom: (factor, x, y) => {
        this.#zoomAt(factor, x, y);
      },
      hover: (point, leads) => {
        this.#hover(point, leads);
      },
      begin: (point) => {
        if (this.#layers?.holds === true) return;
        this.#points = this.#toUnit(point);
        this.#addStroke();
      },
      draw: (point, event) => {
        if (this.#layers?.holds === true) {
          this.#layers.move(point, event);
          return;
        }
        this.#points?.push(...this.#toUnit(point));
        this.#addStroke();
      },
      end: () => {
        if (this.#layers?.holds === true) this.#layers.release();
        else this.#lift();
      },
      abandon: () => {
        this.#layers?.abandon();
        if (this.#points === undefined) return;
        this.studio.store.abandon();
        this.#lift();
      },
    });
    this.overlay.addEventListener('keydown', this.#onKey);
    for (const name of ['keyup', 'blur']) this.overlay.addEventListener(name, () => this.#layers?.keyUp());
    onStillClick(this.overlay, (x, y) => {
      this.#layers?.click({ x, y });
    });
    this.overlay.addEventListener('dblclick', ({ offsetX: x, offsetY: y }) => {
      this.#layers?.doubleClick({ x, y });
    });
    this.#observer = new ResizeObserver(() => {
      this.#resize();
    });
    this.#observer.observe(this);
    const bars = (this.getRootNode() as ShadowRoot).querySelector('.bottom');
    if (bars !== null) this.#observer.observe(bars);
    this.#darkScheme.addEventListener('change', this.#redraw);
    addEventListener('deviceorientation', this.#onTilt);
    addEventListener('pointermove', this.#onActivity, { passive: true });
    document.addEventListener('visibilitychange', this.#redraw);
    this.#resize();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    cancelAnimationFrame(this.#frame);
    clearTimeout(this.#flipTimer);
    this.#observer?.disconnect();
    this.#gestures?.dispose();
    this.#renderer?.dispose();
    this.#darkScheme.removeEventListener('change', this.#redraw);
    removeEventListener('deviceorientation', this.#onTilt);
    removeEventListener('pointermove', this.#onActivity);
    document.removeEventListener('visibilitychange', this.#redraw);
  }

  protected override updated(): void {
    this.#told = ''; // what is drawn may ask anew for a part that could not be fetched
    this.#redraw();
  }

  protected override onState(now: Readonly<Shown>, before: Readonly<Shown>): void {
    const { plate } = now;
    if (now.result !== before.result && now.result?.coarse === true) this.#previewCame = performance.now();
    // Undone, cleared, or another tool: what is drawn next must not take the place of an earlier stroke.
    if (this.#points !== undefined && (plate.strokes.at(-1) !== this.#stroke || now.tool !== before.tool)) this.#lift();
    const resized = String(pageOf(plate)) !== String(pageOf(before.plate));
    const compared = this.#compares(now) !== this.#compares(before);
    if (now.sizing !== before.sizing && now.sizing !== 'free') this.#fitted = true;
    if (now.sizing !== before.sizing) this.#resize();
    else if ((resized || compared) && this.#fitted) this.#place();
    if (now.view !== before.view && this.#fitted) {
      // Other buttons lie over it.
      const { host } = this.getRootNode() as ShadowRoot;
      void (host as HTMLElement & { updateComplete: Promise<boolean> }).updateComplete.then(() => {
        if (this.#fitted && this.getBoundingClientRect().width <= narrow) this.#place();
      });
    }
    this.#redraw();
  }

  // --- Layers -----------------------------------------------------------------------------------------------------------

  /** Once there are any to arrange. */
  #layers: LayerStage | undefined;

  #loadLayers = async (): Promise<void> => {
    const { LayerStage } = await import('../layers/stage.js');
    const view = {
      toPage: (place: Place): readonly [number, number] => {
        const { x, y } = this.#toPage(place);
        return [x, y];
      },
      toScreen: ([x, y]: readonly [number, number]): Place => this.#toScreen({ x, y }),
      scale: () => this.camera.scale / devicePixelRatio,
    };
    this.#layers = new LayerStage(this.studio, view, this.#redraw);
  };

  // --- Drawing ----------------------------------------------------------------------------------------------------------

  #redraw = (): void => {
    if (this.#frame !== 0 || !this.isConnected) return;
    this.#frame = requestAnimationFrame((now) => {
      this.#frame = 0;
      this.#draw(now);
    });
  };

  #draw(now: number): void {
    if (this.state.panel === 'layers') this.lazy(this.#loadLayers);
    const wait = this.#motion.move(now);
    clearTimeout(this.#flipTimer);
    this.#drawScene();
    this.#placeDivider();
    const pixels = devicePixelRatio;
    const { plate, view, marks, mark } = this.state;
    drawOverlay(this.overlay, {
      camera: this.camera,
      pixels,
      page: pageOf(plate),
      cursor: this.state.tool === 'pan' ? undefined : this.#cursor,
      radius: this.state.brush.radius * pageOf(plate)[0],
      softness: this.state.brush.softness,
      marks: view === 'quality' ? marks : [],
      mark,
      shape: view === 'directions' ? this.#shapeOf(plate) : undefined,
      above: this.#layers?.drawing(),
      shimmer: this.#shimmer(),
      strokes: this.#strokes(),
      picture: this.#over() === 'conflict' ? this.#conflict() : this.#picture(),
      grey: this.#over() === 'picture',
      wipe: this.state.wipe,
      styles: getComputedStyle(this),
    });
    if (wait === 0) this.#redraw();
    else if (wait !== undefined) this.#flipTimer = setTimeout(this.#redraw, wait);
  }

  /** What is drawn already stays as it is: a brush that hovers must not wait for beads, which take long without a GPU. */
  #drawScene(): void {
    const scene = this.scene();
    const camera = { ...this.camera, scale: this.camera.scale * this.#fineness() };
    const shown = scene.view === 'directions' ? scene.directions : scene.toolpath;
    const told = JSON.stringify([camera, { ...scene, toolpath: 0, directions: 0, marks: 0 }]);
    const came = this.#previewCame;
    this.#previewCame = undefined;
    if (shown === this.#shown && told === this.#told) return;
    this.#shown = shown;
    this.#told = told;
    this.#renderer?.draw(scene, camera);
    if (came === undefined) return;
    void this.#renderer?.finished().then(() => {
      this.studio.services.drew(performance.now() - came);
    });
  }

  /** [ms] Where it has not been drawn. */
  #previewCame: number | undefined;

  #shown: Scene['toolpath'] | Scene['directions'];
  #told = '';

  /** Of brushes, where beads do not follow them yet. */
  #strokes(): Overlay['strokes'] {
    const { plate, result, view } = this.state;
    if (result === undefined || result.plate.strokes === plate.strokes || view === 'directions') return undefined;
    return this.lazy(loadAhead)?.strokesAhead(plate, result.plate);
  }

  /** Until there are beads. */
  #shimmer(): Overlay['shimmer'] {
    const { shimmer, result, light, view } = this.state;
    if (shimmer === undefined || result !== undefined || view !== 'appearance') return undefined;
    return (width, height) => shimmer(light, width, height);
  }

  /** The one whose lamp shines, where it is laid over the plate. */
  #picture(): ImageBitmap | undefined {
    if (this.#over() !== 'picture') return undefined;
    const bytes = pictureOf(this.state.plate, this.state.lamp)?.bytes;
    if (bytes === undefined) return undefined;
    if (this.#bitmapOf !== bytes) {
      this.#bitmapOf = bytes;
      this.#bitmap = undefined;
      void Promise.all([import('../files/drawn.js'), this.studio.services.engine()])
        .then(([{ bitmapOf }, running]) => bitmapOf(bytes, running))
        .then(
          (bitmap) => {
            if (this.#bitmapOf === bytes) this.#bitmap = bitmap;
            this.#redraw();
          },
          () => undefined, // of a kind that browsers do not draw
        );
    }
    return this.#bitmap;
  }

  /** What the picture whose lamp shines cannot have, once what draws it is there. */
  #conflict(): OffscreenCanvas | undefined {
    const { result, lamp } = this.state;
    if (result?.conflict === undefined) return undefined;
    return this.lazy(loadConflict)?.conflictPicture(result.conflict, lamp);
  }

  #bitmap: ImageBitmap | undefined;
  #bitmapOf: Blob | undefined;

  /** That of the toolpath, while it still is the plate's. */
  #shapeOf({ shape, width, height }: Plate): Shape | undefined {
    const { result } = this.state;
    const same = result?.plate.shape === shape && result.plate.width === width && result.plate.height === height;
    return same ? result.toolpath.shape : undefined;
  }

  #compares = ({ compare, view }: Readonly<Shown>): boolean => compare && view === 'appearance';

  scene(): Scene {
    const { plate, result, directions, view, colourBy, played, compare, light, marks, theme } = this.state;
    const { page } = this.#page();
    const lit = plate.directions.kind === 'lamp' ? plate.directions : undefined;
    // Which way beads run that show a picture, or lie under layers, is known once they are there; a brush is for what the
    // layers lie over.
    const hidden = lit !== undefined || (drawnLayers(plate).length > 0 && this.state.tool === 'pan');
    const solved = hidden && view === 'directions';
    return {
      page,
      toolpath: result?.toolpath,
      directions,
      view: solved ? 'toolpath' : view,
      colourBy: solved ? 'direction' : colourBy,
      lampSlope: lit === undefined ? appearance.softbox : plate.pictures.lampSize,
      fromAfar: lit !== undefined,
      feed: { printer: plate.printer, layerHeight: plate.print.layerHeight },
      progress: view === 'toolpath' ? played : 1,
      compare: compare && view === 'appearance',
      wipe: this.#over() === 'zigzag' ? this.state.wipe : undefined,
      blended: this.#blends(),
      light,
      filament: lookOf(plate),
      marks,
      dark: theme === 'auto' ? this.#darkScheme.matches : theme === 'dark',
    };
  }

  #page(): { page: [number, number]; shown: number } {
    const { plate } = this.state;
    const page = pageOf(plate);
    return { page, shown: this.#compares(this.state) ? page[0] * (2 + gap) : page[0] };
  }

  #resize(): void {
    const { width, height } = this.getBoundingClientRect();
    if (width === 0 || height === 0) return;
    const [columns, rows] = [Math.round(width * devicePixelRatio), Math.round(height * devicePixelRatio)];
    this.#renderer?.resize(columns * this.#fineness(), rows * this.#fineness());
    this.overlay.width = columns;
    this.overlay.height = rows;
    if (this.#fitted) this.#place();
    this.#draw(performance.now());
  }

  // --- The light --------------------------------------------------------------------------------------------------------

  #onActivity = (): void => {
    if (this.#motion.touch()) this.#redraw();
  };

  #onTilt = ({ beta, gamma }: DeviceOrientationEvent): void => {
    if (this.state.lightMode !== 'tilt' || beta === null || gamma === null) return;
    this.studio.store.set({ light: lightOfTilt(beta, gamma) });
  };

  #hover(point: { x: number; y: number } | undefined, leads: boolean): void {
    this.#cursor = point === undefined ? undefined : this.#toPage(point);
    this.overlay.style.cursor = this.#layers?.hover(point) ?? '';
    this.#redraw();
    if (this.#layers?.holds === true) return; // the light stays where it is
    const { width, height } = this.getBoundingClientRect();
    this.#motion.hover(
      leads && point !== undefined ? [(2 * point.x) / width - 1, 1 - (2 * point.y) / height] : undefined,
    );
  }

  // --- The camera -------------------------------------------------------------------------------------------------------

  /** Millimetres under a point of the element. */
  #toPage({ x, y }: { x: number; y: number }): Cursor {
    const { width, height } = this.getBoundingClientRect();
    const scale = this.camera.scale / devicePixelRatio;
    return { x: this.camera.x + (x - width / 2) / scale, y: this.camera.y - (y - height / 2) / scale };
  }

  /** The place on the element of a place of the page [mm]. */
  #toScreen({ x, y }: Cursor): Place {
    const { width, height } = this.getBoundingClientRect();
    const scale = this.camera.scale / devicePixelRatio;
    return { x: width / 2 + (x - this.camera.x) * scale, y: height / 2 - (y - this.camera.y) * scale };
  }

  #toUnit(point: { x: number; y: number }): number[] {
    const { x, y } = this.#toPage(point);
    const { page } = this.#page();
    return [x / page[0], y / page[1]];
  }

  fit(): void {
    this.#fitted = true;
    if (this.state.sizing !== 'whole') this.studio.store.set({ sizing: 'whole' });
    this.#place();
  }

  #blends = (): boolean => this.state.sizing === 'arm' && this.state.view === 'appearance';

  /** Pixels drawn per pixel of the screen, one way: what is finer than the eye must be drawn to be blended. */
  #fineness = (): number => (this.#blends() && Math.max(this.overlay.width, this.overlay.height) <= 2048 ? 2 : 1);

  /** CSS pixels per mm, as large as it will be; at arm's length for somebody who looks at the screen from nearer. */
  #lifeScale = (): number => (this.#blends() && this.#coarse.matches ? handLength / armLength : 1) * (96 / 25.4);

  /** All of it, or as large as in life, in the middle of what is free. */
  #place(): void {
    const { page, shown } = this.#page();
    const { width, height } = this.getBoundingClientRect();
    const free = width <= narrow ? this.#amongButtons(width, height) : this.#betweenBars(width, height);
    const scale = this.state.sizing === 'whole' ? undefined : this.#lifeScale();
    const seen = seenIn(free, [shown, page[1]], [width, height], scale);
    this.camera = { ...seen, scale: seen.scale * devicePixelRatio };
    this.#redraw();
  }

  /** What the buttons leave of a narrow canvas. */
  #amongButtons(width: number, height: number): Box {
    const { left: x, top: y } = this.getBoundingClientRect();
    const area = { left: rulerWidth, top: rulerWidth, right: width, bottom: height };
    const root = this.getRootNode() as ShadowRoot;
    // A notice lifts the bars under the plate for a while: the plate stays where it is.
    const lift = root.querySelector('sillon-notices')?.clientHeight ?? 0;
    const buttons = [...root.querySelectorAll('.views, sillon-tools, .actions, .bottom > *')].map((one) => {
      this.#observer?.observe(one); // it may not be drawn yet
      const { left, top, right, bottom } = one.getBoundingClientRect();
      const down = (one.matches('.bottom > *') ? lift : 0) - y;
      return { left: left - x, top: top + down, right: right - x, bottom: bottom + down };
    });
    const free = freeOf(area, buttons);
    const enough = free.right - free.left > width / 4 && free.bottom - free.top > height / 4;
    const { left, top, right, bottom } = enough ? free : area;
    return { left: left + clear, top: top + clear, right: right - clear, bottom: bottom - clear };
  }

  /** What lies between the bars of a wide one. What a low bench leaves out (the stage's style) need not be kept free. */
  #betweenBars(width: number, height: number): Box {
    const sides = { left: toolsWidth + margin, right: width - margin };
    if (height > 340) {
      const bars = (this.getRootNode() as ShadowRoot).querySelector('.bottom')?.clientHeight ?? 0;
      const below = Math.max(2 * margin, Math.min(bars + 24, height / 2 - margin));
      return { ...sides, top: 2 * margin, bottom: height - below };
    }
    const bare = height <= 170 || this.studio.store.state.mode === 'view';
    return { ...sides, top: rulerWidth + (bare ? 8 : 64), bottom: height - (bare ? 8 : 12) };
  }

  /** Where the plate lies in this element [CSS pixels]. */
  plateBox(): { left: number; top: number; width: number; height: number } {
    const { page } = this.#page();
    const { width, height } = this.getBoundingClientRect();
    const scale = this.camera.scale / devicePixelRatio;
    const [left, top] = [width / 2 - this.camera.x * scale, height / 2 - (page[1] - this.camera.y) * scale];
    return { left, top, width: page[0] * scale, height: page[1] * scale };
  }

  zoom(factor: number): void {
    const { width, height } = this.getBoundingClientRect();
    this.#zoomAt(factor, width / 2, height / 2);
  }

  #zoomAt(factor: number, x: number, y: number): void {
    const at = this.#toPage({ x, y });
    const { page } = this.#page();
    const { width } = this.getBoundingClientRect();
    const least = (width * devicePixelRatio) / (12 * Math.max(...page));
    this.camera = zoomed(this.camera, at, factor, least, 1200 * devicePixelRatio);
    this.#letGo();
    this.#redraw();
  }

  #move(dx: number, dy: number): void {
    const { page, shown } = this.#page();
    const ratio = devicePixelRatio;
    this.camera = panned(this.camera, dx * ratio, dy * ratio, [shown, page[1]], 0.5);
    this.#fitted = false;
    this.#redraw();
  }

  #letGo(): void {
    this.#fitted = false;
    if (this.state.sizing !== 'free') this.studio.store.set({ sizing: 'free' });
  }

  lookAt(x: number, y: number, across: number): void {
    const { width } = this.getBoundingClientRect();
    this.camera = { x, y, scale: (width * devicePixelRatio) / across };
    this.#letGo();
    this.#redraw();
  }

  // --- Brushes ------------------------------------------------------------------------------------------------------------

  #addStroke(): void {
    const points = this.#points;
    const { tool, brush } = this.state;
    if (points === undefined || tool === 'pan') return;
    const stroke: Stroke = {
      tool,
      points: [...points],
      radius: brush.radius,
      softness: brush.softness,
      ...(tool === 'mode' ? { mode: brush.mode } : {}),
    };
    const first = points.length === 2;
    this.#stroke = stroke;
    this.studio.change(
      (plate) => ({ ...plate, strokes: [...(first ? plate.strokes : plate.strokes.slice(0, -1)), stroke] }),
      'stroke',
    );
  }

  #lift(): void {
    this.#points = undefined;
    this.studio.settle();
  }

  // --- Keys ---------------------------------------------------------------------------------------------------------------

  #onKey = (event: KeyboardEvent): void => {
    if (this.#layers?.key(event) === true) {
      event.preventDefault();
      event.stopPropagation();
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { key } = event;
    const step = event.shiftKey ? 80 : 24;
    const arrows: Record<string, readonly [number, number]> = {
      ArrowLeft: [step, 0],
      ArrowRight: [-step, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
    };
    const arrow = arrows[key];
    const drawing = this.state.tool !== 'pan';
    if (arrow !== undefined && drawing) this.#moveCursor(-arrow[0], arrow[1]);
    else if (arrow !== undefined) this.#move(arrow[0], arrow[1]);
    else if (drawing && (key === ' ' || key === 'Enter')) this.#togglePen();
    else if (key === 'Escape' && this.#points !== undefined) this.#lift();
    else if (key === '+' || key === '=') this.zoom(1.25);
    else if (key === '-') this.zoom(0.8);
    else if (key === '0') this.fit();
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  /** With keys a brush is led as with a pointer; the space bar puts it down and takes it up. */
  #moveCursor(dx: number, dy: number): void {
    const scale = this.camera.scale / devicePixelRatio;
    const { page } = this.#page();
    const from = this.#cursor ?? { x: page[0] / 2, y: page[1] / 2 };
    this.#cursor = {
      x: Math.min(page[0], Math.max(0, from.x + dx / scale)),
      y: Math.min(page[1], Math.max(0, from.y + dy / scale)),
    };
    if (this.#points !== undefined) {
      this.#points.push(this.#cursor.x / page[0], this.#cursor.y / page[1]);
      this.#addStroke();
    }
    this.#redraw();
  }

  #togglePen(): void {
    if (this.#points !== undefined) {
      this.#lift();
      return;
    }
    const { page } = this.#page();
    this.#cursor ??= { x: page[0] / 2, y: page[1] / 2 };
    this.#points = [this.#cursor.x / page[0], this.#cursor.y / page[1]];
    this.#addStroke();
  }

  // --- Pictures -------------------------------------------------------------------------------------------------------------

  async capture(width: number): Promise<Blob> {
    if (this.#renderer === undefined) throw new StudioError('NoWebGl');
    return this.#renderer.capture({ ...this.scene(), view: 'appearance', progress: 1 }, width);
  }

  /** One turn of the light, or from one picture to the other and back, as a video. */
  async record(seconds: number, signal?: AbortSignal): Promise<Blob> {
    const { recordCanvas } = await import('./video.js');
    const before = this.state.light;
    this.studio.store.set({ recording: true, view: 'appearance' });
    try {
      const [first, second] = this.studio.lamps();
      const pose = (share: number): void => {
        if (first !== undefined && second !== undefined) {
          // From one picture to the other and back.
          this.studio.store.set({ light: between(first, second, (1 - Math.cos(2 * Math.PI * share)) / 2) });
          return;
        }
        this.studio.store.set({ light: { ...before, azimuth: (before.azimuth + 360 * share) % 360 } });
      };
      return await recordCanvas(this.drawing, seconds, pose, signal);
    } finally {
      this.studio.store.set({ recording: false, light: before });
    }
  }
}
