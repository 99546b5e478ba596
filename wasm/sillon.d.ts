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
  /** Reads and checks a project file (docs/project.md) or a published scene, and completes it with all defaults. */
  readProject(json: string, options?: RunOptions): Promise<Project>;
  /** Checks a project and returns it as the text of a file that readProject and the command line read. */
  writeProject(project: DeepPartial<Project>, options?: RunOptions): Promise<string>;

  /** The printers and filaments that come with the engine; fields `preset` and `filament` of a Printer name them. */
  presets(options?: RunOptions): Promise<Presets>;
  /** Takes a printer from G-code of the user's own slicer (its start and end blocks, proven there), PrusaSlicer or
   * SuperSlicer settings (.ini), an Orca preset (.json) or a project of ours.
   * @param name printer of a bundle; left out: the active one. @throws `InvalidFile`, `InvalidArgument`, `TooLarge`. */
  importPrinter(file: Bytes, name?: string, options?: RunOptions): Promise<ImportedPrinter>;
  /** Reads any G-code as a printer would and says what would go wrong.
   * @param printer whose bed and limits count; left out: what the file's own settings say. */
  checkGcode(file: Bytes, printer?: Partial<Printer>, options?: RunOptions): Promise<GcodeCheck>;
  /** G-code as the .gcode.3mf that Bambu printers take: a zip with the file, its MD5, picture, time and filament. Not tried
   * on a printer. importPrinter and checkGcode read such files. */
  packGcode(file: Bytes, options?: RunOptions): Promise<Blob>;

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
  /** Also judge the plate (alignment, coverage, overlap, ...): costs more than making it. Default true. */
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

// --- What goes in ------------------------------------------------------------------------------------------------------

/** The sections of a project file, with bytes in place of file names. */
export interface PlateInput {
  /** Default: a rectangle of the direction picture's proportions. */
  shape?: ShapeInput;
  /** Default: angle 0. */
  directions?: DirectionInput;
  /** Default: constrained, that is: as the directions say. */
  modes?: ModeInput;
}

export type ShapeInput =
  | { builtin: 'rectangle' | 'rounded' | 'disc'; size?: [number, number]; radius?: number }
  /** SVG, or a mask picture whose bright, opaque pixels are inside. `pageWidth` 0: as drawn, 80 mm for a mask. */
  | { file: InputFile; pageWidth?: number; unitless?: 'px' | 'mm' }
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

/** A recipe to begin with, and values that override its own. */
export interface ToolpathOptions extends Partial<ToolpathParams> {
  preset?: Recipe;
}

/** Ways to make a toolpath; docs/project.md says what they change. */
export type Recipe = 'draft' | 'fewest-turns' | 'fine' | 'paper-2023' | 'standard' | 'strict';

/** Section `toolpath` of docs/project.md: defaults, units and ranges. */
export interface ToolpathParams {
  spacing: number;
  perimeterMode: 'none' | 'soft' | 'count';
  perimeters: number;
  bridge: number | null;
  mapFilter: 'average' | 'nearest';
  /** 0..2^53 - 1. */
  seed: number;
  jitter: number;
  phaseTransport: 'midpoint' | 'neighbour';
  sweepsPerLevel: number;
  spacingBend: number;
  lineGive: number;
  waveReach: number;
  borderPull: number;
  stitchAlignment: number;
  relaxationRounds: number;
  relaxationStrength: number;
  relaxationSmoothing: number;
  widthBalance: number;
  beadOverlap: number;
  minWidth: number;
  maxWidth: number;
  simplifyTolerance: number;
}

/** Section `printer` of docs/project.md. */
export interface Printer extends PrinterValues {
  /** Id of a printer, such as `prusa-mk4s`; the other fields override it. */
  preset: string;
  /** Id of a filament, laid over the printer. */
  filament: string;
}

export interface PrinterValues {
  name: string;
  flavor: 'marlin' | 'klipper' | 'reprap' | 'prusa' | 'bambu';
  bedMin: [number, number];
  bedMax: [number, number];
  roundBed: boolean;
  excludedMin: [number, number];
  excludedMax: [number, number];
  maxZ: number;
  nozzle: number;
  filamentDiameter: number;
  filamentDensity: number;
  filamentType: string;
  anyTemperature: boolean;
  nozzleTemperature: number;
  firstLayerNozzleTemperature: number;
  bedTemperature: number;
  speed: number;
  firstLayerSpeed: number;
  travelSpeed: number;
  machineSpeed: number;
  acceleration: number;
  machineAcceleration: number;
  cornerSpeed: number;
  machineCornerSpeed: number;
  curveAcceleration: number;
  maxFlow: number;
  maxSegmentsPerSecond: number;
  pressureAdvance: number;
  setPressureAdvance: boolean;
  retractLength: number;
  retractSpeed: number;
  lift: number;
  absoluteE: boolean;
  startGcode: string;
  endGcode: string;
  screenSizes: string;
}

/** Section `print` of docs/project.md, and the date in the file's first line. */
export interface PrintParams {
  layers: number;
  base: number;
  basePattern: 'hatched' | 'concentric' | 'same';
  showSide: 'up' | 'bed' | 'both';
  skirt: number;
  brim: number;
  elephantFoot: number;
  constantFlow: boolean;
  coast: number;
  copies: [number, number];
  copyGap: number;
  layerHeight: number;
  startHeight: number;
  firstLayerHeight: number;
  flow: number;
  baseFlow: number;
  rotate: number;
  mirror: boolean;
  strict: boolean;
  place: [number, number] | null;
  /** Default: now. The same date gives the same bytes. */
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
  };
  directions: { file: string; encoding: DirectionEncoding; angle: number };
  modes: { file: string; mode: DirectionMode };
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
}

/** docs/report.md. Everything from `lengthMm` on but `time` and `digest` only where the plate was measured. */
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
  warnings: string[];
}

export interface Presets {
  printers: Preset[];
  filaments: Preset[];
}

export interface Preset {
  id: string;
  /** The default printer with the preset's values; without `preset` and `filament`. */
  printer: PrinterValues;
}

export interface ImportedPrinter {
  /** Values that the file does not tell are the defaults. */
  printer: PrinterValues;
  source: 'donor G-code' | 'PrusaSlicer settings' | 'Orca settings' | 'project';
  /** Names of the settings taken. */
  read: string[];
  /** What could not be taken over or needs a look, one sentence each. */
  notRead: string[];
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
  rule: string;
  /** The print is at risk; else worth knowing. */
  error: boolean;
  /** The first, from 1; 0: the file as a whole. */
  line: number;
  count: number;
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
