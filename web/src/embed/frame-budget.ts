// How many views may be drawn in a frame, and whose turn it is: the page around them is to stay smooth, without graphics
// hardware too, where one picture takes longer than a frame.

/** A view that wants to be drawn. */
export interface Waiting {
  /** 'led': somebody moves its light; 'stale': it does not show what it should; 'orbits': its light moves by itself. */
  readonly why: 'led' | 'stale' | 'orbits';
  /** When it was drawn last [ms]. */
  readonly drawnAt: number;
  /** From the middle of the window [px]; asked for only where not all can orbit. */
  fromMiddle(): number;
  draw(): void;
}

const share = 4; // [ms] of each frame
const mostOfFrame = 12; // views
const fluent = 6; // pictures a second below which a light had better not orbit
const framesPerSecond = 60;
const order = ['led', 'stale', 'orbits'] as const;

/** What the page loses by a picture of so many ms: one that outlasts the share costs whole frames. */
const lost = (cost: number): number => (cost > share ? 2 * cost : cost);

export class FrameBudget {
  /** What was taken beyond the share, which the next frames do without [ms]. */
  #debt = 0;
  /** Of a picture, about [ms]. */
  #cost = 1;
  readonly #clock: () => number;

  constructor(clock = () => performance.now()) {
    this.#clock = clock;
  }

  /** Once in each frame. */
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

  /** As many as can be drawn fluently, but one at least: those in the middle of the window. */
  #orbiting(waiting: readonly Waiting[]): Waiting[] {
    const all = waiting.filter(({ why }) => why === 'orbits');
    const most = Math.max(1, Math.floor((framesPerSecond * share) / lost(this.#cost) / fluent));
    if (all.length <= most) return all;
    const places = new Map(all.map((one) => [one, one.fromMiddle()]));
    return all.sort((a, b) => (places.get(a) ?? 0) - (places.get(b) ?? 0)).slice(0, most);
  }
}
