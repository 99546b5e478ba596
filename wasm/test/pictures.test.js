// Pictures are kept under their numbers, and decoded once. The engine's worker runs here, in the test's own thread, around a
// module that counts what it decodes.
import assert from 'node:assert/strict';
import { before, beforeEach, test } from 'node:test';

import { ask, at, startHere } from './support/own-worker.js';
import { png } from './support/png.js';

const counting = `
  import create from ${JSON.stringify(at('sillon-st.js'))};
  export default async (args) => {
    const module = await create(args);
    const { decodePicture, generateToolpath } = module;
    module.decodePicture = (...given) => {
      globalThis.decoded.push(given[1]);
      return globalThis.refuses ? { error: {} } : decodePicture(...given);
    };
    module.generateToolpath = (project, files, ...given) => {
      globalThis.taken.push(files);
      return generateToolpath(project, files, ...given);
    };
    return module;
  };`;
// An eighth of the memory is for pictures: 8 MiB.
before(() => {
  Object.assign(globalThis, { decoded: [], taken: [] });
  return startHere(64, `data:text/javascript,${encodeURIComponent(counting)}`);
});

beforeEach(() => {
  globalThis.decoded.length = 0;
  globalThis.taken.length = 0;
});

/** Directions of a PNG; each `seed` is another picture. */
function picture(side, seed) {
  return png(
    side,
    side,
    1,
    Uint8Array.from({ length: side * side }, (_, k) => (k * seed) % 251),
  );
}

let last = 0;
const newNumber = () => 1000 + ++last;

/** @param number  of the file; without a file it is to be kept */
async function plate(number, file, changes = {}) {
  const project = JSON.stringify({
    sillon: 1,
    shape: { builtin: 'disc', size: [8, 8] },
    layers: [{ kind: 'map', file: 'layers[0].file' }],
    toolpath: { spacing: 0.5, ...changes },
  });
  const files = { 'layers[0].file': { number, value: file } };
  return ask({
    type: 'call',
    call: { name: 'generateToolpath', project, files, measure: false, across: false, number: newNumber() },
  });
}

test('a picture that is kept is decoded once, and needs no file', async () => {
  const bytes = picture(64, 3);
  for (const [number, file] of [
    [1, Uint8Array.from(bytes)],
    [2, new Blob([bytes])],
  ]) {
    globalThis.decoded.length = 0;
    const first = await plate(number, file);
    assert.equal(first.type, 'done', first.message);
    assert.ok(first.kept.includes(number));
    const second = await plate(number, undefined);
    const third = await plate(number, undefined, { widthBalance: 0.2 });
    assert.deepEqual(globalThis.decoded, ['layers[0].file']);
    assert.deepEqual(second.value.toolpath, first.value.toolpath);
    assert.equal(third.type, 'done');
  }
});

test('the plate is the same as of the file itself', async () => {
  const bytes = picture(48, 5);
  globalThis.refuses = true;
  const { value: ofFile } = await plate(3, Uint8Array.from(bytes));
  globalThis.refuses = false;
  const { value: ofPixels } = await plate(3, Uint8Array.from(bytes));
  const [file, pixels] = globalThis.taken.map((files) => files['layers[0].file']);
  assert.ok(file instanceof Uint8Array && pixels.samples instanceof Uint16Array);
  assert.deepEqual(ofPixels.toolpath, ofFile.toolpath);
});

test('what is kept is bounded: the picture that was used longest ago goes first', async () => {
  const numbers = [11, 12, 13, 14, 15]; // 2 MB of samples each: four fit
  let kept;
  for (const number of numbers) ({ kept } = await plate(number, picture(1020, number)));
  const those = () => kept.filter((number) => numbers.includes(number));
  assert.deepEqual(those(), [12, 13, 14, 15]);
  await plate(12, undefined);
  ({ kept } = await plate(11, picture(1020, 11)));
  assert.deepEqual(those(), [14, 15, 12, 11]);
  assert.equal(globalThis.decoded.length, 6);
});

test('a picture that comes with one that is kept does not take its place before that is used', async () => {
  const numbers = [21, 22, 23, 24];
  for (const number of numbers) await plate(number, picture(1020, number));
  const files = {
    'layers[0].modeFile': { number: 25, value: picture(1020, 25) },
    'layers[0].file': { number: 21, value: undefined },
  };
  const project = JSON.stringify({
    sillon: 1,
    shape: { builtin: 'disc', size: [8, 8] },
    layers: [{ kind: 'map', file: 'layers[0].file', modeFile: 'layers[0].modeFile' }],
    toolpath: { spacing: 0.5 },
  });
  const { type, message } = await ask({
    type: 'call',
    call: { name: 'generateToolpath', project, files, measure: false, across: false, number: newNumber() },
  });
  assert.equal(type, 'done', message);
});

test('a picture that is too large to be kept goes into the engine as it came', async () => {
  const { type, kept } = await plate(31, picture(1200, 17));
  assert.equal(type, 'done');
  assert.equal(kept.includes(31), false);
  assert.equal(globalThis.decoded.length, 0);
  assert.ok(globalThis.taken[0]['layers[0].file'] instanceof Uint8Array);
});

test('what is no picture is refused with the sentence that names it', async () => {
  const { type, code, message } = await plate(
    32,
    Uint8Array.from({ length: 100 }, (_, k) => k),
  );
  assert.equal(`${type} ${code}`, 'failed InvalidFile');
  assert.match(message, /layers\[0\]\.file/);
});
