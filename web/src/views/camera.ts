// The camera over a page: moved by hand, and what lies where on the page and on the screen.
import type { Camera } from './scene.js';

/** Nearer by a factor, with the same place [mm] under the pointer. @param least, most  pixels per mm */
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

/** Dragged along [pixels, y down]. Its middle leaves the page by no more than a share of the page's sides. */
export function panned(camera: Camera, dx: number, dy: number, page: readonly [number, number], share: number): Camera {
  const within = (value: number, length: number): number =>
    Math.min((1 + share) * length, Math.max(-share * length, value));
  return {
    ...camera,
    x: within(camera.x - dx / camera.scale, page[0]),
    y: within(camera.y + dy / camera.scale, page[1]),
  };
}

/** Looks down at a page [mm] on an element of the screen. */
export class PageCamera {
  /** Pixels of the screen. */
  now: Camera = { x: 0, y: 0, scale: 1 };
  /** Nobody has moved it: it fits whatever size the page and the element get. */
  fitted = true;

  constructor(
    private readonly element: Element,
    /** Its sides. */
    protected readonly page: () => readonly [number, number],
    protected readonly redraw: () => void,
    /** How near and how far it goes: CSS pixels per mm at most, and screens across the page's longer side. */
    private readonly limits: { most: number; across: number },
  ) {}

  /** Of the element [CSS pixels]. */
  protected get size(): DOMRect {
    return this.element.getBoundingClientRect();
  }

  /** CSS pixels per mm. */
  get cssScale(): number {
    return this.now.scale / devicePixelRatio;
  }

  /** Millimetres under a point of the element. */
  toPage({ x, y }: { x: number; y: number }): { x: number; y: number } {
    const { width, height } = this.size;
    return { x: this.now.x + (x - width / 2) / this.cssScale, y: this.now.y - (y - height / 2) / this.cssScale };
  }

  /** The point of the element over a place of the page [mm]. */
  toScreen({ x, y }: { x: number; y: number }): { x: number; y: number } {
    const { width, height } = this.size;
    return { x: width / 2 + (x - this.now.x) * this.cssScale, y: height / 2 - (y - this.now.y) * this.cssScale };
  }

  zoom(factor: number, x = this.size.width / 2, y = this.size.height / 2): void {
    const { most, across } = this.limits;
    const least = (this.size.width * devicePixelRatio) / (across * Math.max(...this.page()));
    this.now = zoomed(this.now, this.toPage({ x, y }), factor, least, most * devicePixelRatio);
    this.letGo();
  }

  /** @param share  as `panned` has it @param page  with what stands beside it */
  pan(dx: number, dy: number, share: number, page = this.page()): void {
    this.now = panned(this.now, dx * devicePixelRatio, dy * devicePixelRatio, page, share);
    this.fitted = false;
    this.redraw();
  }

  protected letGo(): void {
    this.fitted = false;
    this.redraw();
  }
}
