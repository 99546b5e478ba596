// Pictures under lamps: what the engine is asked for, where the light belongs, and what a spool can show.
import type { Look, PictureReport } from 'sillon';
import { appearance } from './appearance.js';
import { slopesOf } from './filaments.js';
import { completeLayers, drawnLayers, showsPictures } from './layers.js';
import { isExample, type DirectionSource, type LampPicture, type Plate, type SourceFile } from './plate.js';
import type { Light } from './view.js';

export type LampSource = Extract<DirectionSource, { kind: 'lamp' }>;

export const mostPictures = 4;
/** Slopes that blur as much: a bulb, a softbox, a large window. */
export const lampSizes = {
  bulb: appearance.bulb,
  softbox: appearance.softbox,
  window: appearance.window,
} as const;

/** Between the lamps of two pictures [degrees]: near enough to show both at once where both are bright, far enough to part them. */
const between = 55;
const usualElevation = 45;

/** The engine solves for the plate's pictures, or for those of its layers. */
const isSolved = (plate: Plate): boolean => plate.directions.kind === 'lamp' || showsPictures(plate);

/** Whether both plates ask the engine for the same pictures; other directions do not know of spools. */
export function samePictures(a: Plate, b: Plate): boolean {
  if (!isSolved(a) || !isSolved(b)) return true;
  const asked = ({ pictures }: Plate): string => JSON.stringify(Object.entries(pictures).sort());
  return asked(a) === asked(b) && a.spool === b.spool && slopesOf(a).join() === slopesOf(b).join();
}

/** Number of plates that the engine makes for pictures, whether they fill the plate or lie in layers: each correction is one more,
 * as `pathsFor` of the core has it. */
export function platesFor(plate: Plate): number {
  const { corrections, localContrast } = plate.pictures;
  const shown = plate.directions.kind === 'lamp' || showsPictures(plate);
  return shown && localContrast === 0 ? 1 + corrections : 1;
}

const wrapped = (azimuth: number): number => ((azimuth % 360) + 360) % 360;

/** A lamp for one more picture, beside those that are there. @param light  of the first */
export function lampFor(pictures: readonly LampPicture[], light: Light): [number, number] {
  const last = pictures.at(-1)?.lamp;
  if (last === undefined || last === null) {
    const elevation = Math.min(65, Math.max(25, Math.round(light.elevation)));
    return pictures.length === 0 ? [wrapped(Math.round(light.azimuth)), elevation] : [between, usualElevation];
  }
  return [wrapped(last[0] + between), last[1]];
}

const lightOf = ([azimuth, elevation]: readonly [number, number]): Light => ({
  azimuth: wrapped(azimuth),
  elevation,
});

/** The lamps of the plate's pictures: as solved for, else as asked for. */
export function lampsOf(source: DirectionSource, look: Look | undefined): Light[] {
  if (source.kind !== 'lamp') return [];
  return source.pictures.flatMap(({ lamp }, k) => {
    const found = lamp ?? look?.lamps[k];
    return found === undefined ? [] : [lightOf(found)];
  });
}

/** What is to be seen on the plate; of several pictures, the one whose lamp shines. */
export function pictureOf({ directions }: Plate, lamp: number): SourceFile | undefined {
  if (directions.kind === 'lamp') return directions.pictures[lamp]?.file;
  return 'file' in directions && directions.kind !== 'map' ? directions.file : undefined;
}

/** Tells a visitor's own picture, which is to be seen, from an example's, which may glitter under a light that moves by itself. */
export function isOwnPicture(plate: Plate, lamp: number): boolean {
  const file = pictureOf(plate, lamp);
  return file !== undefined && !isExample(file);
}

export const usualLight: Readonly<Light> = { azimuth: 60, elevation: 35 };

/** The lamp of a picture among layers that names none, where the plate has no picture of its own. */
export const layersLamp: readonly [number, number] = [60, 45];

/** Where the plate looks as it is meant to: beads that run across the light are bright. */
export function homeLight(plate: Plate, look: Look | undefined): Light {
  const { directions } = plate;
  const [lamp] = lampsOf(directions, look);
  if (lamp !== undefined) return lamp;
  const picture = drawnLayers(plate).find(({ kind }) => kind === 'picture');
  if (picture !== undefined) return lightOf(picture.lamp ?? layersLamp);
  const across = (angle: number): Light => ({ ...usualLight, azimuth: (((angle - 90) % 180) + 180) % 180 });
  switch (directions.kind) {
    case 'tone':
      return across(directions.invert ? directions.from : directions.to);
    case 'levels':
      return across(directions.invert ? directions.dark : directions.light);
    case 'colours':
      return across(directions.colours.at(-1)?.angle ?? usualLight.azimuth + 90); // the lightest is bright
    case 'qr':
      return across(directions.light);
    case 'text':
      return across(directions.letters);
    default:
      return usualLight;
  }
}

// --- What can be seen ----------------------------------------------------------------------------------------------------

const unlike = 0.7; // correlation below which nobody recognises the picture
const wideLamp = 0.25;

/** Steps of 10 % that are told apart between the darkest and the brightest place. */
export const greySteps = (contrast: number): number =>
  Math.max(1, Math.floor(Math.log(Math.max(1, contrast)) / Math.log(1.1)));

export type Weakness = 'spool' | 'window' | 'unlike' | 'crowded';

/** Pictures over one another that fill the plate, without those of the layers over them. */
export const seenOfDirections = (seen: readonly PictureReport[] | undefined): readonly PictureReport[] | undefined =>
  seen?.filter(({ layer }) => layer === 1);

/** The file that one of the reports is about. @param k  its place among all */
export function judgedFile(plate: Plate, all: readonly PictureReport[], k: number): SourceFile | undefined {
  const layer = all[k]?.layer ?? 1;
  const place = all.slice(0, k).filter((one) => one.layer === layer).length;
  const { directions } = plate;
  const above = completeLayers(plate)[layer - 2]; // the lowest is that of the directions
  const lit = directions.kind === 'lamp' ? directions.pictures : [];
  const shown = above === undefined ? [] : [above, ...above.others];
  return (layer === 1 ? lit : shown)[place]?.file ?? undefined;
}

/** Why people may not see the pictures; empty: they will. @param all  of the finished plate */
export function weaknessesOf(plate: Plate, all: readonly PictureReport[] | undefined): Weakness[] {
  const { directions } = plate;
  const seen = seenOfDirections(all);
  if (directions.kind !== 'lamp') return [];
  const found: Weakness[] = [];
  const window = plate.pictures.lampSize >= wideLamp;
  if (window) found.push('window');
  const [along] = slopesOf(plate);
  const dull = along >= 6; // [degrees] gold: the shine is as wide along the bead as across it
  if (!window && (dull || seen?.some(({ contrast }) => contrast < appearance.weakContrast) === true))
    found.push('spool');
  // Of three pictures and more it is the others that leave no room, whatever the size.
  if (seen?.some(({ r }) => r < unlike) === true) found.push(seen.length > 2 ? 'crowded' : 'unlike');
  return found;
}

/** For the sentences about weaknesses: how many pictures there are, and the lowest of their correlations. */
export function leastSeen(all: readonly PictureReport[] | undefined): { n: number; r: number } {
  const seen = seenOfDirections(all) ?? [];
  return { n: seen.length, r: Math.min(1, ...seen.map(({ r }) => r)) };
}
