// Detects machines on which drawing is slow, as without a graphics card. On those, each frame waits until the last one
// is visible: otherwise frames would queue up.

const ease = 40; // [ms] per frame that is still fast
const enough = 3; // frames in a row that tell a slow machine from a short moment of other work

export class Pace {
  #slow = false;
  /** Frames in a row that contradict `slow`. */
  #frames = 0;
  #flying = false;

  /** Starts as fast. @param again  called when a frame has come for which another one waited */
  constructor(private readonly again: () => void) {}

  /** True once several frames in a row took longer than `ease`. */
  get slow(): boolean {
    return this.#slow;
  }

  #waits = false;

  /** Tells whether the next frame must wait. @returns true: the last frame is not visible yet */
  holds(): boolean {
    this.#waits = this.#slow && this.#flying;
    return this.#waits;
  }

  /** Measures a frame.
   * @param began  start of the drawing [ms]
   * @param there  resolves when the frame is visible
   * @param now  current time [ms] */
  async follow(began: number, there: Promise<void>, fineness: number, now: () => number): Promise<void> {
    if (this.#flying) return; // if frames overlap, one of them is measured
    this.#flying = true;
    await there;
    this.#flying = false;
    this.#learn((now() - began) / fineness ** 2);
    if (!this.#waits) return;
    this.#waits = false;
    this.again();
  }

  /** Counts frames; a frame at half fineness is judged by the cost that it would have at full fineness. */
  #learn(ms: number): void {
    const other = ms > ease !== this.#slow;
    this.#frames = other ? this.#frames + 1 : 0;
    if (this.#frames < enough) return;
    this.#slow = !this.#slow;
    this.#frames = 0;
  }
}
