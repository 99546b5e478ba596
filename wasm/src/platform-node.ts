// Threads of Node that look like web workers to the engine's files.
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { availableParallelism } from 'node:os';
import { join, resolve, sep } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Worker } from 'node:worker_threads';

import { SillonError, invalid, messageOf } from './errors.js';
import { filesIn, type Platform } from './platform.js';
import type { FromWorker } from './protocol.js';

/** Returns the folder of the engine's files, which bundlers for servers leave in the package. The code avoids `new
 * URL` with `import.meta.url`: bundlers would try to copy the folder like a file, and fail. */
function ownFolder(): URL {
  // In a bundle of CommonJS, __filename gives the place; in other bundles nothing may.
  const filename = typeof __filename === 'string' ? pathToFileURL(__filename).href : '';
  const here = (import.meta as { url?: string }).url ?? filename;
  if (here.startsWith('file:')) {
    const beside = new URL(here.replace(/[^/]*$/, 'engine/'));
    if (existsSync(new URL('worker.js', beside))) return beside;
  }
  const home = process.cwd();
  try {
    const find = createRequire(join(home, 'package.json'));
    return new URL('dist/engine/', pathToFileURL(find.resolve('sillon/package.json')));
  } catch {
    const beside = here === '' ? 'its script, whose place is unknown,' : here;
    throw new SillonError(
      'LoadFailed',
      `the folder sillon/dist/engine is neither beside ${beside} nor below ${home}; the option assetBase may name it`,
    );
  }
}

function folderOf(assetBase: string | URL): URL {
  const isUrl = typeof assetBase !== 'string' || /^[a-z][a-z0-9+.-]+:/i.test(assetBase); // "C:\" is no scheme
  if (!isUrl) return pathToFileURL(resolve(assetBase) + sep);
  const text = String(assetBase);
  if (!text.startsWith('file:')) throw invalid(`assetBase is "${text}"; in Node it must be a folder or its file: URL`);
  return new URL(text.endsWith('/') ? text : `${text}/`);
}

export const node: Platform = {
  files(assetBase) {
    const folder = assetBase === undefined ? ownFolder() : folderOf(assetBase);
    return filesIn((name) => new URL(name, folder).href);
  },

  async read(url) {
    try {
      return await readFile(new URL(url));
    } catch (problem) {
      throw new SillonError('LoadFailed', `${url} could not be read: ${messageOf(problem)}`);
    }
  },

  cores: availableParallelism,

  obstacleToThreads: () => '',

  // Reads the module here, because fetch opens no files.
  async compile(wasm) {
    try {
      return await WebAssembly.compile(await readFile(new URL(wasm)));
    } catch (problem) {
      throw new SillonError('LoadFailed', `${wasm} could not be read: ${messageOf(problem)}`);
    }
  },

  // Reads the file here, because Blobs that stand for files on disk cannot be posted.
  async portable(file, name) {
    try {
      return new Uint8Array(await file.arrayBuffer());
    } catch (problem) {
      throw new SillonError('InvalidFile', `${name} could not be read: ${messageOf(problem)}`);
    }
  },

  startWorker(files, _threads, memory, events) {
    const scope = new URL('node-worker.js', files.worker);
    const worker = new Worker(scope, {
      workerData: { script: files.worker, name: 'sillon' },
      execArgv: [],
      resourceLimits: { maxOldGenerationSizeMb: memory },
    });
    worker.on('message', (message: FromWorker) => {
      events.onMessage(message);
    });
    worker.on('error', (error: NodeJS.ErrnoException) => {
      const code = error.code === 'ERR_WORKER_OUT_OF_MEMORY' ? 'OutOfMemory' : undefined;
      events.onFailure(`the worker ${files.worker} failed: ${messageOf(error)}`, code);
    });
    worker.on('exit', () => {
      events.onFailure('the worker ended by itself');
    });
    return Promise.resolve({
      threadScripts: { threadScript: files.mt.threadScript, mainScript: files.mt.script },
      post(message) {
        worker.postMessage(message);
      },
      hold(busy) {
        if (busy) worker.ref();
        else worker.unref();
      },
      end() {
        void worker.terminate();
      },
    });
  },
};
