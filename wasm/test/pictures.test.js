// Pictures that are handed over again are decoded once. The engine's worker runs here, in the test's own thread, around a
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
  return startHere('st', 64, `data:text/javascript,${encodeURIComponent(counting)}`);
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

async function plate(file, changes = {}) {
  const project = JSON.stringify({
    sillon: 1,
    shape: { builtin: 'disc', size: [8, 8] },
    directions: { file: 'directions.file', encoding: 'angle' },
    toolpath: { spacing: 0.5, ...changes },
  });
  const files = { 'directions.file': file };
  const answer = await ask({
    type: 'call',
    call: { name: 'generateToolpath', project, files, measure: false, across: false },
    wanted: undefined,
  });
  return answer;
}

test('a file that is handed over again is decoded once, whether as bytes or as a Blob', async () => {
  const bytes = picture(64, 3);
  const first = await plate(Uint8Array.from(bytes));
  assert.equal(first.type, 'done', first.message);
  const second = await plate(new Blob([bytes]));
  const third = await plate(Uint8Array.from(bytes), { widthBalance: 0.2 });
  assert.deepEqual(globalThis.decoded, ['directions.file']);
  assert.deepEqual(second.value.toolpath, first.value.toolpath);
  assert.equal(third.type, 'done');
});

test('the plate is the same as of the file itself', async () => {
  const bytes = picture(48, 5);
  globalThis.refuses = true;
  const { value: ofFile } = await plate(Uint8Array.from(bytes));
  globalThis.refuses = false;
  const { value: ofPixels } = await plate(Uint8Array.from(bytes));
  const [file, pixels] = globalThis.taken.map((files) => files['directions.file']);
  assert.ok(file instanceof Uint8Array && pixels.samples instanceof Uint16Array);
  assert.deepEqual(ofPixels.toolpath, ofFile.toolpath);
});

test('other bytes are another picture, however the file is called', async () => {
  const bytes = picture(64, 7);
  await plate(Uint8Array.from(bytes));
  const other = await plate(picture(64, 11));
  assert.equal(globalThis.decoded.length, 2);
  const again = await plate(Uint8Array.from(bytes));
  assert.equal(globalThis.decoded.length, 2);
  assert.notDeepEqual(again.value.toolpath, other.value.toolpath);
});

test('what is kept is bounded: the picture that was used longest ago goes first', async () => {
  const files = [1, 2, 3, 4, 5].map((seed) => picture(1020, 12 + seed)); // 2 MB of samples each: four fit
  for (const file of files) await plate(Uint8Array.from(file));
  assert.equal(globalThis.decoded.length, 5);
  await plate(Uint8Array.from(files[1]));
  assert.equal(globalThis.decoded.length, 5);
  await plate(Uint8Array.from(files[0]));
  assert.equal(globalThis.decoded.length, 6);
  await plate(Uint8Array.from(files[1])); // used later than the third
  assert.equal(globalThis.decoded.length, 6);
});

test('a picture that is too large to be kept goes into the engine as it came', async () => {
  const { type } = await plate(picture(1200, 17));
  assert.equal(type, 'done');
  assert.equal(globalThis.decoded.length, 0);
  assert.ok(globalThis.taken[0]['directions.file'] instanceof Uint8Array);
});

test('what is no picture is refused with the sentence that names it', async () => {
  const { type, code, message } = await plate(Uint8Array.from({ length: 100 }, (_, k) => k));
  assert.equal(`${type} ${code}`, 'failed InvalidFile');
  assert.match(message, /directions\.file/);
});
