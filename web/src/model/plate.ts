// Everything that makes a plate: the sections of a project under the core's own names, and what only the studio has, which a
// project keeps in a section of its own. Plain data, never changed in place: one undo step is one Plate, and two Plates share
// what did not change.
import type {
  BuiltinShape,
  DirectionMode,
  Layer,
  PictureParams,
  PrintParams,
  PrinterValues,
  Project,
  Spool,
  ToolpathParams,
} from 'sillon';

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

/** One layer as the core has it, with its files as they came. Lengths are mm on the page, angles degrees. */
export type PlateLayer = Readonly<Omit<Layer, 'file' | 'maskFile' | 'modeFile' | 'font' | 'pictures'>> & {
  /** A whole number above 0 that no other layer of the plate has; it stays while the layer changes. */
  readonly id: number;
  readonly file: SourceFile | null;
  readonly pictures: readonly LampPicture[];
  readonly maskFile: SourceFile | null;
  readonly modeFile: SourceFile | null;
  /** The name of a built-in font, or a font's file. */
  readonly font: string | SourceFile;
};

/** What beads may do at a place, as people choose among it. */
export const modeChoices = ['constrained', 'parallel', 'orthogonal', 'smoothest'] as const satisfies DirectionMode[];

/** A spool that somebody has measured: an entry of a file of spools, with its name there. */
export interface OwnSpool extends Readonly<Spool> {
  /** 1 to 40 letters, digits, `-` and `_`. */
  key: string;
}

/** The body that a plate is a level top face of. */
export interface Body {
  /** STL. */
  file: SourceFile;
  /** Lower left of the face's box, and its height [mm]. */
  face: readonly [x: number, y: number, z: number];
  /** Size of that box. */
  size: readonly [number, number];
  /** `id` of the file with the face's outline. */
  outline: string;
}

/** The profiles that a printer began with, where a project names them: their values are all there, too. */
export type Machine = PrinterValues & { profile?: string; filament?: string };

export interface Plate {
  shape: ShapeSource;
  /** Size of the page without what an offset adds; a file's proportions are kept by whoever sets them. 0 height: follows the picture
   * of the lowest layer. */
  width: number;
  height: number;
  /** Bottom first: the lowest fills the page. */
  layers: readonly PlateLayer[];
  /** Settings that all pictures share. The spool is the filament whose colour and gloss the appearance
   * shows, too. */
  pictures: PictureParams;
  toolpath: ToolpathParams;
  print: Omit<PrintParams, 'date'>;
  printer: Machine;

  // Parts that only the studio has.
  name: string;
  /** Printer that came with a design from elsewhere and is not used before the visitor says so; kept with the work alone. */
  brought?: Machine | undefined;
  /** The body that slicers get with the plate's directions on it. */
  body?: Body | undefined;
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
