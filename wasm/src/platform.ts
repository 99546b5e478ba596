// What differs between browsers and Node.
import type { Call, EngineFiles, FromWorker, ThreadScripts, ToWorker } from './protocol.js';

export interface Platform {
  /** @throws SillonError InvalidArgument */
  files(assetBase: string | URL | undefined): EngineFiles;
  cores(): number;
  /** Why memory cannot be shared between threads; empty if it can. */
  obstacleToThreads(): string;
  /** The module, where the worker cannot fetch it by itself. @throws SillonError LoadFailed */
  compile?(wasm: string): Promise<WebAssembly.Module>;
  /** The call as it can be posted to a worker. @throws SillonError InvalidFile */
  portable?(call: Call): Promise<Call>;
  /** @param memory  of its JavaScript, where a worker's can be limited [MiB]
   * @throws SillonError LoadFailed */
  startWorker(files: EngineFiles, threads: number, memory: number, events: WorkerEvents): Promise<EngineWorker>;
}

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
