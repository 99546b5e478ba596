// Plates that came from somewhere else, and have not been made yet. One that stops the page must not come back by itself, so that
// it is kept only once it has been made.
import type { Plate } from './plate.js';
import { isOf } from './result.js';
import type { State } from './state.js';

export class Untried {
  #arriving = 0;
  readonly #plates = new WeakSet<Plate>();

  /** What `work` puts into the plate comes from somewhere else. */
  async during<Result>(work: () => Promise<Result>): Promise<Result> {
    ++this.#arriving;
    try {
      return await work();
    } finally {
      --this.#arriving;
    }
  }

  /** To be asked after each change of plate or result. @param before  the plate before that
   * @returns whether the plate may be kept */
  mayKeep({ plate, result }: Pick<State, 'plate' | 'result'>, before: Plate): boolean {
    if (plate !== before && (this.#arriving > 0 || this.#plates.has(before))) this.#plates.add(plate);
    if (result !== undefined && isOf(result, plate)) this.#plates.delete(plate);
    return !this.#plates.has(plate);
  }
}
