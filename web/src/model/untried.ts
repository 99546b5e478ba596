// Plates from elsewhere that have not been made yet. One that makes the page hang must not come back with the next
// visit, so such plates are kept only after they have been made.
import type { Plate } from './plate.js';
import { isOf } from './result.js';
import type { State } from './state.js';

/** Knows which plates have come from elsewhere and have not been made yet. */
export class Untried {
  #arriving = 0;
  readonly #plates = new WeakSet<Plate>();

  /** Runs `work`, and treats every plate that it sets as one from elsewhere. */
  async during<Result>(work: () => Promise<Result>): Promise<Result> {
    ++this.#arriving;
    try {
      return await work();
    } finally {
      --this.#arriving;
    }
  }

  /** Decides whether the plate may be kept; call it after each change of plate or result.
   * @param before  the plate before the change */
  mayKeep({ plate, result }: Pick<State, 'plate' | 'result'>, before: Plate): boolean {
    if (plate !== before && (this.#arriving > 0 || this.#plates.has(before))) this.#plates.add(plate);
    if (result !== undefined && isOf(result, plate)) this.#plates.delete(plate);
    return !this.#plates.has(plate);
  }
}
