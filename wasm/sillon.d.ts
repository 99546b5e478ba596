// sillon: a picture and a 2D shape become one continuous, dense, oriented toolpath, and G-code.
// Lengths are mm, angles degrees, speeds mm/s. World space: x right, y up, origin at the page's lower left.

/** Loads the engine into a worker of its own. Nothing is ever computed on the calling thread.
 * @throws SillonError `InvalidArgument` (an option), `LoadFailed` (the file that could not be fetched or compiled). */
export function createEngine(options?: EngineOptions): Promise<Engine>;

export interface EngineOptions {
  /** 'auto': as many as the machine has, at most 8, where memory can be shared between threads, else 1; 'off': 1;
   * a number: 1..64. Results never depend on it. Default 'auto'. */
  threads?: 'auto' | 'off' | number;
  /** Folder from which the files of `sillon/dist/engine` are served, with or without a final slash; may be another origin.
   * Default: beside this module. */
  assetBase?: string | URL;
  /** Milliseconds without work after which the worker is ended and its memory given back; it comes back by itself.
   * 0..Infinity. Default 10000. */
  idleTimeout?: number;
  /** Most memory that the engine may take in each of its two workers [MiB], 64..4096; so may, apart from it, a worker's JavaScript
   * in Node, and a G-code file that is not taken in pieces. A call that would need more ends with `OutOfMemory`. Default:
   * 3072; with threads as much of it as the system lets them share. */
  memory?: number;
}

/** Makes all that a page that sells or shows plates needs of an upload, with limits. The engine that it starts is ended in
 * any case. docs/guide/shops.md
 * @throws SillonError as the calls of Engine do; `TooLarge` also after `limits.seconds`, `OutOfMemory` also beyond
 * `limits.memory`. */
export function preparePlate(upload: PlateInput, options?: PrepareOptions): Promise<PreparedPlate>;

export interface PrepareOptions {
  toolpath?: ToolpathOptions;
  /** Printer of the shop; it replaces one in the upload, because a machine runs its start and end blocks. */
  printer?: Partial<Printer>;
  print?: Partial<PrintParams>;
  /** The filament that poster and view show. */
  filament?: Partial<ViewParams>;
  /** Longer side of the poster [pixels], 16..1024. Default 640. */
  posterSide?: number;
  /** Ends the work, too. */
  signal?: AbortSignal;
  limits?: {
    /** For all of it. More than 0; default 60. */
    seconds?: number;
    /** The same as EngineOptions.memory. Default 512. */
    memory?: number;
    /** The same as EngineOptions.threads. Default 'off', because servers have other uploads to look after. */
    threads?: EngineOptions['threads'];
  };
  /** The same as EngineOptions.assetBase. */
  assetBase?: string | URL;
}

export interface PreparedPlate {
  /** image/png: the look under one light. */
  poster: Blob;
  /** image/png: for `<sillon-view>`. */
  view: Blob;
  /** text/x-gcode */
  gcode: Blob;
  /** Faults that would make a print fail, the same as `sillon check` finds. */
  findings: GcodeFinding[];
  grams: number;
  /** Estimate. */
  minutes: number;
  /** Width and height of the plate's page [mm]. */
  page: [number, number];
  summary: GcodeSummary;
  report: Report;
}

/** The engine as it was started, and the reason if it has fewer threads than asked for. */
export interface EngineInfo {
  version: string;
  variant: 'mt' | 'st';
  /** Threads that compute. */
  threads: number;
  /** One sentence, when fewer threads run than were asked for; else empty. */
  reason: string;
  /** Why: the page is not isolated from others, or threads did not start or run; empty where `reason` is. */
  reasonCode: '' | 'NotIsolated' | 'GivenUp';
}

/** Calls run one after the other, in the order they were made. All of them reject with a SillonError, with the signal's
 * reason, or with what a callback of the call threw; the engine stays usable after any error. */
export interface Engine {
  readonly info: EngineInfo;
  /** @throws `InvalidArgument` (which field, its value, its range), `InvalidFile`, `EmptyShape`, `TooLarge`,
   * `OutOfMemory`. */
  generateToolpath(input: PlateInput, params?: ToolpathOptions, options?: GenerateOptions): Promise<ToolpathResult>;
  /** Makes a tiny plate and drops it, so that the first plate of a visitor is about as quick as the next ones: for pages
   * that have the engine before they have anything to make. Takes a quarter of a second of the worker's time, once. */
  warm(options?: RunOptions): Promise<void>;
  /** @throws `InvalidArgument`, `DoesNotFit`, `EmptyShape`. */
  writeGcode(
    toolpath: Toolpath,
    printer?: Partial<Printer>,
    print?: Partial<PrintParams>,
    options?: GcodeOptions,
  ): Promise<Gcode>;
  /** The base layers as a solid that other slicers print: the shape as high as they are, where writeGcode has them; no
   * elephant's foot is taken off, and whether it fits the bed is not looked at. `print.startHeight` then prints the rest.
   * @param shape of a toolpath, or from readShape. @returns model/3mf, or binary model/stl.
   * @throws `InvalidArgument` (also where `print.base` is 0), `DoesNotFit` (in height), `EmptyShape`, `TooLarge`. */
  writeBaseBody(
    shape: Shape,
    printer?: Partial<Printer>,
    print?: Partial<PrintParams>,
    options?: BodyOptions,
  ): Promise<Blob>;
  /** The beads as strokes coloured by direction, and the nozzle's closed line above them. */
  writeSvg(toolpath: Toolpath, options?: RunOptions): Promise<Blob>;
  /** A small picture of directions, from which `<sillon-view>` draws the plate's shimmer on web pages. */
  writeView(toolpath: Toolpath, params?: Partial<ViewParams>, options?: RunOptions): Promise<Blob>;
  /** Directions with their legend beside the look under one light, or the look alone, as PNG. */
  renderPreview(toolpath: Toolpath, params?: Partial<PreviewParams>, options?: RunOptions): Promise<Blob>;

  /** The polygons of a shape, as generateToolpath would fill them. The picture of the lowest layer lends its proportions to a
   * built-in shape without height. */
  readShape(shape: ShapeInput, layers?: readonly LayerInput[], options?: RunOptions): Promise<Shape>;
  /** The directions and modes that the layers of a plate ask of its beads, without the plate. `params`: whose spacing counts. */
  drawLayers(input: PlateInput, params?: Partial<ToolpathParams>, options?: RunOptions): Promise<DirectionRaster>;
  /** A body whose top faces have zones of straight lines, as a 3MF for PrusaSlicer, OrcaSlicer and Bambu Studio: no G-code.
   * Directions that vary become steps. */
  makeZones(input: PlateInput, how?: Partial<ZoneOptions>, options?: RunOptions): Promise<Zones>;
  /** The places of a plate's layers: their boxes, before they turn, and how thin their letters are. For handles: no picture
   * is solved for, and layers that cannot be drawn are told one by one. `params`: whose spacing counts. */
  placeLayers(input: PlateInput, params?: Partial<ToolpathParams>, options?: RunOptions): Promise<PlacedLayer[]>;
  /** PNG, JPEG, BMP or TGA to the stored values, without colour management; EXIF orientation applied.
   * Other formats: draw them to a canvas and hand over its pixels as a Picture. */
  decodePicture(file: Bytes, options?: RunOptions): Promise<Picture>;
  /** An SVG in its colours, as layers of tones see it: RGBA, 1024 pixels along its longer side or fewer, clear where nothing is painted.
   * @throws `InvalidFile`, `EmptyShape`, `TooLarge`. */
  paintDrawing(file: Bytes, options?: RunOptions): Promise<Picture>;
  /** Reads and checks a project file (docs/reference/project.md) or a published scene, and completes it with all defaults. */
  readProject(json: string, options?: RunOptions): Promise<Project>;
  /** Checks a project and returns it as the text of a file that readProject and the command line read. */
  writeProject(project: DeepPartial<Project>, options?: RunOptions): Promise<string>;

  /** The printers and filaments that come with the engine; fields `profile` and `filament` of a Printer name them. */
  profiles(options?: RunOptions): Promise<Profiles>;
  /** Takes a printer from G-code of the user's own slicer (its start and end blocks, proven there), PrusaSlicer or
   * SuperSlicer settings (.ini), an Orca preset (.json) or a project of ours.
   * @param name printer of a bundle; left out: the active one. @throws `InvalidFile`, `InvalidArgument`, `TooLarge`. */
  importPrinter(file: Bytes, name?: string, options?: RunOptions): Promise<ImportedPrinter>;
  /** Reads any G-code as a printer would and says what would go wrong.
   * @param printer whose bed and limits count; left out: what the file's own settings say. */
  checkGcode(file: Bytes, printer?: Partial<Printer>, options?: RunOptions): Promise<GcodeCheck>;
  /** Looks at a start or end block line by line, before it is trusted with a machine: heat, moves below the bed, commands
   * that outlive the print, reach files or the network or have no place in a print; unknown commands and macros. One
   * finding per line and code, in the order of the lines.
   * @param flavor only tells which commands are unknown (default 'marlin'); errors are the same for every machine. */
  examineBlock(block: string, flavor?: Printer['flavor'], options?: RunOptions): Promise<GcodeFinding[]>;
  /** G-code as the .gcode.3mf that Bambu printers take: a zip with the file, its MD5, picture, time and filament, by the
   * number that the file loads. Not tried on a printer. importPrinter and checkGcode read such files, and .bgcode.
   * @throws `InvalidArgument` for other printers' G-code and for several filaments, `TooLarge`. */
  packGcode(file: Bytes, options?: RunOptions): Promise<Blob>;

  /** The top and bottom surfaces of a file that PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura sliced:
   * G-code, .gcode.3mf, .bgcode or .gz. The engine keeps the print for the next call with the same Blob, as do printRelief and
   * rebrush: hand it over again, and it is read once. @throws `InvalidFile`, `TooLarge`. */
  listSurfaces(file: Bytes, options?: RunOptions): Promise<SlicedFile>;
  /** Computes the relief of such a print as seen from above: the highest bead at each place.
   * @param side  most cells of the longer side, 16..4096, default 1024. @throws `InvalidFile`, `InvalidArgument`. */
  printRelief(file: Bytes, side?: number, options?: RunOptions): Promise<PrintRelief>;
  /** Lays other beads on the surfaces of such a file, and changes nothing else (docs/guide/rebrush.md).
   * @throws `InvalidArgument` (also where no surface can be replaced), `InvalidFile`, `TooLarge`. */
  rebrush(file: Bytes, how?: Partial<RebrushOptions>, options?: RunOptions): Promise<Rebrushed>;

  /** A small print that teaches a setting of a printer or a filament, as `sillon calibrate` writes it (docs/guide/calibrate.md).
   * @throws `InvalidArgument` (also where the hot end cannot do a value), `DoesNotFit`, `TooLarge`. */
  calibrate(kind: CalibrationKind, request?: CalibrationRequest, options?: RunOptions): Promise<Calibration>;
  /** Measures the spool in a photograph of the print 'coupon' (docs/internals/photographs.md).
   * @param photograph  as decodePicture gives it, or a canvas; at most 64 million pixels.
   * @throws `InvalidFile` (one sentence: why nothing can be measured), `InvalidArgument`, `TooLarge`. */
  readCoupon(photograph: Picture, request?: CouponRequest, options?: RunOptions): Promise<CouponReading>;
  /** Joins the readings of one coupon's photographs, as `sillon calibrate read` does. Lamp and camera are the first's.
   * @param readings  of readCoupon, at least one. @param request  that they were read with.
   * @throws `InvalidFile` (one sentence) where one differs so much that it shows another spool, `InvalidArgument`. */
  joinReadings(
    readings: readonly CouponReading[],
    request?: CouponRequest,
    options?: RunOptions,
  ): Promise<CouponReading>;

  /** Ends the worker; running and waiting calls reject with code `Disposed`. */
  dispose(): void;
}

export interface RunOptions {
  /** Rejects the call at once and ends its work within 100 ms. A page that shares no memory (headers COOP and COEP) ends the
   * worker for that, which browsers may take two seconds for, and the next plate reuses nothing. */
  signal?: AbortSignal;
  /** At most every 30 ms, and with 1 at the end. @param fraction of the whole job, in [0, 1], never falling. */
  onProgress?: (progress: { stage: string; fraction: number }) => void;
}

export interface GenerateOptions extends RunOptions {
  /** Also judge the plate (alignment, coverage, overlap, ...), which takes up to half as long as making it. Default true. */
  measure?: boolean;
  /** Makes the path of the layer below instead: its beads run across the plate's, except along the border. It is not
   * measured. */
  across?: boolean;
}

export interface GcodeOptions extends RunOptions {
  /** Receives the file in pieces of UTF-8, in order, as they are written; then `blob` is empty. It may be
   * asynchronous: the call ends after what it promises, and rejects as that does; the next pieces do not wait for it. */
  onChunk?: (chunk: Uint8Array) => void;
  /** The path of the layer below, from generateToolpath with `across`; needed where `print.basePattern` is 'across'. */
  below?: Toolpath;
}

export interface BodyOptions extends RunOptions {
  /** Default '3mf', which says that its numbers are millimetres. */
  format?: '3mf' | 'stl';
}

/** docs/guide/calibrate.md shows each. */
export type CalibrationKind = 'flow' | 'speed' | 'fan' | 'width' | 'directions' | 'swatch' | 'coupon';

export interface CalibrationRequest {
  printer?: Partial<Printer>;
  print?: Partial<PrintParams>;
  /** Only of the swatch. */
  toolpath?: ToolpathOptions;
  /** First and last value to try, in the kind's unit; left out: the kind's own. */
  from?: number;
  to?: number;
  /** Filament that the file's pictures and `picture` show. Default: blue PLA. */
  filament?: Partial<ViewParams>;
  /** Longer side of `picture` [pixels], 64..1024; 0 makes none. Default 0. */
  pictureSide?: number;
}

export interface Calibration {
  /** text/x-gcode */
  blob: Blob;
  summary: GcodeSummary;
  /** Check of the same file, read back. */
  check: GcodeCheck;
  /** Value to enter: names of settings, or words where it is none of ours. */
  setting: string[];
  /** Unit of the values: 'mm', 's', 'mm/s', 'degrees Celsius', '%', 'degrees' or ''. */
  unit: string;
  /** One English sentence: which of the values is right. */
  advice: string;
  /** Values that were tried, each with its place from the page's lower left. `label` is printed beside it. */
  values: { label: string; value: number; at: [number, number] }[];
  /** Width and height. */
  page: [number, number];
  /** image/png: how the print would look under one light. */
  picture?: Blob;
}

export interface CouponRequest {
  /** The printer for which the coupon was made; nozzle and flow count. */
  printer?: Partial<Printer>;
  print?: Partial<PrintParams>;
  from?: number;
  to?: number;
  /** A slope as `pictures.lampSize`, 0..2; left out: unknown, and small. */
  lampSize?: number;
  /** Elevation measured to within 2° [degrees], 10..80; if left out, 47 to within 9° is assumed. */
  lampElevation?: number;
}

/** With one standard deviation. */
export interface Measured {
  value: number;
  error: number;
}

export interface CouponReading {
  /** RMS slopes of the surface that the nozzle passed over, along and across the bead [degrees]. */
  along: Measured;
  across: Measured;
  /** The lowest that closes the surface; null: none of the discs tells it. */
  flow: Measured | null;
  /** Without `flow`: all discs are closed, or none is; neither: the photograph does not tell. */
  allDiscsClosed: boolean;
  noDiscClosed: boolean;
  /** Width of a bead, and the width that was asked for. */
  width: Measured;
  widthAsked: number;
  /** Direction of the lamp, in the coupon's own directions [degrees]. */
  azimuth: Measured;
  elevation: Measured;
  /** Tilt of the camera off the coupon's normal [degrees]. */
  tilt: number;
  pixelsPerMm: number;
  /** Standard deviation. */
  blur: number;
  /** For a file of spools. */
  spool: Spool;
}

/** An entry of a file of spools: docs/reference/spools.md. */
export interface Spool {
  colour: [number, number, number];
  fine: SpoolSlopes;
  wide?: SpoolSlopes;
  source?: string;
}

/** Along and across the bead [degrees]. */
export interface SpoolSlopes {
  nozzleSide: [number, number];
  bedSide: [number, number];
}

/** The beads to lay on a print. */
export interface RebrushOptions {
  /** The same as of a plate. Where the lowest shows pictures, beads follow borders only as far as these allow it, unless
   * `toolpath.perimeterMode` says otherwise. */
  layers: readonly LayerInput[];
  /** Settings that all pictures share. */
  pictures: Partial<PictureParams>;
  /** The spacing is that of each surface. */
  toolpath: ToolpathOptions;
  /** Bottoms are those that lie on the bed. Default 'top'. */
  sides: 'top' | 'bottom' | 'both';
  /** The page that the layers lie on: each face, the box around the faces of one object, the bed, or the box around all faces.
   * Default 'face'. */
  fit: 'face' | 'object' | 'bed' | 'all';
  /** Places in the list of listSurfaces: these alone, whatever their side. Default: all that `sides` names. */
  only: number[];
}

/** Heights above the bed at the middle of each cell, row 0 on top. */
export interface PrintRelief {
  /** Lower left, on the bed. */
  corner: [number, number];
  cell: number;
  columns: number;
  rows: number;
  /** 0: nothing lies there. */
  heights: Float32Array;
}

/** Why a surface cannot be replaced: `core/include/sillon/rebrush/rebrush.hpp` lists them. */
export type LeftReason =
  | 'Narrow'
  | 'Small'
  | 'Covered'
  | 'Bridge'
  | 'Ironed'
  | 'Interleaved'
  | 'Command'
  | 'Object'
  | 'Height'
  | 'Modes'
  | 'Flow'
  | 'Travel'
  | 'Cut'
  | 'Path'
  | 'Coverage'
  | 'Spill'
  | 'After';

/** A surface of a sliced file. */
export interface SlicedSurface {
  side: 'top' | 'bottom';
  /** From 1. */
  layer: number;
  z: number;
  height: number;
  /** The slicer's name for it; may be empty. */
  object: string;
  tool: number;
  /** On a page of its own, whose lower left lies at `corner` on the bed. */
  region: Shape;
  corner: [number, number];
  areaMm2: number;
  /** Width of its beads, and spacing between them. */
  width: number;
  spacing: number;
  volumeMm3: number;
  speed: number;
  /** Why it cannot be, or was not, replaced; else empty. */
  left: string;
  /** The same as one word; else empty. */
  reason: LeftReason | '';
}

export interface SlicedFile {
  slicer: 'PrusaSlicer' | 'SuperSlicer' | 'OrcaSlicer' | 'Bambu Studio' | 'Cura';
  program: string;
  layers: number;
  lines: number;
  /** 0.4 where the file does not tell. */
  nozzle: number;
  surfaces: SlicedSurface[];
}

export interface Rebrushed {
  /** The same kind of file. */
  blob: Blob;
  /** By which the print takes longer, as estimated; the file's own times say so too. */
  seconds: number;
  /** The surfaces that were asked for. */
  surfaces: (SlicedSurface & {
    /** Its place in the list of listSurfaces. */
    index: number;
    replaced: boolean;
    newVolumeMm3: number;
    /** -1 is perfect. */
    alignment: number;
    /** [%] */
    coverage: number;
    /** Greatest distance by which a bead reaches over the region. */
    beyond: number;
    seconds: number;
    /** Lamps as azimuth and elevation, how well each picture is seen (docs/reference/metrics.md), and the share of it that is
     * cut off to keep its proportions, 0..1. */
    pictures: { layer: number; lamp: [number, number]; r: number; ssim: number; contrast: number; leftOut?: number }[];
    /** The new path, on the region's page; none where it was left. */
    cycles: Cycle[];
  })[];
}

// --- What goes in ------------------------------------------------------------------------------------------------------

/** The sections of a project file, with bytes in place of file names. */
export interface PlateInput {
  /** Default: a rectangle of the direction picture's proportions. */
  shape?: ShapeInput;
  /** The plate shows these, the last on top; the lowest fills it. Default: beads at 0 degrees. */
  layers?: readonly LayerInput[];
  /** Settings that all pictures share; the slopes are those of the spool from the nozzle of `printer` unless `slopes` says
   * others. */
  pictures?: Partial<PictureParams>;
  /** Whose nozzle lays the beads: it gives pictures the spool's slopes. As for writeGcode; default: 0.4 mm. */
  printer?: Partial<Printer>;
  /** Whose `showSide` is the side that pictures are seen on. As for writeGcode. */
  print?: Partial<PrintParams>;
}

/** Directions and modes over a page, row 0 on top. */
export interface DirectionRaster {
  width: number;
  height: number;
  /** 0..65535 is −90..90 degrees, counter-clockwise from the right. */
  angle: Uint16Array;
  /** 0 parallel, 1 orthogonal, 2 smoothest, 3 constrained. */
  mode: Uint8Array;
}

/** Ways to cut a body into zones. */
export interface ZoneOptions {
  /** An STL, on whose top the layers lie. Default: a prism of the plate's shape. */
  body: Bytes;
  /** Corner and height [mm] of a level top face of the body: the plate's shape is its outline then, and it alone gets zones.
   * Default: all tops. */
  face: readonly [x: number, y: number, z: number];
  /** Height of that prism, 0.05..5000 mm. Default 2. */
  height: number;
  /** The most directions, 2..12. Default 6. */
  most: number;
  /** Narrowest place of a zone, 0.5..100 mm. Default 3. */
  least: number;
  /** Layer height that the slicer is told, 0.01..2 mm. Default 0.2. */
  layerHeight: number;
}

export interface Zones {
  /** model/3mf */
  file: Blob;
  /** By angle, 0 to 180 degrees. */
  zones: { degrees: number; areaMm2: number }[];
  /** Mean angle between the directions that were asked for and those of the zones [degrees]. */
  error: number;
  /** Edges of the body that an odd number of triangles share: slicers may find no layers where there are any. */
  openEdges: number;
  notes: DrawingNote[];
  warnings: GcodeWarning[];
}

/** The box of a layer on the page. */
export interface PlacedLayer {
  /** Its middle, from the page's lower left corner [mm]. */
  at: [number, number];
  /** Before it turns [mm]. */
  size: [number, number];
  /** Share of letters or of a drawing that is narrower than two beads, 0..1. */
  thin: number;
  /** Reason why the layer cannot be drawn; the box is what it asks for. */
  problem?: string;
}

/** One layer: its kind, and whatever differs from the defaults. A `font` is a built-in one, or a file's bytes. */
export type LayerInput = Partial<Omit<Layer, 'file' | 'maskFile' | 'modeFile' | 'font' | 'pictures'>> & {
  kind: Layer['kind'];
  file?: InputFile;
  maskFile?: InputFile;
  modeFile?: InputFile;
  font?: string | Bytes;
  pictures?: readonly { file: InputFile; lamp?: readonly [number, number] | null }[];
};

/** A round hole: its middle in mm from the page's lower left corner, to the right and upwards, and its diameter in mm. */
export interface RoundHole {
  x: number;
  y: number;
  diameter: number;
}

/** The shapes that need no file. */
export type BuiltinShape =
  'rectangle' | 'rounded' | 'disc' | 'hexagon' | 'heart' | 'shield' | 'star' | 'ring' | 'tag' | 'text';

/** Changes of any shape. `offset`: its outline is moved outwards by so many mm, -20..50, and its page grows with it; below 0
 * inwards, on the same page. `holes`: up to 16, cut out last. `keepThin`: places of half a bead to one are widened to one. */
export interface ShapeChanges {
  offset?: number;
  holes?: readonly RoundHole[];
  keepThin?: boolean;
}

export type ShapeInput = ShapeChanges &
  /** `size`: width and height in mm; a height of 0 is the shape's own. `radius`: of corners in mm, default 3. `points`: of a star, 3..24,
   * default 5. `inner`: diameter of the hole of a ring or a tag in mm; default 0: half of the ring, 5 mm of a tag. */
  (
    | {
        builtin: BuiltinShape;
        size?: readonly [number, number];
        radius?: number;
        corners?: 'round' | 'chamfer';
        points?: number;
        inner?: number;
        /** Letters of the shape `text`, as wide as its size, and their font: a built-in one, or a file's bytes. */
        text?: string;
        font?: string | Bytes;
        /** Weight of these letters, 1..1000, if their font is a variable one; 0 is the font's own. */
        weight?: number;
      }
    /** SVG, or a mask picture whose bright, opaque pixels are inside. `pageWidth` 0: as drawn, 80 mm for a mask.
     * `paint`: a drawing is what it shows (default), or all its outlines, whatever their paint. */
    | { file: InputFile; pageWidth?: number; unitless?: 'px' | 'mm'; paint?: 'shown' | 'ignore' }
    /** A rectangle of the direction picture's proportions. */
    | { size?: readonly [number, number] }
  );

/** Grey 0..1 is -90..90°; grey 0..1 is 0..180°; red and green are x and y. */
export type DirectionEncoding = 'angle' | 'rotation' | 'tangent';

/** In a mode picture grey 0, 85, 170, 255. */
export type DirectionMode = 'parallel' | 'orthogonal' | 'smoothest' | 'constrained';

/** A file's bytes, SVG text, or pixels. Nothing is detached or changed. */
export type InputFile = string | ArrayBuffer | ArrayBufferView | Blob | Picture;

/** A file's bytes. */
export type Bytes = ArrayBuffer | ArrayBufferView | Blob;

/** Row 0 on top, channels interleaved: grey, grey + alpha, RGB or RGBA. 8-bit samples count as value * 257. */
export interface Picture {
  width: number;
  height: number;
  channels: 1 | 2 | 3 | 4;
  samples: Uint8Array | Uint8ClampedArray | Uint16Array;
}

/** A preset to begin with, and values that override its own. */
export interface ToolpathOptions extends Partial<ToolpathParams> {
  preset?: Preset;
}

/** Ways to make a toolpath; docs/reference/project.md says what they change. */
export type Preset = 'draft' | 'fewest-turns' | 'fine' | 'paper-2023' | 'standard';

/** A picture to be seen, and where its lamp stands. */
export interface LampPicture {
  file: string;
  /** Azimuth counter-clockwise from +x, -360..360, and elevation, 1..90 [degrees]; null: chosen for the picture. */
  lamp: [number, number] | null;
}

/** A colour as '#rrggbb', and the direction of what is painted in it [degrees]. */
export interface ColourAngle {
  colour: string;
  angle: number;
}

/** One gesture of a brush. */
export interface Stroke {
  /** Turns beads to the way of the brush, sets `mode`, or brings back what lies below the layer. Default 'comb'. */
  tool?: 'comb' | 'mode' | 'erase';
  /** Radius of the brush, 0.1..1000 mm. Default 4. */
  radius?: number;
  /** Rim of the brush: 0 is hard, 1 fades from its middle. Default 0.5. */
  soft?: number;
  mode?: DirectionMode;
  /** x0, y0, x1, y1, ... from the lower left corner of the page [mm]. */
  points: number[];
}

/** One of the `layers` of docs/reference/project.md; which kind has which setting is told there. */
export interface Layer {
  /** The content of the layer: one direction, a direction picture, pictures under their lamps, a text, a QR code, a pattern, the tones of a picture, a drawing, a band along the border, or strokes of brushes. Default "direction". */
  kind: 'direction' | 'map' | 'picture' | 'text' | 'code' | 'pattern' | 'tones' | 'drawing' | 'border' | 'strokes';
  /** A layer that is not visible draws nothing. Default true. */
  visible: boolean;
  /** Middle of the layer, from the lower left corner of the page; null: the middle of the page. -10000..10000 mm, default null. */
  at: [number, number] | null;
  /** Width and height before it turns; a side of 0 follows the content. 0..10000 mm, default [0,0]. */
  size: [number, number];
  /** Turns the layer counter-clockwise about its middle. -360..360 °, default 0. */
  rotation: number;
  /** Mirrors the layer left to right before it turns. Default false. */
  mirror: boolean;
  /** The places where it shows: its own letters, drawing or box, the disc in its box, the whole page, or inside or outside of the mask file. Default "own". */
  mask: 'own' | 'disc' | 'page' | 'inside' | 'outside';
  /** Drawing or mask picture that bounds the layer, stretched over its box. Default "". */
  maskFile: string;
  /** Width over which its directions turn into those below, about its edge. 0..100 mm, default 0. */
  soft: number;
  /** Beads lie along the border, across it, as smoothly as possible, or as the directions say. Default "constrained". */
  mode: 'parallel' | 'orthogonal' | 'smoothest' | 'constrained';
  /** Picture of the modes, over the layer’s box; empty: the mode everywhere. Default "". */
  modeFile: string;
  /** Direction of its beads on the page, counter-clockwise from the right; turns rays, rings and edges. -360..360 °, default 0, of direction, text, code, pattern, tones, drawing, border. */
  angle: number;
  /** Direction in the box around letters or a drawing; null: what lies below shows, and the light modules of a QR code lie across the dark ones. -360..360 °, default null, of text, code, drawing. */
  ground: number | null;
  /** Beads fill letters, drawings and borders in one direction, along the outline, or across what lies below. Default "across", of text, drawing, border. */
  fill: 'angle' | 'along' | 'across';
  /** File of a map, of tones, of a drawing or of an echo. Default "", of map, pattern, tones, drawing. */
  file: string;
  /** Reading of a map’s picture as directions: grey is −90 to 90°; grey is 0 to 180°; red and green are x and y. Default "angle", of map. */
  encoding: 'angle' | 'rotation' | 'tangent';
  /** Pictures to show, one per lamp: {"file", "lamp"}; lamp is [azimuth, elevation] in degrees; null: the solver chooses, and above other layers it is the lamp of the lowest pictures, or 60 and 45. Default [], of picture. */
  pictures: LampPicture[];
  /** Lower left corner of the part of a picture that is used, in shares of the picture. 0..1, default [0,0], of map, picture, tones. */
  cropMin: [number, number];
  /** Upper right corner of that part. 0..1, default [1,1], of map, picture, tones. */
  cropMax: [number, number];
  /** Letters, in one or several lines, what a QR code says, or what an echo without a file follows. Default "", of text, code, pattern. */
  text: string;
  /** A built-in font, or a TTF or OTF file. Default "Nunito", of text, pattern. */
  font: string;
  /** Weight of the letters, where the font is a variable one; 0 is the font’s own. 0..1000, default 0, of text, pattern. */
  weight: number;
  /** Height of capitals, where the size is 0. 1..1000 mm, default 10, of text, pattern. */
  textSize: number;
  /** Radius of the circle that letters stand on; 0: straight; below 0: along the lower side, to be read from inside. -5000..5000 mm, default 0, of text, pattern. */
  circle: number;
  /** Place of shorter lines in the box. Default "middle", of text, pattern. */
  align: 'left' | 'middle' | 'right';
  /** Share of a QR code that may be damaged: 7, 15, 25 or 30 percent. Default "medium", of code. */
  correction: 'low' | 'medium' | 'quartile' | 'high';
  /** Rays from the middle turned by the angle (90 makes rings), rays that turn on their way out, waves, smooth chance, or contours around a drawing or letters. Default "radial", of pattern. */
  pattern: 'radial' | 'spiral' | 'waves' | 'noise' | 'echo';
  /** Length of one wave, way out over which a spiral turns by 180°, or distance of the knots of noise. 1..1000 mm, default 20, of pattern. */
  waveLength: number;
  /** Angle by which waves and noise turn the directions to either side. 0..90 °, default 20, of pattern. */
  amplitude: number;
  /** Another number makes another noise of the same kind. 0..9007199254740991, default 1, of pattern. */
  seed: number;
  /** Directions follow the brightness, two levels of it, the edges, or the flat colours of a picture or drawing. Default "brightness", of tones. */
  by: 'brightness' | 'levels' | 'edges' | 'colours';
  /** Direction where the picture is black, or darker than the threshold. -360..360 °, default 0, of tones. */
  from: number;
  /** Direction where the picture is white, or lighter than the threshold. -360..360 °, default 90, of tones. */
  to: number;
  /** Tone between dark and light levels: 0 is black, 1 is white. 0..1, default 0.5, of tones. */
  threshold: number;
  /** Contrast of brightness about the middle grey; 1 leaves the picture as it is. 0..10, default 1, of tones. */
  contrast: number;
  /** Blur of the brightness, or width over which edges are averaged. 0..100 mm, default 0, of tones. */
  smoothing: number;
  /** Directions of flat colours: {"colour": "#rrggbb", "angle": degrees}; other colours go with the nearest. Default [], of tones. */
  colours: ColourAngle[];
  /** Width of a band along the border. 0.1..1000 mm, default 3, of border. */
  width: number;
  /** Gestures of brushes, in order: {"tool", "radius", "soft", "mode", "points"}; tool is comb, mode or erase; points are [x, y, x, y, ...] in mm on the page. Default [], of strokes. */
  strokes: Stroke[];
}

/** Section `pictures` of docs/reference/project.md. */
export interface PictureParams {
  /** Keep cuts off what sticks out of a page of other proportions, as much on either side; stretch covers the page with all of the picture. Default "keep". */
  proportions: 'keep' | 'stretch';
  /** The filament whose reflection the pictures are solved for. Default "bluePla". */
  spool: 'bluePla' | 'clearPetg' | 'goldPla' | 'greyPla' | 'redPetg';
  /** RMS surface slopes of your own spool, along and across the bead; null uses the named spool’s. 0.1..45 °, default null. */
  slopes: [number, number] | null;
  /** Angular size of the lamp, as the surface slope that would blur its reflection as much: 0.02 is a bulb, 0.1 a softbox, 0.4 a window. 0..2, default 0.1. */
  lampSize: number;
  /** Weight of smooth directions against exact tones: larger values give fewer U-turns and less detail. 0.001..10, default 0.02. */
  smoothness: number;
  /** Amount of local contrast added before solving; makes faces readable but departs from the picture’s own tones. 0..2, default 0. */
  localContrast: number;
  /** Number of times the pictures are solved again to correct what the previous plate did not show; each takes as long as a plate. 0..8, default 3. */
  corrections: number;
}

/** Section `toolpath` of docs/reference/project.md: defaults, units and ranges. */
export interface ToolpathParams {
  /** Width of the lines: the distance between the middles of neighbouring beads; start with the nozzle diameter. 0.05..20 mm, default 0.4. */
  spacing: number;
  /** Whether beads end at the outline, follow it where the directions allow, or are enclosed by a number of walls. Default "count". */
  perimeterMode: 'none' | 'soft' | 'count';
  /** Number of beads along the outline, where they enclose the others. 0..100, default 1. */
  perimeters: number;
  /** Joins solids closer than this into one path; null uses one spacing. 0..100 mm, default null. */
  bridge: number | null;
  /** Whether neighbouring pixels of the direction picture are averaged or the nearest one is taken. Default "average". */
  mapFilter: 'average' | 'nearest';
  /** 0 is regular; every other number gives a different plate of the same quality. 0..9007199254740991, default 0. */
  seed: number;
  /** How far a seed moves the points where directions are sampled. 0..0.25 τ, default 0.025. */
  jitter: number;
  /** Continues a neighbour’s wave by the mean of both directions, or by the neighbour’s alone as in 2023. Default "midpoint". */
  phaseTransport: 'midpoint' | 'neighbour';
  /** Smoothing sweeps on each level of the hierarchy; more sweeps take longer. 1..1000, default 8. */
  sweepsPerLevel: number;
  /** How much closer or wider than the line width beads may lie to save U-turns, by a factor of up to e^this; 0 keeps them evenly spaced. 0..0.5, default 0.3. */
  spacingVariation: number;
  /** Beads may deviate from the directions by up to this angle to save U-turns; takes about twice as long. 0..30 °, default 0. */
  directionTolerance: number;
  /** Radius over which the cells’ waves are averaged: three standard deviations of a Gaussian; 0.5 in 2023. 0.45..1.5 τ, default 1. */
  kernelRadius: number;
  /** How strongly beads follow the outline where the choice is theirs, relative to a neighbour. 0..100, default 1. */
  borderWeight: number;
  /** Cost of misaligned length where two curves are joined. 0..10, default 1.1. */
  stitchAlignment: number;
  /** Lays neighbouring beads soon after one another, for an even shine, or joins curves wherever that costs least. Default "even". */
  order: 'even' | 'plain';
  /** Rounds that move beads apart where they lie nearer than half a spacing (Eq. 15); 8 in 2023. 0..100, default 0. */
  repulsionRounds: number;
  /** Rounds of relaxation, which evens out the gaps between beads: fewer kinks, slightly less exact directions. 0..100, default 2. */
  relaxationRounds: number;
  /** How far a bead moves towards its wider gap per round, as a fraction of the difference between its gaps. 0..0.5, default 0.08. */
  relaxationStrength: number;
  /** How much each round of relaxation straightens a bead. 0..1, default 0.65. */
  relaxationSmoothing: number;
  /** 0: the nearer neighbour limits the width on both sides (Eq. 16); 1: the space between both neighbours does. 0..1, default 1. */
  widthBalance: number;
  /** Overlap of neighbouring beads above which both are made narrower; 1 allows any. 0..1 τ, default 0.0021. */
  beadOverlap: number;
  /** Minimum bead width, except where the border leaves less space. 0.1..1 τ, default 0.5. */
  minWidth: number;
  /** Maximum bead width. 1..4 τ, default 2. */
  maxWidth: number;
  /** Largest change of position and width when points are removed; larger values make smaller files. 0..1 mm, default 0.0013. */
  simplifyTolerance: number;
}

/** Section `printer` of docs/reference/project.md. */
export interface Printer extends PrinterValues {
  /** Id of a printer, such as `prusa-mk4s`; the other fields override it. */
  profile: string;
  /** Id of a filament, laid over the printer. */
  filament: string;
}

export interface PrinterValues {
  /** Printer name, written into the G-code. Default "Generic". */
  name: string;
  /** Firmware dialect of the G-code; Prusa is for Prusa’s Buddy boards; Bambu needs your own start block. Default "marlin". */
  flavor: 'marlin' | 'klipper' | 'reprap' | 'prusa' | 'bambu';
  /** Lower left corner of the bed: 0, 0 on most printers, negative where the origin is at the centre. -5000..5000 mm, default [0,0]. */
  bedMin: [number, number];
  /** Upper right corner of the bed, at least 10 mm to the right of and above the lower left one. -5000..5000 mm, default [220,220]. */
  bedMax: [number, number];
  /** The bed is the disc inscribed in its corners, which must form a square. Default false. */
  roundBed: boolean;
  /** Lower left corner of a rectangle on the bed that nothing may touch. -5000..5000 mm, default [0,0]. */
  excludedMin: [number, number];
  /** Upper right corner of that rectangle; equal corners exclude nothing. -5000..5000 mm, default [0,0]. */
  excludedMax: [number, number];
  /** Highest Z the printer can reach while printing. 0.05..5000 mm, default 200. */
  maxZ: number;
  /** Added to each Z position between the start block and the end block, for printers whose Z is 0 above or below the bed; slicers call it z_offset. -2..2 mm, default 0. */
  zOffset: number;
  /** Nozzle diameter; 0.4 mm on most printers. 0.05..2 mm, default 0.4. */
  nozzle: number;
  /** Filament diameter: 1.75 mm, or 2.85 mm on some printers. 0.5..5 mm, default 1.75. */
  filamentDiameter: number;
  /** Filament density, used only to estimate weight. 0.1..25 g/cm³, default 1.24. */
  filamentDensity: number;
  /** Flow ratio of the filament (extrusion multiplier), as calibrated in your slicer; it multiplies the flow of every layer, brim and purge line. 0.1..2, default 1. */
  filamentFlow: number;
  /** Filament type, written into the G-code. Default "PLA". */
  filamentType: string;
  /** Highest nozzle temperature that the hot end is made for, such as 240 with a PTFE tube down to the nozzle. 170..300 °C, default 300. */
  maxNozzleTemperature: number;
  /** Highest bed temperature that the printer is made for. 0..120 °C, default 120. */
  maxBedTemperature: number;
  /** For experts: the nozzle may have 0 to 300 °C and the bed up to 120, which no machine may exceed, instead of the printer’s own limits. Default false. */
  generalHeatLimits: boolean;
  /** Nozzle temperature, as on the filament’s label; 170 to the printer’s limit unless the general limits hold. 0..300 °C, default 215. */
  nozzleTemperature: number;
  /** Nozzle temperature of the first layer, often slightly higher for adhesion; 170 to the printer’s limit unless the general limits hold. 0..300 °C, default 220. */
  firstLayerNozzleTemperature: number;
  /** Bed temperature, as on the filament’s label; at most the printer’s limit unless the general limits hold. 0..120 °C, default 60. */
  bedTemperature: number;
  /** Printing speed; slow and constant gives the cleanest reflection. 5..1000 mm/s, default 50. */
  speed: number;
  /** Printing speed of the first layer; slower adheres better. 5..1000 mm/s, default 20. */
  firstLayerSpeed: number;
  /** Printing speed of bottom layers above the first; 0 uses the printing speed. 0..1000 mm/s, default 0. */
  baseSpeed: number;
  /** Printing speed of the top layers; 0 uses the printing speed, but at most 20 mm/s where pressure advance is not set. 0..1000 mm/s, default 0. */
  showSpeed: number;
  /** Speed of moves that do not extrude. 5..1000 mm/s, default 120. */
  travelSpeed: number;
  /** The machine’s own speed limit, at least 5; all speeds are capped at it; 0 means unknown. 0..1000 mm/s, default 0. */
  machineSpeed: number;
  /** Acceleration while printing; 1000 to 2000 gives clean U-turns. 1..100000 mm/s², default 1000. */
  acceleration: number;
  /** Acceleration on the first layer; 0 uses the printing acceleration. 0..100000 mm/s², default 0. */
  firstLayerAcceleration: number;
  /** The printer’s own acceleration, restored at the end, and the upper limit while printing; 0 means unknown: acceleration is only used for estimates and not set. 0..100000 mm/s², default 0. */
  machineAcceleration: number;
  /** Klipper’s square corner velocity; about half of Marlin’s jerk. 0.1..100 mm/s, default 5. */
  cornerSpeed: number;
  /** The printer’s own corner speed, restored at the end; 0 means unknown: corner speed is only used for estimates and not set. 0..100 mm/s, default 0. */
  machineCornerSpeed: number;
  /** Limits speed in curves of radius r to the square root of this times r, but never below 5 mm/s; 0 means no limit. 0..100000 mm/s², default 1000. */
  curveAcceleration: number;
  /** Fan speed on the first layer. 0..100 %, default 0. */
  firstLayerFan: number;
  /** Fan speed on bottom layers above the first; negative values choose what the filament usually gets, such as 100 for PLA, 50 for PETG and 10 for ABS. -1..100 %, default -1. */
  baseFan: number;
  /** Fan speed on top layers above the first; negative values choose what the filament usually gets, such as 100 for PLA, 50 for PETG and 10 for ABS. -1..100 %, default -1. */
  showFan: number;
  /** Layers that would take less time are slowed down, but not below 5 mm/s; 0 means no minimum. 0..300 s, default 8. */
  minLayerTime: number;
  /** Largest volume per second the hot end can melt; wide beads are slowed down to stay within it. 0.1..1000 mm³/s, default 10. */
  maxFlow: number;
  /** Largest number of moves per second the printer’s board can process. 1..100000 1/s, default 300. */
  maxSegmentsPerSecond: number;
  /** Pressure advance of the printer and filament; limits how fast the bead width changes along the path. 0..2 s, default 0.04. */
  pressureAdvance: number;
  /** Writes pressure advance into the G-code; otherwise the printer keeps its own. Default false. */
  setPressureAdvance: boolean;
  /** Length of filament retracted before a travel. 0..20 mm, default 0.8. */
  retractLength: number;
  /** Speed at which filament is retracted and returned. 1..200 mm/s, default 35. */
  retractSpeed: number;
  /** Height the nozzle is raised before a travel. 0..20 mm, default 0.4. */
  lift: number;
  /** Writes E as absolute positions (M82, reset with G92 E0 on each layer) instead of distances, for hosts that do not support relative extrusion. Default false. */
  absoluteE: boolean;
  /** Start block with optional placeholders; empty uses the built-in one: home, heat, wait. Default "". */
  startGcode: string;
  /** End block with optional placeholders; empty uses the built-in one: park, heaters off. Default "". */
  endGcode: string;
  /** Thumbnail sizes in pixels: WxH, WxH/PNG or WxH/QOI; at most 8, with sides of 16 to 1024. Default "32x32, 300x300". */
  screenSizes: string;
}

/** Section `print` of docs/reference/project.md, and the date in the file's first line. */
export interface PrintParams {
  /** Number of layers of directed beads, which show, on each side that shows them. 1..1000, default 1. */
  layers: number;
  /** Number of plain layers under the top layers. 0..1000, default 2. */
  base: number;
  /** Hatching at alternately 45 and 135°, loops that follow the outline, the path of the top layers itself, or hatching with the layer next to the top layers across their beads, which takes a second path. Default "hatched". */
  basePattern: 'hatched' | 'concentric' | 'same' | 'across';
  /** Loops along the outline of hatched bottom layers. 0..10, default 1. */
  basePerimeters: number;
  /** Top: what shows is on top. Bed: it is mirrored on the bed, the bottom layers above it. Both: both sides, for shapes that are their own mirror image. Default "up". */
  showSide: 'up' | 'bed' | 'both';
  /** Loops around the plates that prime the nozzle. 0..20, default 1. */
  skirt: number;
  /** Filament extruded beside the plate before printing, in addition to what the last print retracted. 0..100 mm, default 10. */
  purgeLength: number;
  /** Number of layers of a raised border on top of the top layers, along the outline and its holes. 0..50, default 0. */
  rim: number;
  /** Width of the raised border, in whole lines as wide as the nozzle and at least one. 0.1..100 mm, default 2. */
  rimWidth: number;
  /** Loops attached to the plate’s first layer, for adhesion. 0..50, default 0. */
  brim: number;
  /** Inset of the first bottom layer, to compensate for its being squeezed wider. 0..0.5 mm, default 0.1. */
  elephantFoot: number;
  /** Prints wide beads of top layers slower and narrow ones faster (speed × spacing / width, at most 1.5 times the speed), so that the plastic flows evenly; not on the first layer. Default false. */
  constantFlow: boolean;
  /** Length before the end of a path that is travelled without extruding. 0..1 mm, default 0. */
  coast: number;
  /** Length over which the two ends of a top layer’s cycle overlap, one ramping down while the other ramps up; requires coasting of 0. 0..20 mm, default 0. */
  scarf: number;
  /** Columns and rows of copies, printed one after another; copied plates may be at most 3 mm high. 1..20, default [1,1]. */
  copies: [number, number];
  /** Distance between copies, brims included. 1..100 mm, default 10. */
  copyGap: number;
  /** Layer height, at most 0.8 of the nozzle diameter. 0.05..1.6 mm, default 0.2. */
  layerHeight: number;
  /** Prints on top of an object of this height that stands on the bed, which the printer must not touch as it homes; at most the build height. 0..5000 mm, default 0. */
  startHeight: number;
  /** First layer height, at least 0.05 mm and at most 0.8 of the nozzle diameter; 0 uses the layer height. 0..1.6 mm, default 0. */
  firstLayerHeight: number;
  /** Extrusion multiplier of the top layers; slightly below 1 keeps the grooves between beads crisp. 0.01..2, default 0.95. */
  flow: number;
  /** Extrusion multiplier of the bottom layers; 1 fills them. 0.01..2, default 1. */
  baseFlow: number;
  /** Extrusion multiplier of a top layer that is printed on the bed; less than 1 leaves fine gaps there. 0.01..2, default 1. */
  bedFlow: number;
  /** Rotation of the plate on the bed, counter-clockwise. -360..360 °, default 0. */
  rotate: number;
  /** Mirrors the plate left to right, before rotation, for plates seen from below; a show side on the bed is mirrored automatically. Default false. */
  mirror: boolean;
  /** Refuses a path that crosses itself or leaves the shape by more than 0.1 mm; otherwise both are only reported. Default false. */
  strict: boolean;
  /** Where the lower left corner of the (rotated) page goes on the bed; null centres it. -10000..10000 mm, default null. */
  place: [number, number] | null;

  /** Date in the file's first line; default: now. The same date gives the same bytes. */
  date: Date;
}

/** The filament that a plate is shown in. */
export interface ViewParams {
  /** Colour of the body: red, green, blue in sRGB, 0..255. Default gold. */
  colour: [number, number, number];
  /** RMS slopes of the surface along and across the bead [degrees], 0.1..45. Default 8.93, 15.6. */
  slopes: [number, number];
}

export interface PreviewParams {
  /** Width of one panel [pixels], 16..16384; of the look alone 16..1024, like its height, which follows the page. Default 1600;
   * 1024 for the look alone. */
  width: number;
  /** Directions with their legend beside the look, or the look alone, as a poster. Default 'both'. */
  panels: 'both' | 'look';
  /** Colour of the body: red, green, blue in sRGB, 0..255. Default blue. */
  colour: [number, number, number];
  /** RMS slopes of the surface along and across the bead [degrees], 0.1..45. Default 2.36, 17.32. */
  slopes: [number, number];
  /** Direction of the light, degrees counter-clockwise from +x. Default 60. */
  lightAzimuth: number;
  /** Degrees above the plate, 1..90. Default 35. */
  lightElevation: number;
}

/** A project file, complete; `file` is a name, empty for none. */
export interface Project {
  sillon: 1;
  shape: {
    file: string;
    builtin: 'none' | BuiltinShape;
    size: [number, number];
    radius: number;
    corners: 'round' | 'chamfer';
    points: number;
    inner: number;
    pageWidth: number;
    unitless: 'px' | 'mm';
    paint: 'shown' | 'ignore';
    offset: number;
    holes: RoundHole[];
    keepThin: boolean;
    /** Letters of the shape `text`, their font, and their weight where it is a variable one. */
    text: string;
    font: string;
    weight: number;
  };
  /** Left out: none. */
  layers?: (Partial<Layer> & Pick<Layer, 'kind'>)[];
  pictures: PictureParams;
  toolpath: ToolpathParams;
  print: Omit<PrintParams, 'date'>;
  printer: Printer;
  /** The studio's own values in a project; other programs leave them as they are. */
  studio?: Record<string, unknown>;
}

export type DeepPartial<T> = T extends readonly unknown[]
  ? T
  : T extends object
    ? { [K in keyof T]?: DeepPartial<T[K]> }
    : T;

// --- What comes out ----------------------------------------------------------------------------------------------------

export interface ToolpathResult {
  toolpath: Toolpath;
  report: Report;
  /** Present for two pictures and more. */
  conflict?: Conflict;
}

/** Tones that pictures on one plate take from each other, in cells over the page, row 0 on top. */
export interface Conflict {
  width: number;
  height: number;
  /** For each picture, `width` times `height` tones asked for minus tones that the directions show under its lamp: -100..100, in
   * percent of the way (in sRGB) from the darkest direction to white. Above 0 light is missing, below 0 there is too much. */
  missing: Int8Array[];
}

/** Plain data, copied out of the engine: may be kept, changed, cloned and its buffers transferred. */
export interface Toolpath {
  /** Distance between neighbouring beads. */
  spacing: number;
  /** One per connected part, in printing order. */
  cycles: Cycle[];
  /** Shape that was filled: base layers and skirt are made from it. */
  shape: Shape;
  /** Notes on the making and the quality of the toolpath, for the G-code's header. */
  notes: string[];
  /** Given for plates that show pictures: the look of the pictures in the G-code, too. */
  look?: Look;
}

/** The filament and the light under which a plate of pictures is to be seen. */
export interface Look {
  /** Colour of the spool, sRGB. */
  colour: [number, number, number];
  /** Along and across the bead, degrees. */
  slopes: [number, number];
  /** A slope, as `pictures.lampSize`. */
  lampSize: number;
  /** Azimuth and elevation for each picture, degrees. */
  lamps: [number, number][];
}

/** A closed path of beads; the segment from the last point to the first is extruded like any other. */
export interface Cycle {
  /** x0, y0, x1, y1, ... */
  points: Float32Array;
  /** Bead width at each point; half as many as `points`. */
  widths: Float32Array;
}

export interface Shape {
  page: [number, number];
  paths: { fillRule: 'nonzero' | 'evenodd'; rings: Float64Array[] }[];
  /** Numbers of texts and pictures of the drawing that are not in the shape: text on paths, or in scripts that no built-in font
   * has. */
  texts?: number;
  images?: number;
  /** Text of the drawing is set in built-in fonts, which stand in for its own. */
  otherFont?: boolean;
  /** Painted, but cut off at the page's edges, as viewers do [mm²]. */
  offPage?: number;
  /** Nothing is painted: outlines were taken whatever their paint. */
  unpainted?: boolean;
  /** Places that `keepThin` widened: x, y [mm], area [mm²], width [mm]. */
  kept?: [number, number, number, number][];
}

/** docs/reference/report.md. Everything from `lengthMm` on but `time` and `digest` only where the plate was measured. */
export interface Report {
  version: string;
  spacing: number;
  grid: [number, number];
  parts: number;
  cycles: number;
  toolpaths: number;
  points: number;
  longestJointMm: number;
  gapJoints: number;
  /** Toolpaths more than connected parts: no joint to the rest of their part was possible. */
  unjoined: number;
  /** Middles of these toolpaths, x, y [mm]. */
  apart: [number, number][];
  /** Seconds by stage, and their `total`. */
  time: Record<string, number>;
  /** Greatest size of the engine's memory. */
  peakBytes: number;
  threads: number;
  /** Equal digests mean equal plates, on every platform. */
  digest: string;
  /** Notes on what was taken for granted of the drawings of the shape and of visible layers, or left out of them. */
  notes: DrawingNote[];
  /** Warnings about these drawings, the pictures and the path. Those of the print stand in `GcodeSummary.warnings`. */
  warnings: GcodeWarning[];

  lengthMm?: number;
  alignment?: number;
  alignmentInterior?: number;
  alignmentConstrained?: number;
  coverage?: number;
  overlap?: number;
  spill?: number;
  uTurns?: number;
  kinks?: number;
  crossings?: number;
  dislocations?: number;
  singularities?: number;
  dislocationBound?: number;
  turnBound?: number;
  width?: { p01: number; median: number; p99: number; belowHalf: number; clamped: number };
  fillRatio?: number;
  lostAreaMm2?: number;
  /** The largest hundred: x, y [mm], area [mm²], width [mm]. */
  lostPlaces?: [number, number, number, number][];
  /** Widened to one bead by `keepThin`. */
  keptAreaMm2?: number;
  /** The same as lostPlaces, for the parts that were kept. */
  keptPlaces?: [number, number, number, number][];
  /** Figures on how well the toolpath shows each picture under its lamp: docs/reference/metrics.md. */
  pictures?: PictureReport[];
  /** Visible layers: the shares of their letters, drawing, modules or box that are not seen, each for one reason. */
  layers?: LayerReport[];
}

export interface LayerReport {
  /** From 1, as in warnings. */
  layer: number;
  /** Beside the plate or in its holes, 0 to 1. */
  beside: number;
  /** Under the rim. */
  underRim: number;
  /** By layers above. */
  covered: number;
  /** Within 15 degrees of what it lies on. */
  alike: number;
  /** Present for a QR code. */
  readable?: boolean;
}

export interface PictureReport {
  /** Number of its layer, from 1. */
  layer: number;
  file: string;
  /** Azimuth and elevation, degrees. */
  lamp: [number, number];
  /** Correlation of what is seen with the picture, -1 to 1. */
  r: number;
  ssim: number;
  /** The brightest by the darkest. */
  contrast: number;
  /** Correlation with the other pictures under this lamp. */
  others: number[];
  from: 'gcode' | 'toolpath';
}

export interface Gcode {
  /** text/x-gcode; empty where `onChunk` took the pieces. */
  blob: Blob;
  summary: GcodeSummary;
}

export interface GcodeSummary {
  filamentMm: number;
  filamentCm3: number;
  filamentGrams: number;
  /** Estimate. */
  seconds: number;
  moves: number;
  bytes: number;
  clampedLengthMm: number;
  /** Length of oriented beads that `curveAcceleration` slows. */
  curveSlowedMm: number;
  warnings: GcodeWarning[];
}

export interface DrawingNote {
  /** One of those that `core/src/report/input_note.cpp` lists: `TextLeftOut`, `SeveralColours` … */
  code: string;
  /** `layer`, from 1, where it is about a layer's drawing or mask, and the words in braces of `message`'s pattern. */
  values: Record<string, number | string>;
  /** One English sentence. */
  message: string;
}

/** A fact that the user should know of a plate, or of a file that was written. */
export interface GcodeWarning {
  code: WarningCode;
  /** Numbers, names of settings, and what a reader of a block says; the words in braces of `message`'s pattern. */
  values: Record<string, number | string>;
  /** The same as one English sentence. */
  message: string;
}

export type WarningCode =
  | 'AccelerationHeld'
  | 'BaseTooThin'
  | 'BlockMovesLow'
  | 'DetailLost'
  | 'DrawingFaint'
  | 'DrawingLettersLost'
  | 'DrawingOffPage'
  | 'DrawingUnpainted'
  | 'DrawingUnread'
  | 'EndHot'
  | 'EndLine'
  | 'FillRatio'
  | 'FlatBeads'
  | 'LayerLeftOut'
  | 'LayerLettersLent'
  | 'LayerLettersLost'
  | 'LayerOnlyPicture'
  | 'LettersLent'
  | 'ManyBytes'
  | 'ManyMoves'
  | 'MaxFlowSlows'
  | 'MirroredUp'
  | 'NoPressureAdvance'
  | 'NotPrimed'
  | 'NotPrimedAbovePrint'
  | 'OutsideShape'
  | 'PictureLost'
  | 'PictureOneTone'
  | 'PicturesCrowded'
  | 'PressureAdvanceReset'
  | 'PrintOnBed'
  | 'PrintedApart'
  | 'SegmentsSlow'
  | 'SkirtLeftOut'
  | 'SpeedHeld'
  | 'StartFlow'
  | 'StartLine'
  | 'StartScales'
  | 'StartTemperature'
  | 'ThinLayers'
  | 'ThinLetters'
  | 'UnusualFilament'
  | 'UnusualFlow'
  | 'WidthHeld';

export interface Profiles {
  printers: PrinterProfile[];
  filaments: PrinterProfile[];
}

export interface PrinterProfile {
  id: string;
  /** The default printer with the profile’s values; without `profile` and `filament`. */
  printer: PrinterValues;
}

export interface ImportNote {
  /** A code of `core/src/printer_import/notes.cpp`: `BedUnknown`, `OutOfRange` …, or the `reason` of an error. */
  code: string;
  /** Values that the message names: texts as in the file, numbers in plain notation. */
  values: Record<string, string>;
  /** One sentence in English. */
  message: string;
}

export interface ImportedPrinter {
  /** Values that the file does not tell are those of `profile`, else the defaults. */
  printer: PrinterValues;
  /** The printer that comes with the library and is the same machine; empty where none is known. */
  profile: string;
  source: 'donor G-code' | 'PrusaSlicer settings' | 'Orca settings' | 'project';
  /** Names of the settings taken. */
  read: string[];
  /** Settings that could not be taken over or need a look. */
  notRead: ImportNote[];
}

export interface GcodeCheck {
  findings: GcodeFinding[];
  /** Rules that could not be judged, since no printer was given and the file does not tell the machine's limits. */
  unchecked: ('bed' | 'height' | 'nozzle' | 'flow' | 'speed')[];
  /** Lines that put the print at risk. */
  errors: number;
  lines: number;
  moves: number;
  layers: number;
  filamentMm: number;
  pathMm: number;
  travelMm: number;
  /** Paths whose end is their beginning, and others. */
  closed: number;
  open: number;
  retractions: number;
  /** Greatest speed of beads. */
  fastest: number;
  /** Length of oriented beads slower than the fastest of their layer. */
  slowedMm: number;
  /** mm³/s. */
  mostFlow: number;
  /** Moves per second over any 8. */
  mostMoves: number;
  printer: string;
  /** Box of the middles of beads, without start and end blocks, mm; null: there are none. */
  box: { min: [number, number]; max: [number, number] } | null;
  /** Top of the highest bead, mm. */
  top: number;
  /** Share of the base that each oriented layer of a file of ours covers; null where there is no base. */
  coverage: (number | null)[];
  /** Times that the beads of the visible layers wait for their neighbours; null: no oriented bead has one, or the file is
   * not ours. */
  neighbourDelay: NeighbourDelay | null;
}

/** Weighed by length; docs/reference/metrics.md. */
export interface NeighbourDelay {
  /** Share of the length beside a bead laid more than 30 s earlier or later, 0..1. */
  over30: number;
  /** More than 120 s. */
  over120: number;
  /** 90 % of the length wait no longer [s]. */
  most: number;
  /** Share of the length between two beads laid earlier: there the sense changes in which beads lean, and with it the shine. */
  squeezed: number;
}

/** One rule that was broken, however often. */
export interface GcodeFinding {
  /** One per sentence, such as 'too-hot'. */
  code: string;
  /** Group of the code, such as 'heating'. */
  rule: string;
  /** The print is at risk; else worth knowing. */
  error: boolean;
  /** The first, from 1; 0: the file as a whole. */
  line: number;
  count: number;
  /** Values that the sentence shows, by name, such as { limit: '300', degrees: '480' }. */
  values: Record<string, string>;
  /** In English. */
  message: string;
}

export type ErrorCode =
  /** A parameter, an input or an option is not what it must be; the message names it, its value and its range. */
  | 'InvalidArgument'
  /** Bytes that cannot be read as what they claim to be. */
  | 'InvalidFile'
  /** The job would need more than the limits allow. */
  | 'TooLarge'
  /** Nothing to fill. */
  | 'EmptyShape'
  /** Larger than the printer's bed. */
  | 'DoesNotFit'
  /** The engine ran out of memory; it has been started afresh. */
  | 'OutOfMemory'
  /** An engine file could not be fetched or compiled; the message names its address. */
  | 'LoadFailed'
  /** The worker ended or fell silent; it has been started afresh. */
  | 'Crashed'
  /** dispose() was called. */
  | 'Disposed'
  /** Our fault. */
  | 'Internal';

/** The reasons that are one sentence. Words in braces are its `values`. */
export type PlainReason =
  /** The run was cancelled. */
  | 'Cancelled'
  /** No bead fits into this shape at a toolpath.spacing of {spacing} mm; use a smaller one or a larger shape. */
  | 'NoBeadFits'
  /** Nothing in the drawing is filled, and no bead fits into its lines at a toolpath.spacing of {spacing} mm; shape.paint ignore (--paint ignore) fills what they enclose. */
  | 'LinesTooThin'
  /** Hole {n} at {x}, {y} mm, {diameter} mm wide, lies outside the shape, which reaches from {left}, {bottom} to {right}, {top} mm; move it onto the shape, or leave it out. */
  | 'HoleOutside'
  /** An offset of {offset} mm leaves nothing of the shape, whose deepest place is {depth} mm from the outline; use an offset that is nearer to 0. */
  | 'OffsetTooDeep'
  /** No font has a letter for {letter}; take a font that has it, or leave it out. */
  | 'MissingLetter'
  /** The font {font} has {letter} only as a picture; take a font that has its outline, or leave it out. */
  | 'PictureLetter'
  /** {name} is {value} mm; it must be more than 0 and at most {most} mm. */
  | 'SizeOutOfRange'
  /** At a width of {width} mm the height is {height} mm; it must be more than 0 and at most {most} mm. */
  | 'HeightOutOfRange'
  /** Shape.radius is {radius} mm; it must be 0 or more. */
  | 'RadiusNegative'
  /** Shape.inner is {inner} mm; it must be more than 0 and less than the shorter side of {side} mm. */
  | 'InnerOutOfRange'
  /** The holes leave nothing of the shape; make them smaller or fewer. */
  | 'HolesLeaveNothing'
  /** The outline has too many edges or meets itself too often; at most 4 million pieces can be read; merge its paths in a drawing program, or draw it as a PNG. */
  | 'OutlineTooManyPieces'
  /** The outline is too detailed for this spacing or this memory; simplify the drawing. */
  | 'OutlineTooDetailed'
  /** The shape has a point at {x}, {y} mm; both coordinates must be -{most} to {most} mm. */
  | 'ShapePointTooFar'
  /** The shape has no outline; it needs at least one closed path. */
  | 'NoOutline'
  /** The shape encloses no area; it needs at least one closed path with an inside. */
  | 'NoInside'
  /** The mask has no pixels; it needs a picture of 1 to 4 channels. */
  | 'MaskWithoutPixels'
  /** The outline of the mask has more than 4 million points; use a smaller or less noisy picture. */
  | 'MaskTooDetailed'
  /** The mask is empty; some of its pixels must be at least 50 % bright or opaque. */
  | 'MaskEmpty'
  /** The page is {width} × {height} mm; both sides must be 0.001 to 100000 mm. */
  | 'PageOutOfRange'
  /** The toolpath has a point outside −100000 to 100000 mm. */
  | 'PathPointTooFar'
  /** The toolpath has a bead width outside 0 to 1000 mm. */
  | 'BeadTooWide'
  /** The plate needs more than a thousand million path points; use a larger toolpath.spacing. */
  | 'PathTooLong'
  /** {name} is a picture of {width} × {height} pixels with {channels} channels and {samples} samples; it must have pixels, 1 to 4 channels and a sample for each. */
  | 'SamplesUnlikePicture'
  /** {name} is a picture whose sides, channels and number of samples do not fit; it must have 1 to 4 channels, sides of 1 to {side} pixels, at most {millions} million pixels, and a sample for each channel of each pixel. */
  | 'SamplesUnlikeSides'
  /** The map of {name} is {width} × {height} pixels with {values} values; it must have a pixel at least, and one value for each. */
  | 'ValuesUnlikeMap'
  /** The direction map is a picture with {channels} channels; tangents need red and green, 3 or 4. */
  | 'TangentsNeedColours'
  /** The angle is not a finite number of degrees; it must be one. */
  | 'AngleNotFinite'
  /** {file} cannot be read as {format}: it is cut off; copy or download it again. */
  | 'PictureCutOff'
  /** {file} cannot be read as {format}: it is damaged; save it again in a picture editor. */
  | 'PictureDamaged'
  /** {file} cannot be read as {format}: its header is damaged or of an unknown kind; save it again in a picture editor. */
  | 'PictureHeader'
  /** {file} cannot be read as {format}: it holds no picture. */
  | 'PictureEmpty'
  /** {file} cannot be read as {format}: it has more than 100 scans; save it again in a picture editor. */
  | 'PictureScans'
  /** {file} cannot be read as {format}: it is packed (run lengths); save it without compression. */
  | 'PicturePacked'
  /** {file} has {width} × {height} pixels; at most {side} per side and {millions} million in all are allowed, {transparent} million with transparency. */
  | 'PictureTooLarge'
  /** {file} is empty; it must hold at least one byte. */
  | 'FileEmpty'
  /** {file} is named but not given; hand its bytes over. */
  | 'FileNotGiven'
  /** {file} is a {kind} file; pictures must be PNG, JPEG, BMP or TGA, and drawings plain SVG in UTF−8. */
  | 'FormatUnread'
  /** {file} is not a picture that can be read (it begins with bytes {bytes}); PNG, JPEG, BMP and TGA can. */
  | 'UnknownPicture'
  /** The font is {font}; it must be a file that is handed over, or one of {known}. */
  | 'UnknownFont'
  /** {font} is no font; it must be a TrueType or OpenType file, plain or packed (.ttf, .otf, .woff, .woff2). */
  | 'NoFont'
  /** The letters of {font} have more than {megabytes} MiB of curves; take another font. */
  | 'FontTooDetailed'
  /** The line is {line} mm long and its circle {circle} mm; take a larger circle, smaller letters or fewer of them. */
  | 'LineLongerThanCircle'
  /** The text has no ink; it must have letters that can be seen. */
  | 'TextWithoutInk'
  /** The text has {bytes} bytes; no QR code of this correction holds it: shorten it, or lower the correction. */
  | 'QrTooLong'
  /** The drawing is not UTF−8 text; save it as plain SVG. */
  | 'SvgNotText'
  /** The file holds no <svg> element; save the drawing as plain SVG. */
  | 'SvgEmpty'
  /** The file is not well-formed XML in line {line}, at {text}; save it again in a drawing program. */
  | 'SvgNotXml'
  /** The first element is {text}; it must be <svg>. */
  | 'SvgFirstElement'
  /** Elements nest deeper than {most} levels; ungroup them in a drawing program. */
  | 'SvgNested'
  /** The file declares more than {most} namespaces at one place; save it as plain SVG. */
  | 'SvgNamespaces'
  /** The entities of the DOCTYPE are too many or too long; at most 1000 are read, of 1 MiB in all, for a text of 64 MiB. */
  | 'SvgEntities'
  /** <use> repeats so many elements that the drawing becomes too large; repeat fewer. */
  | 'SvgUseRepeats'
  /** Clipping repeats so many outlines that the drawing becomes too large; combine the paths under each clip path or mask into one. */
  | 'SvgClipRepeats'
  /** <style> has so many rules that the drawing becomes too large; save it with fewer. */
  | 'SvgStyleRules'
  /** There are too many outlines without paint; combine some of them. */
  | 'SvgLoosePieces'
  /** The outlines have more than {most} points; simplify the drawing. */
  | 'SvgPoints'
  /** A point lies more than 1 km away; coordinates in mm must be within 1000000. */
  | 'SvgPointTooFar'
  /** The drawing has more than {most} letters; convert text to paths, or leave some out. */
  | 'SvgLetters'
  /** The radii of an arc are too small for its length; draw the arc as a curve. */
  | 'SvgArcRadii'
  /** The size of the drawing is unknown; <svg> needs width and height, or a viewBox. */
  | 'SvgWithoutSize'
  /** {attribute} is {text}, which makes a side of {value} mm; it must be more than 0 and at most {most} mm. */
  | 'SvgPageSide'
  /** Width and height must not be negative. */
  | 'SvgNegativeSize'
  /** {attribute} is {text}; it must not be negative. */
  | 'SvgNegative'
  /** {attribute} is {text}; known units are mm, cm, in, pt, pc, px, Q, em, ex and %. */
  | 'SvgUnit'
  /** {attribute} is {text}; it must be lengths. */
  | 'SvgLengths'
  /** Href is {text}; it must name an element of this file by #id. */
  | 'SvgHrefElsewhere'
  /** Href is {text}, but no element has this id. */
  | 'SvgHrefUnknown'
  /** {attribute} is {text}, which shows itself again. */
  | 'SvgShowsItself'
  /** {attribute} has {text} where a number must stand. */
  | 'SvgNumber'
  /** {attribute} has the number {text}, which is too large. */
  | 'SvgNumberTooLarge'
  /** {attribute} has {text} where a flag 0 or 1 must stand. */
  | 'SvgFlag'
  /** {attribute} has {text} where a {sign} must stand. */
  | 'SvgSign'
  /** {attribute} has {text} where a command M L H V C S Q T A or Z must stand. */
  | 'SvgCommand'
  /** {attribute} has {text} where M, the first command, must stand. */
  | 'SvgFirstCommand'
  /** {attribute} has {text} where a known unit must stand. */
  | 'SvgUnitHere'
  /** {attribute} has {text} where a transform such as translate(1 2) must stand. */
  | 'SvgTransform'
  /** {attribute} has {text} where it must end. */
  | 'SvgEnd'
  /** Transform has {text} with {count} numbers; it must be matrix, translate, scale, rotate, skewX or skewY with the numbers it takes. */
  | 'SvgTransformNumbers'
  /** Transform-origin is {text}; it must be two lengths, or words such as center. */
  | 'SvgTransformOrigin'
  /** ViewBox is {text}; its width and height must be more than 0. */
  | 'SvgViewBox'
  /** PreserveAspectRatio is {text}; it must be none or an alignment such as xMidYMid, then meet or slice. */
  | 'SvgAspectRatio'
  /** All that is painted lies off the page or is clipped away; shape.paint ignore (--paint ignore) takes outlines whatever their paint and place. */
  | 'PaintOffPage'
  /** The drawing has no area to fill; it needs paths, basic shapes, lines with a stroke or text that can be set in a built-in font (images do not count). */
  | 'NothingDrawn'
  /** The text is not JSON at line {line}, column {column}; a project or scene is one JSON object. */
  | 'NotJson'
  /** The JSON is nested deeper than {most} levels; a project needs 5. */
  | 'JsonTooDeep'
  /** Unknown key {setting}; similar names: {near}. */
  | 'KeyLike'
  /** Unknown key {setting}; known are {known}. */
  | 'KeyUnknown'
  /** {setting} has no {key}; it must have one. */
  | 'KeyMissing'
  /** {name} is unknown for {setting}; similar names: {near}. */
  | 'NameLike'
  /** {name} is unknown for {setting}; known are {known}. */
  | 'NameUnknown'
  /** {setting} is of the JSON type {type}; it must be text. */
  | 'NotText'
  /** {setting} is of the JSON type {type}; it must be true or false. */
  | 'NotFlag'
  /** {setting} is of the JSON type {type}; it must be a number. */
  | 'NotNumber'
  /** {setting} is of the JSON type {type}; it must be a number or null. */
  | 'NotNumberOrNull'
  /** {setting} is of the JSON type {type}; it must be a whole number. */
  | 'NotWhole'
  /** {setting} is {value}; it must be a whole number from {low} to {high}. */
  | 'NotWholeNumber'
  /** {setting} is of the JSON type {type}; it must be two numbers [x, y]. */
  | 'NotPair'
  /** {setting} is {value}; it must be two whole numbers. */
  | 'NotWholePair'
  /** {setting} is of the JSON type {type}; it must be a list. */
  | 'NotList'
  /** {setting} is of the JSON type {type}; it must be an object. */
  | 'NotObject'
  /** {setting} must be a list of numbers x, y, x, y, ... in mm. */
  | 'NotPoints'
  /** {setting} is {value}; it must be {choices}. */
  | 'NotChoice'
  /** {setting} is not for the kind {kind}; it has {known}. */
  | 'OtherKind'
  /** Sillon is {version}; this program reads version {known}. */
  | 'OtherVersion'
  /** The project has no version; it must have "sillon": {known}. */
  | 'NoVersion'
  /** The file is neither a project nor a scene; a project has "sillon": 1, a scene has "nozzle_width" and "svg_path". */
  | 'NoProject'
  /** There is no shape; give a shape file, a built-in shape ({names}) or a direction picture. */
  | 'NoShape'
  /** {setting} has {bytes} bytes; it must be text of at most {most}. */
  | 'TextTooLong'
  /** {setting} is {value}; it must be one line of at most {most} bytes. */
  | 'NotOneLine'
  /** {setting} has {count} entries; it may have up to {most}. */
  | 'TooMany'
  /** {setting} have {count} points; they may have up to {most}. */
  | 'TooManyPoints'
  /** {setting} is {value}; it must be "#rrggbb". */
  | 'NotColour'
  /** {setting} is empty; it must name a file. */
  | 'FileNotNamed'
  /** {setting} is empty; it must have letters. */
  | 'TextMissing'
  /** Layers.pictures is empty; it must have at least one picture. */
  | 'PicturesMissing'
  /** Layers.file is empty; an echo must name a drawing, or have letters in layers.text. */
  | 'EchoOfNothing'
  /** Shape has both file {file} and a builtin; it must have one of them. */
  | 'TwoShapes'
  /** Printer.bedMax is {max} mm; it must be {low} to {high} mm right of and above printer.bedMin {min}. */
  | 'BedSides'
  /** Printer.roundBed is true on a bed of {width} × {depth} mm; it must be a square. */
  | 'RoundBedSides'
  /** Printer.screenSizes must be at most 8 sizes of 16 to 1024 pixels, such as "16x16/QOI, 300x300/PNG". */
  | 'ScreenSizes'
  /** Layers.cropMax is {max}; it must be right of and above layers.cropMin {min}. */
  | 'CropReversed'
  /** The file holds {count} plates; export them one by one, so that none is forgotten. */
  | 'SeveralPlates'
  /** The plate lies {by} mm over the edge of the round bed. */
  | 'OverRoundBed'
  /** The plate touches the excluded part of the bed; place it elsewhere. */
  | 'OnExcludedZone'
  /** With the lift of the nozzle the print is {height} mm high; this printer reaches {most} mm. */
  | 'TooHigh'
  /** These plates are {height} mm high; several on one bed, printed one after the other, may be at most {most} mm, or the print head would touch them. */
  | 'CopiesTooHigh'
  /** The file has {count} printers, and none is chosen; name one of {names}. */
  | 'WhichPrinter'
  /** Print.rim is {rim}, but what shows lies on the bed; print.showSide must be up for a rim, or print.rim 0. */
  | 'RimBelow'
  /** Its lines are numbered, as hosts send them; take the file that the slicer wrote. */
  | 'LinesNumbered'
  /** It does not mark its surfaces; files of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio and Cura do. */
  | 'NoMarks'
  /** The file gives no filament diameter, and its beads may be {thinWidth} mm wide from filament of {thin} mm or {wideWidth} mm wide from filament of {wide} mm; add a line "; filament_diameter = {thin}" or "; filament_diameter = {wide}" at its end. */
  | 'FilamentOpen'
  /** No bead in it pushes filament by E; export it for a firmware that counts filament so. */
  | 'NoFilament'
  /** {setting} is {value}, but the shape is too thin for lines of {width} mm; it must be 0 here. */
  | 'TooThinFor'
  /** Cycle {cycle} (from 0) has {points} different points at 0.001 mm; it must have at least 3. */
  | 'FewPoints'
  /** The toolpath has a line with {points} points and {widths} widths; there must be one width per point, and at least 2. */
  | 'WidthsUnlikePoints'
  /** A point lies at ({x}, {y}) mm; coordinates must be −100000 to 100000. */
  | 'PointTooFar'
  /** A bead would be {width} × {height} mm = {area} mm2; it must be at most 4 nozzle2 = {most} mm2, so toolpath.spacing is too wide for the nozzle. */
  | 'BeadTooThick'
  /** Date is {date}; it must look like "1970−01−01 at 00:00:00 UTC". */
  | 'BadDate'
  /** {setting} must not contain "generated by"; hosts would take the file for another slicer’s. */
  | 'NamesSlicer'
  /** Print.scarf is {scarf} mm beside a print.coast of {coast}; one of them must be 0: both shape the end of a cycle. */
  | 'ScarfAndCoast'
  /** Print.startHeight is {height} mm; it must be 0 where print.showSide is not up, as that side lies on the bed. */
  | 'SideOnBed'
  /** A thumbnail is {width} × {height} pixels in {bytes} bytes; it must be 1 to 1024 pixels per side and all of them 1 to 700000 bytes. */
  | 'ThumbnailSize'
  /** Patches are printed as they are; print.showSide must be up, print.rotate 0, print.mirror off, print.copies 1x1, print.startHeight 0, print.rim 0 and print.basePattern hatched or concentric. */
  | 'PatchesPlain'
  /** A patch has a line of no length; it must have two different points. */
  | 'NoLength'
  /** A patch has a point at ({x}, {y}) mm, outside the shape that carries it. */
  | 'PatchOutside'
  /** Patch {patch} (from 0): speed is {speed} mm/s, for which a bead of {section} mm2 needs {needs} mm3/s; printer.maxFlow is {most}. */
  | 'PatchFlow'
  /** Print.basePattern is across, which needs a second toolpath, made across the first; none was given. */
  | 'NoAcross'
  /** The shape has no area; there is nothing to print. */
  | 'NoArea'
  /** The toolpath has no lines; there is nothing to print. */
  | 'NoLines'
  /** Printer.maxFlow is {flow} mm3/s; beads of {section} mm2 need at least {least} to print at 5 mm/s. */
  | 'FlowTooLow'
  /** Print.showSide is both, but the shape is not its own mirror image: {points} points of the path would lie outside; it must be up or bed here. */
  | 'NotMirrored'
  /** The path’s crossings with itself are {times}; print.strict allows none. */
  | 'CrossesItself'
  /** Printer.startGcode does not home; it must have G28 or a start macro. */
  | 'NotHomed'
  /** Printer.startGcode draws filament back by G10; it must give it back by G11. */
  | 'DrawnBack'
  /** Printer.startGcode is empty; Bambu printers need the start block of a file that their own slicer made: sillon import cube.gcode.3mf > mine.json reads it. */
  | 'BambuStart'
  /** {block} has line breaks written as \n; each command must be on a line of its own. */
  | 'BreaksWritten'
  /** {block} has "{text}" in line {line}, which has no endif. */
  | 'NoEndif'
  /** {block} has "{text}" in line {line}, which has no if before it. */
  | 'NoIf'
  /** {block} has "{text}" in line {line}, which stands for no value here; put the value itself there. */
  | 'NoValue'
  /** {block} has "{text}" in line {line}, which cannot be evaluated here; keep only the branch that applies. */
  | 'NotEvaluated'
  /** Writing was stopped before the file was complete. */
  | 'WritingStopped'
  /** No sink was given to write to. */
  | 'NoSink'
  /** The G-code has no oriented layer on this page; it must be one that was written with these settings. */
  | 'NotOriented'
  /** The {file} is cut off; fetch or export it again. */
  | 'PackedCutOff'
  /** The {file} is damaged; fetch or export it again. */
  | 'PackedDamaged'
  /** The {file} is packed in a way that is not known here; export plain G-code instead. */
  | 'PackedUnknown'
  /** The {file} is encrypted; export it without encryption. */
  | 'PackedEncrypted'
  /** The {file} holds no G-code; slice the plate before it is exported. */
  | 'PackedEmpty'
  /** The file, or what is packed in it, has {megabytes} MiB; it may have at most {most}. */
  | 'FileTooLarge'
  /** The file is {megabytes} MiB; it must be at most {most}: put fewer objects into it, or slice with a coarser resolution. */
  | 'PrintTooLarge'
  /** The body has no triangle with an area. */
  | 'NoTriangles'
  /** The mesh has a point that is not finite, or a triangle without three points of it. */
  | 'BrokenMesh'
  /** A zone is too entangled to cut into triangles; fewer or wider zones are not. */
  | 'ZoneEntangled'
  /** The outline of {points} points crosses or touches itself in a way that cannot be cut into triangles; it must be simpler. */
  | 'Entangled'
  /** The STL is cut off, or another kind of file. */
  | 'StlCutOff'
  /** The STL has a corner that is not three numbers. */
  | 'StlCorner'
  /** The STL reaches further than 10000 mm. */
  | 'StlTooFar'
  /** The STL has more than 10 million triangles; it must have at most that. */
  | 'StlTooLarge'
  /** Print.base is 0; it must be at least 1 for a body of the base layers. */
  | 'NoBase'
  /** The .gcode.3mf is for filament {package}, but the G-code for filament {gcode}; both must come from one file of your slicer, sliced with one filament: import the printer from it anew. */
  | 'FilamentsDisagree'
  /** The shape is too small for zones; a cell of them is {cell} mm wide. */
  | 'ZonesTooSmall'
  /** The body is flat; there is nothing to see from above. */
  | 'BodyFlat'
  /** The file is an archive (ZIP) without G-code in it; export the G-code from your slicer. */
  | 'ArchiveEmpty'
  /** The G-code is not for a Bambu Lab printer, and others read no .gcode.3mf; take the printer from a file of your own slicer (sillon import your.gcode.3mf), or write plain G-code. */
  | 'NotForBambu'
  /** The G-code loads {count} filaments, and a new .gcode.3mf lists one; take the printer from a file that was sliced with one filament. */
  | 'ManyFilaments'
  /** The file is neither G-code nor settings of a slicer; G-code, .ini, .json, .orca_printer and .3mf are read. */
  | 'UnknownContent'
  /** The file does not tell the bed, and its beads lie left of or before the origin, from ({left}, {front}) to ({right}, {back}); take a file of a slicer that tells it, such as PrusaSlicer or Orca. */
  | 'BedUntold'
  /** {block} of the file is longer than {most} bytes. */
  | 'BlockTooLong'
  /** The G-code marks no layer (;LAYER_CHANGE, ; CHANGE_LAYER or ;LAYER:0); export it from a slicer that does. */
  | 'NoLayers'
  /** The G-code extrudes nothing after its first layer mark. */
  | 'NoBeads'
  /** Its start block loads filament {loaded}, but its first bead is of filament {used}; slice the file with one filament. */
  | 'TwoFilaments'
  /** The file has no setting of a printer that is known here. */
  | 'NoPrinterSettings'
  /** The file has no printer {printer}; name one of {names}. */
  | 'NoSuchPrinter'
  /** The printer {printer} hardens resin; G-code is made for printers with a nozzle. */
  | 'ResinPrinter'
  /** The preset is of a {kind} and not of a printer; export the printer, or a project. */
  | 'OtherPreset'
  /** The preset inherits its bed or its start block from {name}, which lies in another file; open G-code that was sliced for this printer. */
  | 'BedElsewhere'
  /** A bead is {pixels} pixels wide in the photograph; it must be at least 4.5: go nearer, or take a camera with more pixels. */
  | 'BeadsTooSmall'
  /** A square lies there, but no beads of a coupon are seen on it; the photograph is blurred, or it shows something else. */
  | 'NoBeadsSeen'
  /** The photograph has no plain ground along its border; lay the whole coupon on plain paper with some of it on all sides. */
  | 'NoPlainGround'
  /** The photograph shows no coupon; lay it on plain paper of another colour, so that it fills about half of the picture. */
  | 'NoCoupon'
  /** The coupon is cut off by the photograph’s border; all of it and some ground around it must show. */
  | 'CouponCutOff'
  /** The photograph shows no coupon; what lies there is not square, or is cut off or covered. */
  | 'NotSquare'
  /** The photograph has {width} × {height} pixels; each side must have at least {least}. */
  | 'PhotoTooSmall'
  /** The photograph has {width} × {height} pixels; it may have 64 million: take it with fewer. */
  | 'PhotoTooLarge'
  /** The coupon does not shine as it would under one lamp; switch all other lamps off, and close the curtains. */
  | 'ManyLamps'
  /** The photograph is blurred by {blur} mm; it may be by {most}: hold the camera still and let it focus on the coupon. */
  | 'Blurred'
  /** The brightest beads are {contrast} times as bright as the darkest, and must be 1.5 times; use one small lamp, low over the coupon, in a dark room. */
  | 'LowContrast'
  /** Beads would be {percent} % as wide as they were asked for, and must be 90 to 110 %; the coupon is of other settings, or the light shows the beads too poorly: move the lamp around the coupon. */
  | 'OtherWidths'
  /** Lamp elevation is {elevation} degrees, and the photograph shows the lamp at {seen} +- {error}; measure it again at the coupon, over the table, or leave it out. */
  | 'OtherElevation'
  /** The photograph is burnt: {percent} % of the spirals’ pixels are at full scale, and 2 % may be; expose it less. */
  | 'BurntPhoto'
  /** No camera sees a square like that; the photograph is stretched, or cut out of one side of a larger one: give the whole picture as it was taken. */
  | 'StretchedPhoto'
  /** Slopes cannot be told in this light: {value} degrees within {error}; use a smaller lamp, or one that is farther away. */
  | 'SlopesUnclear'
  /** There is no reading to join; give at least one. */
  | 'NoReadings'
  /** Photograph {photograph} has slopes of {value} degrees, and their middle is {middle}; they are not of one coupon, or one is lit too poorly. */
  | 'ReadingsApart'
  /** {kind} tries all directions; from and to must be left out. */
  | 'AllDirections'
  /** {kind} from {from} to {to} has {count} values; to must be at least {least} above from. */
  | 'StepsTooFine'
  /** Fit is bed, but the file does not give its bed; it must be face, object or all. */
  | 'FitWithoutBed'
  /** A move goes further than {most} mm from the origin; no bed is as large. */
  | 'MoveTooFar'
  /** The surface covers nothing. */
  | 'SurfaceEmpty'
  /** It is binary G-code (.bgcode); in PrusaSlicer switch off Preferences, Other, "Use binary G-code when the printer supports it", and export again. */
  | 'BinaryGcode'
  /** The file was not read by readSlicedFile. */
  | 'FileNotRead'
  /** Surface {surface} is chosen; the file has {count}. */
  | 'NoSuchSurface'
  /** The file has no surface of the kind that was asked for. */
  | 'NoSurface'
  /** Two surfaces share a line of the file. */
  | 'SurfacesOverlap'
  /** This needs more memory than there is; make it smaller, or use smaller pictures. */
  | 'NeedsMoreMemory'
  /** The pictures would be judged at more than 100 million points; use a larger toolpath.spacing or a smaller size. */
  | 'JudgedTooFine'
  /** Preview of panels {width} pixels wide would be beyond {most} pixels per side or 100 million in all; choose fewer. */
  | 'PreviewTooLarge'
  /** The lamp makes no direction of this spool more than 1.5 times as bright as another; choose a lower or a smaller lamp, or a glossier spool. */
  | 'WeakLamp'
  /** A file of spools must be JSON of the form {form}. */
  | 'SpoolFile'
  /** {where} must have the form {form}. */
  | 'SpoolForm'
  /** {where} has the key {key}; it must have the form {form}. */
  | 'SpoolKey'
  /** {where} must be called by 1 to 40 letters, digits, - and _. */
  | 'SpoolName'
  /** {where} is one that comes with the program; call yours otherwise. */
  | 'SpoolTaken'
  /** Key {key} is given twice; each key may be given once. */
  | 'KeyTwice'
  /** A file has {count} spools; it may have at most {most}. */
  | 'ManySpools'
  /** The G-code would be refused by `check`: {what} (line {line} of the file); change the start or end code, or the settings of it. */
  | 'CheckRefuses'
  /** Zones show directions as they are given, so the mode must be constrained; --mode constrained sets it. */
  | 'ZonesConstrained';

/** Code of an error's sentence, for those who say it in another language than English. Besides the values of
 * the sentence there may be `place`, a file; `layer`, from 1; or `element` and `elementLine` of a drawing. */
export type ErrorReason =
  /** A number is out of its range: `setting` ("print.layerHeight"), `value`, `low`, `high`, in the setting's own unit.
   * Other numbers than those of a project have a `unit`. */
  | 'SettingOutOfRange'
  /** `left`, `right`, `front`, `back`: by how much the plate lies over that edge of the bed [mm]; those that it does. */
  | 'OverBedEdge'
  /** More cells than there may be: `spacing` [mm]; `leastSpacing` [mm] and `percent` of the size, at which it would do,
   * each where there is one. */
  | 'PlateTooLarge'
  | PlainReason
  /** No surface of a sliced file can be replaced: the reason of the largest. */
  | LeftReason
  /** The warning of that name, where it is no mere warning: a line of a block that must not run. */
  | GcodeWarning['code'];

/** Every error of the engine but an aborted signal's reason. */
export class SillonError extends Error {
  constructor(
    code: ErrorCode,
    message: string,
    hint?: string,
    told?: { reason?: ErrorReason | ''; values?: Readonly<Record<string, number | string>> },
  );
  readonly name: 'SillonError';
  readonly code: ErrorCode;
  /** One sentence on the way out; may be empty. */
  readonly hint: string;
  /** Empty for errors of the package itself and of its worker. */
  readonly reason: ErrorReason | '';
  /** Values of the reason. */
  readonly values: Readonly<Record<string, number | string>>;
}
