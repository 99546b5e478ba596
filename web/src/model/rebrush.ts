// A visitor's choices for a sliced print, as plain data, and the engine's options that follow from them.
import type { DirectionMode, RebrushOptions, SlicedSurface, Stroke } from 'sillon';
import { fieldsOf, numberIn, oneOf, textIn, Unfit } from './check.js';
import { engineInput } from './input.js';
import { spools } from './appearance.js';
import { spoolSlopes, type FilamentKey } from './filaments.js';
import { plateSpoolFrom } from './own-spool.js';
import type { OwnSpool, Plate, SourceFile } from './plate.js';

const ways = ['angle', 'hand', 'plate', 'picture'] as const;
export type Way = (typeof ways)[number];
export type Fit = RebrushOptions['fit'];
export const fits: readonly Fit[] = ['face', 'object', 'bed', 'all'];

/** The surfaces to replace: tops, bottoms (those of the first layer), or both. */
export type Side = NonNullable<RebrushOptions['sides']>;
export const sides: readonly Side[] = ['top', 'bottom', 'both'];

export interface Wish {
  side: Side;
  /** Indices of the chosen surfaces in the engine's list. */
  chosen: ReadonlySet<number>;
  way: Way;
  /** Direction in degrees, counter-clockwise from the right. */
  angle: number;
  picture: SourceFile | undefined;
  /** Azimuth and elevation of the lamp [degrees]. */
  lamp: readonly [number, number];
  /** Key of the filament, whose gloss the pictures are solved for. */
  spool: FilamentKey;
  /** The visitor's own spool, used instead of `spool`. */
  own: OwnSpool | undefined;
  fit: Fit;
  /** Strokes of the way 'hand', with points in mm on the bed. */
  strokes: readonly Stroke[];
}

/** Reads a picture of an earlier visit. @throws Unfit */
function pictureFrom(value: unknown): SourceFile | undefined {
  if (value === undefined) return undefined;
  const { id, name, bytes } = fieldsOf(value, 'picture', ['id', 'name', 'bytes']);
  if (!(bytes instanceof Blob)) throw new Unfit('picture.bytes', bytes);
  return { id: textIn(id, 'picture.id', 1000), name: textIn(name, 'picture.name', 1000), bytes };
}

const isStroke = (value: unknown): value is Stroke => {
  const { points } = (value ?? {}) as { points?: unknown };
  return Array.isArray(points) && points.length % 2 === 0 && points.every(Number.isFinite);
};

const readers: { [Key in keyof Wish]: (value: unknown) => Wish[Key] } = {
  side: (side) => oneOf(side, 'side', sides),
  chosen(chosen) {
    if (!(chosen instanceof Set) || ![...chosen].every(Number.isInteger)) throw new Unfit('chosen', chosen);
    return chosen as Set<number>;
  },
  way: (way) => oneOf(way, 'way', ways),
  angle: (angle) => numberIn(angle, 'angle', -360, 360),
  picture: pictureFrom,
  lamp(lamp) {
    if (!Array.isArray(lamp)) throw new Unfit('lamp', lamp);
    return [numberIn(lamp[0], 'lamp', 0, 360), numberIn(lamp[1], 'lamp', 0, 90)];
  },
  spool: (spool) => oneOf(spool, 'spool', Object.keys(spools) as FilamentKey[]),
  own: (own) => plateSpoolFrom(own).spool,
  fit: (fit) => oneOf(fit, 'fit', fits),
  strokes(strokes) {
    if (!Array.isArray(strokes) || !strokes.every(isStroke)) throw new Unfit('strokes', strokes);
    return strokes;
  },
};

/** Reads the choices of an earlier visit; undefined where this version cannot. The engine checks the values in the
 * strokes. */
export function wishFrom(value: unknown): Wish | undefined {
  try {
    const given = fieldsOf(value, 'wish', Object.keys(readers));
    return Object.fromEntries(Object.entries(readers).map(([key, read]) => [key, read(given[key])])) as unknown as Wish;
  } catch (error) {
    if (error instanceof Unfit) return undefined;
    throw error;
  }
}

/** The tool with which a hand draws on a print. */
export interface HandBrush {
  tool: 'pan' | NonNullable<Stroke['tool']>;
  /** Width of the brush [mm]. */
  across: number;
  /** Width of the soft edge, as in a stroke. */
  soft: number;
  /** Mode that the tool 'mode' paints. */
  mode: DirectionMode;
}

/** A surface and its index in the engine's list. */
export interface Face extends SlicedSurface {
  index: number;
}

const models = /\.(?:stl|3mf|obj|step|stp|amf|ply)$/i;

/** Indices of the bits that are set in a mask of 64 bits or more, as M624 has it. */
function placesIn(mask: string): number[] {
  const bytes = Array.from(atob(mask), (one) => one.charCodeAt(0));
  return bytes.flatMap((byte, k) =>
    [0, 1, 2, 3, 4, 5, 6, 7].filter((bit) => byte & (1 << bit)).map((bit) => 8 * k + bit),
  );
}

/** Name of an object, from its label in the G-code; its number, from 1, where nothing gives a name.
 * @param names  names from the package, in the order of their codes */
export function objectOf(label: string, names: readonly string[]): string | number {
  const text = label.replace(/^(['"])(.*)\1$/, '$2');
  if (text === '') return '';
  if (/^(?:[A-Za-z0-9+/]{4}){2,}(?:[A-Za-z0-9+/]{3}=|[A-Za-z0-9+/]{2}==)$/.test(text)) {
    const [place = 0] = placesIn(text);
    return objectOf(names[place] ?? '', []) || place + 1;
  }
  if (/^\d+$/.test(text)) return Number(text) + 1;
  // PrusaSlicer writes "part.stl id:0 copy 1"; for Klipper the spaces and colons are underscores.
  const [, name = text, copy = '0'] = /^(.*?)[ _]id[:_]\d+[ _]copy[ _](\d+)$/.exec(text) ?? [];
  const plain = (name.split(/[\\/]/).at(-1) ?? '').replace(models, '') || name;
  return copy === '0' ? plain : `${plain} (${Number(copy) + 1})`;
}

/** The surfaces of one side, the largest first. */
export const facesOf = (surfaces: readonly SlicedSurface[], wanted: Side): Face[] =>
  surfaces
    .map((surface, index) => ({ ...surface, index }))
    .filter(({ side }) => wanted === 'both' || side === wanted)
    .sort((a, b) => b.areaMm2 - a.areaMm2 || a.index - b.index);

/** Sum of the surfaces' areas [mm²]. */
export const areaOf = (faces: readonly SlicedSurface[]): number => faces.reduce((sum, { areaMm2 }) => sum + areaMm2, 0);

/** A box on the bed [mm]. */
export interface Box {
  corner: readonly [number, number];
  size: readonly [number, number];
}

/** Bounding box of all chosen faces, as the engine uses it for the fit 'all'. */
export function boxOf({ chosen }: Wish, faces: readonly Face[]): Box {
  const boxes = faces.filter(({ index, left }) => left === '' && chosen.has(index));
  const least = (k: 0 | 1): number => Math.min(...boxes.map(({ corner }) => corner[k]));
  const most = (k: 0 | 1): number => Math.max(...boxes.map(({ corner, region }) => corner[k] + region.page[k]));
  const corner = [least(0), least(1)] as const;
  return { corner, size: [most(0) - corner[0], most(1) - corner[1]] };
}

/** The lack that prevents the engine from being asked; empty where nothing is missing. */
export const lackOf = ({ chosen, way, picture }: Wish): '' | 'nothing' | 'noPicture' =>
  chosen.size === 0 ? 'nothing' : way === 'picture' && picture === undefined ? 'noPicture' : '';

/** Slopes of the visitor's own spool for the visible side. The engine knows those of the other spools. */
const slopesFor = (spool: OwnSpool | undefined, side: Side, nozzle: number): { slopes?: [number, number] } =>
  spool === undefined ? {} : { slopes: spoolSlopes(spool, nozzle, side === 'bottom' ? 'bedSide' : 'nozzleSide') };

/** Converts strokes from the bed to the page that the chosen faces share. There, bottoms are seen from below, while
 * strokes lie as on the bed. */
const strokesOn = ({ corner, size }: Box, { side, strokes }: Wish): Stroke[] =>
  strokes.map((stroke) => ({
    ...stroke,
    points: stroke.points.map((value, k) => {
      const from = value - (corner[k % 2] as number);
      return k % 2 === 0 && side === 'bottom' ? size[0] - from : from;
    }),
  }));

/** The engine's options for these choices.
 * @param faces  all faces that can be replaced; none is named where all of them are chosen
 * @param nozzle  the file's nozzle [mm] */
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
