// <sillon-studio>: the studio in a frame of any page. It owns the frame, talks to it over a port, and turns its
// messages into events and promises. No dependencies: one file for a script tag.
import type { GcodeFinding, GcodeSummary, Project } from 'sillon';
import type { GcodeFile, StudioFile, StudioInfo, StudioMethods, StudioReport, StudioSource } from 'sillon/elements';
import { download } from '../files/download.js';
import { frame } from '../i18n/en.js';
import { fetchFiles, type Asked, type Fetched } from './fetching.js';
import {
  field,
  fileFrom,
  isFields,
  isHello,
  replyFrom,
  toldFrom,
  version,
  type Connect,
  type Fields,
  type Method,
  type Told,
} from './protocol.js';

/** Features that the frame may use if its host may. */
const permissions =
  'cross-origin-isolated fullscreen clipboard-write gyroscope accelerometer web-share local-network-access'.split(' ');

/** Chromium's list of features. Chromium logs a warning for each allowed feature that it does not know, such as
 * sharing on Linux. */
interface FeaturePolicy {
  features(): string[];
}

/** Returns the `allow` attribute of the frame, without features that the browser does not know. */
function knownPermissions(): string {
  const known = (document as { featurePolicy?: FeaturePolicy }).featurePolicy?.features();
  return permissions.filter((name) => known?.includes(name) ?? true).join('; ');
}

/** Attributes that are part of the frame's address. */
const ofAddress = ['threads', 'autosave'] as const;
/** Attributes that the running studio accepts. */
const ofStudio = ['mode', 'controls', 'lang', 'theme', 'units', 'printer', 'accent', 'radius', 'font'] as const;
/** Attributes that name files, with the role of each file. */
const ofFiles = { src: '', project: '', shape: 'shape', image: 'image' } as const;
const others = ['base', 'sandbox'] as const;
/** Address of a picture that stands in for the studio until it is loaded. */
const ofPoster = 'poster';
/** Attribute that is never part of the address, which anybody may write: 'printer' allows a project's own printer. */
const ofLoads = 'trusted';
const attributes = [...ofAddress, ...ofStudio, ...Object.keys(ofFiles), ...others, ofLoads, ofPoster];

const patience = 10_000; // [ms] for the frame's hello after it has loaded; a frame that the browser blocks never sends one
const longest = 60_000; // [ms] for the loading itself, on the slowest networks
const near = '800px'; // margin around the window: the studio loads when the element comes that close

/** A few words of each language; the bundler puts only these into this file. */
const words = import.meta.glob<typeof frame>('../i18n/??.ts', { eager: true, import: 'frame' });

const wordsIn = (language: string): typeof frame | undefined => words[`../i18n/${language}.ts`];
/** Returns the language of a tag: "fr" of "fr-CA". */
const primary = (tag: string): string => tag.toLowerCase().split('-')[0] ?? '';

/** File names that a visitor may download. */
const extensions = /\.(gcode|bgcode|3mf|stl|svg|png|zip|mp4|webm)$/;

/** A failure, for people and programs: docs/guide/embedding.md lists the codes. */
export class StudioFrameError extends Error {
  override readonly name = 'StudioFrameError';
  constructor(
    readonly code: string,
    message: string,
    readonly hint: string,
  ) {
    super(message);
  }
}

interface Waiter {
  resolve: (result: unknown) => void;
  reject: (error: unknown) => void;
}

/** A plate on its way to the frame, or the reason why there is none. */
interface Sent {
  files?: Fetched[];
  project?: object;
  failed?: string;
}

interface Gathered {
  sent: Sent;
  failure?: StudioFrameError;
}

const style = `
  :host { display: block; position: relative; height: 640px; overflow: hidden; }
  :host([hidden]) { display: none; }
  iframe { display: block; width: 100%; height: 100%; border: 0; }
  img { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: contain; background: #f4f3ef; }
  img[hidden] { display: none; }
  p { position: absolute; inset: 0; display: grid; place-content: center; justify-items: center; gap: 8px; margin: 0;
    padding: 16px; font: 16px/1.5 system-ui, sans-serif; color: #23282d; background: #f4f3ef; text-align: center; }
  p[hidden] { display: none; }
  a { color: #0a5c78; }
`;

let sheet: CSSStyleSheet | undefined;

/** Returns the shared style sheet; a host's policy may forbid a style element. */
function styleSheet(): CSSStyleSheet {
  if (sheet === undefined) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(style);
  }
  return sheet;
}

/** The custom element <sillon-studio>: docs/guide/embedding.md. */
export class SillonStudioElement extends HTMLElement implements StudioMethods {
  static readonly observedAttributes = attributes;

  readonly #frame = document.createElement('iframe');
  readonly #notice = document.createElement('p');
  readonly #poster = document.createElement('img');
  #port: MessagePort | undefined;
  /** Reason why there is no port and will be none. */
  #fault: StudioFrameError | undefined;
  /** Calls that wait for a port. */
  readonly #callers = new Set<Waiter>();
  /** Last content of `ready`, and the calls that wait for it. */
  #info: StudioInfo | undefined;
  readonly #curious = new Set<Waiter>();
  readonly #waiters = new Map<number, Waiter>();
  #nextId = 1;
  #late: ReturnType<typeof setTimeout> | undefined;
  /** Watches the element until the studio is to be loaded; undefined afterwards. */
  #near: IntersectionObserver | undefined;
  /** The frame was opened since the element came into its page. */
  #opened = false;
  /** Plate that the page gave to `load` after the attributes named their files. */
  #source: StudioSource | undefined;
  /** Resolves when the studio shows the plate that the page names; rejects if it cannot. */
  #loading: Promise<void> = Promise.resolve();
  #loads = 0;
  /** No plate has been sent to this frame yet, so work of an earlier visit that it shows is kept. */
  #initial = true;
  /** The plate that the page names cannot be shown. */
  #lacking = false;

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    root.adoptedStyleSheets = [styleSheet()];
    this.#notice.hidden = true;
    this.#notice.setAttribute('role', 'alert');
    this.#poster.hidden = true;
    this.#poster.alt = '';
    this.#poster.part.add('poster');
    this.#frame.addEventListener('load', () => {
      if (this.#frame.src !== '' && this.#port === undefined && this.#fault === undefined) this.#wait(patience);
    });
    this.#poster.addEventListener('error', () => {
      this.#poster.hidden = true; // otherwise it would hide the reason why there is no plate
    });
    root.append(this.#frame, this.#poster, this.#notice);
  }

  connectedCallback(): void {
    takeOver(this);
    this.#fault = undefined; // an element that is put into a page again opens again
    addEventListener('message', this.#onMessage);
    document.addEventListener('securitypolicyviolation', this.#onRefused);
    this.#showPoster();
    this.#near = new IntersectionObserver(
      (entries) => {
        if (entries.some(({ isIntersecting }) => isIntersecting)) this.#open();
      },
      { rootMargin: near },
    );
    this.#near.observe(this);
    if (this.#callers.size > 0) this.#open();
  }

  disconnectedCallback(): void {
    removeEventListener('message', this.#onMessage);
    document.removeEventListener('securitypolicyviolation', this.#onRefused);
    this.#near?.disconnect();
    this.#near = undefined;
    this.#opened = false;
    clearTimeout(this.#late);
    this.#close(new StudioFrameError('Closed', 'The element was taken out of its page.', ''));
    this.#frame.removeAttribute('src');
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (before === now) return;
    if (name in ofFiles && now !== null && now !== '') this.#source = undefined;
    if (!this.isConnected || name === ofLoads) return;
    if (name === ofPoster) this.#showPoster();
    else if (!this.#opened)
      return; // all attributes are read when the studio is loaded
    else if ([...ofAddress, ...others].some((one) => one === name)) this.#open();
    else if (name in ofFiles) this.#loadNamed();
    else if (this.#fault === undefined) {
      // An attribute that is removed gets its default back.
      const plain = { accent: '', radius: '', font: '' };
      const lang = navigator.languages.map(primary).find((tag) => wordsIn(tag) !== undefined) ?? 'en';
      const defaults: Record<string, string> = {
        mode: 'edit',
        controls: '',
        lang,
        theme: 'auto',
        units: 'mm',
        ...plain,
      };
      const value = now ?? defaults[name];
      if (value !== undefined) void this.#ask('configure', { [name]: value }).catch(this.#tellOwn);
    }
  }

  // --- Methods for the page -------------------------------------------------------------------------------------------------

  /** Shows another plate. @throws StudioFrameError */
  async load(source: StudioSource): Promise<void> {
    this.#source = source;
    this.#wake();
    const loading = this.#show(++this.#loads, () => this.#given(source), false);
    this.#loading = loading;
    await loading;
  }

  /** Returns the content of the event `ready`, also to callers that come after it. */
  async info(): Promise<StudioInfo> {
    await this.#connection();
    if (this.#info !== undefined) return this.#info;
    const { promise, ...waiter } = wait<StudioInfo>();
    this.#curious.add(waiter);
    return promise;
  }

  /** Returns the plate as a project of the command line
   * (docs/reference/project.md); its pictures are in `exportProject`. */
  async getProject(): Promise<Project> {
    return objectIn(await this.#askOfPlate('getProject'), 'project') as Project;
  }

  /** Waits until the plate is complete and measured. @returns its report */
  async generate({ signal }: { signal?: AbortSignal } = {}): Promise<StudioReport> {
    return objectIn(await this.#askOfPlate('generate', {}, signal), 'report') as StudioReport;
  }

  /** Returns the report of the plate that is shown; null while it is incomplete. */
  async report(): Promise<StudioReport | null> {
    const result = await this.#askOfPlate('report');
    return isFields(result) && isFields(field(result, 'report')) ? (objectIn(result, 'report') as StudioReport) : null;
  }

  /** Returns the G-code file with its summary (grams, seconds) and its findings. */
  async exportGcode({ signal }: { signal?: AbortSignal } = {}): Promise<GcodeFile> {
    const result = await this.#askOfPlate('exportGcode', {}, signal);
    const findings = isFields(result) ? field(result, 'findings') : undefined;
    return {
      ...fileIn(result),
      summary: objectIn(result, 'summary') as GcodeSummary,
      findings: Array.isArray(findings) ? (findings as GcodeFinding[]) : [],
    };
  }

  /** Returns the base layers as a solid for other slicers, 3MF. */
  async exportBody({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportBody', {}, signal);
  }

  /** Returns the beads as an SVG file. */
  async exportSvg({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportSvg', {}, signal);
  }

  /** Returns a zip of the project and its pictures, for the studio and the command line. */
  async exportProject({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportProject', {}, signal);
  }

  /** Returns a file for <sillon-view>. */
  async exportView({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportView', {}, signal);
  }

  /** Returns a picture of the plate: a PNG `width` pixels wide, or a small WebP in which the light moves. */
  async capture({
    signal,
    ...options
  }: { type?: 'image' | 'loop'; width?: number; signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('capture', options, signal);
  }

  // --- The frame ------------------------------------------------------------------------------------------------------------

  /** Returns the folder of the studio; by default, the parent of this script's folder. */
  #base(): URL {
    const given = this.getAttribute('base');
    const base = new URL(given ?? new URL(/* @vite-ignore */ '../', import.meta.url), document.baseURI);
    if (base.protocol !== 'https:' && base.protocol !== 'http:')
      throw new Error(`base is ${base.protocol}, not http or https`);
    return base;
  }

  /** Returns the origin of the frame's messages; a sandbox has an opaque one. */
  #origin(): string {
    const { sandbox } = this.#frame;
    return this.hasAttribute('sandbox') && !sandbox.contains('allow-same-origin') ? 'null' : this.#base().origin;
  }

  /** Loads the frame, and closes the connection to an earlier one. */
  #open(): void {
    this.#near?.disconnect();
    this.#near = undefined;
    this.#opened = true;
    this.#drop(new StudioFrameError('Closed', 'The frame was closed.', ''));
    this.#fault = undefined;
    clearTimeout(this.#late);
    this.#notice.hidden = true;
    let address: URL;
    try {
      address = new URL('embed.html', this.#base());
    } catch (error) {
      const fault = new StudioFrameError('BadAttribute', String(error), '');
      this.#close(fault);
      this.#tellError(fault);
      return;
    }
    for (const name of [...ofAddress, ...ofStudio]) {
      const value = this.getAttribute(name);
      if (value !== null) address.searchParams.set(name, value);
    }
    if (this.#source !== undefined || this.#attributed().length > 0) address.searchParams.set('waits', '');
    this.#frame.allow = knownPermissions();
    this.#frame.title = 'Sillon Studio';
    const sandbox = this.getAttribute('sandbox');
    if (sandbox === null) this.#frame.removeAttribute('sandbox');
    else this.#frame.setAttribute('sandbox', sandbox);
    this.#frame.src = address.href;
    this.#wait(longest);
    this.#initial = true;
    this.#loadNamed();
  }

  /** Reports at once that the page's own policy forbids the frame, without waiting for its hello. */
  #onRefused = ({ effectiveDirective, blockedURI }: SecurityPolicyViolationEvent): void => {
    if (effectiveDirective !== 'frame-src' || !blockedURI.startsWith(this.#base().origin)) return;
    if (!this.#opened || this.#port !== undefined || this.#fault !== undefined) return;
    clearTimeout(this.#late);
    this.#blocked();
  };

  /** Reports a frame as blocked or out of reach if it stays silent for so long [ms]. */
  #wait(time: number): void {
    clearTimeout(this.#late);
    this.#late = setTimeout(() => this.#blocked(), time);
  }

  /** Shows a link to the studio in place of the frame, and rejects all calls. */
  #blocked(): void {
    const say = wordsIn(primary(this.lang || document.documentElement.lang)) ?? frame;
    const link = document.createElement('a');
    link.href = this.#base().href;
    link.target = '_blank';
    link.rel = 'noopener';
    link.textContent = say.open;
    this.#notice.replaceChildren(say.blocked, link);
    this.#notice.hidden = false;
    this.#poster.hidden = true;
    const fault = new StudioFrameError('Blocked', say.blocked, say.open);
    this.#close(fault);
    this.#tellError(fault);
  }

  #showPoster(): void {
    const address = this.getAttribute(ofPoster);
    if (address !== null && address !== '') this.#poster.src = address;
    this.#poster.hidden = address === null || address === '' || (this.#port !== undefined && !this.#lacking);
  }

  /** Returns a port to the frame; loads the frame if necessary.
   * @throws StudioFrameError Blocked, Closed, BadAttribute; the signal's reason */
  #connection(signal?: AbortSignal): Promise<MessagePort> {
    if (this.#port !== undefined) return Promise.resolve(this.#port);
    if (this.#fault !== undefined) return Promise.reject(this.#fault);
    const { promise, ...caller } = wait<MessagePort>();
    this.#callers.add(caller);
    this.#wake();
    return heeding(signal, promise, () => {
      if (this.#callers.delete(caller)) caller.reject(signal?.reason);
    });
  }

  /** Loads the studio now, however far it is from the window. */
  #wake(): void {
    if (this.isConnected && this.#near !== undefined) this.#open();
  }

  /** Rejects all calls, now and until the frame is opened again. */
  #close(fault: StudioFrameError): void {
    this.#fault = fault;
    for (const { reject } of this.#callers) reject(fault);
    this.#callers.clear();
    this.#drop(fault);
  }

  /** Closes the port and rejects the requests that wait for a reply. */
  #drop(fault: StudioFrameError): void {
    if (this.#port === undefined) return;
    this.#port.close();
    this.#port = undefined;
    this.#info = undefined;
    for (const { reject } of [...this.#waiters.values(), ...this.#curious]) reject(fault);
    this.#curious.clear();
    this.#waiters.clear();
  }

  /** Takes the frame's hello: from its window and its origin alone. */
  readonly #onMessage = ({ source, origin, data }: MessageEvent): void => {
    const frame = this.#frame.contentWindow;
    if (frame === null || source !== frame || origin !== this.#origin() || !isHello(data)) return;
    const anew = this.#port !== undefined || this.#fault !== undefined; // a new frame does not know yet which plate the page names
    this.#drop(new StudioFrameError('Closed', 'The frame was loaded anew.', ''));
    this.#fault = undefined; // a late hello still counts
    clearTimeout(this.#late);
    this.#notice.hidden = true;
    this.#poster.hidden = true;
    const { port1, port2 } = new MessageChannel();
    port1.addEventListener('message', this.#onPortMessage);
    port1.start();
    const connect: Connect = { sillon: 'connect', v: version, exports: 'host' };
    // An opaque origin cannot be named; the page itself chose the content of the sandbox.
    frame.postMessage(connect, origin === 'null' ? '*' : origin, [port2]);
    this.#port = port1;
    for (const { resolve } of this.#callers) resolve(port1);
    this.#callers.clear();
    if (!anew) return;
    this.#initial = true;
    this.#loadNamed();
  };

  /** Takes replies and events of the frame. */
  readonly #onPortMessage = ({ data }: MessageEvent): void => {
    const reply = replyFrom(data);
    if (reply !== undefined) {
      const waiter = this.#waiters.get(reply.id);
      this.#waiters.delete(reply.id);
      if (!('error' in reply)) waiter?.resolve(reply.result);
      else if (reply.error.code === 'Aborted') waiter?.reject(new DOMException(reply.error.message, 'AbortError'));
      else waiter?.reject(new StudioFrameError(reply.error.code, reply.error.message, reply.error.hint));
      return;
    }
    const told = toldFrom(data);
    if (told !== undefined) this.#tell(told);
  };

  /** Passes an event of the frame on to the page. */
  #tell({ event, detail }: Told): void {
    if (event === 'export') {
      this.#hand(detail);
      return;
    }
    if (event === 'ready') {
      this.#info = detail as unknown as StudioInfo;
      for (const { resolve } of this.#curious) resolve(detail);
      this.#curious.clear();
    }
    this.dispatchEvent(new CustomEvent(event, { detail }));
  }

  /** Hands over a file that the visitor asked for: the host takes it, or this page downloads it. */
  #hand(detail: Fields): void {
    const file = fileFrom(detail);
    if (file === undefined) return;
    const { name, type } = file;
    const blob = new Blob([file.bytes], { type });
    const event = new CustomEvent('export', { detail: { name, type, blob }, cancelable: true });
    if (!this.dispatchEvent(event)) return;
    // The download is made in this page's name: only kinds of
    // files that a studio writes, and only after a user gesture.
    if (extensions.test(name) && navigator.userActivation.hasBeenActive) download(blob, name);
    else this.#tellError(new StudioFrameError('NoDownload', `${name} was not asked for by the visitor.`, ''));
  }

  readonly #tellError = (error: unknown): void => {
    const { code, message, hint } = faultOf(error);
    this.dispatchEvent(new CustomEvent('error', { detail: { code, message, hint } }));
  };

  /** Reports an error unless the caller knows it already: a missing frame is reported once, and whoever removed the
   * element needs no report. */
  readonly #tellOwn = (error: unknown): void => {
    if (error !== this.#fault && this.isConnected) this.#tellError(error);
  };

  /** Sends a request to the frame and returns its result. @throws StudioFrameError; the signal's reason */
  async #ask(
    method: Method,
    params: Fields = {},
    signal?: AbortSignal,
    transfer: Transferable[] = [],
  ): Promise<unknown> {
    signal?.throwIfAborted();
    const port = await this.#connection(signal);
    signal?.throwIfAborted();
    const id = this.#nextId++;
    const { promise, ...waiter } = wait<unknown>();
    this.#waiters.set(id, waiter);
    try {
      port.postMessage({ v: version, id, method, params }, transfer);
    } catch (error) {
      this.#waiters.delete(id);
      throw new StudioFrameError('BadRequest', errorText(error), ''); // for example a function, which cannot be sent
    }
    return heeding(signal, promise, () => {
      if (this.#waiters.has(id)) this.#ask('cancel', { id }).catch(() => undefined); // a failed cancel leaves nothing to stop
    });
  }

  /** Sends a request about the plate that the page names, once the studio shows it. */
  async #askOfPlate(method: Method, params: Fields = {}, signal?: AbortSignal): Promise<unknown> {
    signal?.throwIfAborted();
    this.#wake();
    const { promise, resolve, reject } = wait<undefined>();
    this.#loading.then(resolve, reject);
    await heeding(signal, promise, () => reject(signal?.reason));
    return this.#ask(method, params, signal);
  }

  async #file(method: Method, params: Fields, signal?: AbortSignal): Promise<StudioFile> {
    return fileIn(await this.#askOfPlate(method, params, signal));
  }

  // --- Files ----------------------------------------------------------------------------------------------------------------

  /** Returns the files that attributes name. */
  #attributed(): Asked[] {
    return Object.entries(ofFiles).flatMap(([name, role]) => {
      const url = this.getAttribute(name);
      return url === null || url === '' ? [] : [{ url, role }];
    });
  }

  /** Loads the plate that the page names, after all attribute changes of one turn, or into a new frame. */
  #loadNamed(): void {
    const mine = ++this.#loads;
    this.#loading = Promise.resolve().then(async () => {
      if (mine !== this.#loads) return this.#loading;
      const source = this.#source;
      const asked = this.#attributed();
      if (source !== undefined) await this.#show(mine, () => this.#given(source), this.#initial);
      else if (asked.length > 0) {
        const gather = async (): Promise<Sent> => ({ files: await fetchFiles(asked, document.baseURI) });
        await this.#show(mine, gather, this.#initial);
      }
    });
    this.#loading.catch((error: unknown) => {
      if (mine === this.#loads) this.#tellOwn(error);
    });
  }

  /** Sends a plate to the studio, or the reason why there is none, which the studio then shows.
   * @param initial  work of an earlier visit is not replaced
   * @throws StudioFrameError */
  async #show(mine: number, gather: () => Promise<Sent>, initial: boolean): Promise<void> {
    const { sent, failure } = await gather().then(
      (sent): Gathered => ({ sent }),
      (error: unknown): Gathered => {
        const failure = faultOf(error);
        return { sent: { failed: failure.message }, failure };
      },
    );
    await this.#connection().catch(() => undefined); // the request below reports the reason
    if (mine !== this.#loads) {
      if (failure !== undefined) throw failure;
      return this.#loading; // another plate was named in the meantime
    }
    const bytes = sent.files?.map((file) => file.bytes);
    const trusted = this.getAttribute(ofLoads) ?? '';
    this.#initial = false;
    try {
      await this.#ask('load', { ...sent, initial, trusted }, undefined, bytes);
      this.#setLacking(false);
    } catch (error) {
      if (mine === this.#loads) this.#setLacking(true);
      throw failure ?? error;
    }
  }

  #setLacking(lacking: boolean): void {
    this.#lacking = lacking;
    this.#showPoster();
  }

  /** Reads the argument of `load`. @throws StudioFrameError, Error */
  async #given(source: StudioSource): Promise<Sent> {
    const list: readonly unknown[] = Array.isArray(source) ? source : [source];
    const files: Fetched[] = [];
    const projects: object[] = [];
    for (const one of list) {
      if (one instanceof Blob) {
        files.push({ name: one instanceof File ? one.name : 'file', bytes: await one.arrayBuffer(), role: '' });
      } else if (typeof one === 'string' || one instanceof URL) {
        files.push(...(await fetchFiles([{ url: String(one), role: '' }], document.baseURI)));
      } else if (isFields(one)) projects.push(one);
      else throw new StudioFrameError('BadRequest', 'load takes files, addresses and a project', '');
    }
    const [project, another] = projects;
    if (another !== undefined) throw new StudioFrameError('BadRequest', 'load takes one project', '');
    if (project === undefined) return { files };
    try {
      return { files, project: structuredClone(project) };
    } catch (error) {
      throw new StudioFrameError('BadRequest', errorText(error), ''); // for example a function, which cannot be sent
    }
  }
}

/** Re-applies properties that the page set before this script
 * defined the element: they hide the accessors of the class. */
function takeOver(element: HTMLElement): void {
  for (const name of attributes) {
    if (!Object.hasOwn(element, name)) continue;
    const value: unknown = Reflect.get(element, name);
    Reflect.deleteProperty(element, name);
    Reflect.set(element, name, value);
  }
}

/** Returns a promise with its resolve and reject. */
function wait<T>(): Waiter & { promise: Promise<T> } {
  let waiter!: Waiter;
  const promise = new Promise<T>((resolve, reject) => {
    waiter = { resolve: resolve as Waiter['resolve'], reject };
  });
  return { promise, ...waiter };
}

/** Returns the promise, and calls `onAbort` if the signal aborts first. The listener is removed once the promise is
 * settled, because a signal may outlive many calls. */
async function heeding<T>(signal: AbortSignal | undefined, promise: Promise<T>, onAbort: () => void): Promise<T> {
  signal?.addEventListener('abort', onAbort);
  try {
    return await promise;
  } finally {
    signal?.removeEventListener('abort', onAbort);
  }
}

/** Wraps an error: any error other than the element's own means that a file could not be loaded. */
const faultOf = (error: unknown): StudioFrameError =>
  error instanceof StudioFrameError ? error : new StudioFrameError('LoadFailed', errorText(error), '');

const errorText = (error: unknown): string => (error instanceof Error ? error.message : String(error));

/** Reads a file from a reply. @throws StudioFrameError BadReply */
function fileIn(result: unknown): StudioFile {
  const file = fileFrom(result);
  if (file === undefined) throw new StudioFrameError('BadReply', 'The frame sent no file.', '');
  return { name: file.name, blob: new Blob([file.bytes], { type: file.type }) };
}

/** Reads an object from a reply; its form is trusted, since the studio comes from the same place as this script.
 * @throws StudioFrameError BadReply */
function objectIn(result: unknown, name: string): object {
  const value = isFields(result) ? field(result, name) : undefined;
  if (!isFields(value)) throw new StudioFrameError('BadReply', `The frame sent no ${name}.`, '');
  return value;
}

// This is repeated in the other element: a module that two entries
// share becomes a file of its own, and each must be one file.
for (const name of attributes) {
  Object.defineProperty(SillonStudioElement.prototype, name, {
    configurable: true,
    enumerable: true,
    get(this: HTMLElement) {
      return this.getAttribute(name) ?? '';
    },
    set(this: HTMLElement, value: string | null | undefined) {
      if (value === null || value === undefined) this.removeAttribute(name);
      else this.setAttribute(name, value);
    },
  });
}

if (customElements.get('sillon-studio') === undefined) customElements.define('sillon-studio', SillonStudioElement);
