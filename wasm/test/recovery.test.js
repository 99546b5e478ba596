// What breaks, what rests and what runs out: the engine comes back by itself, and leaves nothing behind.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

import { createEngine } from 'sillon';

import { copyEngine, wrapped } from './support/engine-copy.js';
import { countWorkers, large, small, until } from './support/jobs.js';

const run = promisify(execFile);
const digestOf = async (plate) => (await plate).report.digest;
const failureOf = (call) => call.then(assert.fail, (error) => error);
let digest;

before(async () => {
  const engine = await createEngine({ threads: 'off' });
  digest = await digestOf(engine.generateToolpath(...small));
  engine.dispose();
});

/** Runs `body` with an engine whose files are changed. */
async function withCopy(changes, options, body) {
  const copy = copyEngine(changes);
  try {
    const engine = await createEngine({ assetBase: copy.folder, ...options });
    try {
      await body(engine);
    } finally {
      engine.dispose();
    }
  } finally {
    copy.remove();
  }
}

describe('a worker that breaks', { timeout: 600_000 }, () => {
  const breaks = {
    'by a trap': `module.profiles = () => { throw new WebAssembly.RuntimeError('unreachable'); };`,
    'by an uncaught C++ exception': `module.profiles = () => { throw 5247392; };`,
    'by ending': `module.profiles = () => process.exit(3);`,
  };
  for (const threads of [1, 2]) {
    for (const [how, code] of Object.entries(breaks)) {
      test(`${how}, with ${threads} threads: Crashed, and the next call works`, async () => {
        const glue = threads === 1 ? 'sillon-st.js' : 'sillon-mt.js';
        const variant = threads === 1 ? 'st' : 'mt';
        await withCopy({ [glue]: wrapped(variant, { after: code }) }, { threads }, async (engine) => {
          const broken = failureOf(engine.profiles());
          const next = engine.generateToolpath(...small);
          const error = await broken;
          assert.equal(error.code, 'Crashed', error.message);
          assert.notEqual(error.hint, '');
          assert.equal(await digestOf(next), digest);
          assert.equal(engine.info.variant, variant);
        });
      });
    }
  }

  test('between two calls is not noticed', async () => {
    // It crashes when it is told to: a timer's crash may overtake the answer on a busy machine.
    const after = `new BroadcastChannel('late').onmessage = () => { setTimeout(() => { throw new Error('late'); }); };`;
    const channel = new BroadcastChannel('late');
    const workers = countWorkers();
    await withCopy({ 'sillon-st.js': wrapped('st', { after }) }, { threads: 1 }, async (engine) => {
      await engine.profiles();
      channel.postMessage('now');
      await until(() => workers.count.ended === 1);
      assert.equal(await digestOf(engine.generateToolpath(...small)), digest);
    });
    channel.close();
    workers.stop();
  });

  const endless = `module.generateToolpath = () => { for (;;); };`;

  test('by silence, with threads: the call is done again with one', async (t) => {
    await withCopy({ 'sillon-mt.js': wrapped('mt', { after: endless }) }, { threads: 2 }, async (engine) => {
      t.mock.timers.enable({ apis: ['setInterval'] });
      const call = engine.generateToolpath(...small);
      await new Promise(setImmediate); // it is in the worker
      t.mock.timers.tick(60_000);
      t.mock.timers.reset();
      assert.equal(await digestOf(call), digest);
      assert.deepEqual([engine.info.variant, engine.info.threads], ['st', 1]);
      assert.match(engine.info.reason, /no sign of life/);
    });
  });

  test('by silence, with one thread: Crashed', async (t) => {
    await withCopy({ 'sillon-st.js': wrapped('st', { after: endless }) }, { threads: 1 }, async (engine) => {
      t.mock.timers.enable({ apis: ['setInterval'] });
      const call = failureOf(engine.generateToolpath(...small));
      await new Promise(setImmediate);
      t.mock.timers.tick(59_000);
      const project = failureOf(engine.readProject('{'));
      t.mock.timers.tick(1_000);
      t.mock.timers.reset();
      assert.equal((await call).code, 'Crashed');
      assert.equal((await project).code, 'InvalidFile');
      assert.equal(engine.info.reason, '');
    });
  });

  test('while it starts its threads: one thread works', async (t) => {
    const copy = copyEngine({ 'sillon-mt.js': `export default () => new Promise(() => {});` });
    t.mock.timers.enable({ apis: ['setInterval'] });
    const workers = countWorkers();
    const creating = createEngine({ assetBase: copy.folder, threads: 2 });
    let engine;
    void creating.then((made) => (engine = made));
    // The watch begins when the files are there. It is not to find the second worker silent, too.
    await until(() => {
      if (workers.count.started < 2) t.mock.timers.tick(1000);
      return engine !== undefined;
    });
    workers.stop();
    t.mock.timers.reset();
    copy.remove();
    assert.equal(engine.info.variant, 'st');
    assert.match(engine.info.reason, /no sign of life/);
    engine.dispose();
  });
});

describe('memory', { timeout: 600_000 }, () => {
  // As on a phone: growth is refused beyond 64 MiB.
  const stingy = `
    const grow = WebAssembly.Memory.prototype.grow;
    WebAssembly.Memory.prototype.grow = function (pages) {
      if (this.buffer.byteLength + 65536 * pages > 2 ** 26) throw new RangeError('refused');
      return grow.call(this, pages);
    };`;
  // As on a phone: large shared maxima are refused.
  const cautious = `
    const Memory = WebAssembly.Memory;
    WebAssembly.Memory = class extends Memory {
      constructor(descriptor) {
        if (descriptor.maximum > 1024) throw new RangeError('refused');
        super(descriptor);
      }
    };`;

  test('that runs out is OutOfMemory, and the next call works', async () => {
    await withCopy({ 'sillon-st.js': wrapped('st', { before: stingy }) }, { threads: 1 }, async (engine) => {
      const { code, hint, message } = await failureOf(engine.generateToolpath(...large));
      assert.equal(code, 'OutOfMemory', message);
      assert.match(hint, /spacing/);
      const { report } = await engine.generateToolpath(...small);
      assert.equal(report.digest, digest);
      assert.equal(report.peakBytes, 2 ** 24); // of a new worker
    });
  });

  test('that the fields of the last plate take is given back where a call needs it', async () => {
    // As if there were room for one plate, but not for what it leaves and the next one.
    const after = `let calls = 0;
      const real = module.generateToolpath;
      module.generateToolpath = (...call) =>
        ++calls > 1 ? { error: { code: 'OutOfMemory', message: 'full' } } : real(...call);`;
    await withCopy({ 'sillon-st.js': wrapped('st', { after }) }, { threads: 1 }, async (engine) => {
      const workers = countWorkers();
      for (let k = 0; k < 3; ++k) assert.equal(await digestOf(engine.generateToolpath(...small)), digest);
      workers.stop();
      assert.equal(workers.count.started, 2); // one for each call after the first
    });
  });

  test('that threads share may have a low limit; beyond it one thread does the call', async () => {
    await withCopy({ 'sillon-mt.js': wrapped('mt', { before: cautious }) }, { threads: 2 }, async (engine) => {
      assert.equal(engine.info.threads, 2, engine.info.reason);
      const told = [];
      const onProgress = ({ fraction }) => told.push(fraction);
      const middle = [
        { shape: { builtin: 'disc', size: [60, 60] } },
        { spacing: 0.15 },
        { measure: false, onProgress },
      ];
      const { report } = await engine.generateToolpath(...middle);
      assert.equal(report.threads, 1);
      assert.ok(report.peakBytes > 2 ** 26);
      // Begun anew, but never told to be further back.
      assert.deepEqual(
        told,
        [...told].sort((a, b) => a - b),
      );
      const again = await engine.generateToolpath(...small);
      assert.equal(again.report.digest, digest);
      assert.equal(again.report.threads, 2);
    });
  });

  test('that cannot be shared at all leaves one thread', async () => {
    const before = `WebAssembly.Memory = class { constructor() { throw new RangeError('refused'); } };`;
    await withCopy({ 'sillon-mt.js': wrapped('mt', { before }) }, { threads: 4 }, async (engine) => {
      assert.deepEqual([engine.info.variant, engine.info.threads], ['st', 1]);
      assert.match(engine.info.reason, /64 MiB/);
      assert.equal(await digestOf(engine.generateToolpath(...small)), digest);
    });
  });

  for (const threads of [1, 2]) {
    test(`is refused before work begins, and what the refusal names can be made, with ${threads} threads`, async () => {
      const engine = await createEngine({ threads, memory: 96 });
      const plate = { shape: { builtin: 'rectangle', size: [300, 300] }, layers: [{ kind: 'direction', angle: 30 }] };
      const stages = new Set();
      const onProgress = ({ stage }) => stages.add(stage);
      const { code, message } = await failureOf(engine.generateToolpath(plate, { spacing: 0.2 }, { onProgress }));
      assert.equal(code, 'OutOfMemory', message);
      const [, gigabytes, spacing] =
        /possible in ([\d.]+) GB of memory: use a spacing of at least ([\d.]+) mm, or/.exec(message);
      assert.ok(Number(gigabytes) <= (0.75 * 96 * 2 ** 20) / 1e9, message);
      assert.equal(stages.has('phases'), false);
      const { report } = await engine.generateToolpath(plate, { spacing: Number(spacing) }, { measure: false });
      assert.ok(report.peakBytes <= 96 * 2 ** 20, `${report.peakBytes} bytes`);
      engine.dispose();
    });
  }

  for (const threads of [1, 2]) {
    test(`is given back: 200 plates with ${threads} threads need no more than a few`, async () => {
      const engine = await createEngine({ threads, idleTimeout: Infinity });
      const workers = countWorkers();
      const plates = async (count) => {
        let peakBytes = 0;
        for (let k = 0; k < count; ++k) {
          const { toolpath, report } = await engine.generateToolpath(...small);
          if (k % 10 === 0) await (await engine.writeGcode(toolpath)).blob.arrayBuffer();
          assert.equal(report.digest, digest);
          peakBytes = report.peakBytes;
        }
        return { peakBytes, resident: process.memoryUsage.rss() };
      };
      const few = await plates(20);
      const many = await plates(180);
      workers.stop();
      engine.dispose();
      assert.equal(workers.count.started, 0); // plates and their files all in the one that was there
      assert.equal(many.peakBytes, few.peakBytes);
      assert.ok(many.resident - few.resident < 64 * 2 ** 20, `${(many.resident - few.resident) >> 20} MiB more`);
    });
  }
});

describe('rest', { timeout: 600_000 }, () => {
  for (const threads of [1, 2]) {
    test(`an idle worker ends and comes back, with ${threads} threads`, async () => {
      const workers = countWorkers();
      const engine = await createEngine({ threads, idleTimeout: 20 });
      await until(() => workers.count.ended === 1);
      assert.equal(await digestOf(engine.generateToolpath(...small)), digest);
      assert.equal(workers.count.started, 2);
      await until(() => workers.count.ended === 2);
      engine.dispose();
      workers.stop();
    });
  }

  test('a worker with work in its queue does not rest', async () => {
    const workers = countWorkers();
    const engine = await createEngine({ threads: 1, idleTimeout: 0 });
    const calls = Array.from({ length: 5 }, () => digestOf(engine.generateToolpath(...small)));
    assert.deepEqual(await Promise.all(calls), Array(5).fill(digest));
    assert.ok(workers.count.started <= 2, `${workers.count.started} workers`);
    await until(() => workers.count.ended === workers.count.started);
    engine.dispose();
    workers.stop();
  });

  test('a process ends by itself, though nobody disposed of its engines', async () => {
    const script = fileURLToPath(new URL('./support/no-dispose.js', import.meta.url));
    const { stdout, stderr } = await run(process.execPath, [script], { timeout: 300_000 });
    assert.equal(stdout, `${digest} ${digest}\n`);
    assert.equal(stderr, '');
  });
});
