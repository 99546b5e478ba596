// Messages between the calling thread and the engine's worker. Types only, because the worker is a separate file.
import type * as api from '../sillon.js';

export type Variant = api.EngineInfo['variant'];

/** Addresses of the files in dist/engine. */
export interface EngineFiles {
  worker: string;
  st: ModuleFiles;
  mt: ModuleFiles & { threadScript: string };
  text: ModuleFiles;
  /** Script that unpacks web fonts. */
  unpack: string;
  /** Addresses of fonts by the names of their files. */
  fonts: Record<string, string>;
}
export interface ModuleFiles {
  script: string;
  wasm: string;
}

/** A value that the worker may keep under its number; then only the number is sent. 0: the value is never kept. */
export interface Known<T> {
  number: number;
  value: T | undefined;
}

export type KnownFile = Known<Uint8Array | Blob>;

/** Input files by their names in the project. */
export type Files = Record<string, Known<Uint8Array | Blob | api.Picture>>;

/** A toolpath whose beads the worker may keep. */
export type Path = Omit<api.Toolpath, 'cycles'> & { cycles: Known<api.Cycle[]> };

/** A reading as the engine takes it back, with only the colour of its spool. */
export type ReadingFields = Omit<api.CouponReading, 'spool'> & { colour: api.Spool['colour'] };

/** A call of the engine. `project` is the text of a project file. */
export type Call =
  /** `number`: number under which the beads are kept. */
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
  /** `drawing`: name of the drawing among the files; the others are its letters. */
  | { name: 'paintDrawing'; files: Files; drawing: string }
  | { name: 'readProject'; project: string }
  | { name: 'writeProject'; project: string }
  | { name: 'profiles' }
  /** `number`: number under which the text is kept; 0: the text is handed out in pieces. */
  | { name: 'writeGcode'; toolpath: Path; below: Path | undefined; project: string; date: string; number: number }
  | { name: 'writeBaseBody'; shape: api.Shape; project: string; format: 'stl' | '3mf' }
  | { name: 'writeSvg'; toolpath: Path }
  | { name: 'writeView'; toolpath: Path; params: api.ViewParams }
  | { name: 'renderPreview'; toolpath: Path; params: api.PreviewParams }
  | { name: 'importPrinter'; file: KnownFile; printer: string }
  /** `project`: project whose printer's limits apply; empty: the file's own settings. */
  | { name: 'checkGcode'; file: KnownFile; project: string }
  | { name: 'packGcode'; file: KnownFile }
  /** `project`: project whose printer's flavour applies. */
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
      /** Longer side of the picture [pixels]; 0: none. */
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

/** Addresses from which the engine starts its threads: before Emscripten 3.1.58 the first, which receives the
 * other. */
export interface ThreadScripts {
  threadScript: string;
  mainScript: string;
}

export interface StartMessage {
  type: 'start';
  threads: number;
  /** Limit of the module's memory [MiB]. */
  memory: number;
  script: string;
  wasm: string;
  /** Used only with several threads. */
  threadScripts: ThreadScripts;
  /** The module, if it has been compiled before. */
  compiled: WebAssembly.Module | undefined;
  /** One byte of shared memory, for an engine with one thread; 1 asks the running call to stop. */
  stop: Uint8Array | undefined;
}

/** Messages to the worker; each waits for the answer to the one before. */
export type ToWorker = StartMessage | { type: 'call'; call: Call };

export interface Failure extends Pick<api.SillonError, 'reason' | 'values'> {
  code: api.ErrorCode | 'Cancelled';
  message: string;
}

/** Messages from the worker. A start ends with `started` or `failed`, a call with `done` or `failed`. */
export type FromWorker =
  /** All files are loaded. */
  | { type: 'loaded'; compiled: WebAssembly.Module }
  /** `stop`: byte in the memory of an engine with threads; 1 asks it to stop. */
  | { type: 'started'; version: string; stop: Uint8Array | undefined }
  | { type: 'progress'; stage: string; fraction: number }
  | { type: 'piece'; bytes: Uint8Array }
  /** Sign of life while work goes on. */
  | { type: 'alive' }
  /** `kept`: numbers of values that the next call need not send. */
  | { type: 'done'; value: unknown; kept: number[] }
  | ({ type: 'failed'; kept: number[] } & Failure);
