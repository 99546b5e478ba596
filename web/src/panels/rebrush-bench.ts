// A sliced print from above: its relief, the outlines of its top faces, and the new beads under the light. Moved by hand,
// wheel and keys; a click chooses a face.
import { css, html, LitElement, type PropertyValues, type TemplateResult } from 'lit';
import type { Cycle, PrintRelief, Toolpath } from 'sillon';
import { customElement, property, query } from 'lit/decorators.js';
import { r } from '../i18n/rebrush.js';
import { t } from '../i18n/text.js';
import { appearance } from '../model/appearance.js';
import type { Face } from '../model/rebrush.js';
import type { FilamentLook, Light } from '../model/view.js';
import { bench } from '../style/bench.js';
import { controls } from '../style/controls.js';
import { panned, zoomed } from '../views/camera.js';
import { lightUnder } from '../views/light.js';
import { shadedRelief } from '../views/relief.js';
import { createRenderer } from '../views/renderer.js';
import type { Camera, Renderer } from '../views/scene.js';
import { Gestures } from './gestures.js';
import { icon } from './icons.js';

const margin = 24; // [CSS pixels] around the print
const closest = 400; // [CSS pixels per mm]
const stillClick = 5; // [CSS pixels] that a pointer may move between down and up
const fewFaces = 60; // glow is slow to draw
const above = 0.1; // [mm] by which what hides a face is higher

interface Outline {
  index: number;
  parts: { path: Path2D; rule: CanvasFillRule }[];
  /** What of it is not under the rest of the print. */
  seen: Path2D;
}

function addLine(path: Path2D, points: ArrayLike<number>): void {
  for (let k = 0; k + 1 < points.length; k += 2) {
    const [x, y] = [points[k] as number, points[k + 1] as number];
    if (k === 0) path.moveTo(x, y);
    else path.lineTo(x, y);
  }
}

@customElement('sillon-rebrush-bench')
export class RebrushBench extends LitElement {
  static override styles = [
    controls,
    bench,
    css`
      .overlay.hits {
        cursor: pointer;
      }
      .zoom {
        position: absolute;
        right: 8px;
        bottom: 8px;
        display: flex;
        border: 1px solid var(--line);
        border-radius: var(--radius-large);
        background: var(--surface);
        box-shadow: var(--lift);
      }
    `,
  ];

  @property({ attribute: false }) relief: PrintRelief | undefined;
  @property({ attribute: false }) faces: readonly Face[] = [];
  @property({ attribute: false }) chosen: ReadonlySet<number> = new Set();
  /** New beads of a face, on its page. */
  @property({ attribute: false }) laid: ReadonlyMap<number, readonly Cycle[]> = new Map<number, readonly Cycle[]>();
  /** The face that is pointed at elsewhere. */
  @property({ attribute: false }) marked: number | undefined;
  /** Where the light rests. */
  @property({ attribute: false }) home: Light = { azimuth: 60, elevation: 35 };
  @property({ attribute: false }) filament!: FilamentLook;
  /** Pictures are solved for an eye far above. */
  @property({ type: Boolean }) lit = false;
  @property({ type: Boolean }) dark = false;

  @query('.ground') private ground!: HTMLCanvasElement;
  @query('.beads') private beads!: HTMLCanvasElement;
  @query('.overlay') private overlay!: HTMLCanvasElement;

  #renderer: Renderer | undefined;
  #gestures: Gestures | undefined;
  #observer: ResizeObserver | undefined;
  #camera: Camera = { x: 0, y: 0, scale: 1 };
  #fitted = true;
  #frame = 0;
  #pointed: number | undefined;
  #light: Light | undefined;
  #downAt = { x: 0, y: 0 };
  /** Lower left corner of what is shown, on the bed, and its size [mm]. */
  #corner: readonly [number, number] = [0, 0];
  #page: [number, number] = [1, 1];
  #picture: OffscreenCanvas | undefined;
  #outlines: Outline[] = [];
  #toolpath: Toolpath | undefined;

  override render(): TemplateResult {
    const zoom = (name: 'minus' | 'plus' | 'fit', label: string, run: () => void): TemplateResult =>
      html`<button type="button" class="plain square" aria-label=${label} title=${label} @click=${run}>
        ${icon(name, 16)}
      </button>`;
    return html`<canvas class="ground" aria-hidden="true"></canvas><canvas class="beads" aria-hidden="true"></canvas
      ><canvas class="overlay" tabindex="0" role="application" aria-label=${r('bench')}></canvas>
      <div class="zoom" role="group" aria-label=${t('section.view')}>
        ${zoom('minus', t('verb.zoomOut'), () => {
          this.#zoom(1 / 1.4);
        })}
        ${zoom('plus', t('verb.zoomIn'), () => {
          this.#zoom(1.4);
        })}
        ${zoom('fit', t('verb.fit'), () => {
          this.#fit();
        })}
      </div>`;
  }

  override firstUpdated(): void {
    try {
      this.#renderer = createRenderer(this.beads);
    } catch {
      this.#renderer = undefined; // outlines and relief are there without it
    }
    this.#gestures = new Gestures(this.overlay, {
      draws: () => false,
      pan: (dx, dy) => {
        this.#move(dx, dy);
      },
      zoom: (factor, x, y) => {
        this.#zoom(factor, x, y);
      },
      hover: (place) => {
        this.#hover(place);
      },
      begin: () => undefined,
      draw: () => undefined,
      end: () => undefined,
      abandon: () => undefined,
    });
    this.overlay.addEventListener('pointerdown', ({ offsetX: x, offsetY: y }) => {
      this.#downAt = { x, y };
    });
    this.overlay.addEventListener('click', ({ offsetX: x, offsetY: y }) => {
      if (Math.hypot(x - this.#downAt.x, y - this.#downAt.y) > stillClick) return;
      const index = this.#faceAt(x, y);
      if (index !== undefined) this.dispatchEvent(new CustomEvent('toggle-face', { detail: index }));
    });
    this.overlay.addEventListener('keydown', this.#onKey);
    this.#observer = new ResizeObserver(() => {
      this.#resize();
    });
    this.#observer.observe(this);
  }

  override updated(changed: PropertyValues<this>): void {
    if (changed.has('relief') || changed.has('faces')) this.#lay();
    if (changed.has('dark') || changed.has('relief')) this.#shade();
    if (changed.has('laid') || changed.has('chosen') || changed.has('faces') || changed.has('relief')) this.#join();
    this.#redraw();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    cancelAnimationFrame(this.#frame);
    this.#observer?.disconnect();
    this.#gestures?.dispose();
    this.#renderer?.dispose();
  }

  // --- What is shown ------------------------------------------------------------------------------------------------------

  /** Places the page, and the outlines on it. */
  #lay(): void {
    const { relief, faces } = this;
    if (relief !== undefined) {
      this.#corner = relief.corner;
      this.#page = [relief.columns * relief.cell, relief.rows * relief.cell];
    } else if (faces.length > 0) {
      const least = (k: 0 | 1): number => Math.min(...faces.map(({ corner }) => corner[k]));
      const most = (k: 0 | 1): number => Math.max(...faces.map(({ corner, region }) => corner[k] + region.page[k]));
      this.#corner = [least(0), least(1)];
      this.#page = [most(0) - least(0), most(1) - least(1)];
    }
    // The lowest first: what lies above is drawn later, and is what a click means.
    this.#outlines = [...faces]
      .sort((a, b) => a.z - b.z || b.areaMm2 - a.areaMm2)
      .map((face) => {
        const seen = new Path2D();
        const parts = face.region.paths.map(({ fillRule, rings }) => {
          const path = new Path2D();
          for (const ring of rings) {
            const points = this.#shifted(ring, face);
            addLine(path, points);
            path.closePath();
            for (const run of this.#seenRuns(points, face.z)) addLine(seen, run);
          }
          return { path, rule: fillRule };
        });
        return { index: face.index, parts, seen };
      });
    if (this.#fitted) this.#fit();
  }

  /** Points of a face's own page on that of the print. */
  #shifted<Points extends Float32Array | Float64Array>(points: Points, { corner }: Face): Points {
    const [dx, dy] = [corner[0] - this.#corner[0], corner[1] - this.#corner[1]];
    return points.map((value, k) => value + (k % 2 === 0 ? dx : dy)) as Points;
  }

  /** Whether nothing of the print lies above this place. */
  #isSeen(x: number, y: number, z: number): boolean {
    const { relief } = this;
    if (relief === undefined) return true;
    const [column, row] = [Math.floor(x / relief.cell), relief.rows - 1 - Math.floor(y / relief.cell)];
    if (column < 0 || row < 0 || column >= relief.columns || row >= relief.rows) return true;
    return (relief.heights[row * relief.columns + column] as number) < z + above;
  }

  /** The stretches of a closed line that are seen; the whole of it comes back to its beginning. */
  #seenRuns(points: ArrayLike<number>, z: number): number[][] {
    const runs: number[][] = [];
    let run: number[] = [];
    for (let k = 0; k <= points.length; k += 2) {
      const [x, y] = [points[k % points.length] as number, points[(k + 1) % points.length] as number];
      if (this.#isSeen(x, y, z)) run.push(x, y);
      else if (run.length > 0) {
        runs.push(run);
        run = [];
      }
    }
    return run.length > 0 ? [...runs, run] : runs;
  }

  #shade(): void {
    const { relief } = this;
    this.#picture = undefined;
    if (relief === undefined) return;
    const picture = new OffscreenCanvas(relief.columns, relief.rows);
    const pixels = shadedRelief(relief, this.dark ? [128, 134, 140] : [206, 204, 198]);
    picture.getContext('2d')?.putImageData(new ImageData(pixels, relief.columns, relief.rows), 0, 0);
    this.#picture = picture;
  }

  /** One toolpath of the new beads of all chosen faces, without what lies under the rest of the print. */
  #join(): void {
    const cycles = this.#outlines.flatMap(({ index }) => {
      const face = this.faces.find((one) => one.index === index);
      if (face === undefined || !this.chosen.has(index)) return [];
      return (this.laid.get(index) ?? []).flatMap(({ points, widths }) =>
        this.#seenCycles(this.#shifted(points, face), widths, face.z),
      );
    });
    const spacing = this.faces[0]?.spacing ?? 0.4;
    this.#toolpath =
      cycles.length === 0 ? undefined : { spacing, cycles, shape: { page: this.#page, paths: [] }, notes: [] };
  }

  /** The renderer draws closed lines: a stretch of one goes to its end and back again. */
  #seenCycles(points: Float32Array, widths: Float32Array, z: number): Cycle[] {
    type Place = [x: number, y: number, width: number];
    const runs: number[][] = [];
    let run: number[] = [];
    let hidden = 0;
    let last: Place = [0, 0, 0];
    /** @param stays  it is a point of the line, not one between */
    const pass = (place: Place, stays: boolean): void => {
      if (this.#isSeen(place[0], place[1], z)) {
        if (stays || run.length === 0) run.push(...place);
      } else {
        ++hidden;
        if (run.length > 0) runs.push([...run, ...last]);
        run = [];
      }
      last = place;
    };
    const at = (k: number): Place => {
      const from = k % widths.length;
      return [points[2 * from] as number, points[2 * from + 1] as number, widths[from] as number];
    };
    // Between its points too: a bead may pass under what lies above.
    const step = 2 * (this.relief?.cell ?? 1);
    for (let k = 0; k < widths.length; ++k) {
      const [from, to] = [at(k), at(k + 1)];
      const pieces = Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / step);
      pass(from, true);
      for (let piece = 1; piece < pieces; ++piece) {
        const share = piece / pieces;
        pass(from.map((value, n) => value + share * ((to[n] as number) - value)) as Place, false);
      }
    }
    if (hidden === 0) return [{ points, widths }];
    if (run.length > 0) runs.push(run);
    return runs.map((line) => {
      const count = line.length / 3;
      const places = Array.from(
        { length: Math.max(1, 2 * count - 2) },
        (_, k) => 3 * (k < count ? k : 2 * count - 2 - k),
      );
      return {
        points: Float32Array.from(places.flatMap((k) => line.slice(k, k + 2))),
        widths: Float32Array.from(places, (k) => line[k + 2] as number),
      };
    });
  }

  #redraw(): void {
    if (this.#frame !== 0 || !this.isConnected) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      this.#draw();
    });
  }

  #draw(): void {
    this.#drawGround();
    this.#renderer?.draw(
      {
        page: this.#page,
        toolpath: this.#toolpath,
        directions: undefined,
        view: 'appearance',
        colourBy: 'direction',
        lampSlope: appearance.softbox,
        fromAfar: this.lit,
        feed: { speed: 1, maxFlow: 1, layerHeight: 1 },
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
    const [wide, tall] = this.#page;
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
    const [accent, soft] = [styles.getPropertyValue('--accent'), styles.getPropertyValue('--soft')];
    const pixel = devicePixelRatio / scale;
    const glows = this.#outlines.length <= fewFaces;
    for (const { index, parts, seen } of this.#outlines) {
      const chosen = this.chosen.has(index);
      const pointed = index === this.#pointed || index === this.marked;
      context.strokeStyle = chosen ? accent : soft;
      context.fillStyle = accent;
      context.lineWidth = (pointed ? 3 : chosen ? 1.75 : 1.25) * pixel;
      context.setLineDash(chosen ? [] : [4 * pixel, 4 * pixel]);
      context.shadowColor = chosen && glows ? accent : 'transparent';
      context.shadowBlur = 12 * devicePixelRatio;
      for (const { path, rule } of parts) {
        context.globalAlpha = chosen && !this.laid.has(index) ? 0.3 : pointed ? 0.12 : 0;
        if (context.globalAlpha > 0) context.fill(path, rule);
      }
      context.globalAlpha = 1;
      context.stroke(seen);
    }
  }

  // --- Camera and pointer ---------------------------------------------------------------------------------------------------

  #resize(): void {
    const { width, height } = this.getBoundingClientRect();
    if (width === 0 || height === 0) return;
    const [columns, rows] = [Math.round(width * devicePixelRatio), Math.round(height * devicePixelRatio)];
    for (const canvas of [this.ground, this.overlay]) {
      canvas.width = columns;
      canvas.height = rows;
    }
    this.#renderer?.resize(columns, rows);
    if (this.#fitted) this.#fit();
    this.#draw();
  }

  #fit(): void {
    const { width, height } = this.getBoundingClientRect();
    const room = (length: number): number => Math.max(1, length - 2 * Math.min(margin, length * 0.06));
    const scale = Math.min(room(width) / this.#page[0], room(height) / this.#page[1]);
    this.#camera = { x: this.#page[0] / 2, y: this.#page[1] / 2, scale: scale * devicePixelRatio };
    this.#fitted = true;
    this.#redraw();
  }

  /** Millimetres of the page under a point of the element. */
  #toPage(x: number, y: number): [number, number] {
    const { left, bottom, scale } = this.#place();
    return [(x * devicePixelRatio - left) / scale, (bottom - y * devicePixelRatio) / scale];
  }

  #zoom(factor: number, x?: number, y?: number): void {
    const { width, height } = this.getBoundingClientRect();
    const [atX, atY] = this.#toPage(x ?? width / 2, y ?? height / 2);
    const least = (width * devicePixelRatio) / (8 * Math.max(...this.#page));
    const at = { x: atX, y: atY };
    this.#camera = zoomed(this.#camera, at, factor, least, closest * devicePixelRatio);
    this.#fitted = false;
    this.#redraw();
  }

  #move(dx: number, dy: number): void {
    const ratio = devicePixelRatio;
    this.#camera = panned(this.#camera, dx * ratio, dy * ratio, this.#page, 0.4);
    this.#fitted = false;
    this.#redraw();
  }

  #onKey = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 80 : 24;
    const keys: Record<string, () => void> = {
      ArrowLeft: () => {
        this.#move(step, 0);
      },
      ArrowRight: () => {
        this.#move(-step, 0);
      },
      ArrowUp: () => {
        this.#move(0, step);
      },
      ArrowDown: () => {
        this.#move(0, -step);
      },
      '+': () => {
        this.#zoom(1.25);
      },
      '-': () => {
        this.#zoom(0.8);
      },
      '0': () => {
        this.#fit();
      },
    };
    const run = keys[event.key === '=' ? '+' : event.key];
    if (run === undefined) return;
    run();
    event.preventDefault();
    event.stopPropagation();
  };

  /** The highest of those that lie there, one above the other. */
  #faceAt(x: number, y: number): number | undefined {
    const context = this.overlay.getContext('2d');
    if (context === null) return undefined;
    context.setTransform(1, 0, 0, 1, 0, 0);
    const [u, v] = this.#toPage(x, y);
    const hit = this.#outlines.filter(({ parts }) =>
      parts.some(({ path, rule }) => context.isPointInPath(path, u, v, rule)),
    );
    return hit.at(-1)?.index;
  }

  #hover(place: { x: number; y: number } | undefined): void {
    const { width, height } = this.getBoundingClientRect();
    this.#pointed = place === undefined ? undefined : this.#faceAt(place.x, place.y);
    this.#light =
      place === undefined
        ? undefined
        : lightUnder((place.x - width / 2) / (width / 2), (height / 2 - place.y) / (height / 2));
    this.overlay.classList.toggle('hits', this.#pointed !== undefined);
    this.#redraw();
  }
}
