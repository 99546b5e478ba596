// Looks of a plate under a light.
import { appearance } from '../model/appearance.js';
import { lookOf } from '../model/filaments.js';
import { groundPictures } from '../model/fills.js';
import { pageOf, type Plate } from '../model/plate.js';
import type { Light } from '../model/view.js';
import type { Look } from './look.js';

/** Returns the part of a look that the plate decides: its page, the lamp's size, and whether the eye is far away. */
export function seenBy(plate: Plate): Pick<Look, 'lampSlope' | 'fromAfar' | 'page'> {
  const lit = groundPictures(plate).length > 0;
  return { page: pageOf(plate), lampSlope: lit ? plate.pictures.lampSize : appearance.softbox, fromAfar: lit };
}

/** Returns the look of small pictures, in which one direction has one colour everywhere. */
export function smallLook(plate: Plate, light: Light): Look {
  const { colour, along, across } = lookOf(plate);
  return { ...seenBy(plate), light, body: colour, slopes: [along, across], fromAfar: true };
}
