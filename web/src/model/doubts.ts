// Why people may not see on a plate what it is made to show, told before it is printed.
import type { PictureReport } from 'sillon';
import { weaknessesOf, type Weakness } from './lamp.js';
import { drawnLayers } from './layers.js';
import type { DirectionSource, Plate } from './plate.js';

/** Of a finished plate, as computed under its own light. */
export interface Seen {
  /** Correlation of what is seen with what the directions ask for, in cells of two beads. */
  r: number;
  /** Brightness of what is meant to be bright by that of what is meant to be dark. */
  contrast: number;
  /** Of what the directions ask for: the share of its variance that is not finer than such a cell, 0..1. */
  kept: number;
  /** Height of the lines of letters, if there are any [mm]. */
  letters?: number;
}

export type Doubt = Weakness | 'blank' | 'small' | 'letters' | 'fine' | 'faint';

/** What has a picture in it; of the others nothing is to be recognised. Codes are read by a decoder instead. */
const shown: readonly DirectionSource['kind'][] = ['tone', 'levels', 'colours', 'text'];

/** Under layers nobody knows any more what is asked for at which place. */
export const hasPicture = (plate: Plate): boolean =>
  shown.includes(plate.directions.kind) && drawnLayers(plate).length === 0;

/** Correlations, by eye from rendered plates: "Hello" 3.6 mm high in beads of 0.4 mm has 0.85 and nobody reads it, 4.8 mm high
 * 0.91 and one guesses it, 6 mm high 0.96 and all do; a fox's head of four colours, 12 mm across, is still a fox at 0.93. */
export const leastLikeness = { letters: 0.93, picture: 0.85 } as const;
/** Height of letters that all can read [beads], by the same. */
export const legible = 15;
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
  const { directions, toolpath } = plate;
  const letters = directions.kind === 'text';
  if (letters && directions.text.trim() === '') return [...doubts, 'blank'];
  if (seen === undefined || !hasPicture(plate)) return doubts;
  // Nothing is left of letters that small, and the beads' contrast tells nothing of the directions then.
  if ((seen.letters ?? Infinity) < (legible / 2) * toolpath.spacing) doubts.push('small');
  else if (seen.contrast < leastContrast) doubts.push('faint');
  else if (seen.r < leastLikeness[letters ? 'letters' : 'picture'] || seen.kept < leastKept)
    doubts.push(letters ? 'letters' : 'fine');
  return doubts;
}
