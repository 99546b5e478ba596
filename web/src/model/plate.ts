// Everything that makes a plate: the sections of a project under the core's own names, and what only the studio has, which a
// project keeps in a section of its own. Plain data, never changed in place: one undo step is one Plate, and two Plates share
// what did not change.
import type {
  BuiltinShape,
  DirectionEncoding,
  DirectionMode,
  Layer,
  PictureParams,
  PrintParams,
  PrinterValues,
  Project,
  Spool,
} from 'sillon';
import type { ToolpathParams } from 'sillon';

/** A file as it came: kept for the project file. Equal `id`: equal bytes. */
export interface SourceFile {
  id: string;
  name: string;
  bytes: Blob;
}

/** The `id` of a file that came with the page begins with it. */
export const ofExample = 'example/';

export const isExample = ({ id }: SourceFile): boolean => id.startsWith(ofExample);

type ShapeSection = Project['shape'];

/** The core's settings for a shape, beside its content and size. */
export type ShapeSettings = Readonly<Omit<ShapeSection, 'file' | 'builtin' | 'size' | 'pageWidth' | 'holes'>> & {
  readonly holes: ShapeSection['holes'];
};

/** A shape that has a diameter and no height. */
export const isRoundKind = (kind: ShapeSource['kind']): boolean => kind === 'disc' || kind === 'ring';

/** The 2D shape on its page. Sizes are mm. A file is an SVG, or a mask picture: bright, opaque pixels are inside. */
export type ShapeSource = ShapeSettings & ({ kind: BuiltinShape } | { kind: 'file'; file: SourceFile });

/** A picture to be seen while its lamp shines: azimuth counter-clockwise from the right, and elevation [degrees]; null: the
 * engine chooses. */
export interface LampPicture {
  file: SourceFile;
  lamp: readonly [number, number] | null;
}

/** A colour of a drawing as '#rrggbb', and the direction of what is painted in it [degrees]. */
export interface FlatColour {
  colour: string;
  angle: number;
}

/** Where directions come from. Angles are degrees, counter-clockwise from the right; a bead has no sense: 180° is 0°.
 * Places are in the page's unit square, y up; lengths are shares of the page's width. */
export type DirectionSource =
  | { kind: 'angle'; angle: number }
  /** Up to four pictures, each solved for by the engine: the directions that show it under its lamp. */
  | { kind: 'lamp'; pictures: readonly LampPicture[] }
  /** A picture that tells angles as the engine reads them. */
  | { kind: 'map'; file: SourceFile; encoding: DirectionEncoding }
  /** Tone to angle: black is `from`, white is `to`. Smoothing is a blur radius; contrast 1 leaves tones as they are. */
  | { kind: 'tone'; file: SourceFile; from: number; to: number; invert: boolean; contrast: number; smoothing: number }
  /** Along the picture's edges, smoothly between them. */
  | { kind: 'edges'; file: SourceFile; smoothing: number; across: boolean }
  /** Two directions: where the picture is dark, and where it is light. */
  | { kind: 'levels'; file: SourceFile; dark: number; light: number; threshold: number; invert: boolean }
  /** A direction for each flat colour of a drawing or a picture, from dark to light; other colours go with the nearest. */
  | { kind: 'colours'; file: SourceFile; colours: readonly FlatColour[] }
  | { kind: 'text'; text: string; font: string; bold: boolean; size: number; letters: number; ground: number }
  | { kind: 'qr'; text: string; dark: number; light: number; margin: number }
  | { kind: 'radial'; centre: [number, number]; angle: number }
  | { kind: 'spiral'; centre: [number, number]; turns: number; angle: number }
  | { kind: 'waves'; angle: number; amplitude: number; length: number }
  | { kind: 'noise'; seed: number; scale: number; amplitude: number; angle: number };

/** One layer as the core has it, with its files as they came. Lengths are mm on the page, angles degrees. */
export type PlateLayer = Readonly<Omit<Layer, 'file' | 'maskFile' | 'modeFile' | 'font' | 'pictures'>> & {
  /** A whole number above 0 that no other layer of the plate has; it stays while the layer changes. */
  readonly id: number;
  /** The first picture of a picture layer, too. */
  readonly file: SourceFile | null;
  /** Lamp of that picture; null: as for the plate. */
  readonly lamp: readonly [number, number] | null;
  /** The pictures after the first. */
  readonly others: readonly LampPicture[];
  readonly maskFile: SourceFile | null;
  readonly modeFile: SourceFile | null;
  /** The name of a built-in font, or a font's file. */
  readonly font: string | SourceFile;
};

/** What beads may do at a place, as people choose among it. */
export const modeChoices = ['constrained', 'parallel', 'orthogonal', 'smoothest'] as const satisfies DirectionMode[];

/** One gesture of a brush, in page units as above. Edits are replayed in order over the source. */
export interface Stroke {
  tool: 'comb' | 'mode' | 'erase';
  /** x0, y0, x1, y1, ... */
  points: readonly number[];
  /** Radius, share of the page's width. */
  radius: number;
  /** How soft the rim is: 0 hard, 1 fades from the middle. */
  softness: number;
  /** Of `mode`; `comb` makes what it touches constrained. */
  mode?: DirectionMode;
}

/** What everything but the strokes asks of places, and a picture of modes laid over it. */
export interface ModeSource {
  mode: DirectionMode;
  file?: SourceFile;
}

/** A spool that somebody has measured: an entry of a file of spools, with its name there. */
export interface OwnSpool extends Readonly<Spool> {
  /** 1 to 40 letters, digits, `-` and `_`. */
  key: string;
}

/** The profiles that a printer began with, where a project names them: their values are all there, too. */
export type Machine = PrinterValues & { profile?: string; filament?: string };

export interface Plate {
  shape: ShapeSource;
  /** Of the page without what an offset adds; a file's proportions are kept by whoever sets them. 0 height: follows the direction
   * picture. */
  width: number;
  height: number;
  directions: DirectionSource;
  modes: ModeSource;
  /** Over the directions, the last on top. */
  layers: readonly PlateLayer[];
  /** Settings that all pictures share. The spool is the filament whose colour and gloss the appearance
   * shows, too. */
  pictures: PictureParams;
  toolpath: ToolpathParams;
  print: Omit<PrintParams, 'date'>;
  printer: Machine;

  // Parts that only the studio has; of the directions, all that is drawn.
  name: string;
  strokes: readonly Stroke[];
  /** Printer that came with a design from elsewhere and is not used before the visitor says so; kept with the work alone. */
  brought?: Machine | undefined;
  /** Instead of the spool's colour and gloss, those of one's own. */
  spool?: OwnSpool | undefined;
}

/** The parts of a plate that its page follows from. */
export type PageParts = Pick<Plate, 'shape' | 'width' | 'height'>;

/** Width and height of the page, which grows with an outline that is moved outwards. */
export function pageOf({ shape, width, height }: PageParts): [number, number] {
  const grown = 2 * Math.max(0, shape.offset);
  return [width + grown, (height || width) + grown];
}

/** Tells whether the studio draws directions and modes for the engine; else the project's own sections tell them. */
export const isDrawn = ({ directions: { kind }, strokes }: Pick<Plate, 'directions' | 'strokes'>): boolean =>
  kind !== 'lamp' && (strokes.length > 0 || (kind !== 'angle' && kind !== 'map'));
