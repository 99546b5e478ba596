// Interface for the differences between browsers and Node.
import { fontFiles } from './fonts.js';
import type { EngineFiles, FromWorker, ThreadScripts, ToWorker } from './protocol.js';

export interface Platform {
  /** @throws SillonError InvalidArgument */
  files(assetBase: string | URL | undefined): EngineFiles;
  cores(): number;
  /** Returns the reason why threads cannot share memory; empty if they can. */
  obstacleToThreads(): string;
  /** Reads a file of the engine. @throws SillonError LoadFailed */
  read(url: string): Promise<Uint8Array>;
  /** Compiles the module, if the worker cannot fetch it by itself. @throws SillonError LoadFailed */
  compile?(wasm: string): Promise<WebAssembly.Module>;
  /** Converts a file so that it can be posted to a worker. @throws SillonError InvalidFile */
  portable?(file: Blob, name: string): Promise<Uint8Array>;
  /** Forgets what was kept for a start, after the start has failed, for example because a policy forbids it.
   * @returns true if anything was kept, so that another start may succeed */
  forget?(files: EngineFiles, threads: number): boolean;
  /** Starts a worker.
   * @param memory  limit of its JavaScript's memory, if the platform has one [MiB]
   * @throws SillonError LoadFailed */
  startWorker(files: EngineFiles, threads: number, memory: number, events: WorkerEvents): Promise<EngineWorker>;
}

/** Returns the addresses of the engine's files in one folder. @param at  returns the address of a file there */
export const filesIn = (at: (name: string) => string): EngineFiles => ({
  worker: at('worker.js'),
  st: { script: at('sillon-st.js'), wasm: at('sillon-st.wasm') },
  mt: { script: at('sillon-mt.js'), wasm: at('sillon-mt.wasm'), threadScript: at('sillon-mt.worker.js') },
  text: { script: at('text.js'), wasm: at('harfbuzz.wasm') },
  unpack: at('unpack.js'),
  fonts: Object.fromEntries(Array.from(fontFiles.values(), (name) => [name, at(name)])),
});

export interface WorkerEvents {
  onMessage(message: FromWorker): void;
  /** The worker could not be started, or has ended by itself. @param code  the error's code, if known */
  onFailure(message: string, code?: 'OutOfMemory'): void;
}

export interface EngineWorker {
  readonly threadScripts: ThreadScripts;
  post(message: ToWorker): void;
  /** Tells the process whether to wait for the worker. */
  hold(busy: boolean): void;
  end(): void;
}
