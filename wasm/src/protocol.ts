// What passes between the calling thread and the engine's worker. Types only: the worker is one file by itself.
import type * as api from '../sillon.js';

export type Variant = api.EngineInfo['variant'];

/** Addresses of the files in dist/engine. */
export interface EngineFiles {
  worker: string;
  st: ModuleFiles;
  mt: ModuleFiles & { threadScript: string };
  text: ModuleFiles;
  /** What unpacks web fonts. */
  unpack: string;
  /** By the names of their files. */
  fonts: Record<string, string>;
}
export interface ModuleFiles {
  script: string;
  wasm: string;
}

/** Something that the worker may keep under its number: then it travels without its value. 0: nothing is ever kept. */
export interface Known<T> {
  number: number;
  value: T | undefined;
}

export type KnownFile = Known<Uint8Array | Blob>;

/** Inputs by the names that the project gives them. */
export type Files = Record<string, Known<Uint8Array | Blob | api.Picture>>;

/** A toolpath whose beads the worker may keep. */
export type Path = Omit<api.Toolpath, 'cycles'> & { cycles: Known<api.Cycle[]> };

/** A reading as the engine takes it back: of its spool only the colour. */
export type ReadingFields = Omit<api.CouponReading, 'spool'> & { colour: api.Spool['colour'] };

/** One call of the engine. `project` is the text of a project file. */
export type Call =
  /** `number`: under which the beads are kept. */
  | { name: 'generateToolpath'; project: string; files: Files; measure: boolean; across: boolean; number: number }
  | { name: 'readShape'; project: string; files: Files }
  | { name: 'placeLayers'; project: string; files: Files }
  | { name: 'drawLayers'; project: string; files: Files }
  /** `file`: an STL; undefined: a prism of the project's shape. */
  | {
      name: 'makeZones';
      project: string;
      files: Files;
      file: KnownFile | undefined;
      height: number;
      most: number;
      least: number;
      layerHeight: number;
      /** Corner and height of a face of the body; empty: all tops. */
      face: readonly number[];
    }
  | { name: 'linesOfDrawing'; file: KnownFile }
  | { name: 'decodePicture'; file: KnownFile }
  /** `drawing`: which of the files it is; the others are its letters. */
  | { name: 'paintDrawing'; files: Files; drawing: string }
  | { name: 'readProject'; project: string }
  | { name: 'writeProject'; project: string }
  | { name: 'profiles' }
  /** `number`: under which the text is kept; 0: it is handed out in pieces. */
  | { name: 'writeGcode'; toolpath: Path; below: Path | undefined; project: string; date: string; number: number }
  | { name: 'writeBaseBody'; shape: api.Shape; project: string; format: 'stl' | '3mf' }
  | { name: 'writeSvg'; toolpath: Path }
  | { name: 'writeView'; toolpath: Path; params: api.ViewParams }
  | { name: 'renderPreview'; toolpath: Path; params: api.PreviewParams }
  | { name: 'importPrinter'; file: KnownFile; printer: string }
  /** `project`: whose printer counts; empty: what the file's own settings say. */
  | { name: 'checkGcode'; file: KnownFile; project: string }
  | { name: 'packGcode'; file: KnownFile }
  /** `project`: whose printer's flavor counts. */
  | { name: 'examineBlock'; block: string; project: string }
  | { name: 'listSurfaces'; file: KnownFile }
  | { name: 'printRelief'; file: KnownFile; side: number }
  | {
      name: 'rebrush';
      file: KnownFile;
      project: string;
      files: Files;
      sides: api.RebrushOptions['sides'];
      fit: api.RebrushOptions['fit'];
      only: number[];
    }
  | {
      name: 'calibrate';
      kind: string;
      project: string;
      from: number | undefined;
      to: number | undefined;
      filament: api.ViewParams | undefined;
      date: string;
      /** [pixels], 0: none. */
      pictureSide: number;
    }
  | {
      name: 'readCoupon';
      picture: api.Picture;
      project: string;
      from: number | undefined;
      to: number | undefined;
      lampSize: number | undefined;
      lampElevation: number | undefined;
    }
  | { name: 'joinReadings'; readings: ReadingFields[]; lampSize: number | undefined };

/** Addresses that the engine starts its threads from: Emscripten before 3.1.58 takes the first, which then gets the other. */
export interface ThreadScripts {
  threadScript: string;
  mainScript: string;
}

export interface StartMessage {
  type: 'start';
  threads: number;
  /** Most that the module may take [MiB]. */
  memory: number;
  script: string;
  wasm: string;
  /** Used with several threads only. */
  threadScripts: ThreadScripts;
  /** If it has been compiled before. */
  compiled: WebAssembly.Module | undefined;
  /** One byte of shared memory, for an engine with one thread; 1 asks the running call to stop. */
  stop: Uint8Array | undefined;
}

/** One at a time. */
export type ToWorker = StartMessage | { type: 'call'; call: Call };

export interface Failure extends Pick<api.SillonError, 'reason' | 'values'> {
  code: api.ErrorCode | 'Cancelled';
  message: string;
}

/** The last message of a start is `started` or `failed`, that of a call `done` or `failed`. */
export type FromWorker =
  /** All files are there. */
  | { type: 'loaded'; compiled: WebAssembly.Module }
  /** `stop`: the byte that asks an engine with threads to stop, in its memory. */
  | { type: 'started'; version: string; stop: Uint8Array | undefined }
  | { type: 'progress'; stage: string; fraction: number }
  | { type: 'piece'; bytes: Uint8Array }
  /** Nothing to tell but that work goes on. */
  | { type: 'alive' }
  /** `kept`: numbers of what the next call needs no value for. */
  | { type: 'done'; value: unknown; kept: number[] }
  | ({ type: 'failed'; kept: number[] } & Failure);
