// The data that make a plate: the sections of a project under the core's own names, and the studio's own parts, which a
// project keeps in a separate section. Plates are never changed in place: each undo step is one Plate, and two Plates
// share all that is equal.
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

/** A file with its original bytes, kept for the project file. Files with equal `id` have equal bytes. */
export interface SourceFile {
  id: string;
  name: string;
  bytes: Blob;
}

/** Prefix of the `id` of files that come with the page. */
export const ofExample = 'example/';

export const isExample = ({ id }: SourceFile): boolean => id.startsWith(ofExample);

type ShapeSection = Project['shape'];

/** The core's settings of a shape, without its content and size. */
export type ShapeSettings = Readonly<Omit<ShapeSection, 'file' | 'builtin' | 'size' | 'pageWidth' | 'holes'>> & {
  readonly holes: ShapeSection['holes'];
};

/** Tells whether a shape has a diameter instead of a width and height. */
export const isRoundKind = (kind: ShapeSource['kind']): boolean => kind === 'disc' || kind === 'ring';

/** The 2D shape on its page, in mm. A file is an SVG or a mask picture, whose bright, opaque pixels are inside. */
export type ShapeSource = ShapeSettings & ({ kind: BuiltinShape } | { kind: 'file'; file: SourceFile });

/** A picture that shows while its lamp shines. The lamp is an azimuth, counter-clockwise from the right, and an
 * elevation [degrees]; null lets the engine choose. */
export interface LampPicture {
  file: SourceFile;
  lamp: readonly [number, number] | null;
}

/** One layer with the core's values and its original files. Lengths are mm on the page, angles degrees. */
export type PlateLayer = Readonly<Omit<Layer, 'file' | 'maskFile' | 'modeFile' | 'font' | 'pictures'>> & {
  /** Whole number above 0, unique in the plate, which stays while the layer changes. */
  readonly id: number;
  readonly file: SourceFile | null;
  readonly pictures: readonly LampPicture[];
  readonly maskFile: SourceFile | null;
  readonly modeFile: SourceFile | null;
  /** Name of a built-in font, or a font file. */
  readonly font: string | SourceFile;
};

/** Modes that beads can have at a place, in the order in which people choose among them. */
export const modeChoices = ['constrained', 'parallel', 'orthogonal', 'smoothest'] as const satisfies DirectionMode[];

/** A spool that somebody has measured: an entry of a file of spools, with its key there. */
export interface OwnSpool extends Readonly<Spool> {
  /** Key of 1 to 40 letters, digits, `-` and `_`. */
  key: string;
}

/** The 3D body that has the plate as a level top face. */
export interface Body {
  /** The body as an STL file. */
  file: SourceFile;
  /** Lower left corner of the face's bounding box, and the face's height [mm]. */
  face: readonly [x: number, y: number, z: number];
  /** Size of the bounding box [mm]. */
  size: readonly [number, number];
  /** `id` of the file that holds the face's outline. */
  outline: string;
}

/** A printer's values, with the profiles that they began with where a project names any. */
export type Machine = PrinterValues & { profile?: string; filament?: string };

export interface Plate {
  shape: ShapeSource;
  /** Size of the page [mm] without what an offset adds. Whoever sets it keeps a file's proportions. A height of 0
   * follows the picture of the lowest layer. */
  width: number;
  height: number;
  /** Layers from the bottom to the top; the lowest fills the page. */
  layers: readonly PlateLayer[];
  /** Settings that all pictures share. `spool` is also the filament whose colour and gloss the appearance shows. */
  pictures: PictureParams;
  toolpath: ToolpathParams;
  print: Omit<PrintParams, 'date'>;
  printer: Machine;

  // The studio's own parts follow.
  name: string;
  /** Printer that came with a design from elsewhere, unused until the visitor agrees; kept with the visitor's work
   * only, never in links. */
  brought?: Machine | undefined;
  /** The body that slicers get together with the plate's directions. */
  body?: Body | undefined;
  /** The visitor's own spool, whose colour and gloss replace those of `pictures.spool`. */
  spool?: OwnSpool | undefined;
}

/** The parts of a plate that determine its page. */
export type PageParts = Pick<Plate, 'shape' | 'width' | 'height'>;

/** Width and height of the page [mm]; a positive offset of the outline enlarges it. */
export function pageOf({ shape, width, height }: PageParts): [number, number] {
  const grown = 2 * Math.max(0, shape.offset);
  return [width + grown, (height || width) + grown];
}
