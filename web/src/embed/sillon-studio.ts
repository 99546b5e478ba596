// <sillon-studio>: the studio in a frame of any page. It keeps the frame, speaks with it over a port, and turns what it says
// into events and promises. No dependencies: one file for a script tag.
import type { Project, Report } from 'sillon';
import type { StudioFile, StudioMethods, StudioSource } from 'sillon/elements';
import { download } from '../files/download.js';
import { frame } from '../i18n/en.js';
import { fetchFiles, type Fetched } from './fetching.js';
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

/** What the frame may do that its host may do. */
const permissions =
  'cross-origin-isolated; fullscreen; clipboard-write; gyroscope; accelerometer; web-share; local-network-access';

/** Attributes that are part of the frame's address. */
const ofAddress = ['threads', 'autosave'] as const;
/** Attributes that the running studio takes. */
const ofStudio = ['mode', 'controls', 'lang', 'theme', 'units', 'printer'] as const;
/** Attributes that name files, and what each is for. */
const ofFiles = { src: '', project: '', shape: 'shape', image: 'image' } as const;
const others = ['base', 'sandbox'] as const;
/** Not part of the address, which anybody may write: 'printer' lets a project's own printer be used. */
const ofLoads = 'trusted';
const attributes = [...ofAddress, ...ofStudio, ...Object.keys(ofFiles), ...others, ofLoads];

const patience = 10_000; // [ms] for the frame's first word; a frame that the browser blocks never says any

/** Of every language's file these few words alone, which the bundler finds and puts into this one. */
const words = import.meta.glob<typeof frame>('../i18n/??.ts', { eager: true, import: 'frame' });

/** What went wrong, for people and programs: docs/guide/embedding.md lists the codes. */
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

const style = `
  :host { display: block; position: relative; height: 640px; overflow: hidden; }
  :host([hidden]) { display: none; }
  iframe { display: block; width: 100%; height: 100%; border: 0; }
  p { position: absolute; inset: 0; display: grid; place-content: center; justify-items: center; gap: 8px; margin: 0;
    padding: 16px; font: 16px/1.5 system-ui, sans-serif; color: #23282d; background: #f4f3ef; text-align: center; }
  p[hidden] { display: none; }
  a { color: #0a5c78; }
`;

let sheet: CSSStyleSheet | undefined;

/** Not a style element, which a host's policy may forbid. */
function styleSheet(): CSSStyleSheet {
  if (sheet === undefined) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(style);
  }
  return sheet;
}

export class SillonStudioElement extends HTMLElement implements StudioMethods {
  static readonly observedAttributes = attributes;

  readonly #frame = document.createElement('iframe');
  readonly #notice = document.createElement('p');
  #port: MessagePort | undefined;
  #connected: Promise<MessagePort>;
  #onConnected!: (port: MessagePort) => void;
  readonly #waiters = new Map<number, Waiter>();
  #nextId = 1;
  #late: ReturnType<typeof setTimeout> | undefined;
  /** Of the files that attributes name: done when the studio has them. */
  #loading: Promise<void> = Promise.resolve();
  #loads = 0;

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    root.adoptedStyleSheets = [styleSheet()];
    this.#notice.hidden = true;
    this.#notice.setAttribute('role', 'alert');
    root.append(this.#frame, this.#notice);
    this.#connected = this.#nextConnection();
  }

  connectedCallback(): void {
    addEventListener('message', this.#onMessage);
    this.#open();
  }

  disconnectedCallback(): void {
    removeEventListener('message', this.#onMessage);
    clearTimeout(this.#late);
    this.#drop();
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (before === now || !this.isConnected || name === ofLoads) return;
    if ([...ofAddress, ...others].some((one) => one === name)) this.#open();
    else if (name in ofFiles) this.#loadAttributes();
    else if (this.#port !== undefined) {
      // Taken away, an attribute has its default again.
      const defaults: Record<string, string> = { mode: 'edit', controls: '', theme: 'auto', units: 'mm' };
      const value = now ?? defaults[name];
      if (value !== undefined) void this.#ask('configure', { [name]: value }).catch(this.#tellError);
    }
  }

  // --- What a page may ask for ----------------------------------------------------------------------------------------------

  /** Shows another plate. @throws StudioFrameError */
  async load(source: StudioSource): Promise<void> {
    ++this.#loads;
    this.#loading = Promise.resolve();
    await this.#load(source);
  }

  /** The plate as a project of the command line (docs/reference/project.md); its pictures are in `exportProject`. */
  async getProject(): Promise<Project> {
    return objectIn(await this.#askOfPlate('getProject'), 'project') as Project;
  }

  /** Waits until the plate is whole and measured. @returns its report */
  async generate({ signal }: { signal?: AbortSignal } = {}): Promise<Report> {
    return objectIn(await this.#askOfPlate('generate', {}, signal), 'report') as Report;
  }

  /** Of the plate that is shown; null while it is not whole. */
  async report(): Promise<Report | null> {
    const result = await this.#askOfPlate('report');
    return isFields(result) && isFields(field(result, 'report')) ? (objectIn(result, 'report') as Report) : null;
  }

  exportGcode({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportGcode', {}, signal);
  }

  /** The base layers as a solid for other slicers, 3MF. */
  exportBody({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportBody', {}, signal);
  }

  exportSvg({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportSvg', {}, signal);
  }

  /** A zip with the project and its pictures, which studio and command line open. */
  exportProject({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportProject', {}, signal);
  }

  /** For <sillon-view>. */
  exportView({ signal }: { signal?: AbortSignal } = {}): Promise<StudioFile> {
    return this.#file('exportView', {}, signal);
  }

  /** Its look: a PNG `width` pixels wide, or a video of one turn of the light. */
  capture(options: { type?: 'image' | 'video'; width?: number; seconds?: number } = {}): Promise<StudioFile> {
    return this.#file('capture', { ...options });
  }

  // --- The frame ------------------------------------------------------------------------------------------------------------

  /** Where the studio is: a folder; by default the one that this script's folder lies in. */
  #base(): URL {
    const given = this.getAttribute('base');
    const base = new URL(given ?? new URL(/* @vite-ignore */ '../', import.meta.url), document.baseURI);
    if (base.protocol !== 'https:' && base.protocol !== 'http:')
      throw new Error(`base is ${base.protocol}, not http or https`);
    return base;
  }

  /** Origin of the frame's messages: an opaque one in a sandbox. */
  #origin(): string {
    const { sandbox } = this.#frame;
    return this.hasAttribute('sandbox') && !sandbox.contains('allow-same-origin') ? 'null' : this.#base().origin;
  }

  #open(): void {
    this.#drop();
    clearTimeout(this.#late);
    this.#notice.hidden = true;
    let address: URL;
    try {
      address = new URL('embed.html', this.#base());
    } catch (error) {
      this.#tellError(new StudioFrameError('BadAttribute', String(error), ''));
      return;
    }
    for (const name of [...ofAddress, ...ofStudio]) {
      const value = this.getAttribute(name);
      if (value !== null) address.searchParams.set(name, value);
    }
    if (Object.keys(ofFiles).some((name) => this.getAttribute(name))) address.searchParams.set('waits', '');
    this.#frame.allow = permissions;
    this.#frame.title = 'Sillon Studio';
    const sandbox = this.getAttribute('sandbox');
    if (sandbox === null) this.#frame.removeAttribute('sandbox');
    else this.#frame.setAttribute('sandbox', sandbox);
    this.#frame.src = address.href;
    this.#late = setTimeout(() => {
      this.#blocked();
    }, patience);
    this.#loadAttributes();
  }

  #blocked(): void {
    const [language = ''] = (this.lang || document.documentElement.lang).toLowerCase().split('-');
    const say = words[`../i18n/${language}.ts`] ?? frame;
    const link = document.createElement('a');
    link.href = this.#base().href;
    link.target = '_blank';
    link.rel = 'noopener';
    link.textContent = say.open;
    this.#notice.replaceChildren(say.blocked, link);
    this.#notice.hidden = false;
    this.#tellError(new StudioFrameError('Blocked', say.blocked, say.open));
  }

  #nextConnection(): Promise<MessagePort> {
    return new Promise((resolve) => (this.#onConnected = resolve));
  }

  #drop(): void {
    if (this.#port === undefined) return;
    this.#port.close();
    this.#port = undefined;
    this.#connected = this.#nextConnection();
    for (const { reject } of this.#waiters.values())
      reject(new StudioFrameError('Closed', 'The frame was closed.', ''));
    this.#waiters.clear();
  }

  /** The frame's hello: from this window of this origin alone. */
  readonly #onMessage = ({ source, origin, data }: MessageEvent): void => {
    const frame = this.#frame.contentWindow;
    if (frame === null || source !== frame || origin !== this.#origin() || !isHello(data)) return;
    this.#drop(); // it has been loaded anew
    clearTimeout(this.#late);
    this.#notice.hidden = true;
    const { port1, port2 } = new MessageChannel();
    port1.addEventListener('message', this.#onPortMessage);
    port1.start();
    const connect: Connect = { sillon: 'connect', v: version, exports: 'host' };
    // An opaque origin cannot be named; whoever is in the sandbox was put there by this page.
    frame.postMessage(connect, origin === 'null' ? '*' : origin, [port2]);
    this.#port = port1;
    this.#onConnected(port1);
  };

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

  #tell({ event, detail }: Told): void {
    if (event === 'export') {
      this.#hand(detail);
      return;
    }
    this.dispatchEvent(new CustomEvent(event, { detail }));
  }

  /** A file that the visitor asked for: the host's, or else a download of this page's. */
  #hand(detail: Fields): void {
    const file = fileFrom(detail);
    if (file === undefined) return;
    const { name, type } = file;
    const blob = new Blob([file.bytes], { type });
    const event = new CustomEvent('export', { detail: { name, type, blob }, cancelable: true });
    if (!this.dispatchEvent(event)) return;
    download(blob, name);
  }

  readonly #tellError = (error: unknown): void => {
    const { code, message, hint } =
      error instanceof StudioFrameError ? error : new StudioFrameError('LoadFailed', errorText(error), '');
    this.dispatchEvent(new CustomEvent('error', { detail: { code, message, hint } }));
  };

  async #ask(
    method: Method,
    params: Fields = {},
    signal?: AbortSignal,
    transfer: Transferable[] = [],
  ): Promise<unknown> {
    signal?.throwIfAborted();
    const port = await this.#connected;
    signal?.throwIfAborted();
    const id = this.#nextId++;
    return new Promise((resolve, reject) => {
      this.#waiters.set(id, { resolve, reject });
      signal?.addEventListener('abort', () => {
        if (this.#waiters.has(id)) void this.#ask('cancel', { id });
      });
      port.postMessage({ v: version, id, method, params }, transfer);
    });
  }

  /** Of the plate that the attributes name, once it is there. */
  async #askOfPlate(method: Method, params: Fields = {}, signal?: AbortSignal): Promise<unknown> {
    await this.#loading;
    return this.#ask(method, params, signal);
  }

  async #file(method: Method, params: Fields, signal?: AbortSignal): Promise<StudioFile> {
    const file = fileFrom(await this.#askOfPlate(method, params, signal));
    if (file === undefined) throw new StudioFrameError('BadReply', 'The frame sent no file.', '');
    return { name: file.name, blob: new Blob([file.bytes], { type: file.type }) };
  }

  // --- Files ----------------------------------------------------------------------------------------------------------------

  /** Once for all attributes that are set in one turn. */
  #loadAttributes(): void {
    const mine = ++this.#loads;
    this.#loading = Promise.resolve()
      .then(async () => {
        const asked = Object.entries(ofFiles).flatMap(([name, role]) => {
          const url = this.getAttribute(name);
          return url === null || url === '' ? [] : [{ url, role }];
        });
        if (asked.length === 0 || mine !== this.#loads) return;
        const files = await fetchFiles(asked, document.baseURI);
        if (mine === this.#loads) await this.#send(files, {}, true); // else another plate was asked for meanwhile
      })
      .catch(this.#tellError);
  }

  async #load(source: StudioSource): Promise<void> {
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
    await this.#send(files, project === undefined ? {} : { project }, false);
  }

  async #send(files: Fetched[], params: Fields, initial: boolean): Promise<void> {
    const bytes = files.map((file) => file.bytes);
    const trusted = this.getAttribute(ofLoads) ?? '';
    await this.#ask('load', { ...params, files, initial, trusted }, undefined, bytes);
  }
}

const errorText = (error: unknown): string => (error instanceof Error ? error.message : String(error));

/** What the studio gave: from where this script is, too, so taken at its word. */
function objectIn(result: unknown, name: string): object {
  const value = isFields(result) ? field(result, name) : undefined;
  if (!isFields(value)) throw new StudioFrameError('BadReply', `The frame sent no ${name}.`, '');
  return value;
}

// Here and not beside the other element: what two entries share becomes a file of its own, and each must be one file.
for (const name of attributes) {
  Object.defineProperty(SillonStudioElement.prototype, name, {
    configurable: true,
    enumerable: true,
    get(this: HTMLElement) {
      return this.getAttribute(name) ?? '';
    },
    set(this: HTMLElement, value: string | null) {
      if (value === null) this.removeAttribute(name);
      else this.setAttribute(name, value);
    },
  });
}

if (customElements.get('sillon-studio') === undefined) customElements.define('sillon-studio', SillonStudioElement);
