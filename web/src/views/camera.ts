// Camera over a page: zooming and panning by hand, and the mapping between page and screen.
import type { Camera } from './scene.js';

/** Zooms by a factor; the place under the pointer [mm] stays.
 * @param least, most  limits of the scale [pixels per mm] */
export function zoomed(
  camera: Camera,
  at: { x: number; y: number },
  factor: number,
  least: number,
  most: number,
): Camera {
  const scale = Math.min(most, Math.max(least, camera.scale * factor));
  const share = camera.scale / scale;
  return { x: at.x + (camera.x - at.x) * share, y: at.y + (camera.y - at.y) * share, scale };
}

/** Pans by a drag [pixels, y down]. The camera's middle leaves the page by no more than a share of the page's sides. */
export function panned(camera: Camera, dx: number, dy: number, page: readonly [number, number], share: number): Camera {
  const within = (value: number, length: number): number =>
    Math.min((1 + share) * length, Math.max(-share * length, value));
  return {
    ...camera,
    x: within(camera.x - dx / camera.scale, page[0]),
    y: within(camera.y + dy / camera.scale, page[1]),
  };
}

/** Camera of an element that looks straight down at a page [mm]. */
export class PageCamera {
  /** Current camera, in pixels of the screen. */
  now: Camera = { x: 0, y: 0, scale: 1 };
  /** The user has not moved the camera yet: it fits whatever size the page and the element get. */
  fitted = true;

  constructor(
    private readonly element: Element,
    /** Sides of the page [mm]. */
    protected readonly page: () => readonly [number, number],
    protected readonly redraw: () => void,
    /** Limits of the zoom: CSS pixels per mm at most, and `across`
     * longer sides of the page per screen width at most. */
    private readonly limits: { most: number; across: number },
  ) {}

  /** Position and size of the element [CSS pixels]. */
  protected get size(): DOMRect {
    return this.element.getBoundingClientRect();
  }

  /** Scale in CSS pixels per mm. */
  get cssScale(): number {
    return this.now.scale / devicePixelRatio;
  }

  /** Returns the place of the page [mm] under a point of the element. */
  toPage({ x, y }: { x: number; y: number }): { x: number; y: number } {
    const { width, height } = this.size;
    return { x: this.now.x + (x - width / 2) / this.cssScale, y: this.now.y - (y - height / 2) / this.cssScale };
  }

  /** Returns the point of the element over a place of the page [mm]. */
  toScreen({ x, y }: { x: number; y: number }): { x: number; y: number } {
    const { width, height } = this.size;
    return { x: width / 2 + (x - this.now.x) * this.cssScale, y: height / 2 - (y - this.now.y) * this.cssScale };
  }

  /** Zooms around a point of the element, within the limits. */
  zoom(factor: number, x = this.size.width / 2, y = this.size.height / 2): void {
    const { most, across } = this.limits;
    const least = (this.size.width * devicePixelRatio) / (across * Math.max(...this.page()));
    this.now = zoomed(this.now, this.toPage({ x, y }), factor, least, most * devicePixelRatio);
    this.letGo();
  }

  /** Pans by a drag [CSS pixels]. @param share  largest share that leaves the page, see `panned`
   * @param page  sides of the page, with what stands beside it */
  pan(dx: number, dy: number, share: number, page = this.page()): void {
    this.now = panned(this.now, dx * devicePixelRatio, dy * devicePixelRatio, page, share);
    this.fitted = false;
    this.redraw();
  }

  /** Marks the camera as moved by hand and draws again. */
  protected letGo(): void {
    this.fitted = false;
    this.redraw();
  }
}
