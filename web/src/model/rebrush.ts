// What a visitor wants of a sliced print, as plain data, and how the engine is asked for it.
import type { RebrushOptions, SlicedSurface } from 'sillon';
import { engineInput } from './input.js';
import type { Plate, SourceFile } from './plate.js';
import type { DirectionRaster } from './raster.js';

export type Way = 'angle' | 'plate' | 'picture';
export type Fit = RebrushOptions['fit'];
export const fits: readonly Fit[] = ['face', 'object', 'bed', 'all'];

export interface Wish {
  /** Places in the engine's list. */
  chosen: ReadonlySet<number>;
  way: Way;
  /** Degrees, counter-clockwise from the right. */
  angle: number;
  picture: SourceFile | undefined;
  /** Azimuth and elevation [degrees]. */
  lamp: readonly [number, number];
  /** Key of the filament: pictures are solved for its gloss. */
  spool: string;
  fit: Fit;
}

/** A top face and its place in the engine's list. */
export interface Face extends SlicedSurface {
  index: number;
}

/** Largest first. */
export const topsOf = (surfaces: readonly SlicedSurface[]): Face[] =>
  surfaces
    .map((surface, index) => ({ ...surface, index }))
    .filter(({ side }) => side === 'top')
    .sort((a, b) => b.areaMm2 - a.areaMm2 || a.index - b.index);

/** What is missing before the engine can be asked; empty: nothing. */
export const lackOf = ({ chosen, way, picture }: Wish): '' | 'nothing' | 'noPicture' =>
  chosen.size === 0 ? 'nothing' : way === 'picture' && picture === undefined ? 'noPicture' : '';

/** @param faces  all that can be replaced; where all are chosen, none is named
 * @param raster  of the plate, for the way 'plate' */
export function howOf(
  wish: Wish,
  faces: readonly Face[],
  plate: Plate,
  raster: DirectionRaster | undefined,
): Partial<RebrushOptions> {
  const all = faces.every(({ index }) => wish.chosen.has(index));
  const only = all ? {} : { only: [...wish.chosen].sort((a, b) => a - b) };
  switch (wish.way) {
    case 'angle':
      return { directions: { angle: wish.angle }, ...only };
    case 'plate': {
      const { directions, modes, pictures } = engineInput({ plate, raster }).input;
      const given = Object.entries({ directions, modes, pictures }).filter(([, part]) => part !== undefined);
      return { ...(Object.fromEntries(given) as Partial<RebrushOptions>), fit: wish.fit, ...only };
    }
    case 'picture': {
      const { picture, lamp } = wish;
      if (picture === undefined) throw new Error('there is no picture');
      const files = [{ file: picture.bytes, lamp: [lamp[0], lamp[1]] as [number, number] }];
      return { pictures: { files, spool: wish.spool as never }, fit: wish.fit, ...only };
    }
  }
}
