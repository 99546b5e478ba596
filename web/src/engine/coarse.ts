// Chooses the spacing of a preview so that it keeps up with a drag.
import { pageOf, type Plate } from '../model/plate.js';

const soon = 45; // [ms] target time of the engine, which leaves 60 ms from the hand's move to the picture
const guess = 0.002; // [ms] per cell; measured in Chromium, one thread
const steady = 0.25; // hysteresis of the preview's spacing, in powers of two
const coarsest = 2; // times the spacing: with wider beads a preview no longer resembles the plate

/** Returns the number of the engine's cells, each half a spacing wide. */
export const cellsOf = (plate: Plate, factor = 1): number => {
  const cell = (plate.toolpath.spacing * factor) / 2;
  const [width, height] = pageOf(plate);
  return (width * height) / (cell * cell);
};

/** Recent cost of one cell, in ms; used to choose the preview's spacing. */
export class Cost {
  #perCell = guess;
  #factor = 1; // factor of the last preview

  learn(plate: Plate, factor: number, ms: number): void {
    this.#perCell = ms / Math.max(1, cellsOf(plate, factor));
  }

  /** Returns the factor by which to widen the spacing for a preview. 1: the plate itself is fast enough; undefined:
   * no preview is. */
  factorFor(plate: Plate): number | undefined {
    const wanted = Math.sqrt((this.#perCell * cellsOf(plate)) / soon);
    if (wanted > coarsest) return undefined;
    // The engine reuses the path of a preview as long as its spacing stays.
    if (Math.abs(Math.log2(wanted / this.#factor)) > steady) this.#factor = Math.max(1, wanted);
    return this.#factor;
  }
}
