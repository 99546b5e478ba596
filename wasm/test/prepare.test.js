// An upload becomes all that a shop needs, in one call that keeps to its limits; hostile ones end in one sentence.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { test } from 'node:test';
import { promisify } from 'node:util';

import { SillonError, createEngine, preparePlate } from 'sillon';

import { copyEngine, wrapped } from './support/engine-copy.js';
import { turning } from './support/jobs.js';
import { png } from './support/png.js';
import { root } from './support/projects.js';

const { samples } = turning(60, 40);
const upload = {
  shape: {
    file:
      '<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="20mm" viewBox="0 0 30 20">' +
      '<ellipse cx="15" cy="10" rx="14" ry="9"/></svg>',
  },
  layers: [{ kind: 'map', file: png(60, 40, 1, samples) }],
};
const date = new Date(0);

test('an upload becomes poster, view, G-code, findings, grams and minutes: those of the calls one by one', async () => {
  const printer = { profile: 'prusa-mk4s' };
  const made = await preparePlate(upload, { printer, print: { layers: 2, date }, posterSide: 240 });
  const engine = await createEngine({ threads: 'off' });
  const { toolpath, report } = await engine.generateToolpath(upload);
  const { blob, summary } = await engine.writeGcode(toolpath, printer, { layers: 2, date });
  const view = await engine.writeView(toolpath);
  const poster = await engine.decodePicture(made.poster);
  engine.dispose();
  assert.equal(await made.gcode.text(), await blob.text());
  assert.deepEqual(Buffer.from(await made.view.arrayBuffer()), Buffer.from(await view.arrayBuffer()));
  assert.equal(made.report.digest, report.digest);
  assert.deepEqual(made.page, [30, 20]);
  assert.equal(made.grams, summary.filamentGrams);
  assert.equal(made.minutes, summary.seconds / 60);
  assert.deepEqual(
    made.findings.filter(({ error }) => error),
    [],
  );
  assert.deepEqual([poster.width, poster.height], [240, 160]);
  // Gold within, the dark ground in the corner; samples have 16 bits.
  const sums = [0, 1, 2].map((k) =>
    poster.samples.reduce((sum, value, at) => sum + (at % poster.channels === k ? value : 0), 0),
  );
  assert.ok(sums[0] > 1.3 * sums[2], String(sums));
  assert.ok(Math.max(...poster.samples.slice(0, 3)) < 80 * 257, String(poster.samples.slice(0, 3)));
});

/** @param pattern  of the message */
const refused = (upload, options, code, pattern) =>
  assert.rejects(preparePlate(upload, options), (error) => {
    assert.ok(error instanceof SillonError, String(error));
    assert.equal(error.code, code, error.message);
    assert.match(error.message, pattern);
    return true;
  });

const svg = (inside) => `<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="30mm"
  height="20mm" viewBox="0 0 30 20">${inside}</svg>`;
const uses = Array.from({ length: 12 }, (_, k) => `<g id="g${k + 1}">${`<use xlink:href="#g${k}"/>`.repeat(10)}</g>`);

test('hostile uploads end in one sentence', async () => {
  const bytes = Uint8Array.from({ length: 3000 }, (_, k) => (k * k * 31 + 7) & 255);
  const huge = png(8, 8, 1, new Uint8Array(64));
  huge.writeUInt32BE(60_000, 16);
  huge.writeUInt32BE(60_000, 20);
  const cut = upload.layers[0].file.subarray(0, 100);
  for (const [file, codes] of [
    ['<svg', ['InvalidFile']],
    ['', ['InvalidFile', 'InvalidArgument']],
    [bytes, ['InvalidFile']],
    [huge, ['InvalidFile', 'TooLarge']],
    [
      svg(`<g id="g0"><rect width="9" height="9"/></g>${uses.join('')}<use xlink:href="#g12"/>`),
      ['InvalidFile', 'TooLarge'],
    ],
    [svg('<g>'.repeat(100_000)), ['InvalidFile', 'TooLarge']],
    [svg('<text>words alone</text>'), ['EmptyShape', 'InvalidFile']],
    ['<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]>' + svg('&x;'), ['InvalidFile', 'EmptyShape']],
  ]) {
    await assert.rejects(preparePlate({ shape: { file } }), (error) => {
      assert.ok(error instanceof SillonError, String(error));
      assert.ok(codes.includes(error.code), `${error.code}: ${error.message}`);
      assert.ok(error.message.length > 10 && !error.message.includes('\n'), error.message);
      return true;
    });
  }
  await refused({ layers: [{ kind: 'map', file: cut }] }, {}, 'InvalidFile', /./);
  await refused(upload, { printer: { profile: 'no-such-printer' } }, 'InvalidArgument', /no-such-printer/);
});

const large = { shape: { builtin: 'rounded', size: [200, 200] }, layers: [{ kind: 'direction', angle: 30 }] };

test('a plate that takes too long is given up, and one that takes too much memory', async () => {
  await refused(large, { toolpath: { spacing: 0.2 }, limits: { seconds: 0.001 } }, 'TooLarge', /more than 0.001 s/);
  await refused(large, { toolpath: { spacing: 0.2 }, limits: { memory: 64 } }, 'OutOfMemory', /memory/);
  await refused(large, { toolpath: { spacing: 0.2 }, limits: { memory: 64, threads: 2 } }, 'OutOfMemory', /memory/);
  // The same memory is enough for less.
  assert.ok((await preparePlate(upload, { limits: { memory: 64 } })).grams > 0);
});

test('what JavaScript itself takes is limited, too: the heap of a worker, and a file that is kept whole', async () => {
  const hungry = wrapped('st', {
    after: `const all = []; module.generateToolpath = () => { for (;;) all.push(Array.from({ length: 1000 }, () => ({}))); };`,
  });
  const copy = copyEngine({ 'sillon-st.js': hungry });
  try {
    await refused(upload, { assetBase: copy.folder, limits: { memory: 64 } }, 'OutOfMemory', /worker.*memory/);
  } finally {
    copy.remove();
  }
  const plate = { shape: { builtin: 'rounded', size: [60, 40] }, layers: [{ kind: 'direction', angle: 30 }] }; // more than 200 KB a layer
  const tower = { printer: { maxZ: 1000 }, print: { layers: 400 } };
  await refused(plate, { ...tower, limits: { memory: 64 } }, 'OutOfMemory', /more than 64 MiB/);
});

test('an abort ends it with the reason given', async () => {
  const reason = new Error('the visitor left');
  await assert.rejects(preparePlate(large, { signal: AbortSignal.abort(reason) }), reason);
  const control = new AbortController();
  const work = preparePlate(large, { signal: control.signal });
  control.abort(reason);
  await assert.rejects(work, reason);
});

test('wrong options are named', async () => {
  await refused(upload, { limits: { seconds: 0 } }, 'InvalidArgument', /limits\.seconds is 0/);
  await refused(upload, { limits: { memory: 8 } }, 'InvalidArgument', /memory is 8; it must be .* 64 to 4096/);
  await refused(upload, { limits: { minutes: 1 } }, 'InvalidArgument', /limits\.minutes/);
  await refused(upload, { posterSide: 2000 }, 'InvalidArgument', /posterSide is 2000/);
  await refused(upload, { poster: 2000 }, 'InvalidArgument', /unknown key "options\.poster"/);
  await refused(upload, 7, 'InvalidArgument', /options is 7/);
  await refused(undefined, {}, 'InvalidArgument', /upload is undefined/);
  await refused({ svg: '<svg/>' }, {}, 'InvalidArgument', /unknown key "svg"/);
});

test('nothing of it keeps a process alive, whether it ended well or not', async () => {
  const script = `import { preparePlate } from 'sillon';
    await preparePlate({ shape: { builtin: 'disc', size: [12, 12] } });
    await preparePlate({ shape: { builtin: 'disc', size: [90, 90] } }, { limits: { seconds: 0.01 } })
      .catch(({ code }) => console.log(code));`;
  const { stdout } = await promisify(execFile)(process.execPath, ['--input-type=module', '--eval', script], {
    cwd: root,
  });
  assert.equal(stdout, 'TooLarge\n');
});
