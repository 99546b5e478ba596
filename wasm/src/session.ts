// One worker with a started engine in it, from its start to its end.
import { SillonError, failureOf, messageOf } from './errors.js';
import type { EngineWorker, Platform } from './platform.js';
import type { Call, EngineFiles, FromWorker } from './protocol.js';

const startSilence = 10; // [s] that an engine may take to start once its files are there
const callSilence = 60; // [s] without a sign of life: threads tell progress only, on large plates rarely
const answerToCancel = 80; // [ms], so that a cancelled call's work ends within 100

type OnMessage = (message: FromWorker) => void;

function sharedByte(): Uint8Array | undefined {
  const shares =
    typeof SharedArrayBuffer !== 'undefined' && (globalThis.crossOriginIsolated as boolean | undefined) !== false;
  return shares ? new Uint8Array(new SharedArrayBuffer(1)) : undefined;
}

/** Somebody waits for the worker's answer to a start or a call. */
interface Waiting {
  /** None: the start. */
  call: Call['name'] | undefined;
  resolve(answer: unknown): void;
  reject(error: SillonError): void;
  onMessage: OnMessage;
}

export class Session {
  version = '';
  /** Ended because it did not answer in time. */
  silent = false;
  /** Has made a plate, and keeps fields of it for the next. */
  madePlate = false;
  /** Numbers of what it knows. */
  kept: ReadonlySet<number> = new Set();
  #end: SillonError | undefined;
  #worker: EngineWorker | undefined;
  /** One byte; 1 asks the running call to stop. undefined: no memory is shared. */
  #stop: Uint8Array | undefined;
  #waiting: Waiting | undefined;
  #watch: ReturnType<typeof setInterval> | undefined;
  #quietSeconds = 0;

  constructor(
    readonly threads: number,
    readonly memory: number,
  ) {}

  get ended(): boolean {
    return this.#end !== undefined;
  }

  /** @returns the compiled module, for the next session.
   * @throws SillonError LoadFailed, OutOfMemory, Crashed */
  async start(
    platform: Platform,
    files: EngineFiles,
    known: WebAssembly.Module | undefined,
  ): Promise<WebAssembly.Module | undefined> {
    const { script, wasm } = this.threads > 1 ? files.mt : files.st;
    let compiled = known ?? (await platform.compile?.(wasm));
    const { memory, threads } = this;
    this.#worker = await platform.startWorker(files, threads, memory, {
      onMessage: (message) => {
        this.#receive(message);
      },
      onFailure: (message, code) => {
        this.end(new SillonError(code ?? (this.version === '' ? 'LoadFailed' : 'Crashed'), message));
      },
    });
    if (this.#end !== undefined) {
      this.#worker.end();
      throw this.#end;
    }

    const { threadScripts } = this.#worker;
    const started = this.#answer((message) => {
      if (message.type === 'loaded') {
        compiled = message.compiled;
        this.#expectSigns(startSilence); // not before: the network may take its time
      } else if (message.type === 'started') {
        this.version = message.version;
        this.#stop ??= message.stop;
      }
    });
    this.#stop = threads === 1 ? sharedByte() : undefined;
    this.#worker.post({ type: 'start', threads, memory, script, wasm, threadScripts, compiled, stop: this.#stop });
    await started;
    return compiled;
  }

  /** One at a time. @throws SillonError */
  run(call: Call, onMessage: OnMessage): Promise<unknown> {
    const answer = this.#answer(onMessage, call.name);
    this.#expectSigns(callSilence);
    if (this.#stop !== undefined) Atomics.store(this.#stop, 0, 0);
    try {
      this.#worker?.post({ type: 'call', call });
    } catch (problem) {
      this.#settle()?.reject(
        new SillonError('InvalidArgument', `the input cannot be handed to the worker: ${messageOf(problem)}`),
      );
    }
    return answer;
  }

  /** Stops the running call. Messages do not get into a worker that computes: it sees a byte of shared memory. A worker
   * that does not answer, or shares none, is ended, which browsers may take two seconds for; a new one from the compiled
   * module and the scripts that the page holds is ready in 40 ms, with its server or without. */
  cancel(): void {
    const waiting = this.#waiting;
    if (waiting === undefined) return;
    if (this.#stop !== undefined) Atomics.store(this.#stop, 0, 1);
    setTimeout(() => {
      if (this.#waiting === waiting) this.end(new SillonError('Crashed', 'the worker was ended to stop its call'));
    }, answerToCancel);
  }

  /** @param error  what a running call rejects with. */
  end(error: SillonError): void {
    if (this.#end !== undefined) return;
    this.#end = error;
    this.#worker?.end();
    this.#settle()?.reject(error);
  }

  #answer(onMessage: OnMessage, call?: Call['name']): Promise<unknown> {
    this.#worker?.hold(true);
    return new Promise((resolve, reject) => {
      this.#waiting = { call, resolve, reject, onMessage };
    });
  }

  #settle(): Waiting | undefined {
    const waiting = this.#waiting;
    this.#waiting = undefined;
    clearInterval(this.#watch);
    this.#worker?.hold(false);
    return waiting;
  }

  #receive(message: FromWorker): void {
    this.#quietSeconds = 0;
    this.#waiting?.onMessage(message);
    if (message.type === 'started') this.#settle()?.resolve(undefined);
    if (message.type === 'done' || message.type === 'failed') this.kept = new Set(message.kept);
    if (message.type === 'done') this.#settle()?.resolve(message.value);
    if (message.type === 'failed') {
      const waiting = this.#settle();
      if (message.code === 'Cancelled') waiting?.resolve(undefined);
      else waiting?.reject(failureOf({ ...message, code: message.code }, waiting.call));
    }
  }

  /** Counts seconds that passed here, not the clock's: after a laptop's sleep no worker is late. */
  #expectSigns(seconds: number): void {
    clearInterval(this.#watch);
    this.#quietSeconds = 0;
    this.#watch = setInterval(() => {
      if (++this.#quietSeconds < seconds) return;
      this.silent = true;
      this.end(new SillonError('Crashed', `the engine gave no sign of life for ${seconds} s`));
    }, 1000);
  }
}
