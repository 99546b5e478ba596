// One worker with a started engine, from its start to its end.
import { SillonError, failureOf, messageOf } from './errors.js';
import type { EngineWorker, Platform } from './platform.js';
import type { Call, EngineFiles, FromWorker } from './protocol.js';

const startSilence = 10; // longest start of an engine once its files are loaded [s]
// [s] A call that gives no sign of life for this long is ended. With threads only progress counts, and large plates
// report it rarely.
const callSilence = 60;
const answerToCancel = 80; // [ms], so that the work of a cancelled call ends within 100 ms

type OnMessage = (message: FromWorker) => void;

function sharedByte(): Uint8Array | undefined {
  const shares =
    typeof SharedArrayBuffer !== 'undefined' && (globalThis.crossOriginIsolated as boolean | undefined) !== false;
  return shares ? new Uint8Array(new SharedArrayBuffer(1)) : undefined;
}

/** A start or a call that waits for the worker's answer. */
interface Waiting {
  /** Name of the call; undefined for the start. */
  call: Call['name'] | undefined;
  resolve(answer: unknown): void;
  reject(error: SillonError): void;
  onMessage: OnMessage;
}

export class Session {
  version = '';
  /** True if it was ended because it did not answer in time. */
  silent = false;
  /** True if it has made a plate, and keeps fields of it for the next. */
  madePlate = false;
  /** Numbers of the values that it keeps. */
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

  /** Starts the engine.
   * @returns the compiled module, for the next session.
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
        this.#expectSigns(startSilence); // not earlier, because the network may be slow
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

  /** Runs a call. Only one may run at a time, and none once the session has `ended`, as nobody would answer it. A call
   * that the worker cancels resolves to undefined. @throws SillonError */
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

  /** Stops the running call. A busy worker receives no messages, but it polls a byte of shared memory. If it does not
   * answer in time, or shares no memory, it is ended, and browsers may need two seconds for that. Its successor starts
   * in 40 ms and needs no network, because the page keeps the compiled module and the scripts. */
  cancel(): void {
    const waiting = this.#waiting;
    if (waiting === undefined) return;
    if (this.#stop !== undefined) Atomics.store(this.#stop, 0, 1);
    setTimeout(() => {
      if (this.#waiting === waiting) this.end(new SillonError('Crashed', 'the worker was ended to stop its call'));
    }, answerToCancel);
  }

  /** Ends the worker. @param error  rejection of a running call. */
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

  /** Handles a message of the worker. */
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

  /** Watches for signs of life. It counts ticks instead of reading the clock, so that no worker counts as late
   * after a laptop has slept. */
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
