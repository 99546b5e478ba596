// How coarse a preview must be to keep up with a hand.
import { pageOf, type Plate } from '../model/plate.js';

/** Engine time per preview [ms]; the other 15 of 60 ms are for directions and drawing. */
const target = 45;
const guess = 0.002; // [ms] per cell; measured in Chromium, one thread
const fewestBeads = 10;
const largestSpacing = 20; // of the engine

export const cellsOf = (plate: Plate, factor = 1): number => {
  const cell = (plate.toolpath.spacing * factor) / 2;
  const [width, height] = pageOf(plate);
  return (width * height) / (cell * cell);
};

/** What a plate's cell has cost lately, and what a preview costs besides. */
export class Cost {
  #perCell = guess;
  #besides = 0; // [ms]

  learn(plate: Plate, factor: number, ms: number): void {
    if (factor === 1) this.#perCell = ms / Math.max(1, cellsOf(plate));
    else this.#besides = ms - this.#perCell * cellsOf(plate, factor);
  }

  /** By how much to widen the spacing for a preview. 1: the plate itself is quick enough. */
  factorFor(plate: Plate): number {
    const full = this.#perCell * cellsOf(plate);
    if (full <= target) return 1;
    // Half is for beads, whatever comes besides: fewer of them would not make that less, and show nothing in the end.
    const forBeads = Math.min(target, Math.max(target / 2, target - this.#besides));
    const { spacing } = plate.toolpath;
    const widest = Math.min(largestSpacing, Math.min(...pageOf(plate)) / fewestBeads);
    return Math.max(1, Math.min(Math.sqrt(full / forBeads), widest / spacing));
  }
}
