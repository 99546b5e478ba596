// Decides how many views are drawn in each frame, and in what order, so that the page around them stays smooth: without
// graphics hardware, a single picture takes longer than a frame.

/** A view that asks to be drawn. */
export interface Waiting {
  /** 'led': somebody moves its light; 'stale': it shows an old state; 'orbits': its light moves by itself. */
  readonly why: 'led' | 'stale' | 'orbits';
  /** Time of its last drawing [ms]. */
  readonly drawnAt: number;
  /** Distance from the middle of the window [px]; computed only if not all views can orbit. */
  fromMiddle(): number;
  draw(): void;
}

const share = 4; // [ms] drawing time in each frame
const mostOfFrame = 12; // views
const fluent = 6; // pictures per second; a light that would orbit more slowly stays still
const framesPerSecond = 60;
const order = ['led', 'stale', 'orbits'] as const;

/** Returns the page's loss for a picture of that cost [ms]: a
 * picture longer than the share makes the page drop whole frames. */
const lost = (cost: number): number => (cost > share ? 2 * cost : cost);

/** Shares each frame's drawing time among all views of a page. */
export class FrameBudget {
  /** Time taken beyond the share [ms]; the next frames draw less for it. */
  #debt = 0;
  /** Running mean of the cost of a picture [ms]. */
  #cost = 1;
  readonly #clock: () => number;

  constructor(clock = () => performance.now()) {
    this.#clock = clock;
  }

  /** Draws the most urgent views; called once in each frame. */
  spend(waiting: readonly Waiting[]): void {
    this.#debt = Math.max(0, this.#debt - share);
    if (this.#debt > 0) return;
    const turns = [...waiting.filter(({ why }) => why !== 'orbits'), ...this.#orbiting(waiting)].sort(
      (a, b) => order.indexOf(a.why) - order.indexOf(b.why) || a.drawnAt - b.drawnAt,
    );
    for (const one of turns.slice(0, mostOfFrame)) {
      const begin = this.#clock();
      one.draw();
      const cost = this.#clock() - begin;
      this.#cost += 0.2 * (cost - this.#cost);
      this.#debt += lost(cost);
      if (this.#debt >= share) return;
    }
  }

  /** Returns the orbiting views that can be drawn fluently, at least one: those nearest to the middle of the window. */
  #orbiting(waiting: readonly Waiting[]): Waiting[] {
    const all = waiting.filter(({ why }) => why === 'orbits');
    const most = Math.max(1, Math.floor((framesPerSecond * share) / lost(this.#cost) / fluent));
    if (all.length <= most) return all;
    const places = new Map(all.map((one) => [one, one.fromMiddle()]));
    return all.sort((a, b) => (places.get(a) ?? 0) - (places.get(b) ?? 0)).slice(0, most);
  }
}
