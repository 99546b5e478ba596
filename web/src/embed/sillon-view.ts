// <sillon-view>: a finished plate that shimmers as the light moves. No WebAssembly, no threads, no dependencies: a small
// picture of directions, and one graphics context for all that are on a page.
import { lightOfTilt, lightUnder, swayedElevation, swayPeriod } from '../views/light.js';
import type { Light } from '../model/view.js';
import { readViewFile, type ViewFile } from './view-file.js';
import { ViewRenderer } from './view-renderer.js';

const attributes = ['src', 'poster', 'alt', 'light', 'azimuth', 'elevation', 'colour'] as const;
const ways = ['pointer', 'tilt', 'orbit', 'fixed'] as const;
type Way = (typeof ways)[number];
const mostPixels = 2048; // of a side

const style = `
  :host { display: block; position: relative; aspect-ratio: 1; }
  :host([hidden]) { display: none; }
  canvas, img { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: contain; }
  [hidden] { display: none; }
`;

// --- What all elements of a page share -------------------------------------------------------------------------------------

const shown = new Set<SillonViewElement>();
const calm = matchMedia('(prefers-reduced-motion: reduce)');
let sheet: CSSStyleSheet | undefined;
let renderer: ViewRenderer | undefined;
let noRenderer = false;
let frame = 0;
let tilt: Light | undefined;

function styleSheet(): CSSStyleSheet {
  if (sheet === undefined) {
    sheet = new CSSStyleSheet(); // not a style element, which a page's policy may forbid
    sheet.replaceSync(style);
  }
  return sheet;
}

function sharedRenderer(): ViewRenderer | undefined {
  if (renderer !== undefined || noRenderer) return renderer;
  try {
    renderer = new ViewRenderer(() => {
      for (const element of shown) element.redraw();
    });
  } catch {
    noRenderer = true;
  }
  return renderer;
}

/** One loop for all; it ends when nothing moves. */
function nextFrame(): void {
  if (frame !== 0) return;
  frame = requestAnimationFrame((now) => {
    frame = 0;
    let moves = false;
    for (const element of shown) moves = element.onFrame(now, tilt) || moves;
    if (moves) nextFrame();
  });
}

const visibility = new IntersectionObserver((entries) => {
  for (const { target, isIntersecting } of entries) {
    if (target instanceof SillonViewElement) target.onVisible(isIntersecting);
  }
});
const sizes = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    if (target instanceof SillonViewElement) target.redraw();
  }
});

function watchTilt(): void {
  addEventListener('deviceorientation', ({ beta, gamma }) => {
    if (beta === null || gamma === null) return;
    tilt = lightOfTilt(beta, gamma);
    for (const element of shown) element.redraw();
  });
}

let tiltAsked = false;

/** Phones of one maker ask their owner, and only after a touch. */
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
        tiltAsked = false; // it was no touch
      },
    );
  }
}

// --- The element -----------------------------------------------------------------------------------------------------------

export class SillonViewElement extends HTMLElement {
  static readonly observedAttributes = attributes;

  readonly #canvas = document.createElement('canvas');
  readonly #poster = document.createElement('img');
  #file: ViewFile | undefined;
  #loading: AbortController | undefined;
  #visible = false;
  #stale = true;
  #pointer: Light | undefined;
  #last = 0;
  #azimuth = 60;

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
    if (!this.hasAttribute('role')) this.setAttribute('role', 'img');
    this.#name();
    this.#showPoster();
    shown.add(this);
    visibility.observe(this);
    sizes.observe(this);
    if (this.#way() === 'tilt') askForTilt();
    if (this.#file === undefined) void this.#load();
  }

  disconnectedCallback(): void {
    shown.delete(this);
    visibility.unobserve(this);
    sizes.unobserve(this);
    this.#drop();
  }

  attributeChangedCallback(name: (typeof attributes)[number]): void {
    if (!this.isConnected) return;
    if (name === 'src') void this.#load();
    else if (name === 'poster') this.#showPoster();
    else if (name === 'alt') this.#name();
    else if (name === 'light' && this.#way() === 'tilt') askForTilt();
    this.redraw();
  }

  /** Draws anew, in the next frame. */
  redraw(): void {
    this.#stale = true;
    if (this.#visible) nextFrame();
  }

  /** @returns whether its light goes on moving */
  onFrame(now: number, tilted: Light | undefined): boolean {
    if (!this.#visible || this.#file === undefined) return false;
    const light = this.#light(now, tilted);
    const moves = this.#orbits(tilted);
    if (moves || this.#stale) this.#draw(light);
    return moves;
  }

  onVisible(visible: boolean): void {
    this.#visible = visible;
    if (visible) nextFrame();
  }

  // --- Light ----------------------------------------------------------------------------------------------------------------

  #way(): Way {
    return ways.find((way) => way === this.getAttribute('light')) ?? 'pointer';
  }

  #number(name: 'azimuth' | 'elevation', usual: number, min: number, max: number): number {
    const value = Number(this.getAttribute(name) ?? usual);
    return Number.isFinite(value) ? Math.min(max, Math.max(min, value)) : usual;
  }

  /** Moves by itself, slowly, while nobody else moves it. */
  #orbits(tilted: Light | undefined): boolean {
    const way = this.#way();
    if (calm.matches || way === 'fixed' || (way === 'tilt' && tilted !== undefined)) return false;
    return way === 'orbit' || this.#pointer === undefined;
  }

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
    // From where it was left, without a leap after a pause.
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
  }

  #showPoster(): void {
    const url = this.getAttribute('poster');
    const safe = url !== null && /^(?:https?|blob|data):$/.test(protocolOf(url));
    if (safe) this.#poster.src = url;
    else this.#poster.removeAttribute('src');
    this.#poster.hidden = !safe || !this.#canvas.hidden;
  }

  #draw(light: Light): void {
    const file = this.#file;
    const drawer = sharedRenderer();
    if (file === undefined || drawer === undefined) return;
    const { clientWidth, clientHeight } = this;
    if (clientWidth === 0 || clientHeight === 0) return;
    // The plate's proportions, within the element's box.
    const scale = Math.min(clientWidth / file.page[0], clientHeight / file.page[1]) * devicePixelRatio;
    const fits = Math.min(1, mostPixels / (scale * Math.max(...file.page)));
    const pixels = (length: number): number => Math.max(1, Math.round(length * scale * fits));
    const [width, height] = [pixels(file.page[0]), pixels(file.page[1])];
    if (this.#canvas.width !== width) this.#canvas.width = width;
    if (this.#canvas.height !== height) this.#canvas.height = height;
    const colour = hexColour(this.getAttribute('colour')) ?? file.colour;
    const drawn = drawer.draw({ file, colour, light }, this.#canvas);
    this.#stale = !drawn;
    if (drawn) {
      this.#canvas.hidden = false;
      this.#poster.hidden = true;
    }
  }

  async #load(): Promise<void> {
    this.#drop();
    const src = this.getAttribute('src');
    if (src === null || src === '') return;
    const loading = new AbortController();
    this.#loading = loading;
    try {
      if (sharedRenderer() === undefined) throw new Error('this browser has no WebGL2');
      if (!/^(?:https?|blob):$/.test(protocolOf(src))) throw new Error(`${protocolOf(src)} addresses are not read`);
      const response = await fetch(new URL(src, document.baseURI), { signal: loading.signal });
      if (!response.ok) throw new Error(`${src} came with status ${response.status}`);
      const file = await readViewFile(await response.arrayBuffer(), src);
      if (loading.signal.aborted) return;
      this.#file = file;
      this.dispatchEvent(new CustomEvent('load'));
      this.redraw();
    } catch (error) {
      if (loading.signal.aborted) return;
      const message = error instanceof Error ? error.message : String(error);
      this.dispatchEvent(new CustomEvent('error', { detail: { code: 'LoadFailed', message } }));
    }
  }

  #drop(): void {
    this.#loading?.abort();
    this.#loading = undefined;
    if (this.#file !== undefined) {
      renderer?.forget(this.#file);
      this.#file.texels.close();
    }
    this.#file = undefined;
    this.#canvas.hidden = true;
    this.#showPoster();
  }
}

/** "#c9942e" */
function hexColour(text: string | null): ViewFile['colour'] | undefined {
  const found = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(text ?? '');
  if (found === null) return undefined;
  const [, red = '', green = '', blue = ''] = found;
  return [parseInt(red, 16), parseInt(green, 16), parseInt(blue, 16)];
}

const protocolOf = (url: string): string =>
  URL.canParse(url, document.baseURI) ? new URL(url, document.baseURI).protocol : '';

// Here and not beside the other element: what two entries share becomes a file of its own, and each must be one file.
for (const name of attributes) {
  Object.defineProperty(SillonViewElement.prototype, name, {
    configurable: true,
    enumerable: true,
    get(this: HTMLElement) {
      return this.getAttribute(name) ?? '';
    },
    set(this: HTMLElement, value: string | null) {
      if (value === null) this.removeAttribute(name);
      else this.setAttribute(name, value);
    },
  });
}

if (customElements.get('sillon-view') === undefined) customElements.define('sillon-view', SillonViewElement);
