// What passes between the calling thread and the engine's worker. Types only: the worker is one file by itself.
import type * as api from '../sillon.js';

export type Variant = api.EngineInfo['variant'];

/** Addresses of the files in dist/engine. */
export interface EngineFiles {
  worker: string;
  st: ModuleFiles;
  mt: ModuleFiles & { threadScript: string };
  /** Fetched when a file is to be written or read. */
  files: ModuleFiles;
  /** Fetched when a sliced file is to be read. */
  rebrush: ModuleFiles;
  /** Fetched for calibration prints. */
  calibrate: ModuleFiles;
  /** Fetched for photographs of one. */
  photo: ModuleFiles;
}
export interface ModuleFiles {
  script: string;
  wasm: string;
}

/** Inputs by the names that the project gives them. */
export type Files = Record<string, Uint8Array | Blob | api.Picture>;

/** One call of the engine. `project` is the text of a project file. */
export type Call = PlateCall | FileCall | RebrushCall | CalibrateCall | PhotoCall;

/** Of the modules that make plates. */
export type PlateCall =
  | { name: 'generateToolpath'; project: string; files: Files; measure: boolean; across: boolean }
  | { name: 'readShape'; project: string; files: Files }
  | { name: 'decodePicture'; file: Uint8Array | Blob }
  | { name: 'readProject'; project: string }
  | { name: 'writeProject'; project: string }
  | { name: 'profiles' };

/** Of the module that writes and reads the files around a plate. */
export type FileCall =
  | {
      name: 'writeGcode';
      toolpath: api.Toolpath;
      below: api.Toolpath | undefined;
      project: string;
      date: string;
      inPieces: boolean;
    }
  | { name: 'writeBaseBody'; shape: api.Shape; project: string; format: 'stl' | '3mf' }
  | { name: 'writeSvg'; toolpath: api.Toolpath }
  | { name: 'writeView'; toolpath: api.Toolpath; params: api.ViewParams }
  | { name: 'renderPreview'; toolpath: api.Toolpath; params: api.PreviewParams }
  | { name: 'importPrinter'; file: Uint8Array | Blob; printer: string }
  /** `project`: whose printer counts; empty: what the file's own settings say. */
  | { name: 'checkGcode'; file: Uint8Array | Blob; project: string }
  | { name: 'packGcode'; file: Uint8Array | Blob }
  /** `project`: whose printer's flavor counts. */
  | { name: 'examineBlock'; block: string; project: string };

/** A sliced file. `number`: the same for the same Blob, whose text the module keeps for the next call; 0: none. */
export interface Print {
  file: Uint8Array | Blob;
  number: number;
}

/** Of the module that lays plates on other people's prints. */
export type RebrushCall =
  | { name: 'listSurfaces'; print: Print }
  | { name: 'printRelief'; print: Print; side: number }
  | {
      name: 'rebrush';
      print: Print;
      project: string;
      files: Files;
      sides: api.RebrushOptions['sides'];
      fit: api.RebrushOptions['fit'];
      only: number[];
    };

/** Of the module that writes calibration prints. */
export interface CalibrateCall {
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

/** A reading as the engine takes it back: of its spool only the colour. */
export type ReadingFields = Omit<api.CouponReading, 'spool'> & { colour: api.Spool['colour'] };

/** Of the module that reads photographs of the coupon. */
export type PhotoCall =
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
}

/** One at a time. */
export type ToWorker = StartMessage | { type: 'call'; call: Call; wanted: Wanted };

/** How a worker without shared engine memory learns, while it computes, that its call is wanted no more: a byte that
 * becomes 1, or an address that cannot be fetched any more. */
export type Wanted = Uint8Array | string | undefined;

export interface Failure extends Pick<api.SillonError, 'reason' | 'values'> {
  code: api.ErrorCode | 'Cancelled';
  message: string;
}

/** The last message of a start is `started` or `failed`, that of a call `done` or `failed`. */
export type FromWorker =
  /** All files are there. */
  | { type: 'loaded'; compiled: WebAssembly.Module }
  /** `cancelFlag`: one byte of the engine's memory, if that can be shared; 1 asks the running call to stop. */
  | { type: 'started'; version: string; cancelFlag: Uint8Array | undefined }
  | { type: 'progress'; stage: string; fraction: number }
  | { type: 'piece'; bytes: Uint8Array }
  /** Nothing to tell but that work goes on. */
  | { type: 'alive' }
  | { type: 'done'; value: unknown }
  | ({ type: 'failed' } & Failure);
