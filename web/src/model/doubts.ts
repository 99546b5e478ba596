// Why people may not see on a plate what it is made to show, told before it is printed.
import type { PictureReport } from 'sillon';
import { groundFill, groundOf, type Fill } from './fills.js';
import { weaknessesOf, type Weakness } from './lamp.js';
import { drawnLayers } from './layers.js';
import type { Plate } from './plate.js';

/** Of a finished plate, as computed under its own light. */
export interface Seen {
  /** Correlation of what is seen with what the directions ask for, in cells of two beads. */
  r: number;
  /** Brightness of what is meant to be bright by that of what is meant to be dark. */
  contrast: number;
  /** Of what the directions ask for: the share of its variance that is not finer than such a cell, 0..1. */
  kept: number;
}

export type Doubt = Weakness | 'fine' | 'faint';

/** Fills that have a picture in them; in the others nothing is to be recognised. */
const shown: readonly (Fill | undefined)[] = ['brightness', 'levels', 'colours'];

/** Tells whether the plate is such a picture alone: about layers above it the engine warns by itself. */
export const hasPicture = (plate: Plate): boolean =>
  shown.includes(groundFill(plate)) && drawnLayers(plate).length === 1 && drawnLayers(plate)[0] === groundOf(plate);

/** Correlation, by eye from rendered plates: a fox's head of four colours, 12 mm across, is still a fox at 0.93. */
export const leastLikeness = 0.85;
/** A chequerboard whose squares are 2.5 beads wide keeps 0.3, of 4 beads 0.65; a photograph 12 mm wide 0.8. */
export const leastKept = 0.5;
/** Directions 30° apart have 1.6: dark and bright are then told apart only when one knows where to look. */
export const leastContrast = 1.6;

/** @param pictures  of the finished plate's report @param seen  of the finished plate; either may be unknown yet */
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
