// Calls one after the other, in a session that is started when one is needed: progress, abort, recovery, rest.
import type * as api from '../sillon.js';
import { SillonError, messageOf } from './errors.js';
import type { CallOptions } from './input.js';
import { withKnown } from './known.js';
import type { Platform } from './platform.js';
import type { Call, EngineFiles, FromWorker, Known, Variant } from './protocol.js';
import { Session } from './session.js';

const longestTimer = 2 ** 31 - 1; // [ms]

/** After these the worker's memory is not to be trusted, or not to be had back. */
const fatal: readonly api.ErrorCode[] = ['OutOfMemory', 'Internal', 'Crashed'];

interface Job {
  call: Call;
  options: CallOptions;
  resolve(value: unknown): void;
  reject(reason: unknown): void;
  /** Its promise is settled; its work may still have to stop. */
  settled: boolean;
  /** Its call is in the worker. */
  started: boolean;
  stage: string;
  fraction: number;
  pieces: number;
  /** What callbacks returned and did not finish yet. */
  pending: Promise<void>[];
}

/** How many threads compute, and why not more. */
export type Threads = Pick<api.EngineInfo, 'threads' | 'reason' | 'reasonCode'>;

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
    /** Of a session [MiB]. */
    readonly memory: number,
    private using: Threads,
    /** Whose compiled modules are used as well. */
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

  run(call: Call, options: CallOptions): Promise<unknown> {
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
          resolve(value);
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

  async #perform(job: Job, threads: number): Promise<void> {
    let session: Session | undefined;
    let kept = false;
    try {
      session = await this.#openSession(threads);
      const call = await this.#sent(job.call, session);
      if (job.settled) return; // while the session started
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
      // The next call does not wait for them.
      void Promise.all(job.pending).then(() => {
        if (!job.settled) job.resolve(value);
      });
    } catch (problem) {
      const error = problem instanceof SillonError ? problem : new SillonError('Internal', messageOf(problem));
      if (fatal.includes(error.code)) this.#closeSession();
      // One thread cannot wait for another in vain, and has more memory: what threads share has a lower limit. A worker
      // that keeps fields of the last plate, or the last print, has less than a new one.
      const silent = threads > 1 && session?.silent === true;
      if (silent) this.#useOneThread(error.message);
      const again = silent || ((threads > 1 || kept) && error.code === 'OutOfMemory');
      if (again && job.pieces === 0 && !job.settled) await this.#perform(job, 1);
      else job.reject(error);
    }
  }

  /** The call as it travels: without what the session knows. */
  #sent(call: Call, { kept }: Session): Promise<Call> {
    return withKnown(call, async <T>(part: Known<T>, name: string) => {
      const { number } = part;
      if (kept.has(number)) return { number, value: undefined };
      const { value } = part;
      const bytes = value instanceof Blob ? await this.platform.portable?.(value, name) : undefined;
      return { number, value: (bytes as T | undefined) ?? value }; // what may be a Blob may be bytes
    });
  }

  /** To the call's callbacks; what they throw ends the call. */
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

  /** The call ends after what an asynchronous callback does, and as that ends. */
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

  /** With one thread where several do not start. */
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
    // In Node a timer would keep the process alive.
    (this.#rest as { unref?: () => void }).unref?.();
  }
}

const variantOf = (threads: number): Variant => (threads > 1 ? 'mt' : 'st');

const disposed = (): SillonError => new SillonError('Disposed', 'the engine was disposed of');

function reasonOf(signal: AbortSignal): unknown {
  return signal.reason ?? new DOMException('The call was aborted', 'AbortError');
}
