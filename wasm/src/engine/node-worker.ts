// Gives a thread of Node the globals of a web worker, then runs a worker's script in it, so that the engine's files
// need no code for Node.
import { Worker, parentPort, workerData } from 'node:worker_threads';

interface Thread {
  script: string;
  name: string;
}

/** A worker started by a worker; the engine's threads are such workers. */
class NestedWorker {
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onerror: ((event: Error & { filename: string; lineno: number }) => void) | null = null;
  readonly #thread: Worker;

  constructor(script: string | URL, options?: { name?: string }) {
    const thread: Thread = { script: String(script), name: options?.name ?? '' };
    this.#thread = new Worker(new URL(import.meta.url), { workerData: thread, execArgv: [] });
    this.#thread.on('message', (data) => this.onmessage?.({ data }));
    // The glue code throws the error that it gets here.
    this.#thread.on('error', (error: Error) => {
      this.onerror?.(Object.assign(error, { filename: thread.script, lineno: 0 }));
    });
  }
  postMessage(message: unknown, transfer?: ArrayBuffer[]): void {
    this.#thread.postMessage(message, transfer);
  }
  terminate(): void {
    void this.#thread.terminate();
  }
}

const port = parentPort;
if (port === null) throw new Error('node-worker.js runs in a worker thread only');
const { script, name } = workerData as Thread;

const scope = {
  self: globalThis,
  name,
  location: new URL(script),
  onmessage: null as ((event: { data: unknown }) => void) | null,
  postMessage: (message: unknown, transfer?: ArrayBuffer[]): void => {
    port.postMessage(message, transfer);
  },
  Worker: NestedWorker,
  // Code only tests for its presence, as the mark of a worker.
  WorkerGlobalScope: EventTarget,
  importScripts: (): never => {
    throw new Error('importScripts is not available');
  },
};
// Defined instead of assigned, because the location of Deno cannot be assigned.
for (const [name, value] of Object.entries(scope)) {
  Object.defineProperty(globalThis, name, { value, writable: true, configurable: true, enumerable: true });
}

await import(script);
port.on('message', (data) => {
  (globalThis as unknown as typeof scope).onmessage?.({ data });
});
