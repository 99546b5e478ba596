// The studio's side of a frame: waits for one host, checks its origin, and answers its requests one after the other.
// Nothing is done before the handshake, and every message is treated as input from a stranger.
import { wholeWords } from '../i18n/say-problem.js';
import { threadsWords } from '../i18n/say-threads.js';
import { Unfit } from '../model/check.js';
import type { Opening } from '../model/file-role.js';
import { isAbort, problemOf, StudioError, type Failure, type Problem } from '../model/problem.js';
import { isOf } from '../model/result.js';
import type { PlateResult } from '../model/state.js';
import type { Notice, Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import { brandFrom, wear } from './brand.js';
import { checkedCapture, checkedPicture, openingsFrom, Refused } from './requests.js';
import {
  connectFrom,
  field,
  hello,
  most,
  requestFrom,
  version,
  type EventName,
  type Fields,
  type FileMessage,
  type Method,
  type Request,
} from './protocol.js';

/** Actions that a host may request; each may reject. */
export interface FrameServices {
  /** Shows another plate from these files. @param trusted  the host vouches for the printer of a project */
  load(openings: readonly Opening[], trusted: boolean): Promise<void>;
  /** Starts the making of plates. */
  begin(): void;
  configure(textOf: (attribute: string) => unknown): Promise<void>;
  /** Returns the complete, measured path of the current plate. */
  finished(): Promise<PlateResult>;
  /** Called after the handshake.
   * @returns true if work of an earlier visit is shown, which must not be replaced */
  onHost(origin: string): Promise<boolean>;
}

interface Answer {
  result: unknown;
  transfer?: Transferable[];
}

type Answering = (params: Fields, signal: AbortSignal) => Promise<Answer>;

/** A request that waits or runs. */
interface Job {
  id: number;
  control: AbortController;
}

/** Turns a file into an answer whose bytes are transferred. */
const sent = async ({ blob, name }: { blob: Blob; name: string }): Promise<Answer> => {
  const bytes = await blob.arrayBuffer();
  return { result: { name, type: blob.type, bytes } satisfies FileMessage, transfer: [bytes] };
};

/** Returns a promise that rejects when the signal aborts. */
const abortOf = (signal: AbortSignal): Promise<never> =>
  new Promise((_, reject) =>
    signal.addEventListener('abort', () => {
      reject(signal.reason as DOMException);
    }),
  );

/** The connection to one host: runs its requests in order. */
class Host {
  readonly #jobs = new Map<number, Job>();
  #last: Promise<unknown> = Promise.resolve();
  #restored = false;

  constructor(
    private readonly port: MessagePort,
    private readonly studio: Studio,
    private readonly services: FrameServices,
  ) {}

  /** Starts to take requests. @param restored  resolves once work of an earlier visit was looked for */
  start(restored: Promise<boolean>): void {
    this.#last = restored.then((found) => {
      this.#restored = found;
    });
    this.port.addEventListener('message', ({ data }) => {
      const request = requestFrom(data);
      if (request !== undefined) this.#take(request);
    });
    this.port.start();
  }

  /** Sends an event to the host. */
  tell(event: EventName, detail: Fields, transfer: Transferable[] = []): void {
    this.port.postMessage({ v: version, event, detail }, transfer);
  }

  /** Checks a request and queues it; `cancel` is done at once. */
  #take(request: Request): void {
    const { id, v, method } = request;
    if (v !== version) {
      this.#refuse(id, new Refused('Version', `messages are of version ${v}; this studio speaks ${version}`));
    } else if (method === 'cancel') {
      this.#cancel(field(request.params, 'id'));
      this.#reply(id, { result: null });
    } else if (this.#jobs.has(id)) {
      this.#refuse(id, new Refused('BadRequest', `request ${id} is waiting already`));
    } else if (this.#jobs.size >= most.waiting) {
      this.#refuse(id, new Refused('Busy', `${most.waiting} requests are waiting already`));
    } else {
      const job = { id, control: new AbortController() };
      this.#jobs.set(id, job);
      this.#last = this.#last.then(() => this.#run(request, job));
    }
  }

  /** Answers one request; the signal ends the wait for the answer. */
  async #run({ id, method, params }: Request, { control }: Job): Promise<void> {
    try {
      control.signal.throwIfAborted();
      const answer = this.#methods.get(method);
      if (answer === undefined) throw new Refused('UnknownMethod', 'there is no such method');
      const { lacking } = this.studio.store.state;
      if (lacking !== undefined && method !== 'load' && method !== 'configure') {
        this.port.postMessage({ v: version, id, error: lacking });
        return;
      }
      this.#reply(id, await Promise.race([answer(params, control.signal), abortOf(control.signal)]));
    } catch (error) {
      this.#refuse(id, error);
    } finally {
      this.#jobs.delete(id);
    }
  }

  /** Answers by method; the map finds no names that objects have by themselves. */
  readonly #methods = new Map(
    Object.entries<Answering>({
      load: async (params) => {
        if (!(this.#restored && field(params, 'initial') === true)) {
          await showNamed(this.studio, async () => {
            await this.services.load(openingsFrom(params), field(params, 'trusted') === 'printer');
          });
          this.services.begin();
        }
        return { result: null };
      },
      configure: async (params) => {
        dress((attribute) => field(params, attribute));
        await this.services.configure((attribute) => field(params, attribute));
        return { result: null };
      },
      getProject: async () => {
        const { projectFileData } = await import('../files/project.js');
        return { result: { project: projectFileData(this.studio.store.state.plate) } };
      },
      generate: async () => {
        const { report } = await this.services.finished();
        await this.studio.make('gcode').catch(() => undefined); // a plate that cannot be exported has no cost
        return { result: { report: { ...report, ...this.#cost() } } };
      },
      exportGcode: async () => {
        const { result, transfer = [] } = await sent(await this.studio.make('gcode'));
        const { summary, check } = this.studio.store.state;
        const told = { summary: summary ?? null, findings: check?.findings ?? [] };
        return { result: { ...(result as FileMessage), ...told }, transfer };
      },
      exportBody: async () => sent(await this.studio.make('body')),
      exportSvg: async () => sent(await this.studio.make('svg')),
      exportView: async () => sent(await this.studio.make('view')),
      exportProject: async () => sent(await this.studio.make('project')),
      capture: async (params, signal) => {
        const loop = checkedCapture(params) === 'loop';
        return sent(loop ? await this.studio.make('loop', signal) : await this.studio.picture(checkedPicture(params)));
      },
      report: () => {
        const { result } = this.studio.store.state;
        const report = result?.measured === true ? { ...result.report, ...this.#cost() } : null;
        return Promise.resolve({ result: { report } });
      },
    } satisfies Record<Exclude<Method, 'cancel'>, Answering>),
  );

  /** Returns grams and minutes of the G-code file, once it is written. */
  #cost(): { grams?: number; minutes?: number } {
    const { summary } = this.studio.store.state;
    return summary === undefined ? {} : { grams: summary.filamentGrams, minutes: summary.seconds / 60 };
  }

  #cancel(id: unknown): void {
    const job = this.#jobs.get(id as number);
    if (job === undefined) return; // the request is already answered
    job.control.abort();
    // Only the running request has work to stop, and the first in the queue is the one that runs.
    if (this.#jobs.values().next().value === job) this.studio.services.cancel();
  }

  #reply(id: number, { result, transfer = [] }: Answer): void {
    this.port.postMessage({ v: version, id, result }, transfer);
  }

  #refuse(id: number, error: unknown): void {
    this.port.postMessage({ v: version, id, error: failureOf(error) });
  }
}

const wordsOf = (problem: Problem): Failure => ({ code: problem.code, ...wholeWords(problem) });

function failureOf(error: unknown): Failure {
  if (error instanceof Refused) return { code: error.code, message: error.message, hint: '' };
  if (isAbort(error)) return { code: 'Aborted', message: 'The request was cancelled.', hint: '' };
  return wordsOf(problemOf(error));
}

/** Shows the plate that a page or its address names. If that fails, only the reason is shown, until another named
 * plate can be. */
export async function showNamed(studio: Studio, show: () => Promise<void>): Promise<void> {
  try {
    await show();
    setLacking(studio, undefined);
  } catch (error) {
    setLacking(studio, failureOf(error));
    throw error;
  }
}

/** Shows the reason in place of the studio.
 * @param lacking  reason why the named plate cannot be shown; undefined: it can */
export function setLacking({ store }: Studio, lacking: Failure | undefined): void {
  store.set({ lacking });
  document.querySelector('.lacking')?.remove();
  for (const app of document.querySelectorAll<HTMLElement>('sillon-app')) app.hidden = lacking !== undefined;
  if (lacking === undefined) return;
  const words = document.createElement('p');
  words.className = 'lacking';
  words.setAttribute('role', 'alert');
  words.textContent = `${lacking.message}\n${lacking.hint}`.trim();
  document.body.append(words);
}

/** Applies the host's brand. @throws StudioError */
function dress(textOf: (attribute: string) => unknown): void {
  try {
    wear(brandFrom(textOf));
  } catch (error) {
    if (error instanceof Unfit) throw new StudioError('GuestValue', { where: error.where, value: error.value });
    throw error;
  }
}

/** Applies the brand from the address. @returns the value that does not fit, as a problem */
function dressByAddress(): Problem | undefined {
  const query = new URLSearchParams(location.search);
  try {
    dress((attribute) => query.get(attribute) ?? undefined);
    return undefined;
  } catch (error) {
    return problemOf(error);
  }
}

/** Returns the result that hosts may hear of: none while the
 * named plate cannot be shown, and none of an earlier plate. */
const resultOf = ({ lacking, result, plate }: Readonly<Shown>): PlateResult | undefined =>
  lacking === undefined && result?.measured === true && isOf(result, plate) ? result : undefined;

/** Sends the studio's events to the host: ready, progress, result, change and error. */
function report(host: Host, studio: Studio): void {
  const { store } = studio;
  const ready = (): void => {
    const { engine } = store.state;
    if (engine === undefined) return;
    const { threads, version: program } = engine;
    host.tell('ready', { threads, why: threadsWords(engine, studio.threads).why, version: program });
  };
  const tellNotices = (notices: readonly Notice[]): void => {
    for (const { problem } of notices) if (problem !== undefined) host.tell('error', { ...wordsOf(problem) });
  };
  ready();
  tellNotices(store.state.notices);
  let settled = store.state.plate;
  store.subscribe((state, before) => {
    if (state.engine !== before.engine) ready();
    if (state.progress !== before.progress && state.progress !== undefined) {
      const { stage, fraction, secondsLeft } = state.progress;
      host.tell('progress', { stage, fraction, etaMs: secondsLeft === undefined ? null : 1000 * secondsLeft });
    }
    if (!state.live && state.plate !== settled && state.lacking === undefined) {
      settled = state.plate;
      host.tell('change', { name: settled.name, width: settled.width, height: settled.height || settled.width });
    }
    const result = resultOf(state);
    if (result !== undefined && result !== resultOf(before)) host.tell('result', { report: result.report });
    if (state.problem !== before.problem && state.problem !== undefined)
      host.tell('error', { ...wordsOf(state.problem) });
    tellNotices(state.notices.filter((notice) => !before.notices.includes(notice)));
  });
}

/** Says hello to the page around this one, and takes commands from that page alone.
 * @param hosts  origins that may command it; '*': any */
export function waitForHost(hosts: readonly string[], studio: Studio, services: FrameServices): void {
  const { parent } = window;
  if (parent === window) return;
  const wrong = dressByAddress();
  const onMessage = ({ source, origin, data, ports }: MessageEvent): void => {
    if (source !== parent || !(hosts.includes('*') || hosts.includes(origin))) return;
    const connect = connectFrom(data);
    const [port] = ports;
    if (connect === undefined || port === undefined) return;
    removeEventListener('message', onMessage); // the first valid host is the only one
    const host = new Host(port, studio, services);
    if (connect.exports === 'host') {
      studio.deliver = (blob, name) =>
        void sent({ blob, name }).then(({ result, transfer }) => {
          host.tell('export', result as Fields, transfer);
        });
    }
    host.start(services.onHost(origin));
    report(host, studio);
    if (wrong !== undefined) host.tell('error', { ...wordsOf(wrong) });
  };
  addEventListener('message', onMessage);
  parent.postMessage(hello, '*'); // safe for any origin: it contains no data
}
