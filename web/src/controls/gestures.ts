// Turns pointers, wheels and pinches on an element into gestures. Places are CSS pixels from its upper left corner.
export interface Place {
  x: number;
  y: number;
}

export interface GestureEvents {
  /** Tells whether this pointer draws or moves an object, instead of the view. */
  draws(event: PointerEvent, place: Place): boolean;
  pan(dx: number, dy: number): void;
  zoom(factor: number, x: number, y: number): void;
  /** Reports the pointer's place; undefined: it has left.
   * @param leads  it floats above the plate, as a finger never does */
  hover(place: Place | undefined, leads: boolean): void;
  begin(place: Place): void;
  draw(place: Place, event: PointerEvent): void;
  end(): void;
  /** Discards a stroke: a second finger has turned it into a pinch. */
  abandon(): void;
}

const wheelStep = 0.0016; // zoom per pixel of a wheel, as a logarithm
const pinchStep = 0.01; // the same for a touchpad's pinch, which arrives as a wheel event with Ctrl
const linePixels = 16;

export class Gestures {
  readonly #pointers = new Map<number, Place>();
  #drawing: number | undefined;
  readonly #end = new AbortController();

  constructor(
    private readonly element: HTMLElement,
    private readonly events: GestureEvents,
  ) {
    const options = { signal: this.#end.signal };
    element.addEventListener('pointerdown', this.#onDown, options);
    element.addEventListener('pointermove', this.#onMove, options);
    element.addEventListener('pointerup', this.#onUp, options);
    element.addEventListener('pointercancel', this.#onUp, options);
    element.addEventListener('pointerleave', this.#onLeave, options);
    element.addEventListener('wheel', this.#onWheel, { ...options, passive: false });
  }

  dispose(): void {
    this.#end.abort();
  }

  #place(event: MouseEvent): Place {
    const { left, top } = this.element.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  }

  /** Begins a stroke or a pan; a second pointer begins a pinch. */
  #onDown = (event: PointerEvent): void => {
    if (event.button > 1) return;
    event.preventDefault();
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    const place = this.#place(event);
    this.#pointers.set(event.pointerId, place);
    if (this.#pointers.size > 1) {
      if (this.#drawing !== undefined) this.events.abandon();
      this.#drawing = undefined;
      return;
    }
    this.events.hover(place, floats(event));
    if (this.events.draws(event, place)) {
      this.#drawing = event.pointerId;
      this.events.begin(place);
    }
  };

  /** Continues the gesture of the pointers that are down, or reports a hover. */
  #onMove = (event: PointerEvent): void => {
    const place = this.#place(event);
    const before = this.#pointers.get(event.pointerId);
    if (before === undefined) {
      this.events.hover(place, floats(event));
      return;
    }
    if (this.#pointers.size === 2) {
      const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
      this.#pointers.set(event.pointerId, place);
      if (other !== undefined) this.#pinch(before, place, other);
      return;
    }
    this.#pointers.set(event.pointerId, place);
    if (this.#drawing === event.pointerId) {
      this.events.hover(place, false);
      for (const each of coalesced(event)) this.events.draw(this.#place(each), event);
    } else if (this.#pointers.size === 1) {
      this.events.pan(place.x - before.x, place.y - before.y);
    }
  };

  #pinch(before: Place, now: Place, other: Place): void {
    const distance = (a: Place): number => Math.hypot(a.x - other.x, a.y - other.y);
    const middle = { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 };
    this.events.pan((now.x - before.x) / 2, (now.y - before.y) / 2);
    if (distance(before) > 1) this.events.zoom(distance(now) / distance(before), middle.x, middle.y);
  }

  #onUp = (event: PointerEvent): void => {
    this.#pointers.delete(event.pointerId);
    if (this.#drawing === event.pointerId) {
      this.#drawing = undefined;
      this.events.end();
    }
    if (event.pointerType !== 'mouse') this.events.hover(undefined, false);
  };

  #onLeave = (event: PointerEvent): void => {
    if (!this.#pointers.has(event.pointerId)) this.events.hover(undefined, false);
  };

  #onWheel = (event: WheelEvent): void => {
    event.preventDefault();
    const { x, y } = this.#place(event);
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? linePixels : 1);
    const limited = Math.min(240, Math.max(-240, pixels));
    this.events.zoom(Math.exp(-limited * (event.ctrlKey ? pinchStep : wheelStep)), x, y);
  };
}

/** Returns all events since the last one; old versions of Safari report only the last. */
function coalesced(event: PointerEvent): PointerEvent[] {
  const events = 'getCoalescedEvents' in event ? event.getCoalescedEvents() : [];
  return events.length > 0 ? events : [event];
}

const floats = ({ pointerType }: PointerEvent): boolean => pointerType !== 'touch';

const stillClick = 5; // [CSS pixels] longest way of a pointer between down and up

/** Listens to clicks that end where they began, so that drags do not count.
 * @param run  receives the place on the element [CSS pixels] */
export function onStillClick(element: HTMLElement, run: (x: number, y: number) => void): void {
  let down = { x: 0, y: 0 };
  element.addEventListener('pointerdown', ({ offsetX: x, offsetY: y }) => {
    down = { x, y };
  });
  element.addEventListener('click', ({ offsetX: x, offsetY: y }) => {
    if (Math.hypot(x - down.x, y - down.y) <= stillClick) run(x, y);
  });
}
