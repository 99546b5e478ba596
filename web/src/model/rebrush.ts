// What a visitor wants of a sliced print, as plain data, and how the engine is asked for it.
import type { DirectionMode, RebrushOptions, SlicedSurface, Stroke } from 'sillon';
import { engineInput } from './input.js';
import { spoolSlopes, type FilamentKey } from './filaments.js';
import type { OwnSpool, Plate, SourceFile } from './plate.js';

export type Way = 'angle' | 'hand' | 'plate' | 'picture';
export type Fit = RebrushOptions['fit'];
export const fits: readonly Fit[] = ['face', 'object', 'bed', 'all'];

/** Which surfaces are meant: of the first layer, the bottoms. */
export type Side = NonNullable<RebrushOptions['sides']>;
export const sides: readonly Side[] = ['top', 'bottom', 'both'];

export interface Wish {
  side: Side;
  /** Places in the engine's list. */
  chosen: ReadonlySet<number>;
  way: Way;
  /** Degrees, counter-clockwise from the right. */
  angle: number;
  picture: SourceFile | undefined;
  /** Azimuth and elevation [degrees]. */
  lamp: readonly [number, number];
  /** Key of the filament: pictures are solved for its gloss. */
  spool: FilamentKey;
  /** Instead of it, a spool of one's own. */
  own: OwnSpool | undefined;
  fit: Fit;
  /** Strokes of the way 'hand': points in mm on the bed. */
  strokes: readonly Stroke[];
}

/** What a hand draws with on a print. */
export interface HandBrush {
  tool: 'pan' | NonNullable<Stroke['tool']>;
  /** [mm] */
  across: number;
  /** As a stroke's. */
  soft: number;
  /** What the tool 'mode' paints. */
  mode: DirectionMode;
}

/** A surface and its place in the engine's list. */
export interface Face extends SlicedSurface {
  index: number;
}

/** Largest first. */
export const facesOf = (surfaces: readonly SlicedSurface[], wanted: Side): Face[] =>
  surfaces
    .map((surface, index) => ({ ...surface, index }))
    .filter(({ side }) => wanted === 'both' || side === wanted)
    .sort((a, b) => b.areaMm2 - a.areaMm2 || a.index - b.index);

/** [mm²] */
export const areaOf = (faces: readonly Face[]): number => faces.reduce((sum, { areaMm2 }) => sum + areaMm2, 0);

/** On the bed [mm]. */
export interface Box {
  corner: readonly [number, number];
  size: readonly [number, number];
}

/** Around all chosen faces, as the engine takes it for the fit 'all'. */
export function boxOf({ chosen }: Wish, faces: readonly Face[]): Box {
  const boxes = faces.filter(({ index, left }) => left === '' && chosen.has(index));
  const least = (k: 0 | 1): number => Math.min(...boxes.map(({ corner }) => corner[k]));
  const most = (k: 0 | 1): number => Math.max(...boxes.map(({ corner, region }) => corner[k] + region.page[k]));
  const corner = [least(0), least(1)] as const;
  return { corner, size: [most(0) - corner[0], most(1) - corner[1]] };
}

/** What is missing before the engine can be asked; empty: nothing. */
export const lackOf = ({ chosen, way, picture }: Wish): '' | 'nothing' | 'noPicture' =>
  chosen.size === 0 ? 'nothing' : way === 'picture' && picture === undefined ? 'noPicture' : '';

/** Of one's own spool, those of the side that is seen; of the others the engine knows them. */
const slopesFor = (spool: OwnSpool | undefined, side: Side, nozzle: number): { slopes?: [number, number] } =>
  spool === undefined ? {} : { slopes: spoolSlopes(spool, nozzle, side === 'bottom' ? 'bedSide' : 'nozzleSide') };

/** Strokes on the page that the chosen faces share. Bottoms are seen from below there, and painted as they lie on the bed. */
const strokesOn = ({ corner, size }: Box, { side, strokes }: Wish): Stroke[] =>
  strokes.map((stroke) => ({
    ...stroke,
    points: stroke.points.map((value, k) => {
      const from = value - (corner[k % 2] as number);
      return k % 2 === 0 && side === 'bottom' ? size[0] - from : from;
    }),
  }));

/** @param faces  all that can be replaced; where all are chosen, none is named
 * @param nozzle  of the file [mm] */
export function howOf(wish: Wish, faces: readonly Face[], plate: Plate, nozzle: number): Partial<RebrushOptions> {
  const all = faces.every(({ index }) => wish.chosen.has(index));
  const sides = wish.side === 'top' ? {} : { sides: wish.side };
  const only = all ? sides : { only: [...wish.chosen].sort((a, b) => a - b) };
  switch (wish.way) {
    case 'angle':
      return { layers: [{ kind: 'direction', angle: wish.angle }], ...only };
    case 'hand': {
      const strokes = strokesOn(boxOf(wish, faces), wish);
      return {
        layers: [
          { kind: 'direction', angle: wish.angle },
          { kind: 'strokes', strokes },
        ],
        fit: 'all',
        ...only,
      };
    }
    case 'plate': {
      const { layers = [], pictures } = engineInput(plate).input;
      const lit = pictures && {
        ...pictures,
        slopes: plate.pictures.slopes,
        ...slopesFor(plate.spool, wish.side, nozzle),
      };
      return { layers, ...(lit !== undefined && { pictures: lit }), fit: wish.fit, ...only };
    }
    case 'picture': {
      const { picture, lamp } = wish;
      if (picture === undefined) throw new Error('there is no picture');
      const pictures = { spool: wish.spool, ...slopesFor(wish.own, wish.side, nozzle) };
      const lit = [{ file: picture.bytes, lamp: [lamp[0], lamp[1]] as const }];
      return { layers: [{ kind: 'picture', pictures: lit }], pictures, fit: wish.fit, ...only };
    }
  }
}
