// How coarse a preview must be to keep up with a hand.
import { pageOf, type Plate } from '../model/plate.js';

const soon = 55; // [ms] from the engine's begin to the picture: 60 from the hand's move
const usualDrawing = 10; // [ms] with a graphics card, most of which is the wait for a frame
const leastTarget = 20; // [ms]
const guess = 0.002; // [ms] per cell; measured in Chromium, one thread
const steady = 0.25; // powers of two by which the spacing of previews may be off
const fewestBeads = 10;
const largestSpacing = 20; // of the engine

export const cellsOf = (plate: Plate, factor = 1): number => {
  const cell = (plate.toolpath.spacing * factor) / 2;
  const [width, height] = pageOf(plate);
  return (width * height) / (cell * cell);
};

/** What a plate's cell has cost lately, what a preview costs besides, and what it costs to draw it. */
export class Cost {
  #perCell = guess;
  #besides = 0; // [ms]
  #drawing = usualDrawing; // [ms]
  #factor = 1; // of the last preview

  learn(plate: Plate, factor: number, ms: number): void {
    if (factor === 1) this.#perCell = ms / Math.max(1, cellsOf(plate));
    else this.#besides = ms - this.#perCell * cellsOf(plate, factor);
  }

  /** @param ms  from a preview to its picture. Pages that nobody sees draw late: such times count as the longest allowed. */
  learnDrawing(ms: number): void {
    this.#drawing = (this.#drawing + Math.min(Math.max(ms, usualDrawing), soon - leastTarget)) / 2;
  }

  /** By how much to widen the spacing for a preview. 1: the plate itself is quick enough. */
  factorFor(plate: Plate): number {
    const target = soon - this.#drawing;
    const full = this.#perCell * cellsOf(plate);
    if (full <= target) return 1;
    // Half is for beads, whatever comes besides: fewer of them would not make that less, and show nothing in the end.
    const forBeads = Math.min(target, Math.max(target / 2, target - this.#besides));
    const wanted = Math.sqrt(full / forBeads);
    // The engine keeps the path of a preview as long as its spacing stays.
    if (Math.abs(Math.log2(wanted / this.#factor)) > steady) this.#factor = wanted;
    const { spacing } = plate.toolpath;
    const widest = Math.min(largestSpacing, Math.min(...pageOf(plate)) / fewestBeads);
    return Math.max(1, Math.min(this.#factor, widest / spacing));
  }
}
