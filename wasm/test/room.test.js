// Files that no memory holds, and those that come in pieces. The engine's worker runs here, in the test's own thread: so a
// Blob can tell a size that it does not have.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { root } from './support/projects.js';

const folder = join(root, 'wasm/dist/engine');
const at = (name) => pathToFileURL(join(folder, name)).href;
let answers = [];
let told = () => {};

/** A file on disk of this size, whose bytes nobody may read. */
function fileOf(size) {
  const slice = () => assert.fail('a file that is refused is not read');
  return Object.defineProperties(new Blob([]), { size: { value: size }, slice: { value: slice } });
}

async function ask(message) {
  answers = [];
  const last = new Promise((resolve) => {
    told = resolve;
  });
  globalThis.onmessage({ data: message });
  return last;
}

before(async () => {
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
  const compiled = await WebAssembly.compile(readFileSync(join(folder, 'sillon-rebrush.wasm')));
  const script = at('sillon-rebrush.js');
  const start = { type: 'start', threads: 1, memory: 1024, script, wasm: '', threadScript: '', compiled };
  const { type, message } = await ask(start);
  assert.equal(type, 'started', message);
});

const list = (file) => ask({ type: 'call', call: { name: 'listSurfaces', file }, wanted: undefined });

test('a file that no memory holds is refused before a byte of it is read', async () => {
  for (const gib of [0.5, 4, 5, 1e6, Infinity]) {
    const { type, code, message } = await list(fileOf(gib * 2 ** 30));
    assert.equal(`${type} ${code}`, 'failed TooLarge', message);
    if (Number.isFinite(gib))
      assert.match(message, new RegExp(`^the file is ${gib * 1024} MiB; it must be at most \\d+: `));
    const [, most] = /at most (\d+)/.exec(message);
    assert.ok(Number(most) > 100 && Number(most) < 512, message);
    assert.match(message, /fewer objects .* coarser resolution$/);
  }
  assert.equal((await list(fileOf(NaN))).code, 'TooLarge');
});

test('after a refusal the next file is read, and it comes in pieces', async () => {
  const text = readFileSync(join(root, 'tests/fuzz/seeds/rebrush/prusa.gcode'));
  const long = Buffer.concat([text, Buffer.alloc(9 << 20, '; a comment\n')]);
  const sizes = [];
  const file = new Blob([long]);
  const slice = file.slice.bind(file);
  file.slice = (from, to) => {
    const piece = slice(from, to);
    sizes.push(piece.size);
    return piece;
  };
  const { type, value } = await list(file);
  assert.equal(type, 'done');
  assert.deepEqual(
    sizes.slice(0, -1),
    sizes.slice(0, -1).map(() => 4 << 20),
  );
  assert.equal(
    sizes.reduce((sum, size) => sum + size, 0),
    long.length,
  );
  const { value: whole } = await list(new Uint8Array(text));
  assert.deepEqual(value.surfaces, whole.surfaces);
  assert.equal(whole.surfaces.length, 2);
});
