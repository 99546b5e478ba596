// Calls in their order, their progress, and their end before the end.
import assert from 'node:assert/strict';
import { openAsBlob } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';

import { createEngine } from 'sillon';

import { atWork, countWorkers, endless, large, small, until, wait } from './support/jobs.js';
import { root } from './support/projects.js';

const digestOf = async (plate) => (await plate).report.digest;
let digest;

for (const threads of [1, 2]) {
  describe(`with ${threads} thread${threads > 1 ? 's' : ''}`, { timeout: 600_000 }, () => {
    let engine;
    before(async () => {
      engine = await createEngine({ threads, idleTimeout: Infinity });
      digest ??= await digestOf(engine.generateToolpath(...small));
    });
    after(() => engine.dispose());

    const stillWorks = async () => assert.equal(await digestOf(engine.generateToolpath(...small)), digest);

    test('calls are answered in order, each with its own answer', async () => {
      const order = [];
      const sizes = [12, 3, 8, 5];
      const calls = sizes.map(async (size, k) => {
        const plate = { shape: { builtin: 'disc', size: [size, size] } };
        const { toolpath } = await engine.generateToolpath(plate, {}, { measure: false });
        order.push(k);
        return toolpath.shape.page[0];
      });
      calls.splice(
        2,
        0,
        engine.generateToolpath(...small).then(({ report }) => {
          order.push('plate');
          return report.digest;
        }),
      );
      const failing = engine.readProject('{').catch(({ code }) => {
        order.push(code);
        return code;
      });
      assert.deepEqual(await Promise.all([...calls, failing]), [12, 3, digest, 8, 5, 'InvalidFile']);
      // The small plate was asked for after all four discs.
      assert.deepEqual(order, [0, 1, 2, 3, 'plate', 'InvalidFile']);
    });

    test('progress never falls and ends at 1', async () => {
      for (const measure of [false, true]) {
        const seen = [];
        const onProgress = ({ stage, fraction }) => seen.push({ stage, fraction });
        const input = { shape: { builtin: 'rounded', size: [60, 60] } };
        await engine.generateToolpath(input, { spacing: 0.3 }, { measure, onProgress });
        assert.ok(seen.length >= 3, `${seen.length} times`);
        assert.equal(seen.at(-1).fraction, 1);
        assert.ok(seen.every(({ stage }) => typeof stage === 'string' && stage !== ''));
        for (const [k, { fraction }] of seen.entries()) {
          assert.ok(fraction >= (seen[k - 1]?.fraction ?? 0) && fraction <= 1, JSON.stringify(seen));
        }
      }
    });

    test('calls that have no stages end at 1 as well', async () => {
      const { toolpath } = await engine.generateToolpath(...small);
      const seen = [];
      await engine.writeSvg(toolpath, { onProgress: ({ fraction }) => seen.push(fraction) });
      assert.deepEqual(seen, [1]);
    });

    test('a call with an aborted signal does not start', async () => {
      const reason = new Error('not wanted');
      const called = [];
      const signal = AbortSignal.abort(reason);
      const call = engine.generateToolpath(small[0], {}, { signal, onProgress: (step) => called.push(step) });
      assert.equal(await call.catch((error) => error), reason);
      const { name } = await engine.writeProject({}, { signal: AbortSignal.abort() }).catch((error) => error);
      assert.equal(name, 'AbortError');
      await stillWorks();
      assert.deepEqual(called, []);
    });

    test('a call that is aborted while it waits does not start', async () => {
      const controller = new AbortController();
      const called = [];
      const first = engine.generateToolpath(...small);
      const onProgress = (step) => called.push(step);
      const waiting = engine.generateToolpath(...endless, { signal: controller.signal, onProgress });
      const last = engine.generateToolpath(...small);
      controller.abort();
      assert.equal((await waiting.catch((error) => error)).name, 'AbortError');
      assert.equal(await digestOf(first), digest);
      assert.equal(await digestOf(last), digest);
      assert.deepEqual(called, []);
    });

    test('the work of a call ends with it', async (t) => {
      const controller = new AbortController();
      const { running, onProgress } = atWork();
      const call = engine.generateToolpath(...large, { signal: controller.signal, onProgress });
      await running;
      const workers = countWorkers();
      t.mock.timers.enable({ apis: ['setTimeout'] }); // on a busy machine it would be ended before it can answer
      controller.abort();
      assert.equal((await call.catch((error) => error)).name, 'AbortError');
      await stillWorks();
      t.mock.timers.reset();
      workers.stop();
      assert.equal(workers.count.started, 0); // the same worker goes on
    });

    test('a signal that fires in time rejects with its own reason', async () => {
      const signal = AbortSignal.timeout(300);
      const { name } = await engine.generateToolpath(...endless, { signal }).catch((error) => error);
      assert.equal(name, 'TimeoutError');
      await stillWorks();
    });

    test('a signal that fires after the call changes nothing', async () => {
      const controller = new AbortController();
      const call = engine.generateToolpath(small[0], {}, { measure: false, signal: controller.signal });
      assert.equal(await digestOf(call), digest);
      controller.abort();
      await stillWorks();
    });

    test('abort and the next call, many times in a row', async () => {
      for (let k = 0; k < 8; ++k) {
        const controller = new AbortController();
        const { running, onProgress } = atWork();
        const call = engine.generateToolpath(...endless, { signal: controller.signal, onProgress });
        if (k % 2 === 0) await running;
        else await wait(10 * k);
        controller.abort();
        const next = engine.generateToolpath(...small);
        assert.equal((await call.catch((error) => error)).name, 'AbortError');
        assert.equal(await digestOf(next), digest);
      }
    });

    test('what a callback throws ends its call', async () => {
      const thrown = new Error('from a callback');
      const onProgress = () => {
        throw thrown;
      };
      assert.equal(await engine.generateToolpath(...endless, { onProgress }).catch((error) => error), thrown);
      const { toolpath } = await engine.generateToolpath(...small);
      const onChunk = onProgress;
      assert.equal(await engine.writeGcode(toolpath, {}, {}, { onChunk }).catch((error) => error), thrown);
      await stillWorks();
    });

    test('what a callback promises is waited for, and ends its call if it fails', async () => {
      const thrown = new Error('the disk is full');
      const { toolpath } = await engine.generateToolpath(...small);
      const failing = async () => {
        await wait(1);
        throw thrown;
      };
      assert.equal(await engine.writeGcode(toolpath, {}, {}, { onChunk: failing }).catch((error) => error), thrown);
      assert.equal(await engine.readProject('{"sillon": 1}', { onProgress: failing }).catch((error) => error), thrown);
      let written = 0;
      let release;
      const open = new Promise((resolve) => (release = resolve));
      const onChunk = async (chunk) => {
        await open;
        written += chunk.length;
      };
      const call = engine.writeGcode(toolpath, {}, {}, { onChunk });
      let ended = false;
      void call.then(() => (ended = true));
      await stillWorks(); // others go on
      assert.equal(ended, false);
      release();
      await call;
      assert.ok(written > 1000);
    });

    test('dispose rejects what runs and what waits, ends the worker, and is final', async () => {
      const workers = countWorkers();
      const own = await createEngine({ threads });
      const { running, onProgress } = atWork();
      const calls = [
        own.generateToolpath(...endless, { onProgress }),
        own.generateToolpath(...small),
        own.readProject('{'),
      ];
      const codes = Promise.all(calls.map((call) => call.catch(({ code }) => code)));
      await running;
      own.dispose();
      own.dispose();
      assert.deepEqual(await codes, ['Disposed', 'Disposed', 'Disposed']);
      const { code, hint } = await own.generateToolpath(...small).catch((error) => error);
      assert.equal(code, 'Disposed');
      assert.notEqual(hint, '');
      await until(() => workers.count.ended === workers.count.started);
      workers.stop();
      assert.ok(workers.count.started > 0);
    });

    test('dispose in the turn of a call leaves no worker', async () => {
      const own = await createEngine({ threads });
      const workers = countWorkers();
      const code = own.profiles().catch((error) => error.code);
      own.dispose();
      assert.equal(await code, 'Disposed');
      await wait(200); // for one that starts afterwards
      workers.stop();
      assert.equal(workers.count.ended, workers.count.started);
    });
  });
}

test(
  'without shared memory an abort ends the worker, and another goes on with what was kept',
  { timeout: 600_000 },
  async () => {
    const { SharedArrayBuffer } = globalThis;
    delete globalThis.SharedArrayBuffer;
    const engine = await createEngine({ threads: 1, idleTimeout: Infinity }).finally(() => {
      globalThis.SharedArrayBuffer = SharedArrayBuffer;
    });
    const { toolpath, report } = await engine.generateToolpath(...small);
    const svg = await (await engine.writeSvg(toolpath)).text();
    const workers = countWorkers();
    const controller = new AbortController();
    const { running, onProgress } = atWork();
    const call = engine.generateToolpath(...endless, { signal: controller.signal, onProgress });
    await running;
    controller.abort();
    assert.equal((await call.catch((error) => error)).name, 'AbortError');
    assert.equal(await (await engine.writeSvg(toolpath)).text(), svg);
    assert.equal(await digestOf(engine.generateToolpath(...small)), report.digest);
    engine.dispose();
    await until(() => workers.count.ended === workers.count.started);
    workers.stop();
    assert.equal(workers.count.started, 1);
  },
);

test('a Blob that stands for a file on disk is read like any other', async () => {
  const engine = await createEngine({ threads: 'off' });
  const file = await openAsBlob(join(root, 'examples/inputs/photo.png'));
  const picture = await engine.decodePicture(file);
  assert.deepEqual(picture, await engine.decodePicture(await file.arrayBuffer()));
  const input = { shape: { size: [20, 0] }, layers: [{ kind: 'map', file }] };
  assert.equal((await engine.generateToolpath(input, {}, { measure: false })).report.toolpaths, 1);
  engine.dispose();
});
