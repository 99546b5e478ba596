// Values that the engine's worker keeps do not travel a second time; those that changed, or are gone from there, do.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, beforeEach, describe, test } from 'node:test';

import { createEngine } from 'sillon';

import { until } from './support/jobs.js';
import { png } from './support/png.js';
import { root } from './support/projects.js';

/** Calls that were handed to workers, as they travelled. */
const calls = [];
const onWorker = (worker) => {
  const post = worker.postMessage.bind(worker);
  worker.postMessage = (message) => {
    if (message.type === 'call') calls.push(message.call);
    post(message);
  };
};
process.on('worker', onWorker);
after(() => process.off('worker', onWorker));
beforeEach(() => (calls.length = 0));

const date = new Date(0);
const textOf = async (blob) => Buffer.from(await blob.arrayBuffer()).toString('latin1');
const disc = (size) => ({ shape: { builtin: 'disc', size: [size, size] } });
const picture = (seed) =>
  png(
    32,
    32,
    1,
    Uint8Array.from({ length: 32 * 32 }, (_, k) => (k * seed) % 251),
  );

for (const threads of [1, 2]) {
  describe(`with ${threads} thread${threads > 1 ? 's' : ''}`, { timeout: 600_000 }, () => {
    let engine;
    before(async () => {
      engine = await createEngine({ threads, idleTimeout: Infinity });
    });
    after(() => engine.dispose());

    test('the last plate is written without its beads', async () => {
      const { toolpath } = await engine.generateToolpath(disc(12));
      const kept = [
        await textOf(await engine.writeSvg(toolpath)),
        await textOf((await engine.writeGcode(toolpath, {}, { date })).blob),
        await textOf(await engine.writeView(toolpath)),
        await textOf(await engine.renderPreview(toolpath, { width: 64 })),
      ];
      assert.deepEqual(
        calls.slice(1).map((call) => call.toolpath.cycles.value),
        [undefined, undefined, undefined, undefined],
      );
      const own = structuredClone(toolpath);
      assert.deepEqual(kept, [
        await textOf(await engine.writeSvg(own)),
        await textOf((await engine.writeGcode(own, {}, { date })).blob),
        await textOf(await engine.writeView(own)),
        await textOf(await engine.renderPreview(own, { width: 64 })),
      ]);
      assert.equal(calls[5].toolpath.cycles.value.length, 1); // the copy travels once
      assert.equal(calls[6].toolpath.cycles.value, undefined);
    });

    test('beads that somebody has changed travel', async () => {
      const { toolpath } = await engine.generateToolpath(disc(12));
      const before = await textOf(await engine.writeSvg(toolpath));
      toolpath.cycles[0].points[0] += 0.5;
      const moved = await textOf(await engine.writeSvg(toolpath));
      assert.notEqual(moved, before);
      toolpath.cycles[0].points[0] -= 0.5;
      toolpath.cycles.pop();
      assert.notEqual(await textOf(await engine.writeSvg(toolpath)), before);
      assert.deepEqual(
        calls.slice(1).map((call) => call.toolpath.cycles.value?.length),
        [undefined, 1, 0],
      );
      toolpath.cycles.push(null);
      await assert.rejects(engine.writeSvg(toolpath), { code: 'InvalidArgument', message: /^toolpath\.cycles\[0\]/ });
    });

    test('what else a toolpath says counts as it is handed over', async () => {
      const { toolpath } = await engine.generateToolpath(disc(12));
      const { blob } = await engine.writeGcode({ ...toolpath, notes: ['a note of mine'] }, {}, { date });
      assert.match(await textOf(blob), /a note of mine/);
      assert.equal(calls[1].toolpath.cycles.value, undefined);
    });

    test('a plate, the same plate measured and the layer below it are all kept', async () => {
      const plate = [disc(14), { spacing: 0.5 }];
      const { toolpath } = await engine.generateToolpath(...plate, { measure: false });
      await engine.generateToolpath(...plate);
      const { toolpath: below } = await engine.generateToolpath(...plate, { across: true });
      const print = { base: 2, basePattern: 'across', date };
      const { blob } = await engine.writeGcode(toolpath, {}, print, { below });
      const { toolpath: path, below: layer } = calls.at(-1);
      assert.deepEqual([path.cycles.value, layer.cycles.value], [undefined, undefined]);
      const own = structuredClone({ toolpath, below });
      const { blob: other } = await engine.writeGcode(own.toolpath, {}, print, { below: own.below });
      assert.equal(await textOf(blob), await textOf(other));
    });

    test('the last G-code is checked and packed where it was written', async () => {
      const { toolpath } = await engine.generateToolpath(disc(12));
      const bambu = { flavor: 'bambu', startGcode: 'G28\nM190 S60\nM109 S220\n' };
      const { blob } = await engine.writeGcode(toolpath, bambu, { date });
      const check = await engine.checkGcode(blob, bambu);
      const packed = await textOf(await engine.packGcode(blob));
      assert.deepEqual(
        calls.slice(2).map((call) => call.file.value),
        [undefined, undefined],
      );
      const own = new Uint8Array(await blob.arrayBuffer());
      assert.deepEqual(await engine.checkGcode(own, bambu), check);
      assert.equal(await textOf(await engine.packGcode(own)), packed);
      assert.ok(check.moves > 100);
    });

    test('a file may be a print and a picture, and is brought in as each', async () => {
      const file = new Blob([readFileSync(join(root, 'tests/fuzz/seeds/rebrush/prusa.gcode'))]);
      const { surfaces } = await engine.listSurfaces(file);
      assert.deepEqual((await engine.listSurfaces(file)).surfaces, surfaces);
      assert.deepEqual(
        calls.map((call) => call.file.value === undefined),
        [false, true],
      );
      assert.ok((await engine.checkGcode(file)).moves > 10);
      const drawn = new Blob([picture(3)]);
      const input = { ...disc(12), layers: [{ kind: 'map', file: drawn, encoding: 'angle' }] };
      await engine.generateToolpath(input, {}, { measure: false });
      assert.equal((await engine.decodePicture(drawn)).width, 32);
    });

    test('a plate of a picture is made before what is asked for after it', async () => {
      const file = new Blob([picture(3)]);
      await Promise.all([
        engine.generateToolpath({ ...disc(12), layers: [{ kind: 'map', file }] }, {}, { measure: false }),
        engine.profiles(),
        engine.readProject('{}').catch(() => undefined),
        engine.profiles(),
      ]);
      assert.deepEqual(
        calls.map(({ name }) => name),
        ['generateToolpath', 'profiles', 'readProject', 'profiles'],
      );
    });

    test('a picture travels once, and again when its bytes have changed', async () => {
      const bytes = Uint8Array.from(picture(5));
      const make = async (file) => {
        const input = { ...disc(12), layers: [{ kind: 'map', file, encoding: 'angle' }] };
        return (await engine.generateToolpath(input, {}, { measure: false })).report.digest;
      };
      const first = await make(bytes);
      assert.equal(await make(bytes), first);
      const other = Uint8Array.from(picture(7));
      bytes.set(other.subarray(0, bytes.length));
      const changed = other.length === bytes.length ? await make(bytes) : await make(other);
      assert.notEqual(changed, first);
      const travelled = calls.map((call) => call.files['layers[0].file'].value !== undefined);
      assert.deepEqual(travelled, [true, false, true]);
    });
  });
}

test('what a worker has kept is handed over again to the next one', { timeout: 600_000 }, async () => {
  let ended = 0;
  const count = (worker) => worker.on('exit', () => ++ended);
  process.on('worker', count);
  const engine = await createEngine({ threads: 1, idleTimeout: 0 });
  const { toolpath } = await engine.generateToolpath(disc(12));
  const { blob } = await engine.writeGcode(toolpath, {}, { date });
  const before = ended;
  await until(() => ended > before);
  const { blob: again } = await engine.writeGcode(toolpath, {}, { date });
  assert.equal(await textOf(again), await textOf(blob));
  assert.equal(calls.at(-1).toolpath.cycles.value.length, 1);
  process.off('worker', count);
  engine.dispose();
});

test('what needs no plate does not wait for one', { timeout: 600_000 }, async () => {
  const engine = await createEngine({ threads: 1 });
  const control = new AbortController();
  const endless = engine.generateToolpath(
    { shape: { builtin: 'rounded', size: [150, 150] }, layers: [{ kind: 'direction', angle: 30 }] },
    { spacing: 0.16, sweepsPerLevel: 1000 },
    { signal: control.signal },
  );
  const check = await engine.checkGcode(Buffer.from('G28\nG1 X10 Y10 F600\n'));
  assert.ok(check.lines >= 2);
  assert.deepEqual(await engine.examineBlock('G28\n'), []);
  control.abort();
  await assert.rejects(endless, { name: 'AbortError' });
  engine.dispose();
});
