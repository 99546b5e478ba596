// <sillon-view>: a finished plate that shimmers as the light moves. No WebAssembly, no threads, no dependencies: a
// small picture of directions, and one graphics context for all views of a page.
import { lightOfTilt, lightUnder, swayedElevation, swayPeriod } from '../views/light.js';
import type { Light } from '../model/view.js';
import { FrameBudget, type Waiting } from './frame-budget.js';
import { decodeView, fetchView, type ViewFile } from './view-file.js';
import { ViewRenderer } from './view-renderer.js';

const attributes = ['src', 'poster', 'alt', 'light', 'azimuth', 'elevation', 'colour'] as const;
const ways = ['pointer', 'tilt', 'orbit', 'fixed'] as const;
type Way = (typeof ways)[number];
const mostPixels = 2048; // longest side of a canvas
const near = '800px'; // margin around the window: a view that close is fetched and kept decoded

const style = `
  :host { display: block; position: relative; aspect-ratio: 1; }
  :host([hidden]) { display: none; }
  canvas, img { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: contain; }
  [hidden] { display: none; }
`;

// --- State that all elements of a page share -------------------------------------------------------------------------------

const shown = new Set<SillonViewElement>();
const calm = matchMedia('(prefers-reduced-motion: reduce)');
let sheet: CSSStyleSheet | undefined;
let renderer: ViewRenderer | undefined;
let noRenderer = false;
let frame = 0;
let tilt: Light | undefined;

function styleSheet(): CSSStyleSheet {
  if (sheet === undefined) {
    sheet = new CSSStyleSheet(); // a page's policy may forbid a style element
    sheet.replaceSync(style);
  }
  return sheet;
}

/** Returns the renderer of all views of the page; undefined without WebGL2. */
function sharedRenderer(): ViewRenderer | undefined {
  if (renderer !== undefined || noRenderer) return renderer;
  try {
    renderer = new ViewRenderer(() => {
      for (const element of shown) void element.restore();
    });
  } catch {
    noRenderer = true;
  }
  return renderer;
}

const budget = new FrameBudget();

/** Draws all views of a page in one loop, which ends when no view asks to be drawn. */
function nextFrame(): void {
  if (frame !== 0) return;
  frame = requestAnimationFrame((now) => {
    frame = 0;
    const waiting = [...shown].map((element) => element.onFrame(now, tilt)).filter((one) => one !== undefined);
    budget.spend(waiting);
    if (waiting.length > 0) nextFrame();
  });
}

const watch = (told: (element: SillonViewElement, inside: boolean) => void, rootMargin: string): IntersectionObserver =>
  new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) {
        if (target instanceof SillonViewElement) told(target, isIntersecting);
      }
    },
    { rootMargin },
  );
const visibility = watch((element, inside) => element.onVisible(inside), '0px');
const nearness = watch((element, inside) => element.onNear(inside), near);

calm.addEventListener('change', nextFrame); // the loop has ended if no view was to move

/** Decodes pictures one after the other: many at once would need many times the memory. */
let decoding: Promise<unknown> = Promise.resolve();
function inTurn<T>(decode: () => Promise<T>): Promise<T> {
  const done = decoding.then(decode);
  decoding = done.catch(() => undefined);
  return done;
}
const sizes = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    if (target instanceof SillonViewElement) target.redraw();
  }
});

/** Follows the tilt of the device. */
function watchTilt(): void {
  addEventListener('deviceorientation', ({ beta, gamma }) => {
    if (beta === null || gamma === null) return;
    tilt = lightOfTilt(beta, gamma);
    for (const element of shown) element.redraw();
  });
}

let tiltAsked = false;

/** Asks for access to the tilt sensor. iOS asks the visitor for permission, and allows the request only after a touch. */
function askForTilt(): void {
  if (tiltAsked || !('DeviceOrientationEvent' in globalThis)) return;
  tiltAsked = true;
  const { requestPermission } = DeviceOrientationEvent as { requestPermission?: () => Promise<string> };
  if (requestPermission === undefined) watchTilt();
  else {
    requestPermission().then(
      (answer) => {
        if (answer === 'granted') watchTilt();
      },
      () => {
        tiltAsked = false; // the call did not follow a touch
      },
    );
  }
}

// --- The element -----------------------------------------------------------------------------------------------------------

/** The custom element <sillon-view>: docs/guide/embedding.md. */
export class SillonViewElement extends HTMLElement {
  static readonly observedAttributes = attributes;

  readonly #canvas = document.createElement('canvas');
  readonly #poster = document.createElement('img');
  #file: ViewFile | undefined;
  /** True if 'load' was dispatched for the file, which may be decoded many times. */
  #told = false;
  #loading: AbortController | undefined;
  #near = false;
  #visible = false;
  #stale = true;
  #drawnAt = 0;
  #pointer: Light | undefined;
  /** Time at which the light moved last [ms], and its azimuth then [degrees]. An orbit goes on from there. */
  #last = 0;
  #azimuth = 60;
  /** True if `aria-label` repeats `alt`; otherwise the label belongs to the page. */
  #named = false;

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    root.adoptedStyleSheets = [styleSheet()];
    this.#canvas.part.add('canvas');
    this.#poster.part.add('poster');
    this.#poster.alt = '';
    this.#poster.hidden = true;
    this.#canvas.hidden = true;
    root.append(this.#poster, this.#canvas);
    this.addEventListener('pointermove', this.#onPointer);
    this.addEventListener('pointerleave', this.#onLeave);
    this.addEventListener('click', () => {
      if (this.#way() === 'tilt') askForTilt();
    });
  }

  connectedCallback(): void {
    takeOver(this);
    if (!this.hasAttribute('role')) this.setAttribute('role', 'img');
    this.#name();
    this.#showPoster();
    shown.add(this);
    visibility.observe(this);
    nearness.observe(this);
    sizes.observe(this);
    if (this.#way() === 'tilt') askForTilt();
  }

  disconnectedCallback(): void {
    shown.delete(this);
    visibility.unobserve(this);
    nearness.unobserve(this);
    sizes.unobserve(this);
    this.#visible = false;
    this.#near = false;
    this.#drop();
  }

  attributeChangedCallback(name: (typeof attributes)[number]): void {
    if (!this.isConnected) return;
    if (name === 'src') {
      this.#drop();
      if (this.#near) void this.#load();
    }
    if (name === 'poster') this.#showPoster();
    else if (name === 'alt') this.#name();
    else if (name === 'light' && this.#way() === 'tilt') askForTilt();
    this.redraw();
  }

  /** Draws anew in the next frame. */
  redraw(): void {
    this.#stale = true;
    if (this.#visible) nextFrame();
  }

  /** Returns the view's request for this frame; undefined if it has nothing to draw. */
  onFrame(now: number, tilted: Light | undefined): Waiting | undefined {
    const file = this.#file;
    if (!this.#visible || file === undefined || renderer?.holds(file) !== true) return undefined;
    const orbits = this.#orbits(tilted);
    if (!orbits && !this.#stale) return undefined;
    return {
      why: !this.#stale ? 'orbits' : this.#pointer === undefined ? 'stale' : 'led',
      drawnAt: this.#drawnAt,
      fromMiddle: () => {
        const { left, top, width, height } = this.getBoundingClientRect();
        return Math.hypot(left + width / 2 - innerWidth / 2, top + height / 2 - innerHeight / 2);
      },
      draw: () => {
        this.#drawnAt = now;
        this.#draw(file, this.#light(now, tilted));
      },
    };
  }

  onVisible(visible: boolean): void {
    this.#visible = visible;
    if (visible) nextFrame();
  }

  /** Far from the window, a view keeps only the bytes of its file. */
  onNear(near: boolean): void {
    this.#near = near;
    if (!near) this.#release();
    else if (this.#file === undefined) void this.#load();
    else void this.restore();
  }

  // --- Light ----------------------------------------------------------------------------------------------------------------

  #way(): Way {
    return ways.find((way) => way === this.getAttribute('light')) ?? 'pointer';
  }

  #number(name: 'azimuth' | 'elevation', usual: number, min: number, max: number): number {
    const text = this.getAttribute(name)?.trim() ?? '';
    const value = text === '' ? usual : Number(text);
    return Number.isFinite(value) ? Math.min(max, Math.max(min, value)) : usual;
  }

  /** Tells whether the light moves by itself, slowly, while nobody else moves it. */
  #orbits(tilted: Light | undefined): boolean {
    const way = this.#way();
    if (calm.matches || way === 'fixed' || (way === 'tilt' && tilted !== undefined)) return false;
    return way === 'orbit' || this.#pointer === undefined;
  }

  /** Returns the light of this frame, by the attribute `light`. */
  #light(now: number, tilted: Light | undefined): Light {
    const way = this.#way();
    const moved = way === 'tilt' ? (tilted ?? this.#pointer) : way === 'pointer' ? this.#pointer : undefined;
    if (moved !== undefined) {
      this.#azimuth = moved.azimuth;
      this.#last = now;
      return moved;
    }
    if (!this.#orbits(tilted)) {
      return { azimuth: this.#number('azimuth', 60, -360, 360), elevation: this.#number('elevation', 35, 5, 90) };
    }
    // [ms] A longer pause counts as 50 ms, so that the light does not leap.
    this.#azimuth = (this.#azimuth + (360 * Math.min(50, now - this.#last)) / swayPeriod) % 360;
    this.#last = now;
    return { azimuth: this.#azimuth, elevation: swayedElevation(now) };
  }

  readonly #onPointer = ({ clientX, clientY }: PointerEvent): void => {
    const { left, top, width, height } = this.getBoundingClientRect();
    this.#pointer = lightUnder((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
    this.redraw();
  };

  readonly #onLeave = (): void => {
    this.#pointer = undefined;
    this.redraw();
  };

  // --- Pictures --------------------------------------------------------------------------------------------------------------

  #name(): void {
    const alt = this.getAttribute('alt');
    if (alt !== null) this.setAttribute('aria-label', alt);
    else if (this.#named) this.removeAttribute('aria-label');
    this.#named = alt !== null;
  }

  #showPoster(): void {
    const url = this.getAttribute('poster');
    const safe = url !== null && /^(?:https?|blob|data):$/.test(protocolOf(url));
    if (safe) this.#poster.src = url;
    else this.#poster.removeAttribute('src');
    this.#poster.hidden = !safe || !this.#canvas.hidden;
  }

  /** Draws the view into its canvas, at the size of the element. */
  #draw(file: ViewFile, light: Light): void {
    const { clientWidth, clientHeight } = this;
    // A view without a box counts as drawn, too: the resize observer asks again once it has one.
    this.#stale = false;
    if (clientWidth === 0 || clientHeight === 0) return;
    // The canvas has the plate's proportions, within the element's box.
    const scale = Math.min(clientWidth / file.page[0], clientHeight / file.page[1]) * devicePixelRatio;
    const fits = Math.min(1, mostPixels / (scale * Math.max(...file.page)));
    const pixels = (length: number): number => Math.max(1, Math.round(length * scale * fits));
    const [width, height] = [pixels(file.page[0]), pixels(file.page[1])];
    if (this.#canvas.width !== width) this.#canvas.width = width;
    if (this.#canvas.height !== height) this.#canvas.height = height;
    const colour = hexColour(this.getAttribute('colour')) ?? file.colour;
    if (renderer?.draw({ file, colour, light }, this.#canvas) !== true) {
      this.#stale = true; // the context is lost: `restore` draws again when it is back
      return;
    }
    this.#canvas.hidden = false;
    this.#poster.hidden = true;
  }

  /** Loads the file in `src` and decodes it; dispatches 'error' if there is no such view. */
  async #load(): Promise<void> {
    this.#drop();
    const src = this.getAttribute('src');
    if (src === null || src === '') return;
    const loading = new AbortController();
    this.#loading = loading;
    try {
      if (sharedRenderer() === undefined) throw new Error('this browser has no WebGL2');
      if (!/^(?:https?|blob):$/.test(protocolOf(src))) throw new Error(`${protocolOf(src)} addresses are not read`);
      const file = await fetchView(new URL(src, document.baseURI), src, loading.signal);
      if (loading.signal.aborted) return;
      this.#file = file;
    } catch (error) {
      if (!loading.signal.aborted) this.#fail(error);
      return;
    }
    await this.restore();
  }

  #fail(error: unknown): void {
    this.#drop();
    const message = error instanceof Error ? error.message : String(error);
    this.dispatchEvent(new CustomEvent('error', { detail: { code: 'LoadFailed', message } }));
  }

  /** Decodes the file for the renderer, in turn with other views: at first, and again after a release or a lost
   * context. Dispatches 'load' when this succeeds for the first time, and 'error' if it fails. A view that leaves the
   * neighbourhood of the window meanwhile is decoded once it is back. */
  async restore(): Promise<void> {
    const file = this.#file;
    const wanted = (): boolean => this.#near && file !== undefined && this.#file === file;
    try {
      await inTurn(async () => {
        if (file === undefined || !wanted()) return;
        const texels = await decodeView(file, this.getAttribute('src') ?? '');
        if (wanted()) sharedRenderer()?.hold(file, texels);
        texels.close();
        this.redraw();
      });
    } catch (error) {
      if (this.#file === file) this.#fail(error);
      return;
    }
    if (!wanted() || this.#told) return;
    this.#told = true;
    this.dispatchEvent(new CustomEvent('load'));
  }

  /** Frees everything that can be decoded from the file again. */
  #release(): void {
    if (this.#file !== undefined) renderer?.forget(this.#file);
    this.#canvas.hidden = true;
    this.#canvas.width = this.#canvas.height = 0;
    this.#showPoster();
  }

  /** Aborts loading and forgets the file. */
  #drop(): void {
    this.#loading?.abort();
    this.#loading = undefined;
    this.#release();
    this.#file = undefined;
    this.#told = false;
  }
}

/** Re-applies properties that the page set before this script
 * defined the element: they hide the accessors of the class. */
function takeOver(element: HTMLElement): void {
  for (const name of attributes) {
    if (!Object.hasOwn(element, name)) continue;
    const value: unknown = Reflect.get(element, name);
    Reflect.deleteProperty(element, name);
    Reflect.set(element, name, value);
  }
}

/** Reads a colour such as "#c9942e"; undefined if it is malformed. */
function hexColour(text: string | null): ViewFile['colour'] | undefined {
  const found = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(text ?? '');
  if (found === null) return undefined;
  const [, red = '', green = '', blue = ''] = found;
  return [parseInt(red, 16), parseInt(green, 16), parseInt(blue, 16)];
}

const protocolOf = (url: string): string =>
  URL.canParse(url, document.baseURI) ? new URL(url, document.baseURI).protocol : '';

// The element <sillon-studio> repeats this code. The bundler would move shared code into a third file, but each element
// has to be a single file.
for (const name of attributes) {
  Object.defineProperty(SillonViewElement.prototype, name, {
    configurable: true,
    enumerable: true,
    get(this: HTMLElement) {
      return this.getAttribute(name) ?? '';
    },
    set(this: HTMLElement, value: string | null | undefined) {
      if (value === null || value === undefined) this.removeAttribute(name);
      else this.setAttribute(name, value);
    },
  });
}

if (customElements.get('sillon-view') === undefined) customElements.define('sillon-view', SillonViewElement);
