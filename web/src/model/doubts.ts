// Reasons why people may not see on a plate what it is made to show, told before it is printed.
import type { PictureReport } from 'sillon';
import { groundFill, groundOf, type Fill } from './fills.js';
import { weaknessesOf, type Weakness } from './lamp.js';
import { drawnLayers } from './layers.js';
import type { Plate } from './plate.js';

/** Measures of how a finished plate looks, computed under its own light. */
export interface Seen {
  /** Correlation of what is seen with what the directions ask for, over cells two beads wide. */
  r: number;
  /** Mean brightness of the parts meant to be bright, divided by that of the parts meant to be dark. */
  contrast: number;
  /** Share, 0..1, of the variance in the wanted brightness that is not finer than such a cell. */
  kept: number;
}

export type Doubt = Weakness | 'fine' | 'faint';

/** Fills that hold a picture. In the others there is nothing to recognise. */
const shown: readonly (Fill | undefined)[] = ['brightness', 'levels', 'colours'];

/** Tells whether the plate is such a picture and nothing else. Layers above a picture have the engine's own
 * warnings. */
export const hasPicture = (plate: Plate): boolean =>
  shown.includes(groundFill(plate)) && drawnLayers(plate).length === 1 && drawnLayers(plate)[0] === groundOf(plate);

/** Lowest acceptable correlation, set by eye from rendered plates: a fox's head of four colours, 12 mm across, is
 * still a fox at 0.93. */
export const leastLikeness = 0.85;
/** Lowest acceptable share of detail. A chequerboard with squares 2.5 beads wide keeps 0.3, one with squares of 4
 * beads 0.65, and a photograph 12 mm wide 0.8. */
export const leastKept = 0.5;
/** Lowest acceptable contrast. Directions 30° apart have 1.6: dark and bright are then told apart only by those who
 * know where to look. */
export const leastContrast = 1.6;

/** Lists the reasons why the plate may not show its picture.
 * @param pictures  report on the finished plate's pictures; undefined while unknown
 * @param seen  measures of the finished plate; undefined while unknown */
export function doubtsOf(
  plate: Plate,
  pictures: readonly PictureReport[] | undefined,
  seen: Seen | undefined,
): Doubt[] {
  const doubts: Doubt[] = weaknessesOf(plate, pictures);
  if (seen === undefined || !hasPicture(plate)) return doubts;
  if (seen.contrast < leastContrast) doubts.push('faint');
  else if (seen.r < leastLikeness || seen.kept < leastKept) doubts.push('fine');
  return doubts;
}
