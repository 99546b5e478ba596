// Files that no memory holds, and those that come in pieces. The engine's worker runs here, in the test's own thread: so a
// Blob can tell a size that it does not have.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';

import { answers, ask, startHere } from './support/own-worker.js';
import { root } from './support/projects.js';

/** A file on disk of this size, whose bytes nobody may read. */
function fileOf(size) {
  const slice = () => assert.fail('a file that is refused is not read');
  return Object.defineProperties(new Blob([]), { size: { value: size }, slice: { value: slice } });
}

before(() => startHere(1024));

const call = (call) => ask({ type: 'call', call });
const list = (value, number = 0) => call({ name: 'listSurfaces', file: { number, value } });
const sample = readFileSync(join(root, 'tests/fuzz/seeds/rebrush/prusa.gcode'));

/** A file whose pieces are told, by their sizes. */
function watched(bytes, sizes) {
  const file = new Blob([bytes]);
  const slice = file.slice.bind(file);
  file.slice = (from, to) => {
    const piece = slice(from, to);
    sizes.push(piece.size);
    return piece;
  };
  return file;
}

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
  const long = Buffer.concat([sample, Buffer.alloc(9 << 20, '; a comment\n')]);
  const sizes = [];
  const { type, value } = await list(watched(long, sizes));
  assert.equal(type, 'done');
  assert.deepEqual(
    sizes.slice(0, -1),
    sizes.slice(0, -1).map(() => 4 << 20),
  );
  assert.equal(
    sizes.reduce((sum, size) => sum + size, 0),
    long.length,
  );
  const { value: whole } = await list(new Uint8Array(sample));
  assert.deepEqual(value.surfaces, whole.surfaces);
  assert.equal(whole.surfaces.length, 2);
});

test('a print is kept under its number until another takes its place or is refused', async () => {
  const relief = (value) => call({ name: 'printRelief', file: { number: 1, value }, side: 64 });
  const { value: listed, kept } = await list(new Blob([sample]), 1);
  assert.deepEqual(kept, [1]);
  const { value: drawn } = await relief(undefined);
  assert.equal(drawn.heights.length, drawn.columns * drawn.rows);
  const shorter = sample.subarray(0, sample.lastIndexOf(';LAYER_CHANGE'));
  const other = await list(new Blob([shorter]), 2);
  assert.ok(other.value.layers < listed.layers);
  assert.deepEqual(other.kept, [2]);
  assert.equal((await relief(undefined)).code, 'Internal');
  assert.deepEqual((await relief(new Blob([sample]))).value, drawn);
  const refused = await list(fileOf(2 ** 40), 3);
  assert.deepEqual([refused.code, refused.kept], ['TooLarge', []]);
  assert.deepEqual((await list(new Blob([sample]), 1)).value, listed);
  // What is no print is none the second time either.
  for (let k = 0; k < 2; ++k) assert.equal((await list(new Blob(['G28\n']), 4)).code, 'InvalidFile');
  assert.deepEqual((await relief(new Blob([sample]))).value, drawn);
});

test('reading a print tells how far it is', async () => {
  const long = Buffer.concat([sample, Buffer.alloc(9 << 20, '; a comment\n')]);
  assert.equal((await list(new Uint8Array(long))).type, 'done');
  const told = answers.filter(({ type }) => type === 'progress');
  assert.ok(told.length > 0);
  assert.deepEqual([...new Set(told.map(({ stage }) => stage))], ['reading']);
  assert.ok(told.every(({ fraction }) => fraction >= 0 && fraction <= 1));
});
