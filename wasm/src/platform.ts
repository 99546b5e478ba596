// What differs between browsers and Node.
import { fontFiles } from './fonts.js';
import type { EngineFiles, FromWorker, ThreadScripts, ToWorker } from './protocol.js';

export interface Platform {
  /** @throws SillonError InvalidArgument */
  files(assetBase: string | URL | undefined): EngineFiles;
  cores(): number;
  /** Why memory cannot be shared between threads; empty if it can. */
  obstacleToThreads(): string;
  /** A file of the engine's. @throws SillonError LoadFailed */
  read(url: string): Promise<Uint8Array>;
  /** The module, where the worker cannot fetch it by itself. @throws SillonError LoadFailed */
  compile?(wasm: string): Promise<WebAssembly.Module>;
  /** A file as it can be posted to a worker. @throws SillonError InvalidFile */
  portable?(file: Blob, name: string): Promise<Uint8Array>;
  /** After a start that failed: what was kept for it is not used again, as where a policy forbids it.
   * @returns whether anything was kept, so that another start may go better */
  forget?(files: EngineFiles, threads: number): boolean;
  /** @param memory  of its JavaScript, where a worker's can be limited [MiB]
   * @throws SillonError LoadFailed */
  startWorker(files: EngineFiles, threads: number, memory: number, events: WorkerEvents): Promise<EngineWorker>;
}

/** The engine's files in one folder. @param at  the address of a file there */
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
  /** The worker could not be started, or has ended by itself. @param code  where that is known */
  onFailure(message: string, code?: 'OutOfMemory'): void;
}

export interface EngineWorker {
  readonly threadScripts: ThreadScripts;
  post(message: ToWorker): void;
  /** Whether the process must wait for the worker. */
  hold(busy: boolean): void;
  end(): void;
}
