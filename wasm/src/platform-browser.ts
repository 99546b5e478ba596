// Workers of browsers. They are started only from addresses of their page's own origin, so scripts from elsewhere become
// blobs first; so do those that a bundler has turned into data: addresses.
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

/** Vite's development server moves this module there, up to Vite 7 without the files beside it. */
const movedByVite = /\/node_modules\/\.vite\/deps[^/]*\/engine\//;

/** Some bundlers write paths for what `new URL(file, import.meta.url)` means. */
const addressed = <T extends object>(files: T): T =>
  Object.fromEntries(
    Object.entries(files).map(([name, value]: [string, unknown]) => [
      name,
      typeof value === 'string'
        ? new URL(value, page()).href.replace(movedByVite, '/node_modules/sillon/dist/engine/')
        : addressed(value as object),
    ]),
  ) as T;

/** The files beside this module. */
function ownFiles(): EngineFiles {
  let beside: EngineFiles;
  try {
    // Written out one by one: bundlers find and copy only these.
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
      'this script does not know its own address, so the option assetBase must be that of the folder sillon/dist/engine',
    );
  }
  return addressed(beside);
}

async function fetchFile(url: string): Promise<Uint8Array<ArrayBuffer>> {
  if (url.startsWith('data:')) return decodeData(url); // which policies may forbid to fetch
  let response: Response;
  try {
    response = await fetch(url);
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

const blobOf = (script: string): string => URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));

/** An address that a worker may be started from; a blob's as a classic worker: Chromium starts no module workers from
 * blobs in frames of opaque origin. */
async function startable(url: string): Promise<string> {
  if (isOwn(url)) return url;
  const text = new TextDecoder().decode(await fetchFile(url));
  return blobOf(text.replace(/\bexport\s*\{\s*\};?/, '')); // the compiler's mark of a module
}

/** Threads have a script of their own. From Emscripten 3.1.58 on it is empty, and they are module workers of the main one:
 * in Chromium's frames of opaque origin none can start, and one thread works. */
async function startableThreads({ script, threadScript }: EngineFiles['mt']): Promise<ThreadScripts> {
  if (isOwn(threadScript)) return { threadScript, mainScript: script };
  const text = new TextDecoder().decode(await fetchFile(threadScript));
  const startsMain = text === '' && !isOwn(script);
  const mainScript = startsMain ? blobOf(`export { default } from ${JSON.stringify(script)};`) : script;
  return { threadScript: blobOf(text), mainScript };
}

/** Why a worker failed. Browsers do not say what kept its script from being loaded. */
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
    return 'this page is not cross-origin isolated (headers COOP and COEP), so threads cannot share memory';
  },

  async startWorker(files, threads, _memory, events) {
    const script = await startable(files.worker);
    const threadScripts: ThreadScripts =
      threads > 1 ? await startableThreads(files.mt) : { threadScript: '', mainScript: '' };
    const forgetBlobs = (): void => {
      for (const url of [script, threadScripts.threadScript, threadScripts.mainScript]) {
        if (url.startsWith('blob:')) URL.revokeObjectURL(url);
      }
    };
    let worker: Worker;
    try {
      worker = new Worker(script, { type: script.startsWith('blob:') ? 'classic' : 'module', name: 'sillon' });
    } catch (problem) {
      throw new SillonError('LoadFailed', `${files.worker} could not be started as a worker: ${messageOf(problem)}`);
    }
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      if (data.type === 'started') forgetBlobs();
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
      hold() {}, // pages do not end by themselves
      end() {
        worker.terminate();
        forgetBlobs();
      },
    };
  },
};
