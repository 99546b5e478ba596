// Comparisons of plates by what the engine would make of them.
import { samePictures } from './lamp.js';
import { sameLayers } from './layers.js';
import type { Plate } from './plate.js';
import type { PlateResult } from './state.js';

/** Tells whether both have the same directions at the same places. */
export const sameDirections = (a: Plate, b: Plate): boolean =>
  a.shape === b.shape && a.width === b.width && a.height === b.height && sameLayers(a, b);

/** Tells whether both have the same directions, including those solved for pictures. */
export const sameSolved = (a: Plate, b: Plate): boolean => sameDirections(a, b) && samePictures(a, b);

/** Tells whether both make the same toolpath. Printer, print and name do not matter, nor does the filament without
 * pictures under lamps. */
export const sameToolpath = (a: Plate, b: Plate): boolean => sameSolved(a, b) && a.toolpath === b.toolpath;

/** Tells whether the result is the plate's own path. Asking for the file of another plate would make the engine
 * begin that path, even one just cancelled. */
export const isOf = ({ plate: of }: Pick<PlateResult, 'plate'>, plate: Plate): boolean => sameToolpath(of, plate);
