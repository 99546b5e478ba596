// The plate on its bench: an element that handles pointers, wheels and keys, and has the plate drawn.
import { css, html, nothing, type TemplateResult } from 'lit';
import type { Shape } from 'sillon';
import { customElement, query } from 'lit/decorators.js';
import { formatNumber, t } from '../i18n/text.js';
import { pictureOf } from '../model/lamp.js';
import { pictureLayers } from '../model/layers.js';
import { pageOf, type Plate } from '../model/plate.js';
import { problemOf, StudioError } from '../model/problem.js';
import { thicknessOf } from '../model/thickness.js';
import { sameSolved } from '../model/result.js';
import { bench } from '../controls/bench.js';
import { lampOf, lightOfTilt } from '../views/light.js';
import { createRenderer } from '../views/renderer.js';
import type { Camera, Renderer, Scene } from '../views/scene.js';
import { StudioElement } from '../controls/element.js';
import { Gestures, onStillClick, type Place } from '../controls/gestures.js';
import type { Divider } from '../controls/divider.js';
import type { LayerStage } from '../layers/stage.js';
import type { Shown } from '../studio/shown.js';
import type { Stage } from '../studio/studio.js';
import { Brush } from './brush.js';
import { FileBitmap } from './file-bitmap.js';
import { MovingLight } from './moving-light.js';
import { drawOverlay, type Overlay } from './overlay.js';
import { Pace } from './pace.js';
import { PlateCamera } from './plate-camera.js';
import { isRuled, overOf, sceneOf, shownPlate } from './plate-scene.js';

const longestShadow = 18; // [CSS pixels] under a low lamp; longer shadows look like a second plate

const loadDivider = (): Promise<unknown> => import('../controls/divider.js');
const loadFlat = () => import('../views/flat-renderer.js');
const loadAhead = () => import('../views/ahead.js');
const loadConflict = () => import('../views/conflict.js');

const restsAfter = 180; // [ms] without a move of light or camera, after which the drawing is at rest
const halved = 0.5; // pixels drawn per screen pixel, in one direction, while something moves on a slow machine

@customElement('sillon-canvas')
export class PlateCanvas extends StudioElement implements Stage {
  static override styles = [
    bench,
    css`
      :host {
        background: radial-gradient(
          farthest-side,
          color-mix(in srgb, var(--bench), white 11%),
          color-mix(in srgb, var(--bench), white 3%)
        );
      }
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

  static override reads = ['tool', 'over', 'view', 'plate'] as const;

  @query('.drawing') private drawing!: HTMLCanvasElement;
  @query('.overlay') private overlay!: HTMLCanvasElement;

  #renderer: Renderer | undefined;
  #camera!: PlateCamera;
  #brush!: Brush;
  #picture!: FileBitmap;
  #motion!: MovingLight;
  /** Tools to arrange layers, loaded with the panel of layers. */
  #layers: LayerStage | undefined;
  #gestures: Gestures | undefined;
  #observer: ResizeObserver | undefined;
  #frame = 0;
  #flipTimer: ReturnType<typeof setTimeout> | undefined;
  readonly #darkScheme = matchMedia('(prefers-color-scheme: dark)');

  #description(): string {
    const { plate, view } = this.state;
    const [width, height] = pageOf(plate).map((length) => formatNumber(length, 1)) as [string, string];
    return t('view.canvas', { name: plate.name || t('app.untitled'), view: t(`view.${view}`), width, height });
  }

  override render(): TemplateResult {
    return html`<canvas class="drawing" aria-hidden="true"></canvas
      ><canvas
        class="overlay ${this.state.tool === 'pan' ? '' : 'draws'}"
        tabindex="0"
        role="application"
        aria-roledescription=${t('app.plate')}
        aria-label=${this.#description()}
      ></canvas
      >${
        overOf(this.state) === undefined || !this.lazy(loadDivider)
          ? nothing
          : html`<sillon-divider .studio=${this.studio} .shareAt=${this.#shareAt}></sillon-divider>`
      }`;
  }

  #shareAt = (x: number): number =>
    this.#camera.toPage({ x: x - this.getBoundingClientRect().left, y: 0 }).x / pageOf(this.state.plate)[0];

  #placeDivider(): void {
    const divider = this.renderRoot.querySelector<Divider>('sillon-divider');
    if (divider === null) return;
    const { left, top, width, height } = this.plateBox();
    divider.place(left + this.state.wipe * width, top, height);
  }

  override focus(): void {
    this.overlay.focus();
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.#camera = new PlateCamera(this, this.#redraw, (button) => this.#observer?.observe(button));
    this.#brush = new Brush(this.studio);
    this.#picture = new FileBitmap(this.studio, this.#redraw);
    this.#motion = new MovingLight(this.studio, this.#isSlow);
  }

  override firstUpdated(): void {
    this.studio.stage = this;
    try {
      this.#renderer = createRenderer(this.drawing, this.lazy);
    } catch (error) {
      this.studio.fail(problemOf(error instanceof StudioError ? error : new StudioError('NoWebGl', {}, String(error))));
    }
    this.#gestures = new Gestures(this.overlay, {
      draws: (event, place) =>
        this.state.tool === 'pan' ? this.#layers?.takes(place, event) === true : event.button === 0 && !event.altKey,
      pan: (dx, dy) => this.#camera.move(dx, dy),
      zoom: (factor, x, y) => this.#camera.zoom(factor, x, y),
      hover: (point, leads) => this.#hover(point, leads),
      begin: (point) => {
        if (this.#layers?.holds !== true) this.#brush.begin(this.#camera.toPage(point));
      },
      draw: (point, event) => {
        if (this.#layers?.holds === true) this.#layers.move(point, event);
        else this.#brush.draw(this.#camera.toPage(point));
      },
      end: () => {
        if (this.#layers?.holds === true) this.#layers.release();
        else this.#brush.lift();
      },
      abandon: () => {
        this.#layers?.abandon();
        this.#brush.abandon();
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
    this.#observer = new ResizeObserver(() => this.#resize());
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
    clearTimeout(this.#restTimer);
    this.#observer?.disconnect();
    this.#gestures?.dispose();
    this.#renderer?.dispose();
    this.#darkScheme.removeEventListener('change', this.#redraw);
    removeEventListener('deviceorientation', this.#onTilt);
    removeEventListener('pointermove', this.#onActivity);
    document.removeEventListener('visibilitychange', this.#redraw);
  }

  protected override updated(): void {
    if (this.#renderer === undefined) this.#drawFlat();
    this.#told = ''; // the next drawing may again request a part that could not be loaded
    this.#redraw();
  }

  /** Uses the renderer without WebGL2, once it is loaded. */
  #drawFlat(): void {
    this.#renderer = this.lazy(loadFlat)?.createFlatRenderer(this.drawing);
    if (this.#renderer !== undefined) this.#resize();
  }

  protected override onState(now: Readonly<Shown>, before: Readonly<Shown>): void {
    this.#brush.follow(now, before);
    this.#camera.follow(now, before);
    if (now.sizing !== before.sizing) this.#resize();
    this.#redraw();
  }

  // --- Layers -----------------------------------------------------------------------------------------------------------

  /** Loads the tools that arrange layers on the plate. */
  #loadLayers = async (): Promise<void> => {
    const { LayerStage } = await import('../layers/stage.js');
    const view = {
      toPage: (place: Place): readonly [number, number] => {
        const { x, y } = this.#camera.toPage(place);
        return [x, y];
      },
      toScreen: ([x, y]: readonly [number, number]): Place => this.#camera.toScreen({ x, y }),
      scale: () => this.#camera.cssScale,
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

  /** Draws the plate and its overlay, and moves the light. */
  #draw(now: number): void {
    if (this.state.panel === 'layers') this.lazy(this.#loadLayers);
    const wait = this.#motion.move(now);
    clearTimeout(this.#flipTimer);
    this.#drawScene(now);
    this.#castShadow();
    this.#placeDivider();
    const pixels = devicePixelRatio;
    const { plate, view, marks, mark } = this.state;
    drawOverlay(this.overlay, {
      camera: this.#camera.now,
      pixels,
      page: pageOf(plate),
      cursor: this.state.tool === 'pan' ? undefined : this.#brush.cursor,
      radius: this.state.brush.radius * pageOf(plate)[0],
      softness: this.state.brush.softness,
      marks: view === 'quality' ? marks : [],
      mark,
      shape: view === 'directions' ? this.#shapeOf(plate) : undefined,
      above: this.#layers?.drawing(),
      shimmer: this.#shimmer(),
      strokes: this.#strokes(),
      picture: this.#laidOver(),
      grey: overOf(this.state) === 'picture',
      wipe: this.state.wipe,
      ruled: isRuled(this.state),
      styles: getComputedStyle(this),
    });
    if (wait === 0) this.#redraw();
    else if (wait !== undefined) this.#flipTimer = setTimeout(this.#redraw, wait);
  }

  /** Casts the shadow of the plate on the bench: it falls away from the lamp, as far as the plate's thickness throws
   * it. Slow machines get none, because browsers blur it again for each frame. */
  #castShadow(): void {
    const { plate, light, view } = this.state;
    const [x, y, z] = lampOf(light);
    const thrown = (thicknessOf(plate) * this.#camera.cssScale) / z; // [CSS pixels] for each unit towards the lamp
    const length = Math.min(1, longestShadow / (thrown * Math.hypot(x, y) || 1)) * thrown;
    const away = `${(-x * length).toFixed(1)}px ${(y * length).toFixed(1)}px`;
    const cast =
      view === 'appearance' && !this.#isSlow()
        ? `drop-shadow(0 0 2px rgb(0 0 0 / 0.6)) drop-shadow(${away} 6px rgb(0 0 0 / 0.5))`
        : '';
    if (cast === this.#cast) return;
    this.#cast = cast;
    this.drawing.style.filter = cast;
  }

  #cast = '';

  /** Draws the scene unless nothing in it has changed: a hovering brush must not wait for beads, which take long
   * without a GPU. */
  #drawScene(now: number): void {
    const renderer = this.#renderer;
    if (renderer === undefined) return;
    const scene = this.#scene();
    const shown = scene.view === 'directions' ? scene.directions : (scene.toolpath ?? scene.directions);
    const told = JSON.stringify([this.camera, { ...scene, toolpath: 0, directions: 0, marks: 0 }]);
    const changes = shown !== this.#shown || told !== this.#told;
    if (changes && shown === this.#shown && this.#told !== '') this.#movedAt = now;
    const moves = now - this.#movedAt < restsAfter;
    const fineness = moves && this.#isSlow() ? halved : this.#camera.fineness();
    if ((!changes && fineness === this.#fineness) || this.#pace.holds()) return;
    this.#shown = shown;
    this.#told = told;
    if (fineness !== this.#fineness) this.#resizeDrawing(fineness);
    const began = performance.now();
    const current = sameSolved(this.state.directions?.plate ?? this.state.plate, this.state.plate);
    const quick = fineness === halved && current && (scene.view === 'appearance' || renderer.stepwise === true);
    renderer.draw({ ...scene, fineness, quick }, { ...this.camera, scale: this.camera.scale * fineness });
    if (!document.hidden) void this.#pace.follow(began, renderer.finished(), fineness, () => performance.now());
    clearTimeout(this.#restTimer);
    if (moves && this.#isSlow()) this.#restTimer = setTimeout(this.#redraw, restsAfter);
  }

  readonly #pace = new Pace(() => this.#redraw());
  /** Tells whether drawing is slow, as without a graphics card. */
  #isSlow = (): boolean => this.#pace.slow || this.#renderer?.stepwise === true;

  /** Pixels drawn per screen pixel, in one direction. */
  #fineness = 1;
  #movedAt = -Infinity; // [ms]
  #restTimer: ReturnType<typeof setTimeout> | undefined;
  #shown: Scene['toolpath'] | Scene['directions'];
  #told = '';

  #resizeDrawing(fineness: number): void {
    this.#fineness = fineness;
    this.#renderer?.resize(Math.round(this.overlay.width * fineness), Math.round(this.overlay.height * fineness));
  }

  /** Returns a function that draws brush strokes which the shown beads do not follow yet; undefined: there are none. */
  #strokes(): Overlay['strokes'] {
    const { plate, view } = this.state;
    const shown = shownPlate(this.state);
    if (shown === undefined || shown.layers === plate.layers) return undefined;
    if (view === 'directions' && pictureLayers(plate).length === 0) return undefined; // the directions already show them
    return this.lazy(loadAhead)?.strokesAhead(plate, shown);
  }

  /** Returns the light that stands in for beads, until there are some. */
  #shimmer(): Overlay['shimmer'] {
    const { shimmer, result, light, view } = this.state;
    if (shimmer === undefined || result !== undefined || view !== 'appearance') return undefined;
    return (width, height) => shimmer(light, width, height);
  }

  /** Returns the picture whose lamp shines, or the conflict of that picture; undefined until its code is loaded. */
  #laidOver(): Overlay['picture'] {
    const { plate, result, lamp } = this.state;
    const over = overOf(this.state);
    if (over === 'conflict' && result?.conflict !== undefined)
      return this.lazy(loadConflict)?.conflictPicture(result.conflict, lamp);
    const bytes = over === 'picture' ? pictureOf(plate, lamp)?.bytes : undefined;
    return bytes && this.#picture.of(bytes);
  }

  /** Returns the shape that the engine read last; undefined: the plate has another one by now. */
  #shapeOf({ shape, width, height }: Plate): Shape | undefined {
    const { directions, result } = this.state;
    const isSame = (of: Plate | undefined): boolean =>
      of?.shape === shape && of.width === width && of.height === height;
    if (isSame(directions?.plate)) return directions?.shape;
    return isSame(result?.plate) ? result?.toolpath.shape : undefined;
  }

  #scene = (): Scene => ({
    ...sceneOf(this.state, this.#darkScheme.matches),
    fades: !this.studio.calm() && !this.#isSlow(),
  });

  #appearance = (): Scene => ({ ...this.#scene(), view: 'appearance', progress: 1 });

  /** Adapts both canvases to the size of the element. */
  #resize(): void {
    const { width, height } = this.getBoundingClientRect();
    if (width === 0 || height === 0) return;
    this.overlay.width = Math.round(width * devicePixelRatio);
    this.overlay.height = Math.round(height * devicePixelRatio);
    this.#resizeDrawing(this.#camera.fineness());
    this.#told = '';
    this.#camera.keepFitted();
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

  /** Passes the pointer's place to the brush, the layers and the light. */
  #hover(point: Place | undefined, leads: boolean): void {
    this.#brush.cursor = point && this.#camera.toPage(point);
    this.overlay.style.cursor = this.#layers?.hover(point) ?? '';
    this.#redraw();
    if (this.#layers?.holds === true) return; // the light stays in place while a layer is dragged
    const { width, height } = this.getBoundingClientRect();
    this.#motion.hover(
      leads && point !== undefined ? [(2 * point.x) / width - 1, 1 - (2 * point.y) / height] : undefined,
    );
  }

  // --- Methods for other parts --------------------------------------------------------------------------------------------

  get camera(): Camera {
    return this.#camera.now;
  }

  fit(): void {
    this.#camera.fit();
  }

  zoom(factor: number): void {
    this.#camera.zoom(factor);
  }

  wheel(event: WheelEvent): void {
    this.overlay.dispatchEvent(new WheelEvent(event.type, event));
  }

  lookAt(x: number, y: number, across: number): void {
    this.#camera.lookAt(x, y, across);
  }

  plateBox(): { left: number; top: number; width: number; height: number } {
    return this.#camera.plateBox();
  }

  async capture(width: number): Promise<Blob> {
    if (this.#renderer === undefined) throw new StudioError('NoWebGl');
    return this.#renderer.capture(this.#appearance(), width);
  }

  async loop(signal?: AbortSignal): Promise<Blob> {
    if (this.#renderer === undefined) throw new StudioError('NoWebGl');
    const lamps = this.studio.lamps();
    const { makeLoop } = await import('./loop.js');
    return makeLoop(this.#appearance(), lamps.length > 0 ? lamps : [this.state.light], signal);
  }

  // --- Keys ---------------------------------------------------------------------------------------------------------------

  /** Handles keys of the layers, the camera and the brush. */
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
    if (arrow !== undefined && drawing) this.#moveBrush(...arrow);
    else if (arrow !== undefined) this.#camera.move(...arrow);
    else if (drawing && (key === ' ' || key === 'Enter')) this.#brush.toggle();
    else if (key === 'Escape' && this.#brush.points !== undefined) this.#brush.lift();
    else if (key === '+' || key === '=') this.zoom(1.25);
    else if (key === '-') this.zoom(0.8);
    else if (key === '0') this.fit();
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  /** Moves the brush by keys. */
  #moveBrush(dx: number, dy: number): void {
    this.#brush.move(-dx / this.#camera.cssScale, dy / this.#camera.cssScale);
    this.#redraw();
  }
}
