// Tells where it is hard to draw, as without a graphics card. There no frame is drawn before the last one is to be seen: they would
// queue up behind each other.

const ease = 40; // [ms] for a frame
const enough = 3; // frames in a row that tell a slow machine from a moment of work

export class Pace {
  #slow = false;
  /** In a row, of the other kind. */
  #frames = 0;
  #flying = false;

  /** @param again  is called when a frame has come for which another has waited */
  constructor(private readonly again: () => void) {}

  /** True once several frames in a row took longer than `ease`. */
  get slow(): boolean {
    return this.#slow;
  }

  #waits = false;

  /** @returns whether there must not be another frame yet */
  holds(): boolean {
    this.#waits = this.#slow && this.#flying;
    return this.#waits;
  }

  /** A frame is drawn. @param began  when [ms] @param there  when it is to be seen @param now  the time [ms] */
  async follow(began: number, there: Promise<void>, fineness: number, now: () => number): Promise<void> {
    if (this.#flying) return; // of several one is measured
    this.#flying = true;
    await there;
    this.#flying = false;
    this.#learn((now() - began) / fineness ** 2);
    if (!this.#waits) return;
    this.#waits = false;
    this.again();
  }

  /** Half as fine a frame that would be slow if it were whole says that this is no machine for more. */
  #learn(ms: number): void {
    const other = ms > ease !== this.#slow;
    this.#frames = other ? this.#frames + 1 : 0;
    if (this.#frames < enough) return;
    this.#slow = !this.#slow;
    this.#frames = 0;
  }
}
