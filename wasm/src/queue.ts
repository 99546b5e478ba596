// Runs calls one after the other in a session, which is started when needed. Handles progress, abort, recovery and
// idling.
import type * as api from '../sillon.js';
import { SillonError, messageOf } from './errors.js';
import type { CallOptions } from './input.js';
import { withKnown } from './known.js';
import type { Platform } from './platform.js';
import type { Call, EngineFiles, FromWorker, Known, Variant } from './protocol.js';
import { Session } from './session.js';

const longestTimer = 2 ** 31 - 1; // [ms]

/** Errors after which the worker's memory cannot be trusted, or cannot be freed. */
const fatal: readonly api.ErrorCode[] = ['OutOfMemory', 'Internal', 'Crashed'];

interface Job {
  call: Call;
  options: CallOptions;
  resolve(value: unknown): void;
  reject(reason: unknown): void;
  /** Its promise is settled, although its work may still have to stop. */
  settled: boolean;
  /** Its call was sent to the worker. */
  started: boolean;
  stage: string;
  fraction: number;
  pieces: number;
  /** Promises of asynchronous callbacks that are not finished yet. */
  pending: Promise<void>[];
}

/** Number of threads that compute, and the reason if there are not more. */
export type Threads = Pick<api.EngineInfo, 'threads' | 'reason' | 'reasonCode'>;

/** The value of a call: mostly that of the engine's function of the same name. */
export type ValueOf<Name extends Call['name']> = Name extends 'linesOfDrawing'
  ? string[]
  : Name extends 'readProject'
    ? string
    : Name extends keyof api.Engine
      ? Awaited<ReturnType<api.Engine[Name]>>
      : never;

export class Queue {
  readonly #compiled: Partial<Record<Variant, WebAssembly.Module | undefined>>;
  #waiting: Job[] = [];
  #running: Job | undefined;
  #session: Session | undefined;
  #version = '';
  #disposed = false;
  #rest: ReturnType<typeof setTimeout> | undefined;

  constructor(
    readonly platform: Platform,
    readonly files: EngineFiles,
    readonly idleTimeout: number,
    /** Limit of a session's memory [MiB]. */
    readonly memory: number,
    private using: Threads,
    /** Queue whose compiled modules are shared. */
    other?: Queue,
  ) {
    this.#compiled = other === undefined ? {} : other.#compiled;
  }

  get info(): api.EngineInfo {
    return { version: this.#version, variant: variantOf(this.using.threads), ...this.using };
  }

  /** Tells whether a call with this number could begin at once, without its value. */
  has(number: number): boolean {
    return this.#running === undefined && this.#session?.ended === false && this.#session.kept.has(number);
  }

  /** @throws SillonError LoadFailed, OutOfMemory, Crashed */
  async start(): Promise<void> {
    await this.#openSession(this.using.threads);
    this.#restLater();
  }

  /** Adds a call to the queue. Its promise rejects with the signal's reason if it is aborted. */
  run<C extends Call>(call: C, options: CallOptions): Promise<ValueOf<C['name']>> {
    const { signal } = options;
    return new Promise((resolve, reject) => {
      if (this.#disposed) throw disposed();
      if (signal?.aborted === true) throw reasonOf(signal);
      const onAbort = (): void => {
        if (signal) this.#giveUp(job, reasonOf(signal));
      };
      const settle = (): void => {
        job.settled = true;
        signal?.removeEventListener('abort', onAbort);
      };
      const job: Job = {
        call,
        options,
        resolve(value) {
          settle();
          resolve(value as ValueOf<C['name']>);
        },
        reject(reason) {
          settle();
          // eslint-disable-next-line @typescript-eslint/prefer-promise-reject-errors -- a signal's reason may be anything
          reject(reason);
        },
        settled: false,
        started: false,
        stage: call.name,
        fraction: 0,
        pieces: 0,
        pending: [],
      };
      signal?.addEventListener('abort', onAbort);
      this.#waiting.push(job);
      if (this.#running === undefined) void this.#work();
    });
  }

  dispose(): void {
    this.#disposed = true;
    clearTimeout(this.#rest);
    for (const job of [this.#running, ...this.#waiting]) job?.reject(disposed());
    this.#waiting = [];
    this.#closeSession();
  }

  async #work(): Promise<void> {
    clearTimeout(this.#rest);
    for (let job = this.#waiting.shift(); job !== undefined; job = this.#waiting.shift()) {
      this.#running = job;
      await this.#perform(job, this.using.threads);
    }
    this.#running = undefined;
    this.#restLater();
  }

  /** Runs a job in a session, and again in another one if that may help. */
  async #perform(job: Job, threads: number): Promise<void> {
    let session: Session | undefined;
    let kept = false;
    try {
      session = await this.#openSession(threads);
      const call = await this.#sent(job.call, session);
      if (job.settled) return; // settled while the session started
      if (session.ended) {
        await this.#perform(job, threads);
        return;
      }
      job.started = true;
      kept = session.madePlate || session.kept.size > 0;
      session.madePlate ||= call.name === 'generateToolpath';
      const value = await session.run(call, (message) => {
        this.#tell(job, message);
      });
      if (job.fraction < 1) this.#tell(job, { type: 'progress', stage: job.stage, fraction: 1 });
      // The next call does not wait for the callbacks.
      void Promise.all(job.pending).then(() => {
        if (!job.settled) job.resolve(value);
      });
    } catch (problem) {
      const error = problem instanceof SillonError ? problem : new SillonError('Internal', messageOf(problem));
      if (fatal.includes(error.code)) this.#closeSession();
      // Tries again with one thread: it cannot wait for another one in vain, and has more memory, because shared memory
      // has a lower limit. A new worker also has more memory than one that keeps fields of the last plate, or the last
      // print.
      const silent = threads > 1 && session?.silent === true;
      if (silent) this.#useOneThread(error.message);
      const again = silent || ((threads > 1 || kept) && error.code === 'OutOfMemory');
      if (again && job.pieces === 0 && !job.settled) await this.#perform(job, 1);
      else job.reject(error);
    }
  }

  /** Returns the call as it is sent, without values that the session knows. */
  #sent(call: Call, { kept }: Session): Promise<Call> {
    return withKnown(call, async <T>(part: Known<T>, name: string) => {
      const { number } = part;
      if (kept.has(number)) return { number, value: undefined };
      const { value } = part;
      const bytes = value instanceof Blob ? await this.platform.portable?.(value, name) : undefined;
      return { number, value: (bytes as T | undefined) ?? value }; // a Blob may be replaced by bytes
    });
  }

  /** Passes a message to the call's callbacks; an error that they throw ends the call. */
  #tell(job: Job, message: FromWorker): void {
    if (job.settled) return;
    try {
      if (message.type === 'progress' && message.fraction >= job.fraction) {
        job.stage = message.stage;
        job.fraction = message.fraction;
        this.#await(job, job.options.onProgress?.({ stage: message.stage, fraction: message.fraction }));
      } else if (message.type === 'piece') {
        ++job.pieces;
        this.#await(job, job.options.onChunk?.(message.bytes));
      }
    } catch (thrown) {
      this.#giveUp(job, thrown);
    }
  }

  /** Makes the call wait for an asynchronous callback; if that rejects, the call does, too. */
  #await(job: Job, returned: unknown): void {
    if (typeof (returned as PromiseLike<unknown> | undefined)?.then !== 'function') return;
    job.pending.push(
      Promise.resolve(returned).then(
        () => undefined,
        (thrown: unknown) => {
          this.#giveUp(job, thrown);
        },
      ),
    );
  }

  #giveUp(job: Job, reason: unknown): void {
    job.reject(reason);
    this.#waiting = this.#waiting.filter((other) => other !== job);
    if (this.#running === job && job.started) this.#session?.cancel();
  }

  /** Opens a session, with one thread if several cannot be started. */
  async #openSession(threads: number): Promise<Session> {
    if (this.#session?.ended === false && this.#session.threads === threads) return this.#session;
    this.#closeSession();
    const session = new Session(threads, this.memory);
    const variant = variantOf(threads);
    this.#session = session;
    try {
      this.#compiled[variant] = await session.start(this.platform, this.files, this.#compiled[variant]);
      this.#version = session.version;
      return session;
    } catch (problem) {
      this.#closeSession();
      if (!this.#disposed && this.platform.forget?.(this.files, threads) === true) return this.#openSession(threads);
      if (threads === 1 || this.#disposed) throw problem;
      this.#useOneThread(messageOf(problem));
      return this.#openSession(1);
    }
  }

  #closeSession(): void {
    this.#session?.end(disposed());
    this.#session = undefined;
  }

  #useOneThread(why: string): void {
    this.using = { threads: 1, reason: `threads were given up: ${why}`, reasonCode: 'GivenUp' };
  }

  #restLater(): void {
    if (this.#disposed || this.idleTimeout > longestTimer) return;
    this.#rest = setTimeout(() => {
      this.#closeSession();
    }, this.idleTimeout);
    // In Node the timer would keep the process alive.
    (this.#rest as { unref?: () => void }).unref?.();
  }
}

const variantOf = (threads: number): Variant => (threads > 1 ? 'mt' : 'st');

const disposed = (): SillonError => new SillonError('Disposed', 'the engine was disposed of');

function reasonOf(signal: AbortSignal): unknown {
  return signal.reason ?? new DOMException('The call was aborted', 'AbortError');
}
