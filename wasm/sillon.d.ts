// sillon: a picture and a 2D shape become one continuous, dense, oriented toolpath, and G-code.
// Lengths are mm, angles degrees, speeds mm/s. World space: x right, y up, origin at the page's lower left.

/** Loads the engine into a worker of its own. Nothing is ever computed on the calling thread.
 * @throws SillonError `InvalidArgument` (an option), `LoadFailed` (the file that could not be fetched or compiled). */
export function createEngine(options?: EngineOptions): Promise<Engine>;

export interface EngineOptions {
  /** 'auto': as many as the machine has, at most 8, where memory can be shared between threads, else 1; 'off': 1;
   * a number: 1..64. Results never depend on it. Default 'auto'. */
  threads?: 'auto' | 'off' | number;
  /** Where the files of `sillon/dist/engine` are served from, with or without a final slash; may be another origin.
   * Default: beside this module. */
  assetBase?: string | URL;
  /** Milliseconds without work after which the worker is ended and its memory given back; it comes back by itself.
   * 0..Infinity. Default 10000. */
  idleTimeout?: number;
}

/** What was started, and why not more. */
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
  generateToolpath(input: PlateInput, params?: ToolpathOptions, options?: GenerateOptions): Promise<Plate>;
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
  /** Directions with their legend beside the look under one light, as PNG. */
  renderPreview(toolpath: Toolpath, params?: Partial<PreviewParams>, options?: RunOptions): Promise<Blob>;

  /** The polygons of a shape, as generateToolpath would fill them. `directions` lends its proportions to a built-in
   * shape without height. */
  readShape(shape: ShapeInput, directions?: DirectionInput, options?: RunOptions): Promise<Shape>;
  /** PNG, JPEG, BMP or TGA to the stored values, without colour management; EXIF orientation applied.
   * Other formats: draw them to a canvas and hand over its pixels as a Picture. */
  decodePicture(file: InputFile, options?: RunOptions): Promise<Picture>;
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
  /** G-code as the .gcode.3mf that Bambu printers take: a zip with the file, its MD5, picture, time and filament. Not tried
   * on a printer. importPrinter and checkGcode read such files, and .bgcode. */
  packGcode(file: Bytes, options?: RunOptions): Promise<Blob>;

  /** The top and bottom surfaces of a file that PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura sliced:
   * G-code, .gcode.3mf, .bgcode or .gz. @throws `InvalidFile`, `TooLarge`. */
  listSurfaces(file: Bytes, options?: RunOptions): Promise<SlicedFile>;
  /** What such a print looks like from above: the highest bead at each place.
   * @param side  most cells of the longer side, 16..4096, default 1024. @throws `InvalidFile`, `InvalidArgument`. */
  printRelief(file: Bytes, side?: number, options?: RunOptions): Promise<PrintRelief>;
  /** Lays other beads on the surfaces of such a file, and changes nothing else (docs/guide/rebrush.md).
   * @throws `InvalidArgument` (also where no surface can be replaced), `InvalidFile`, `TooLarge`. */
  rebrush(file: Bytes, how?: Partial<RebrushOptions>, options?: RunOptions): Promise<Rebrushed>;

  /** Ends the worker; running and waiting calls reject with code `Disposed`. */
  dispose(): void;
}

export interface RunOptions {
  /** Rejects the call at once and ends its work within 100 ms; within two seconds in a page that shares no memory and
   * whose Content-Security-Policy forbids `connect-src blob:`. */
  signal?: AbortSignal;
  /** At most every 30 ms, and with 1 at the end. @param fraction of the whole job, in [0, 1], never falling. */
  onProgress?: (progress: { stage: string; fraction: number }) => void;
}

export interface GenerateOptions extends RunOptions {
  /** Also judge the plate (alignment, coverage, overlap, ...), which takes up to half as long as making it. Default true. */
  measure?: boolean;
}

export interface GcodeOptions extends RunOptions {
  /** Receives the file in pieces of UTF-8, in order, as they are written; then `blob` is empty. */
  onChunk?: (chunk: Uint8Array) => void;
}

export interface BodyOptions extends RunOptions {
  /** Default '3mf', which says that its numbers are millimetres. */
  format?: '3mf' | 'stl';
}

/** What to lay on a print. */
export interface RebrushOptions {
  /** Default: angle 0. */
  directions: DirectionInput;
  /** Default: constrained, that is: as the directions say. */
  modes: ModeInput;
  /** Pictures to be seen under lamps, instead of `directions`; `slopes` are those of the spool. Beads then follow borders only
   * where the pictures allow it, unless `toolpath.perimeterMode` says otherwise. */
  pictures: PictureInput;
  /** The spacing is that of each surface. */
  toolpath: ToolpathOptions;
  /** Bottoms are those of the first layer. Default 'top'. */
  sides: 'top' | 'bottom' | 'both';
  /** What pictures are stretched over: each face, the faces of one object, the bed, or all faces. Default 'face'. */
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

/** Why a surface cannot be replaced: `core/include/sillon/rebrush/surfaces.hpp` lists them. */
export type LeftReason =
  | 'Narrow'
  | 'Small'
  | 'Covered'
  | 'Ironed'
  | 'Interleaved'
  | 'Command'
  | 'Object'
  | 'Height'
  | 'Modes'
  | 'Flow'
  | 'Travel'
  | 'Cut';

/** A surface of a sliced file. */
export interface SlicedSurface {
  side: 'top' | 'bottom';
  /** From 1. */
  layer: number;
  z: number;
  height: number;
  /** As the slicer names it; may be empty. */
  object: string;
  tool: number;
  /** On a page of its own, whose lower left lies at `corner` on the bed. */
  region: Shape;
  corner: [number, number];
  areaMm2: number;
  /** Of its beads, and between them. */
  width: number;
  spacing: number;
  volumeMm3: number;
  speed: number;
  /** Why it cannot be, or was not, replaced; else empty. */
  left: string;
  /** The same as one word, where reading the file tells it; else empty. */
  reason: LeftReason | '';
}

export interface SlicedFile {
  slicer: 'PrusaSlicer' | 'SuperSlicer' | 'OrcaSlicer' | 'Bambu Studio' | 'Cura';
  program: string;
  layers: number;
  lines: number;
  surfaces: SlicedSurface[];
}

export interface Rebrushed {
  /** The same kind of file. */
  blob: Blob;
  /** By which the print takes longer, as estimated; the file's own times say so too. */
  seconds: number;
  /** Those that were asked for. */
  surfaces: (SlicedSurface & {
    /** Its place in the list of listSurfaces. */
    index: number;
    replaced: boolean;
    newVolumeMm3: number;
    /** -1 is perfect. */
    alignment: number;
    /** [%] */
    coverage: number;
    /** How far a bead reaches over the region at most. */
    beyond: number;
    seconds: number;
    /** Lamps as azimuth and elevation, and how well each picture is seen: docs/reference/metrics.md. */
    pictures: { lamp: [number, number]; r: number; contrast: number }[];
    /** The new path, on the region's page; none where it was left. */
    cycles: Cycle[];
  })[];
}

// --- What goes in ------------------------------------------------------------------------------------------------------

/** The sections of a project file, with bytes in place of file names. */
export interface PlateInput {
  /** Default: a rectangle of the direction picture's proportions. */
  shape?: ShapeInput;
  /** Default: angle 0. */
  directions?: DirectionInput;
  /** Default: constrained, that is: as the directions say. */
  modes?: ModeInput;
  /** Pictures to be seen under lamps, instead of `directions`. */
  pictures?: PictureInput;
}

/** Up to four pictures, each with its lamp as [azimuth, elevation]; without one it is chosen. The slopes are those of the spool
 * from a nozzle of 0.4 mm unless `slopes` says others. */
export type PictureInput = Partial<Omit<PictureParams, 'files'>> & {
  files: { file: InputFile; lamp?: [number, number] | null }[];
};

export type ShapeInput =
  | { builtin: 'rectangle' | 'rounded' | 'disc'; size?: [number, number]; radius?: number }
  /** SVG, or a mask picture whose bright, opaque pixels are inside. `pageWidth` 0: as drawn, 80 mm for a mask.
   * `paint`: a drawing is what it shows (default), or all its outlines, whatever their paint. */
  | { file: InputFile; pageWidth?: number; unitless?: 'px' | 'mm'; paint?: 'shown' | 'ignore' }
  /** A rectangle of the direction picture's proportions. */
  | { size?: [number, number] };

export type DirectionInput = { angle: number } | { file: InputFile; encoding?: DirectionEncoding };

/** Grey 0..1 is -90..90°; grey 0..1 is 0..180°; red and green are x and y. */
export type DirectionEncoding = 'angle' | 'rotation' | 'tangent';

export type ModeInput = { mode: DirectionMode } | { file: InputFile };

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
export type Preset = 'draft' | 'fewest-turns' | 'fine' | 'paper-2023' | 'standard' | 'strict';

/** A picture to be seen, and where its lamp stands. */
export interface LampPicture {
  file: string;
  /** Azimuth counter-clockwise from +x, -360..360, and elevation, 1..90 [degrees]; null: chosen for the picture. */
  lamp: [number, number] | null;
}

/** Section `pictures` of docs/reference/project.md. */
export interface PictureParams {
  /** Pictures to be seen, each under its own lamp, instead of directions: {"file", "lamp"}, the lamp as [azimuth, elevation] in degrees, or null to choose it. Default []. */
  files: LampPicture[];
  /** The filament whose shine the pictures are made for, as measured in 2023. Default "bluePla". */
  spool: 'bluePla' | 'clearPetg' | 'goldPla' | 'greyPla' | 'redPetg';
  /** RMS slopes of the surface along and across the bead of a spool of your own; null is the named one’s. 0.1..45 °, default null. */
  slopes: [number, number] | null;
  /** The slope of the surface that would blur a point as much: 0.02 is a bulb, 0.1 a softbox, 0.4 a window. 0..2, default 0.1. */
  lampSize: number;
  /** Weight of changes of direction against errors of tone: more means fewer U-turns and less detail. 0.001..10, default 0.02. */
  smoothness: number;
  /** How far what differs from its surroundings is raised: readable faces, but other tones than the picture has. 0..2, default 0. */
  localContrast: number;
  /** How often a single picture’s plate is looked at and made again with what its beads left out; each takes as long as a plate. 0..8, default 3. */
  corrections: number;
}

/** Section `toolpath` of docs/reference/project.md: defaults, units and ranges. */
export interface ToolpathParams {
  /** Distance between neighbouring beads; the nozzle’s diameter is a good start. 0.05..20 mm, default 0.4. */
  spacing: number;
  /** Beads end at the border, follow it where directions allow, or a number of perimeters follows it. Default "count". */
  perimeterMode: 'none' | 'soft' | 'count';
  /** How many beads follow the border in mode "count". 0..100, default 1. */
  perimeters: number;
  /** Parts of the shape nearer than this become one path; null is one spacing. 0..100 mm, default null. */
  bridge: number | null;
  /** Whether neighbouring pixels of the direction picture are averaged or the nearest one is taken. Default "average". */
  mapFilter: 'average' | 'nearest';
  /** 0 is regular; other numbers give other plates of like quality. 0..9007199254740991, default 0. */
  seed: number;
  /** How far a seed moves the points at which directions are sampled. 0..0.25 τ, default 0.025. */
  jitter: number;
  /** A neighbour’s wave is continued by the mean of both directions, or by the neighbour’s alone as in 2023. Default "midpoint". */
  phaseTransport: 'midpoint' | 'neighbour';
  /** Smoothing sweeps on each level of the hierarchy; more take longer. 1..1000, default 8. */
  sweepsPerLevel: number;
  /** Beads may lie closer or wider by a factor of up to e^this where that saves U-turns; 0 keeps them one spacing apart. 0..0.5, default 0.3. */
  spacingVariation: number;
  /** Beads may deviate this far from the directions where that saves U-turns; takes about twice as long. 0..30 °, default 0. */
  directionTolerance: number;
  /** Radius over which the waves of cells are averaged, three σ of a Gaussian; 0.5 in 2023. 0.45..1.5 τ, default 1. */
  kernelRadius: number;
  /** In mode "soft", the weight of the border’s wave relative to a neighbour’s. 0..100, default 1. */
  borderWeight: number;
  /** Cost of misaligned length where two curves are joined. 0..10, default 1.1. */
  stitchAlignment: number;
  /** Rounds that even out the gaps between beads: fewer kinks, directions slightly less exact. 0..100, default 2. */
  relaxationRounds: number;
  /** How far a bead moves towards its wider side per round, as a share of the difference between its gaps. 0..0.5, default 0.08. */
  relaxationStrength: number;
  /** How much each round of relaxation straightens a bead. 0..1, default 0.65. */
  relaxationSmoothing: number;
  /** 0: the nearer neighbour limits a bead on both sides (Eq. 16); 1: the space between both does. 0..1, default 1. */
  widthBalance: number;
  /** How far neighbouring beads may overlap before both are made narrower; at 1 none is. 0..1 τ, default 0.0021. */
  beadOverlap: number;
  /** No bead is narrower, except where the border leaves less space. 0.1..1 τ, default 0.5. */
  minWidth: number;
  /** No bead is wider. 1..4 τ, default 2. */
  maxWidth: number;
  /** Largest change of position and width when points are left out; more makes smaller files. 0..1 mm, default 0.0013. */
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
  /** Name of the printer, written into the G-code. Default "Generic". */
  name: string;
  /** What the printer’s firmware understands; "prusa" is Prusa’s Buddy boards; "bambu" needs a start block of your own. Default "marlin". */
  flavor: 'marlin' | 'klipper' | 'reprap' | 'prusa' | 'bambu';
  /** Lower left corner of the bed: [0, 0] on most printers, negative where the origin is the centre. -5000..5000 mm, default [0,0]. */
  bedMin: [number, number];
  /** Upper right corner of the bed, at least 10 mm right of and above the lower left one. -5000..5000 mm, default [220,220]. */
  bedMax: [number, number];
  /** The bed is the disc within its corners, which are then those of a square. Default false. */
  roundBed: boolean;
  /** Lower left corner of a box on the bed that nothing may touch. -5000..5000 mm, default [0,0]. */
  excludedMin: [number, number];
  /** Upper right corner of that box; a box of no size excludes nothing. -5000..5000 mm, default [0,0]. */
  excludedMax: [number, number];
  /** How high the printer can print. 0.05..5000 mm, default 200. */
  maxZ: number;
  /** Diameter of the nozzle; most printers come with 0.4 mm. 0.05..2 mm, default 0.4. */
  nozzle: number;
  /** Diameter of the filament: 1.75 mm, or 2.85 mm on some printers. 0.5..5 mm, default 1.75. */
  filamentDiameter: number;
  /** Density of the filament, for its weight only. 0.1..25 g/cm³, default 1.24. */
  filamentDensity: number;
  /** Kind of filament, written into the G-code. Default "PLA". */
  filamentType: string;
  /** For those who know why: allows nozzles of 0 to 500 °C and beds of up to 200. Default false. */
  anyTemperature: boolean;
  /** Temperature of the nozzle, as on the filament’s label; 170 to 300 without anyTemperature. 0..500 °C, default 215. */
  nozzleTemperature: number;
  /** Temperature of the nozzle on the first layer, where a little hotter sticks better; 170 to 300 without anyTemperature. 0..500 °C, default 220. */
  firstLayerNozzleTemperature: number;
  /** Temperature of the bed, as on the filament’s label; at most 120 without anyTemperature. 0..200 °C, default 60. */
  bedTemperature: number;
  /** Speed along the beads; even and slow shines best. 5..1000 mm/s, default 50. */
  speed: number;
  /** Speed of the first layer; slow sticks better. 5..1000 mm/s, default 20. */
  firstLayerSpeed: number;
  /** Speed of base layers above the first; 0: the same as along the beads. 0..1000 mm/s, default 0. */
  baseSpeed: number;
  /** Speed of oriented layers; 0: speed, but at most 20 where nothing sets pressure advance. 0..1000 mm/s, default 0. */
  showSpeed: number;
  /** Speed of moves that extrude nothing. 5..1000 mm/s, default 120. */
  travelSpeed: number;
  /** The machine’s own limit, 5 or more, at which all speeds are held; 0: not known. 0..1000 mm/s, default 0. */
  machineSpeed: number;
  /** Acceleration while printing; 1000 to 2000 keeps U-turns clean. 1..100000 mm/s², default 1000. */
  acceleration: number;
  /** Acceleration of the first layer; 0: the same as above it. 0..100000 mm/s², default 0. */
  firstLayerAcceleration: number;
  /** The printer’s own, put back at the end; acceleration is held at it; 0: acceleration is only estimated with, not set. 0..100000 mm/s², default 0. */
  machineAcceleration: number;
  /** Klipper’s square corner velocity; half of Marlin’s jerk. 0.1..100 mm/s, default 5. */
  cornerSpeed: number;
  /** The printer’s own, put back at the end; 0: corner speed is only estimated with, not set. 0..100 mm/s, default 0. */
  machineCornerSpeed: number;
  /** Curves of radius r are printed at most at the root of this × r, but at 5 mm/s; 0: as fast as straights. 0..100000 mm/s², default 1000. */
  curveAcceleration: number;
  /** Fan speed on the first layer. 0..100 %, default 0. */
  firstLayerFan: number;
  /** Fan speed on base layers above the first; below 0: 100 for PLA, 50 for others. -1..100 %, default -1. */
  baseFan: number;
  /** Fan speed on oriented layers above the first; below 0: 100 for PLA, 50 for others. -1..100 %, default -1. */
  showFan: number;
  /** Layers that would take less are slowed, but not below 5 mm/s; 0: none is. 0..300 s, default 8. */
  minLayerTime: number;
  /** What the hot end can melt; wide beads are printed slower to keep to it. 0.1..1000 mm³/s, default 10. */
  maxFlow: number;
  /** What the printer’s board can keep up with. 1..100000 1/s, default 300. */
  maxSegmentsPerSecond: number;
  /** Limits how fast a bead’s width may change along the path. 0..2 s, default 0.04. */
  pressureAdvance: number;
  /** Writes it into the G-code; off: the printer keeps its own. Default false. */
  setPressureAdvance: boolean;
  /** How far filament is pulled back before a travel. 0..20 mm, default 0.8. */
  retractLength: number;
  /** Speed of pulling filament back and pushing it forward. 1..200 mm/s, default 35. */
  retractSpeed: number;
  /** How far the nozzle rises before a travel. 0..20 mm, default 0.4. */
  lift: number;
  /** Writes E as a position (M82, G92 E0 per layer) instead of a distance, for hosts that know nothing else. Default false. */
  absoluteE: boolean;
  /** Start block, which may have placeholders; empty: home, heat, wait. Default "". */
  startGcode: string;
  /** End block, likewise; empty: park, heaters off. Default "". */
  endGcode: string;
  /** Sizes in pixels: WxH, WxH/PNG or WxH/QOI, at most 8, sides of 16 to 1024. Default "32x32, 300x300". */
  screenSizes: string;
}

/** Section `print` of docs/reference/project.md, and the date in the file's first line. */
export interface PrintParams {
  /** Oriented layers on each side that shows them. 1..1000, default 1. */
  layers: number;
  /** Plain layers that carry the oriented ones. 0..1000, default 2. */
  base: number;
  /** Zigzags at 45 and 135° in turn, loops along the border, or the oriented path itself. Default "hatched". */
  basePattern: 'hatched' | 'concentric' | 'same';
  /** Loops along the border of hatched base layers. 0..10, default 1. */
  basePerimeters: number;
  /** Oriented layers on top; mirrored on the bed with the base above; or both, where the shape is its own mirror image. Default "up". */
  showSide: 'up' | 'bed' | 'both';
  /** Loops around the plates that get the plastic flowing. 0..20, default 1. */
  skirt: number;
  /** Length of filament that is laid off the plate first, besides what the last print drew back. 0..100 mm, default 10. */
  purgeLength: number;
  /** Loops that touch the plate on the first layer, so that it stays on the bed. 0..50, default 0. */
  brim: number;
  /** How far a first layer of the base stays within the border, as it is squeezed wider. 0..0.5 mm, default 0.1. */
  elephantFoot: number;
  /** Oriented beads are printed at speed × spacing / width, at most 1.5 times the speed, except on the first layer. Default false. */
  constantFlow: boolean;
  /** Length before the end of a path over which nothing is extruded. 0..1 mm, default 0. */
  coast: number;
  /** Length over which both ends of an oriented cycle overlap, one thinning out as the other sets in; needs a coast of 0. 0..20 mm, default 0. */
  scarf: number;
  /** Plates in a row and in a column, printed one after the other; at most 3 mm high then. 1..20, default [1,1]. */
  copies: [number, number];
  /** Space between copies, brims included. 1..100 mm, default 10. */
  copyGap: number;
  /** Height of a layer, at most 0.8 of the nozzle. 0.05..1.6 mm, default 0.2. */
  layerHeight: number;
  /** All layers lie above a print of this height that stands on the bed; at most maxZ. 0..5000 mm, default 0. */
  startHeight: number;
  /** Height of the first layer, at least 0.05 mm and at most 0.8 of the nozzle; 0 is the height of the others. 0..1.6 mm, default 0. */
  firstLayerHeight: number;
  /** Flow of the oriented layers; slightly less than 1 keeps the furrows between beads crisp. 0.01..2, default 0.95. */
  flow: number;
  /** Flow of the base layers; 1 fills them. 0.01..2, default 1. */
  baseFlow: number;
  /** Flow of an oriented layer that lies on the bed. 0.01..2, default 1. */
  bedFlow: number;
  /** Turns the plate on the bed, counter-clockwise. -360..360 °, default 0. */
  rotate: number;
  /** Mirrors left to right, before the rotation, for plates seen from below; a side shown on the bed is mirrored by itself. Default false. */
  mirror: boolean;
  /** Refuses a path that crosses itself or leaves the shape by more than 0.1 mm, instead of reporting it. Default false. */
  strict: boolean;
  /** Lower left corner, on the bed, of the page or of the box around the turned page; null is centred. -10000..10000 mm, default null. */
  place: [number, number] | null;

  /** Of the file's first line; default: now. The same date gives the same bytes. */
  date: Date;
}

/** The filament that a plate is shown in. */
export interface ViewParams {
  /** Of the body: red, green, blue in sRGB, 0..255. Default gold. */
  colour: [number, number, number];
  /** RMS slopes of the surface along and across the bead [degrees], 0.1..45. Default 8.93, 15.6. */
  slopes: [number, number];
}

export interface PreviewParams {
  /** Of one panel [pixels], 16..16384. Default 1600. */
  width: number;
  /** Of the light, degrees counter-clockwise from +x. Default 60. */
  lightAzimuth: number;
  /** Degrees above the plate, 1..90. Default 35. */
  lightElevation: number;
}

/** A project file, complete; `file` is a name, empty for none. */
export interface Project {
  sillon: 1;
  shape: {
    file: string;
    builtin: 'none' | 'rectangle' | 'rounded' | 'disc';
    size: [number, number];
    radius: number;
    pageWidth: number;
    unitless: 'px' | 'mm';
    paint?: 'shown' | 'ignore';
  };
  directions: { file: string; encoding: DirectionEncoding; angle: number };
  modes: { file: string; mode: DirectionMode };
  pictures: PictureParams;
  toolpath: ToolpathParams;
  print: Omit<PrintParams, 'date'>;
  printer: Printer;
}

export type DeepPartial<T> = T extends readonly unknown[]
  ? T
  : T extends object
    ? { [K in keyof T]?: DeepPartial<T[K]> }
    : T;

// --- What comes out ----------------------------------------------------------------------------------------------------

export interface Plate {
  toolpath: Toolpath;
  report: Report;
}

/** Plain data, copied out of the engine: may be kept, changed, cloned and its buffers transferred. */
export interface Toolpath {
  /** Distance between neighbouring beads. */
  spacing: number;
  /** One per connected part, in printing order. */
  cycles: Cycle[];
  /** What was filled: base layers and skirt are made from it. */
  shape: Shape;
  /** What made the toolpath and how good it is; goes into the G-code's header. */
  notes: string[];
  /** Of plates that show pictures: what the pictures in the G-code look like, too. */
  look?: Look;
}

/** How a plate of pictures is to be seen. */
export interface Look {
  /** Of the spool, sRGB. */
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
  /** Of the drawing, and not in the shape: text and pictures are not read. */
  texts?: number;
  images?: number;
  /** Painted, but cut off at the page's edges, as viewers do [mm²]. */
  offPage?: number;
  /** Nothing is painted: outlines were taken whatever their paint. */
  unpainted?: boolean;
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
  /** Seconds by stage, and their `total`. */
  time: Record<string, number>;
  /** Of the engine's memory. */
  peakBytes: number;
  threads: number;
  /** Equal digests mean equal plates, on every platform. */
  digest: string;

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
  width?: { p01: number; median: number; p99: number; belowHalf: number; clamped: number };
  fillRatio?: number;
  lostAreaMm2?: number;
  /** The largest hundred: x, y [mm], area [mm²], width [mm]. */
  lostPlaces?: [number, number, number, number][];
  /** How well the toolpath shows each picture under its lamp: docs/reference/metrics.md. */
  pictures?: PictureReport[];
}

export interface PictureReport {
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
  /** Of oriented beads that `curveAcceleration` slows. */
  curveSlowedMm: number;
  warnings: GcodeWarning[];
}

/** What the user should know of a file that was written. */
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
  | 'DrawingOffPage'
  | 'DrawingUnpainted'
  | 'EndHot'
  | 'EndLine'
  | 'FillRatio'
  | 'FlatBeads'
  | 'ManyBytes'
  | 'ManyMoves'
  | 'MaxFlowSlows'
  | 'MirroredUp'
  | 'NoPressureAdvance'
  | 'NotPrimed'
  | 'NotPrimedAbovePrint'
  | 'OutsideShape'
  | 'PressureAdvanceReset'
  | 'PrintOnBed'
  | 'SegmentsSlow'
  | 'SkirtLeftOut'
  | 'SpeedHeld'
  | 'StartLine'
  | 'StartTemperature'
  | 'ThinLayers'
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
  /** As `core/src/printer_import/notes.cpp` lists them: `BedUnknown`, `OutOfRange` … */
  code: string;
  /** What the message names: texts as the file has them, numbers in plain notation. */
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
  /** What could not be taken over or needs a look. */
  notRead: ImportNote[];
}

export interface GcodeCheck {
  findings: GcodeFinding[];
  /** Lines that put the print at risk. */
  errors: number;
  lines: number;
  moves: number;
  layers: number;
  filamentMm: number;
  pathMm: number;
  travelMm: number;
  retractions: number;
  /** Of beads. */
  fastest: number;
  /** Of oriented beads slower than the fastest of their layer. */
  slowedMm: number;
  /** mm³/s. */
  mostFlow: number;
  /** Moves per second over any 8. */
  mostMoves: number;
  printer: string;
  /** 99 % of the vertices of oriented beads zigzag by no more, mm; null: there are none. */
  noise: number | null;
  /** Share of the base that each oriented layer of a file of ours covers; null where there is no base. */
  coverage: (number | null)[];
}

/** One rule that was broken, however often. */
export interface GcodeFinding {
  /** One per sentence, such as 'too-hot'. */
  code: string;
  /** What the code belongs to, such as 'heating'. */
  rule: string;
  /** The print is at risk; else worth knowing. */
  error: boolean;
  /** The first, from 1; 0: the file as a whole. */
  line: number;
  count: number;
  /** What the sentence shows, by name, such as { limit: '300', degrees: '480' }. */
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

/** Every error of the engine but an aborted signal's reason. */
export class SillonError extends Error {
  constructor(code: ErrorCode, message: string, hint?: string);
  readonly name: 'SillonError';
  readonly code: ErrorCode;
  /** What to do about it, one sentence; may be empty. */
  readonly hint: string;
}
