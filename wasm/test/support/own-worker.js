// The engine's worker in the test's own thread, so that a test can see what is given to it and what it answers.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { root } from './projects.js';

const folder = join(root, 'wasm/dist/engine');
export const at = (name) => pathToFileURL(join(folder, name)).href;

/** What the worker has said of the last message so far. */
export let answers = [];
let told = () => {};

/** @returns the worker's last word on a message */
export async function ask(message) {
  answers = [];
  const last = new Promise((resolve) => {
    told = resolve;
  });
  globalThis.onmessage({ data: message });
  return last;
}

/** @param memory  [MiB] @param script  the module's glue, if not its own */
export async function startHere(memory, script = at('sillon-st.js')) {
  Object.assign(globalThis, {
    self: globalThis,
    WorkerGlobalScope: EventTarget, // only asked for, as the mark of a worker
    importScripts: () => assert.fail('importScripts is not available'),
    location: new URL(at('worker.js')),
    onmessage: null,
    postMessage: (message) => {
      answers.push(message);
      if (['started', 'done', 'failed'].includes(message.type)) told(message);
    },
  });
  await import(at('worker.js'));
  const compiled = await WebAssembly.compile(readFileSync(join(folder, 'sillon-st.wasm')));
  const start = {
    type: 'start',
    threads: 1,
    memory,
    script,
    wasm: '',
    threadScripts: { threadScript: '', mainScript: '' },
    compiled,
  };
  const { type, message } = await ask(start);
  assert.equal(type, 'started', message);
}
