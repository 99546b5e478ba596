// Workers of browsers. Browsers start workers only from addresses of the page's own origin, so that scripts from
// elsewhere, and those that a bundler has turned into data: addresses, are made blobs first.
import { SillonError, invalid, messageOf } from './errors.js';
import { filesIn, type Platform } from './platform.js';
import type { EngineFiles, FromWorker, ThreadScripts } from './protocol.js';

const page = (): string => (typeof document === 'undefined' ? location.href : document.baseURI);

function filesAt(assetBase: string | URL): EngineFiles {
  const text = String(assetBase);
  try {
    return filesIn((name) => new URL(`${text.replace(/\/$/, '')}/${name}`, page()).href);
  } catch {
    throw invalid(`assetBase is "${text}"; it must be a URL, or a path on this page's server`);
  }
}

/** Folder to which Vite's development server moves this module, up to Vite 7 without the files beside it. */
const movedByVite = /\/node_modules\/\.vite\/deps[^/]*\/engine\//;

/** Makes full addresses: some bundlers turn `new URL(file, import.meta.url)` into a path. */
const addressed = <T extends object>(files: T): T =>
  Object.fromEntries(
    Object.entries(files).map(([name, value]: [string, unknown]) => [
      name,
      typeof value === 'string'
        ? new URL(value, page()).href.replace(movedByVite, '/node_modules/sillon/dist/engine/')
        : addressed(value as object),
    ]),
  ) as T;

/** Returns the addresses of the files beside this module. */
function ownFiles(): EngineFiles {
  let beside: EngineFiles;
  try {
    // Written out one by one, because bundlers find and copy only such addresses.
    beside = {
      worker: new URL('./engine/worker.js', import.meta.url).href,
      st: {
        script: new URL('./engine/sillon-st.js', import.meta.url).href,
        wasm: new URL('./engine/sillon-st.wasm', import.meta.url).href,
      },
      mt: {
        script: new URL('./engine/sillon-mt.js', import.meta.url).href,
        wasm: new URL('./engine/sillon-mt.wasm', import.meta.url).href,
        threadScript: new URL('./engine/sillon-mt.worker.js', import.meta.url).href,
      },
      text: {
        script: new URL('./engine/text.js', import.meta.url).href,
        wasm: new URL('./engine/harfbuzz.wasm', import.meta.url).href,
      },
      unpack: new URL('./engine/unpack.js', import.meta.url).href,
      fonts: {
        'nunito.ttf': new URL('./engine/nunito.ttf', import.meta.url).href,
        'bebas-neue.ttf': new URL('./engine/bebas-neue.ttf', import.meta.url).href,
        'roboto-slab.ttf': new URL('./engine/roboto-slab.ttf', import.meta.url).href,
        'fredoka.ttf': new URL('./engine/fredoka.ttf', import.meta.url).href,
        'caveat.ttf': new URL('./engine/caveat.ttf', import.meta.url).href,
      },
    };
  } catch {
    // Bundles that are plain scripts have no import.meta.url, or an empty one.
    throw new SillonError(
      'LoadFailed',
      'this script does not know its own address, so assetBase must be the folder sillon/dist/engine',
    );
  }
  return addressed(beside);
}

/** Fetches a file of the engine. */
async function fetchFile(url: string, cache: RequestCache = 'default'): Promise<Uint8Array<ArrayBuffer>> {
  if (url.startsWith('data:')) return decodeData(url); // policies may forbid to fetch such addresses
  let response: Response;
  try {
    response = await fetch(url, { cache });
  } catch (problem) {
    throw new SillonError('LoadFailed', `${url} could not be fetched: ${messageOf(problem)}`);
  }
  if (!response.ok) throw new SillonError('LoadFailed', `${url} could not be fetched: status ${response.status}`);
  const type = response.headers.get('content-type') ?? 'of unknown type';
  if (/html/i.test(type)) throw new SillonError('LoadFailed', `${url} is no file of the engine: it came as ${type}`);
  return new Uint8Array(await response.arrayBuffer());
}

function decodeData(url: string): Uint8Array<ArrayBuffer> {
  const comma = url.indexOf(',');
  const body = url.slice(comma + 1);
  if (!url.slice(0, comma).endsWith(';base64')) return new TextEncoder().encode(decodeURIComponent(body));
  return Uint8Array.from(atob(body), (letter) => letter.charCodeAt(0));
}

function isOwn(url: string): boolean {
  const { origin } = new URL(url);
  return origin === self.origin && origin !== 'null';
}

const textOf = async (url: string, cache?: RequestCache): Promise<string> =>
  new TextDecoder().decode(await fetchFile(url, cache));

/** Turns a module into a classic script: Chromium starts no module workers from blobs in frames of opaque origin. */
const classic = (module: string, url: string): string =>
  module.replace(/\bexport\s*(\{\s*\}|default \w+);?/, '').replaceAll('import.meta.url', JSON.stringify(url));

const blobOf = (...script: string[]): string => URL.createObjectURL(new Blob(script, { type: 'text/javascript' }));

interface Scripts extends ThreadScripts {
  script: string;
}

/** Blobs that start workers without a server, by the address of their engine. They are kept because workers end
 * when a call is stopped, and when they are idle. undefined: blobs cannot be used here. */
const held = new Map<string, Scripts | undefined>();

/** Returns the addresses of an engine's scripts, its own first. */
const addressesOf = ({ worker, st, mt }: EngineFiles, threads: number): [string, ...string[]] =>
  threads > 1 ? [mt.script, worker, mt.threadScript] : [st.script, worker];

/** Keeps an engine's scripts as blobs. Policies let blobs import nothing, so that each contains the engine. From
 * Emscripten 3.1.58 on, threads have no script of their own: they are module workers of the engine's script. */
async function hold(addresses: [string, ...string[]], cache?: RequestCache): Promise<void> {
  const [engine = '', own = '', thread = ''] = await Promise.all(addresses.map((url) => textOf(url, cache)));
  const first = `${classic(engine, addresses[0])}\n`;
  held.set(addresses[0], {
    script: blobOf(first, classic(own, '')),
    threadScript: blobOf(first, thread.replaceAll('import(', '(async () => ({ default: createSillon }))(')),
    mainScript: blobOf(engine),
  });
}

/** Explains why a worker failed. Browsers do not tell what prevented its script from being loaded. */
async function whyNot(url: string, message: string | undefined): Promise<string> {
  if (message) return `the worker ${url} failed: ${message}`;
  try {
    await fetchFile(url);
    return `${url} could not be started as a worker`;
  } catch (problem) {
    return messageOf(problem);
  }
}

export const browser: Platform = {
  files: (assetBase) => (assetBase === undefined ? ownFiles() : filesAt(assetBase)),

  read: fetchFile,

  cores: () => navigator.hardwareConcurrency,

  obstacleToThreads() {
    if (self.crossOriginIsolated) return '';
    return 'this page is not cross-origin isolated (headers COOP and COEP)';
  },

  forget(files, threads) {
    const [engine, ...others] = addressesOf(files, threads);
    const used = held.get(engine) !== undefined && [engine, ...others].every(isOwn);
    if (used) held.set(engine, undefined);
    else held.delete(engine);
    return used;
  },

  async startWorker(files, threads, _memory, events) {
    const addresses = addressesOf(files, threads);
    const [engine] = addresses;
    const own = addresses.every(isOwn);
    if (!own && !held.has(engine)) await hold(addresses);
    const { threadScript, script: mainScript } = files.mt;
    const { script, ...threadScripts } = held.get(engine) ?? { script: files.worker, threadScript, mainScript };
    let worker: Worker;
    try {
      worker = new Worker(script, { type: script.startsWith('blob:') ? 'classic' : 'module', name: 'sillon' });
    } catch (problem) {
      throw new SillonError('LoadFailed', `${files.worker} could not be started as a worker: ${messageOf(problem)}`);
    }
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      // Browsers still have a script in their cache that was just loaded.
      if (data.type === 'started' && !held.has(engine)) hold(addresses, 'force-cache').catch(() => undefined);
      events.onMessage(data);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      void whyNot(files.worker, event.message).then((why) => {
        events.onFailure(why);
      });
    };
    return {
      threadScripts,
      post(message) {
        worker.postMessage(message);
      },
      hold() {}, // does nothing, because pages do not end by themselves
      end() {
        worker.terminate();
      },
    };
  },
};
