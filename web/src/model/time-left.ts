// Estimates the time left of a job that reports its progress.

const firstWord = 700; // [ms]; any earlier, an estimate would be a guess
const smallestFraction = 0.03;
const trust = 0.25; // weight of the newest estimate; smaller: steadier; larger: sooner right when the pace changes

/** Exponentially smoothed estimate of a job's remaining time. */
export class TimeLeft {
  #told: number | undefined;
  #at = 0;

  constructor(private readonly begin: number) {}

  /** Estimates the time left.
   * @param fraction  share of the job that is done, 0..1
   * @param now  [ms]
   * @returns seconds; undefined while there is nothing to estimate from */
  estimate(fraction: number, now: number): number | undefined {
    const elapsed = now - this.begin;
    if (fraction >= 1) return 0;
    if (elapsed < firstWord || fraction < smallestFraction) return undefined;
    const left = (elapsed * (1 - fraction)) / fraction / 1000;
    const expected = this.#told === undefined ? left : Math.max(0, this.#told - (now - this.#at) / 1000);
    this.#told = expected + trust * (left - expected);
    this.#at = now;
    return this.#told;
  }
}
