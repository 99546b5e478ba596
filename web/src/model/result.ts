// What of a plate is the same in another.
import { samePictures } from './lamp.js';
import { sameLayers } from './layers.js';
import type { Plate } from './plate.js';
import type { PlateResult } from './state.js';

/** Tells whether both have the same directions at the same places. */
export const sameDirections = (a: Plate, b: Plate): boolean =>
  a.shape === b.shape && a.width === b.width && a.height === b.height && sameLayers(a, b);

/** The same, also where directions are solved for pictures. */
export const sameSolved = (a: Plate, b: Plate): boolean => sameDirections(a, b) && samePictures(a, b);

/** Tells whether both make the same toolpath: printer, print, name and, without pictures under lamps, filament do not matter. */
export const sameToolpath = (a: Plate, b: Plate): boolean => sameSolved(a, b) && a.toolpath === b.toolpath;

/** Tells whether it is the plate's path. Asked for the file of another, the engine would begin it, also where it has just been
 * cancelled. */
export const isOf = ({ plate: of }: Pick<PlateResult, 'plate'>, plate: Plate): boolean => sameToolpath(of, plate);
