// Chooses the spacing of a preview so that it keeps up with a hand.
import { pageOf, type Plate } from '../model/plate.js';

const soon = 45; // [ms] from the engine's begin to its end: 60 from the hand's move to the picture
const guess = 0.002; // [ms] per cell; measured in Chromium, one thread
const steady = 0.25; // powers of two by which the spacing of previews may be off
const coarsest = 2; // times the spacing: wider beads are no picture of the plate

export const cellsOf = (plate: Plate, factor = 1): number => {
  const cell = (plate.toolpath.spacing * factor) / 2;
  const [width, height] = pageOf(plate);
  return (width * height) / (cell * cell);
};

/** Recent cost of one cell, in ms; used to choose the preview's spacing. */
export class Cost {
  #perCell = guess;
  #factor = 1; // of the last preview

  learn(plate: Plate, factor: number, ms: number): void {
    this.#perCell = ms / Math.max(1, cellsOf(plate, factor));
  }

  /** By how much to widen the spacing for a preview. 1: the plate itself is quick enough; undefined: none is. */
  factorFor(plate: Plate): number | undefined {
    const wanted = Math.sqrt((this.#perCell * cellsOf(plate)) / soon);
    if (wanted > coarsest) return undefined;
    // The engine keeps the path of a preview as long as its spacing stays.
    if (Math.abs(Math.log2(wanted / this.#factor)) > steady) this.#factor = Math.max(1, wanted);
    return this.#factor;
  }
}
