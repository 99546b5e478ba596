// The camera above the plate, moved by hand, or placed so that the whole plate is visible between the buttons over it.
import type { StudioElement } from '../controls/element.js';
import { pageOf } from '../model/plate.js';
import type { Shown } from '../studio/shown.js';
import { PageCamera } from '../views/camera.js';
import { freeOf, seenIn, type Box } from '../views/fit.js';
import { rulerWidth } from './overlay.js';
import { blends, compares, isRuled } from './plate-scene.js';

const gap = 0.08; // between plate and zigzag, as a share of the page's width
const margin = 40; // around the plate [CSS pixels]
const toolsWidth = 60;
const narrow = 640; // [CSS pixels] up to this width, buttons lie over the plate
const clear = 4;
const lowest = 440; // [CSS pixels] the stage's style has the same; in a lower bench, the views stand beside the plate
const armLength = 600; // [mm] from the eye to the print
const handLength = 350; // [mm] from the eye to a phone
const mostBlended = 2048; // [pixels] longest side up to which a canvas is drawn at twice the fineness

export class PlateCamera extends PageCamera {
  readonly #coarse = matchMedia('(pointer: coarse)');

  /** Places the camera over the plate.
   * @param watch  calls back when a button's size changes, since the camera must move then */
  constructor(
    private readonly canvas: StudioElement,
    redraw: () => void,
    private readonly watch: (button: Element) => void,
  ) {
    super(canvas, () => pageOf(canvas.state.plate), redraw, { most: 1200, across: 12 });
  }

  get #state(): Readonly<Shown> {
    return this.canvas.state;
  }

  /** Returns the size of the page, with the zigzag beside it if there is one [mm]. */
  #shown(): [number, number] {
    const [width, height] = this.page();
    return [compares(this.#state) ? width * (2 + gap) : width, height];
  }

  /** Returns the place of the page on the canvas [CSS pixels]. */
  plateBox(): { left: number; top: number; width: number; height: number } {
    const [width, height] = this.page();
    const { x: left, y: top } = this.toScreen({ x: 0, y: height });
    return { left, top, width: width * this.cssScale, height: height * this.cssScale };
  }

  /** Returns the pixels drawn per screen pixel, in one direction:
   * details must be drawn finer to blend as they do in the eye. */
  fineness(): number {
    const { width, height } = this.size;
    return blends(this.#state) && Math.max(width, height) * devicePixelRatio <= mostBlended ? 2 : 1;
  }

  /** Moves the camera if the plate, its size on the screen or the buttons over it have changed. */
  follow(now: Readonly<Shown>, before: Readonly<Shown>): void {
    const sized = now.sizing !== before.sizing;
    if (sized && now.sizing !== 'free') this.fitted = true;
    const resized = String(pageOf(now.plate)) !== String(pageOf(before.plate));
    if (sized || resized || compares(now) !== compares(before)) this.keepFitted();
    if (now.view === before.view || !this.fitted) return;
    // Other views have other buttons over the plate.
    const { host } = this.#root;
    void (host as HTMLElement & { updateComplete: Promise<boolean> }).updateComplete.then(() => {
      if (this.size.width <= narrow) this.keepFitted();
    });
  }

  fit(): void {
    this.fitted = true;
    if (this.#state.sizing !== 'whole') this.canvas.studio.store.set({ sizing: 'whole' });
    this.keepFitted();
  }

  move(dx: number, dy: number): void {
    this.pan(dx, dy, 0.5, this.#shown());
  }

  lookAt(x: number, y: number, across: number): void {
    this.now = { x, y, scale: (this.size.width * devicePixelRatio) / across };
    this.letGo();
  }

  protected override letGo(): void {
    if (this.#state.sizing !== 'free') this.canvas.studio.store.set({ sizing: 'free' });
    super.letGo();
  }

  /** Shows the whole plate, or its real size, in the middle of the free area. */
  keepFitted(): void {
    if (!this.fitted) return;
    const { width, height } = this.size;
    const free = width <= narrow || height < lowest ? this.#amongButtons() : this.#betweenBars();
    const scale = this.#state.sizing === 'whole' ? undefined : this.#lifeScale();
    const seen = seenIn(free, this.#shown(), [width, height], scale);
    this.now = { ...seen, scale: seen.scale * devicePixelRatio };
    this.redraw();
  }

  /** Returns CSS pixels per mm at real size; for arm's length, smaller on phones, which are held closer. */
  #lifeScale = (): number => (blends(this.#state) && this.#coarse.matches ? handLength / armLength : 1) * (96 / 25.4);

  get #root(): ShadowRoot {
    return this.canvas.getRootNode() as ShadowRoot;
  }

  /** Returns the area that the buttons of a narrow or low canvas leave free. */
  #amongButtons(): Box {
    const { left: x, top: y, width, height } = this.size;
    const ruler = isRuled(this.#state) ? rulerWidth : 0;
    const area = { left: ruler, top: ruler, right: width, bottom: height };
    // A notice lifts the bars under the plate for a while; the plate stays in place.
    const lift = this.#root.querySelector('sillon-notices')?.clientHeight ?? 0;
    // On a low bench, the buttons at the foot are narrow and lie beside the plate, so they take no height from it.
    const over = height < lowest ? '.views, sillon-tools' : '.views, sillon-tools, .bottom > *';
    const buttons = [...this.#root.querySelectorAll(over)].map((one) => {
      this.watch(one); // the button may not be laid out yet
      const { left, top, right, bottom } = one.getBoundingClientRect();
      const down = (one.matches('.bottom > *') ? lift : 0) - y;
      return { left: left - x, top: top + down, right: right - x, bottom: bottom + down };
    });
    const free = freeOf(area, buttons);
    const enough = free.right - free.left > width / 4 && free.bottom - free.top > height / 4;
    const { left, top, right, bottom } = enough ? free : area;
    return { left: left + clear, top: top + clear, right: right - clear, bottom: bottom - clear };
  }

  /** Returns the area between the bars of a wide canvas. */
  #betweenBars(): Box {
    const { width, height } = this.size;
    const side = isRuled(this.#state) ? toolsWidth + margin : toolsWidth;
    const bars = this.#root.querySelector('.bottom')?.clientHeight ?? 0;
    const bare = this.#state.mode === 'view';
    return {
      left: side,
      right: width - side,
      top: bare ? clear : isRuled(this.#state) ? 2 * margin : margin + 18,
      bottom: height - (bare ? clear : Math.min(bars + 16, height / 2 - margin)),
    };
  }
}
