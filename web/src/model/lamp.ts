// Pictures under lamps: what the engine is asked for, where the light stands, and what a spool can show.
import type { Look, PictureReport } from 'sillon';
import { appearance } from './appearance.js';
import { slopesOf } from './filaments.js';
import { groundFill, groundOf, groundPictures } from './fills.js';
import { completeLayers, pictureLayers } from './layers.js';
import { mostEntries } from './layer-table.js';
import { isExample, type LampPicture, type Plate, type SourceFile } from './plate.js';
import type { Light } from './view.js';

/** The most pictures that one layer can have. */
export const mostPictures = mostEntries.pictures;
/** Slopes that blur as much as a lamp of that size: a bulb, a softbox, a large window. */
export const lampSizes = {
  bulb: appearance.bulb,
  softbox: appearance.softbox,
  window: appearance.window,
} as const;

/** Angle between the lamps of two pictures [degrees]: near enough to show both at once where both are bright, far
 * enough to separate them. */
const between = 55;
const usualElevation = 45;

/** Tells whether the engine solves for pictures of the plate. */
const isSolved = (plate: Plate): boolean => pictureLayers(plate).length > 0;

/** Tells whether both plates ask the engine for the same pictures. Without pictures they always do, since the spool
 * then plays no part. */
export function samePictures(a: Plate, b: Plate): boolean {
  if (!isSolved(a) || !isSolved(b)) return true;
  const asked = ({ pictures }: Plate): string => JSON.stringify(Object.entries(pictures).sort());
  return asked(a) === asked(b) && a.spool === b.spool && slopesOf(a).join() === slopesOf(b).join();
}

/** Number of plates that the engine makes to solve for pictures, in the ground or in other layers: one, and one more
 * for each correction, as in `pathsFor` of the core. */
export function platesFor(plate: Plate): number {
  const { corrections, localContrast } = plate.pictures;
  return isSolved(plate) && localContrast === 0 ? 1 + corrections : 1;
}

const wrapped = (azimuth: number): number => ((azimuth % 360) + 360) % 360;

/** A lamp for one more picture beside those that are there. @param light  used for the first picture */
export function lampFor(pictures: readonly LampPicture[], light: Light): [number, number] {
  const last = pictures.at(-1)?.lamp;
  if (last === undefined || last === null) {
    const elevation = Math.min(65, Math.max(25, Math.round(light.elevation)));
    return pictures.length === 0 ? [wrapped(Math.round(light.azimuth)), elevation] : [between, usualElevation];
  }
  return [wrapped(last[0] + between), last[1]];
}

export const lightOf = ([azimuth, elevation]: readonly [number, number]): Light => ({
  azimuth: wrapped(azimuth),
  elevation,
});

/** Lamp of a picture that names none and lies above other layers, where the ground shows no picture. */
export const layersLamp: readonly [number, number] = [60, 45];

/** Pictures that the light can turn to: those of the lowest layer that has any. */
export const shownPictures = (plate: Plate): readonly LampPicture[] => pictureLayers(plate)[0]?.pictures ?? none;

const none: readonly LampPicture[] = [];

/** Lamps of `shownPictures`: those that were asked for, else those that the engine has found. */
export function lampsOf(plate: Plate, look: Look | undefined): Light[] {
  const ground = groundPictures(plate).length > 0;
  return shownPictures(plate).flatMap(({ lamp }, k) => {
    const found = lamp ?? (ground ? look?.lamps[k] : layersLamp);
    return found === undefined ? [] : [lightOf(found)];
  });
}

/** The number on a clock face nearest to an azimuth. Azimuths begin at the right and run counter-clockwise. */
export const hourOf = (azimuth: number): number => ((Math.round((90 - azimuth) / 30) + 23) % 12) + 1;

export interface Standing {
  light: Light;
  /** Pictures seen under this light; empty where the light suits the whole plate. */
  files: readonly SourceFile[];
}

/** Every lamp that the plate is made for, each once. @param look  look of the plate's path */
export function standingLamps(plate: Plate, look: Look | undefined): Standing[] {
  const ground = groundPictures(plate);
  const all = pictureLayers(plate).flatMap(({ pictures }) =>
    pictures.map(({ file, lamp }, k) => ({
      file,
      light: lightOf(lamp ?? (pictures === ground ? look?.lamps[k] : undefined) ?? layersLamp),
    })),
  );
  const same = (a: Light, b: Light): boolean => a.azimuth === b.azimuth && a.elevation === b.elevation;
  const lights = all.map(({ light }) => light).filter((one, k, list) => list.findIndex((two) => same(one, two)) === k);
  if (lights.length === 0) return [{ light: homeLight(plate, look), files: [] }];
  return lights.map((light) => ({ light, files: all.filter((one) => same(one.light, light)).map(({ file }) => file) }));
}

/** The picture that the plate shows; where it has several, the one whose lamp is on. */
export function pictureOf(plate: Plate, lamp: number): SourceFile | undefined {
  const ground = groundOf(plate);
  return groundPictures(plate)[lamp]?.file ?? (ground?.kind === 'tones' ? (ground.file ?? undefined) : undefined);
}

/** Tells whether the plate shows a visitor's own picture. An example's picture may glitter under a moving light
 * instead. */
export function isOwnPicture(plate: Plate, lamp: number): boolean {
  const file = pictureOf(plate, lamp);
  return file !== undefined && !isExample(file);
}

export const usualLight: Readonly<Light> = { azimuth: 60, elevation: 35 };

/** The light under which the plate looks as intended. Beads that run across the light are bright. */
export function homeLight(plate: Plate, look: Look | undefined): Light {
  const [lamp] = lampsOf(plate, look);
  if (lamp !== undefined) return lamp;
  const ground = groundOf(plate);
  if (ground?.kind !== 'tones' || ground.by === 'edges') return usualLight;
  // White is meant to be bright; among flat colours, the lightest, which is the last.
  const bright = ground.by === 'colours' ? ground.colours.at(-1)?.angle : ground.to;
  return bright === undefined ? usualLight : { ...usualLight, azimuth: (((bright - 90) % 180) + 180) % 180 };
}

// --- Visibility of pictures ----------------------------------------------------------------------------------------------

const unlike = 0.7; // correlation below which nobody recognises the picture
const wideLamp = 0.25;

/** Number of grey steps, 10 % apart, between the darkest and the brightest place. */
export const greySteps = (contrast: number): number =>
  Math.max(1, Math.floor(Math.log(Math.max(1, contrast)) / Math.log(1.1)));

export type Weakness = 'spool' | 'window' | 'unlike' | 'crowded';

/** Reports on the pictures of one layer. @param of  the layer's index among the complete layers; 0: the ground */
export const seenOfLayer = (seen: readonly PictureReport[] | undefined, of = 0): readonly PictureReport[] | undefined =>
  seen?.filter(({ layer }) => layer === of + 1);

/** The file that one of the reports is about. @param k  index of that report in `all` */
export function judgedFile(plate: Plate, all: readonly PictureReport[], k: number): SourceFile | undefined {
  const layer = all[k]?.layer ?? 1;
  const place = all.slice(0, k).filter((one) => one.layer === layer).length;
  return completeLayers(plate)[layer - 1]?.pictures[place]?.file;
}

/** Reasons why people may not see the pictures; empty where they will. @param all  reports on the finished plate */
export function weaknessesOf(plate: Plate, all: readonly PictureReport[] | undefined): Weakness[] {
  if (groundFill(plate) !== 'picture') return [];
  const seen = seenOfLayer(all);
  const found: Weakness[] = [];
  const window = plate.pictures.lampSize >= wideLamp;
  if (window) found.push('window');
  const [along] = slopesOf(plate);
  const dull = along >= 6; // [degrees] gold: the shine is as wide along the bead as across it
  if (!window && (dull || seen?.some(({ contrast }) => contrast < appearance.weakContrast) === true))
    found.push('spool');
  // With three or more pictures, the others leave no room for this one, however large the plate is.
  if (seen?.some(({ r }) => r < unlike) === true) found.push(seen.length > 2 ? 'crowded' : 'unlike');
  return found;
}

/** Values for the sentences about weaknesses: the number of pictures, and their lowest correlation. */
export function leastSeen(all: readonly PictureReport[] | undefined): { n: number; r: number } {
  const seen = seenOfLayer(all) ?? [];
  return { n: seen.length, r: Math.min(1, ...seen.map(({ r }) => r)) };
}
