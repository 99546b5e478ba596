// How coarse a preview must be to keep up with a hand.
import type { Plate } from '../model/plate.js';

/** [ms] of 150; the rest is for drawing and for machines that are busy. */
const target = 110;
const guess = 0.002; // [ms] per cell; measured in Chromium, one thread
const fewestBeads = 10;
const largestSpacing = 20; // of the engine

export const cellsOf = ({ width, height, toolpath }: Plate, factor = 1): number => {
  const cell = (toolpath.spacing * factor) / 2;
  return (width * (height || width)) / (cell * cell);
};

/** What a plate's cell has cost lately. Previews have their own figure: parts of their cost do not depend on cells. */
export class Cost {
  #full: number | undefined;
  #coarse: number | undefined;

  learn(plate: Plate, factor: number, ms: number): void {
    const perCell = ms / Math.max(1, cellsOf(plate, factor));
    if (factor > 1) this.#coarse = perCell;
    else this.#full = perCell;
  }

  /** By how much to widen the spacing for a preview. 1: the plate itself is quick enough. */
  factorFor(plate: Plate): number {
    const full = (this.#full ?? guess) * cellsOf(plate);
    if (full <= target) return 1;
    const perCell = this.#coarse ?? this.#full ?? guess;
    const factor = Math.sqrt((perCell * cellsOf(plate)) / target);
    const { spacing } = plate.toolpath;
    const widest = Math.min(largestSpacing, Math.min(plate.width, plate.height || plate.width) / fewestBeads);
    return Math.max(1, Math.min(factor, widest / spacing));
  }
}
