import assert from 'node:assert/strict';
import { beforeEach, mock, test } from 'node:test';
import type {
  Engine,
  EngineInfo,
  GenerateOptions,
  ToolpathResult,
  PlateInput,
  Report,
  Toolpath,
  ToolpathParams,
} from 'sillon';
import { Cost, cellsOf } from '../../src/engine/coarse.js';
import { changeGround, filledWith } from '../../src/model/fills.js';
import { engineInput } from '../../src/model/input.js';
import { newLayer, withLayer } from '../../src/model/layer-list.js';
import { sameToolpath } from '../../src/model/result.js';
import { StudioEngine } from '../../src/engine/studio-engine.js';
import { TimeLeft } from '../../src/model/time-left.js';
import { newFileShape, newShape } from '../../src/model/defaults.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import type { Problem } from '../../src/model/problem.js';
import type { PlateResult, Progress } from '../../src/model/state.js';
import { fileOf } from './support/pictures.js';

const turn = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));

interface Call {
  input: PlateInput;
  params: Partial<ToolpathParams>;
  options: GenerateOptions;
  finish(ms?: number): Promise<void>;
  fail(error: Error): Promise<void>;
}

class SillonError extends Error {
  override name = 'SillonError';
  readonly reason = '';
  constructor(
    readonly code: string,
    message: string,
  ) {
    super(message);
  }
}

/** An engine whose jobs end when the test says so, and a page that keeps what it hears. */
class Bench {
  time = 0;
  loads = 0;
  loadError: Error | undefined;
  calls: Call[] = [];
  written: { toolpath: Toolpath; printer: unknown; below: Toolpath | undefined }[] = [];
  results: PlateResult[] = [];
  progress: (Progress | undefined)[] = [];
  problems: (Problem | undefined)[] = [];
  info: EngineInfo[] = [];
  running = 0;
  mostRunning = 0;
  readonly studio = new StudioEngine(
    {
      load: () => {
        ++this.loads;
        if (this.loadError !== undefined) return Promise.reject(this.loadError);
        return Promise.resolve(this.engine as unknown as Engine);
      },
      now: () => this.time,
    },
    {
      onResult: (result) => this.results.push(result),
      onProgress: (progress) => this.progress.push(progress),
      onProblem: (problem) => this.problems.push(problem),
      onInfo: (info) => this.info.push(info),
    },
  );

  readonly engine = {
    info: { version: '1', variant: 'st', threads: 1, reason: '' },
    generateToolpath: (input: PlateInput, params: ToolpathParams, options: GenerateOptions): Promise<ToolpathResult> =>
      new Promise((resolve, reject) => {
        this.mostRunning = Math.max(this.mostRunning, ++this.running);
        const end = (): void => {
          --this.running;
        };
        options.signal?.addEventListener('abort', () => {
          end();
          reject(options.signal?.reason as Error);
        });
        this.calls.push({
          input,
          params,
          options,
          finish: (ms = 10) => {
            this.time += ms;
            end();
            const toolpath = {
              spacing: params.spacing,
              cycles: [],
              shape: { page: [1, 1], paths: [] },
              notes: options.measure === true ? ['measured'] : [],
            } as unknown as Toolpath;
            resolve({ toolpath, report: { toolpaths: 1 } as Report });
            return turn();
          },
          fail: (error) => {
            end();
            reject(error);
            return turn();
          },
        });
      }),
    writeGcode: (
      toolpath: Toolpath,
      printer: unknown,
      _print: unknown,
      { signal, below }: { signal: AbortSignal; below?: Toolpath },
    ) =>
      new Promise((resolve, reject) => {
        this.written.push({ toolpath, printer, below });
        signal.addEventListener('abort', () => {
          reject(signal.reason as Error);
        });
        setTimeout(() => {
          resolve({ blob: new Blob(['G28']), summary: {} });
        }, 50);
      }),
    writeBaseBody: (shape: Toolpath['shape'], printer: unknown, print: unknown) =>
      Promise.resolve(new Blob([JSON.stringify([shape, printer, print])])),
    checkGcode: () => Promise.resolve({ findings: [], errors: 0 }),
  };

  get call(): Call {
    const call = this.calls.at(-1);
    assert.ok(call !== undefined, 'no job was begun');
    return call;
  }

  async finishAll(): Promise<void> {
    await turn();
    for (let k = 0; this.running > 0; ++k) {
      assert.ok(k < 20, 'jobs go on for ever');
      await this.call.finish();
    }
  }
}

const plateOf = (width: number): Plate => ({ ...newPlate(), width, height: width });

let bench: Bench;
beforeEach(() => {
  mock.timers.reset();
  mock.timers.enable({ apis: ['setTimeout'] });
  bench = new Bench();
});

test('nothing is loaded before a plate asks for it', async () => {
  await turn();
  assert.equal(bench.loads, 0);
  bench.studio.update(newPlate());
  assert.equal(bench.progress.at(-1)?.job, 'loading');
  await turn();
  assert.equal(bench.loads, 1);
  assert.equal(bench.info.length, 1);
});

test('a resting plate is made whole, shown, then measured; the measured one has the same beads', async () => {
  const plate = newPlate();
  bench.studio.update(plate);
  await turn();
  assert.equal(bench.call.options.measure, false);
  assert.equal(bench.call.params.spacing, plate.toolpath.spacing);
  await bench.call.finish();
  assert.equal(bench.results.length, 1);
  assert.deepEqual([bench.results[0]?.coarse, bench.results[0]?.measured], [false, false]);
  assert.equal(bench.call.options.measure, true);
  await bench.call.finish();
  assert.equal(bench.results[1]?.measured, true);
  assert.equal(bench.results[1].toolpath.cycles, bench.results[0]?.toolpath.cycles);
  assert.deepEqual(bench.results[1].toolpath.notes, ['measured']);
  assert.equal(bench.progress.at(-1), undefined);
  assert.equal(bench.running, 0);
});

/** The same directions, with beads laid in another way. */
const laid = (plate: Plate, minWidth: number): Plate => ({ ...plate, toolpath: { ...plate.toolpath, minWidth } });

test('while a hand changes directions there are no beads, the whole plate comes when it rests', async () => {
  bench.studio.update(plateOf(200), { live: true });
  await turn();
  assert.equal(bench.calls.length, 0);
  mock.timers.tick(249);
  await turn();
  assert.equal(bench.calls.length, 0);
  mock.timers.tick(1);
  await turn();
  assert.equal(bench.call.params.spacing, 0.4);
  await bench.finishAll();
  assert.equal(bench.results.at(-1)?.measured, true);
  const { length } = bench.calls;
  bench.studio.update(plateOf(201), { live: true });
  await turn();
  assert.equal(bench.calls.length, length);
});

test('while a hand changes how beads are laid there are previews, the whole plate comes when it rests', async () => {
  const plate = plateOf(200);
  bench.studio.update(plate);
  await turn();
  await bench.call.finish(100);
  await bench.finishAll();
  bench.studio.update(laid(plate, 0.31), { live: true });
  await turn();
  assert.ok((bench.call.params.spacing ?? 0) > 0.4, 'the preview is as fine as the plate');
  assert.equal(bench.call.options.measure, false);
  await bench.call.finish();
  assert.equal(bench.results.at(-1)?.coarse, true);
  assert.equal(bench.running, 0, 'the whole plate was begun under a moving hand');
  mock.timers.tick(250);
  await turn();
  assert.equal(bench.call.params.spacing, 0.4);
  await bench.finishAll();
  assert.equal(bench.results.at(-1)?.measured, true);
});

test('where previews would be too coarse there are none', async () => {
  const plate = plateOf(200);
  bench.studio.update(plate);
  await turn();
  await bench.call.finish(1000);
  await bench.finishAll();
  const { length } = bench.calls;
  bench.studio.update(laid(plate, 0.31), { live: true });
  await turn();
  assert.equal(bench.calls.length, length);
});

/** A plate of one picture, which is corrected. */
const litOf = (width: number): Plate =>
  filledWith(plateOf(width), 'picture', { pictures: [{ file: fileOf('moon.png'), lamp: [60, 45] }] });

test('a picture is shown after the first of its plates, and corrected then', async () => {
  const asked = (): (number | undefined)[] => bench.calls.map(({ input }) => input.pictures?.corrections);
  bench.studio.update(litOf(20));
  await turn();
  await bench.call.finish();
  assert.deepEqual([asked(), bench.results.at(-1)?.coarse], [[0, 3], true]);
  await bench.finishAll();
  assert.deepEqual(asked(), [0, 3]); // the plates of its corrections are made only once, with the measures
  assert.deepEqual([bench.results.at(-1)?.coarse, bench.results.at(-1)?.measured], [false, true]);
  assert.equal(bench.call.options.measure, true);

  // Another picture is not solved under a hand.
  bench.studio.update(litOf(21), { live: true });
  await turn();
  assert.deepEqual(asked(), [0, 3]);
  // Without corrections it is made as any other.
  const { pictures } = newPlate();
  bench.studio.update({ ...litOf(30), pictures: { ...pictures, corrections: 0 } });
  await bench.finishAll();
  assert.deepEqual(asked().slice(2), [0, 0]);
});

test('of updates under a running preview only the newest is made, and none is starved', async () => {
  const plate = plateOf(200);
  bench.studio.update(plate);
  await bench.finishAll();
  const made = bench.results.length;
  const { length } = bench.calls;
  for (let k = 0; k < 10; ++k) {
    bench.studio.update(laid(plate, 0.3 + k / 100), { live: true });
    await turn();
  }
  assert.equal(bench.calls.length, length + 1);
  await bench.call.finish();
  assert.equal(bench.calls.length, length + 2);
  await bench.call.finish();
  assert.deepEqual(
    bench.results.slice(made).map((result) => result.plate.toolpath.minWidth),
    [0.3, 0.39],
  );
  assert.equal(bench.mostRunning, 1);
});

test('small plates need no preview, and are not restarted by every move', async () => {
  const plate = plateOf(20);
  bench.studio.update(plate);
  await bench.finishAll();
  bench.studio.update(laid(plate, 0.31), { live: true });
  await turn();
  assert.equal(bench.call.params.spacing, 0.4);
  bench.studio.update(laid(plate, 0.32), { live: true });
  assert.equal(bench.call.options.signal?.aborted, false);
  await bench.call.finish();
  assert.equal(bench.results.at(-1)?.coarse, false);
  await bench.call.finish();
  // When the hand rests nothing has to be made again.
  mock.timers.tick(250);
  await turn();
  assert.equal(bench.call.options.measure, true);
});

test('a change stops the whole plate and its measures at once', async () => {
  bench.studio.update(plateOf(50));
  await turn();
  const first = bench.call;
  bench.studio.update(plateOf(51));
  assert.equal(first.options.signal?.aborted, true);
  await turn();
  assert.equal(bench.results.length, 0);
  await bench.call.finish();
  assert.equal(bench.call.options.measure, true);
  const measuring = bench.call;
  bench.studio.update(plateOf(52));
  assert.equal(measuring.options.signal?.aborted, true);
  await bench.finishAll();
  assert.equal(bench.results.at(-1)?.plate.width, 52);
  assert.equal(bench.mostRunning, 1);
});

test('changes of printer, print and name make nothing again', async () => {
  const plate = newPlate();
  bench.studio.update(plate);
  await bench.finishAll();
  const { length } = bench.calls;
  const pictures = { ...plate.pictures, spool: 'bluePla' as const };
  bench.studio.update({ ...plate, name: 'x', printer: { ...plate.printer, speed: 20 }, pictures });
  await turn();
  assert.equal(bench.calls.length, length);
});

test('cancel stops the job and waits for the next change', async () => {
  bench.studio.update(plateOf(50));
  await turn();
  bench.studio.cancel();
  assert.equal(bench.call.options.signal?.aborted, true);
  await turn();
  assert.equal(bench.progress.at(-1), undefined);
  assert.deepEqual(bench.problems, []);
  mock.timers.tick(10_000);
  await turn();
  assert.equal(bench.calls.length, 1);
  bench.studio.retry();
  await turn();
  assert.equal(bench.calls.length, 2);
  await bench.finishAll();
  assert.equal(bench.results.at(-1)?.measured, true);
});

test('cancel under a hand that moves does not let the whole plate come', async () => {
  bench.studio.update(plateOf(200), { live: true });
  await turn();
  bench.studio.cancel();
  mock.timers.tick(10_000);
  await turn();
  assert.equal(bench.calls.length, 0);
});

test('a problem is told once, does not repeat the job, and goes with the next good plate', async () => {
  bench.studio.update(plateOf(50));
  await turn();
  await bench.call.fail(new SillonError('EmptyShape', 'the shape has no area'));
  assert.deepEqual(bench.problems, [{ code: 'EmptyShape', values: {}, detail: 'the shape has no area' }]);
  assert.equal(bench.progress.at(-1), undefined);
  await turn();
  assert.equal(bench.calls.length, 1);
  bench.studio.update(plateOf(51));
  await bench.finishAll();
  assert.equal(bench.problems.at(-1), undefined);
  assert.equal(bench.problems.length, 2);
});

test('an engine that could not be loaded is asked for again', async () => {
  bench.loadError = new SillonError('LoadFailed', 'http://x could not be fetched');
  bench.studio.update(plateOf(50));
  await turn();
  assert.equal(bench.problems.at(-1)?.code, 'LoadFailed');
  bench.loadError = undefined;
  bench.studio.retry();
  await turn();
  assert.equal(bench.loads, 2);
  await bench.finishAll();
  assert.equal(bench.problems.at(-1), undefined);
});

test('progress has a stage, and in time an estimate', async () => {
  bench.studio.update(plateOf(50));
  await turn();
  const { onProgress } = bench.call.options;
  bench.time = 100;
  onProgress?.({ stage: 'lines', fraction: 0.1 });
  assert.deepEqual(bench.progress.at(-1), { job: 'making', stage: 'lines', fraction: 0.1, secondsLeft: undefined });
  bench.time = 2000;
  onProgress?.({ stage: 'stitch', fraction: 0.5 });
  assert.equal(bench.progress.at(-1)?.secondsLeft, 2);
});

test('previews tell no progress', async () => {
  const plate = plateOf(20);
  bench.studio.update(plate);
  await bench.finishAll();
  bench.studio.update(laid(plate, 0.31), { live: true });
  await turn();
  bench.progress = [];
  bench.call.options.onProgress?.({ stage: 'lines', fraction: 0.1 });
  assert.deepEqual(bench.progress, []);
});

test('G-code waits for the whole, measured path and takes the printer of now', async () => {
  const plate = plateOf(200);
  bench.studio.update(plate, { live: true });
  await turn();
  const printing = { ...plate, printer: { ...plate.printer, speed: 33 } };
  const done = bench.studio.gcode(printing);
  await bench.finishAll();
  assert.equal(bench.written.length, 1);
  assert.deepEqual(bench.written[0]?.toolpath.notes, ['measured']);
  assert.equal(bench.written[0].printer, printing.printer);
  assert.equal(bench.progress.at(-1)?.job, 'writing');
  mock.timers.tick(50);
  const { gcode, result } = await done;
  assert.equal(await gcode.blob.text(), 'G28');
  assert.equal(result.measured, true);
  assert.equal(bench.progress.at(-1), undefined);
});

test('a base layer across the beads has a path of its own, made for the G-code alone', async () => {
  const plate = plateOf(200);
  bench.studio.update(plate);
  const printing: Plate = { ...plate, print: { ...plate.print, basePattern: 'across' } };
  const done = bench.studio.gcode(printing);
  await bench.finishAll();
  assert.deepEqual(bench.calls.at(-1)?.options.across, true);
  assert.deepEqual(bench.calls.at(-1)?.input, bench.calls[0]?.input);
  mock.timers.tick(50);
  await done;
  const [file] = bench.written;
  assert.deepEqual(file?.toolpath.notes, ['measured']);
  assert.deepEqual(file.below?.notes, []);
  // Without base layers there is nothing to cross.
  const plain = bench.studio.gcode({ ...printing, print: { ...printing.print, base: 0 } });
  const before = bench.calls.length;
  await bench.finishAll();
  mock.timers.tick(50);
  await plain;
  assert.equal(bench.calls.length, before);
  assert.equal(bench.written[1]?.below, undefined);
});

test('the base body is of the shape that is filled, and takes the layers of now', async () => {
  const plate = plateOf(200);
  bench.studio.update(plate);
  const printing = { ...plate, print: { ...plate.print, base: 7 } };
  const done = bench.studio.body(printing);
  await bench.finishAll();
  const told: unknown = JSON.parse(await (await done).text());
  assert.deepEqual(told, JSON.parse(JSON.stringify([{ page: [1, 1], paths: [] }, plate.printer, printing.print])));
});

test('G-code of a plate that cannot be made rejects with its problem', async () => {
  bench.studio.update(plateOf(50));
  await turn();
  const rejected = assert.rejects(bench.studio.gcode(plateOf(50)), { code: 'TooLarge', detail: 'too many cells' });
  await bench.call.fail(new SillonError('TooLarge', 'too many cells'));
  await rejected;
  // And a second time without making it again.
  await assert.rejects(bench.studio.gcode(plateOf(50)), { code: 'TooLarge' });
});

test('cancel ends exports, whether they wait or write', async () => {
  bench.studio.update(plateOf(50));
  await turn();
  const waiting = bench.studio.gcode(plateOf(50));
  bench.studio.cancel();
  await assert.rejects(waiting, { name: 'AbortError' });

  const writing = bench.studio.gcode(plateOf(50));
  await bench.finishAll();
  assert.equal(bench.written.length, 1);
  bench.studio.cancel();
  await assert.rejects(writing, { name: 'AbortError' });
});

test('a file that nobody wants any more is not written to its end', async () => {
  bench.studio.update(plateOf(50));
  await turn();
  await bench.finishAll();
  const control = new AbortController();
  const unwanted = bench.studio.gcode(plateOf(50), control.signal);
  const wanted = bench.studio.gcode(plateOf(50));
  await turn();
  assert.equal(bench.written.length, 2);
  control.abort();
  await assert.rejects(unwanted, { name: 'AbortError' });
  await assert.rejects(bench.studio.gcode(plateOf(50), control.signal), { name: 'AbortError' });
  assert.equal(bench.written.length, 2);
  mock.timers.tick(50);
  assert.equal(await (await wanted).gcode.blob.text(), 'G28');
});

// --- Its parts ------------------------------------------------------------------------------------------------------------

/** Settings of a shape that nobody has done anything to. */
const unchanged = {
  radius: 3,
  corners: 'round',
  points: 5,
  inner: 0,
  offset: 0,
  holes: [],
  text: '',
  font: 'Nunito',
  weight: 0,
  keepThin: false,
};

test('a plate becomes what the engine takes: its shape, its layers and its settings', () => {
  const { input, params } = engineInput(newPlate());
  const read = { ...unchanged, unitless: 'px', paint: 'shown' };
  assert.deepEqual(input.shape, { builtin: 'disc', size: [70, 70], ...read });
  const [{ kind, pattern, amplitude, waveLength } = assert.fail(), ...others] = input.layers ?? [];
  assert.deepEqual([kind, pattern, amplitude, waveLength, others], ['pattern', 'waves', 40, 24.5, []]);
  assert.deepEqual(params, newPlate().toolpath);
});

test('files are handed over as they came', () => {
  const [map, modes] = [fileOf('map.png'), fileOf('modes.png')];
  const plate = filledWith(plateOf(40), 'map', { file: map, encoding: 'tangent', modeFile: modes, mode: 'parallel' });
  const [layer] = engineInput(plate).input.layers ?? [];
  assert.equal(layer?.file, map.bytes);
  assert.equal(layer.modeFile, modes.bytes);
  assert.deepEqual([layer.encoding, layer.mode], ['tangent', 'parallel']);
});

test('a preview has wider spacing, the same layers, and joins no parts that the plate keeps apart', () => {
  const plate = plateOf(40);
  const { input, params } = engineInput(plate, { factor: 2 });
  assert.deepEqual([params.spacing, params.bridge], [0.8, 0.4]);
  assert.deepEqual(input, engineInput(plate).input);
  const apart = { ...plate, toolpath: { ...plate.toolpath, bridge: 1.5 } };
  assert.equal(engineInput(apart, { factor: 2 }).params.bridge, 1.5);
  assert.equal(engineInput(plate, { factor: 1 }).params.bridge, null);
});

test('a file is handed over with the width of its page', () => {
  const bytes = new Blob(['<svg/>']);
  const plate: Plate = {
    ...newPlate(),
    shape: newFileShape({ id: 'a', name: 'a.svg', bytes }, 'mm'),
  };
  const read = { ...unchanged, unitless: 'mm', paint: 'ignore' };
  assert.deepEqual(engineInput(plate).input.shape, { file: bytes, pageWidth: 70, ...read });
});

test('what makes another toolpath, and what does not', () => {
  const plate = newPlate();
  const same = (change: Partial<Plate>): boolean => sameToolpath(plate, { ...plate, ...change });
  assert.ok(same({}));
  assert.ok(same({ print: { ...plate.print } }));
  assert.ok(same({ layers: [...plate.layers] }));
  assert.ok(!same({ width: 71 }));
  assert.ok(!same({ shape: newShape('disc') }));
  assert.ok(!same({ toolpath: { ...plate.toolpath } }));
  assert.ok(!same({ layers: [] }));
  assert.ok(!sameToolpath(plate, changeGround(plate, { mode: 'parallel' })));
  assert.ok(!sameToolpath(plate, withLayer(plate, newLayer(plate, 'border'))));
});

test('previews are as coarse as the last ones cost, and there are none that would be twice as coarse', () => {
  const plate = plateOf(200);
  const cost = new Cost();
  assert.equal(cost.factorFor(plate), undefined);
  cost.learn(plate, 1, 45);
  assert.equal(cost.factorFor(plate), 1);
  cost.learn(plate, 1, 3 * 45);
  assert.ok(Math.abs((cost.factorFor(plate) ?? 0) - Math.sqrt(3)) < 1e-9);
  cost.learn(plate, 1, 4.1 * 45);
  assert.equal(cost.factorFor(plate), undefined);
  cost.learn(plate, 1, 1);
  assert.equal(cost.factorFor(plate), 1);
});

test('previews keep their spacing while it is about right, so that the engine can keep their path', () => {
  const cost = new Cost();
  cost.learn(plateOf(200), 1, 2 * 45);
  const first = cost.factorFor(plateOf(200));
  cost.learn(plateOf(200), 1, 2 * 45 * 1.3);
  assert.equal(cost.factorFor(plateOf(200)), first);
  cost.learn(plateOf(200), 1, 2 * 45 * 1.9);
  assert.ok((cost.factorFor(plateOf(200)) ?? 0) > (first ?? 0));
});

test('a height of 0 counts as the width', () => {
  assert.equal(cellsOf({ ...newPlate(), width: 4, height: 0 }), cellsOf({ ...newPlate(), width: 4, height: 4 }));
});

test('time left: nothing at first, exact for even progress, smooth for uneven, never negative', () => {
  const even = new TimeLeft(0);
  assert.equal(even.estimate(0.02, 5000), undefined);
  assert.equal(even.estimate(0.5, 100), undefined);
  for (let k = 1; k < 10; ++k) assert.ok(Math.abs((even.estimate(k / 10, 1000 * k) ?? 0) - (10 - k)) < 1e-9);
  assert.equal(even.estimate(1, 10_000), 0);

  const uneven = new TimeLeft(0);
  assert.equal(uneven.estimate(0.5, 1000), 1);
  // Slower from here: the plain estimate would jump from 1 to 9.7.
  const next = uneven.estimate(0.51, 10_000) ?? 0;
  assert.ok(next > 1 && next < 5, `${next}`);
  assert.ok((uneven.estimate(0.99, 10_001) ?? -1) >= 0);
});
