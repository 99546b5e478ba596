// What of a plate is the same in another.
import { samePictures } from './lamp.js';
import { sameLayers } from './layers.js';
import type { Plate } from './plate.js';
import type { PlateResult } from './state.js';

const mustStay = ({ directions }: Plate): boolean => directions.kind === 'qr' || directions.kind === 'text';

const isPlain = ({ holes, offset }: Plate['shape']): boolean => holes.length === 0 && offset === 0;

/** Whether codes and letters must stay within the ellipse of the page. */
export const isRound = (plate: Plate): boolean =>
  plate.shape.kind === 'disc' && isPlain(plate.shape) && mustStay(plate);

/** The shape that codes and letters must stay within, where it is neither its page nor the ellipse of that. */
export function roomShape(plate: Plate): Plate['shape'] | undefined {
  const { shape } = plate;
  const known = (shape.kind === 'rectangle' || shape.kind === 'disc') && isPlain(shape);
  return !known && mustStay(plate) ? shape : undefined;
}

export const sameSource = (a: Plate, b: Plate): boolean =>
  a.directions === b.directions &&
  a.modes === b.modes &&
  a.width === b.width &&
  a.height === b.height &&
  a.shape.offset === b.shape.offset &&
  isRound(a) === isRound(b) &&
  roomShape(a) === roomShape(b);

export const sameDirections = (a: Plate, b: Plate): boolean => a.strokes === b.strokes && sameSource(a, b);

/** Whether it is the plate's path: all but printer, print and looks are the same. Asked for the file of another, the engine
 * would begin it, also where it has just been cancelled. */
export const isOf = ({ plate: of }: Pick<PlateResult, 'plate'>, plate: Plate): boolean =>
  sameDirections(of, plate) &&
  sameLayers(of, plate) &&
  of.shape === plate.shape &&
  of.toolpath === plate.toolpath &&
  samePictures(of, plate);
