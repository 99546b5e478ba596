// The directions that stand in for beads: drawn by the engine, of plates only the newest.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { DirectionRaster, Engine, PlateInput, Shape, ShapeInput, ToolpathParams } from 'sillon';
import { drawDirections, followDirections } from '../../src/app/directions.js';
import { filledWith } from '../../src/model/fills.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import type { PlateResult } from '../../src/model/state.js';
import { Store } from '../../src/model/store.js';
import { newShown, type Shown } from '../../src/studio/shown.js';
import { fileOf } from './support/pictures.js';

const turn = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));
const plateOf = (width: number): Plate => ({ ...newPlate(), width, height: width });

interface Call {
  input: PlateInput;
  spacing: number;
  raster: DirectionRaster;
  finish(): Promise<void>;
  fail(): Promise<void>;
}

/** A store, and an engine that has drawn when the test says so. */
class Bench {
  readonly calls: Call[] = [];
  readonly store: Store<Shown>;
  readonly read: ShapeInput[] = [];
  readonly #engine = {
    readShape: (shape: ShapeInput): Promise<Shape> => {
      this.read.push(shape);
      return Promise.resolve({ page: [1, this.read.length], paths: [] });
    },
    drawLayers: (input: PlateInput, { spacing }: ToolpathParams): Promise<DirectionRaster> =>
      new Promise((resolve, reject) => {
        const raster = { width: this.calls.length + 1, height: 1, angle: new Uint16Array(1), mode: new Uint8Array(1) };
        this.calls.push({
          ...{ input, spacing, raster },
          finish: () => {
            resolve(raster);
            return turn();
          },
          fail: () => {
            reject(new Error('no letter of any font'));
            return turn();
          },
        });
      }),
  } as unknown as Engine;

  constructor(state: Partial<Shown> = {}) {
    this.store = new Store<Shown>({ ...newShown(), view: 'directions', ...state });
    followDirections(this.store, () => Promise.resolve(this.#engine));
  }
  async change(plate: Plate, live = false): Promise<void> {
    this.store.change(() => plate);
    this.store.set({ live });
    await turn();
  }
  get last(): Call {
    return this.calls.at(-1) ?? assert.fail('nothing was drawn');
  }
  get shown(): DirectionRaster | undefined {
    return this.store.state.directions?.raster;
  }
}

test('directions are drawn of every plate, coarse in every view and fine where they are shown', async () => {
  const bench = new Bench({ view: 'appearance' });
  await bench.change(plateOf(200));
  assert.equal(bench.last.spacing, (4 * 200) / 256);
  await bench.last.finish();
  assert.equal(bench.shown, bench.last.raster);
  assert.equal(bench.store.state.directions?.plate.width, 200);
  bench.store.set({ view: 'directions' });
  await turn();
  assert.equal(bench.calls.length, 2);
  assert.equal(bench.last.spacing, (4 * 200) / 1024);
  await bench.last.finish();
  assert.equal(bench.shown, bench.last.raster);
  // There and back, another name or printer: they are there already.
  bench.store.set({ view: 'appearance' });
  await turn();
  bench.store.set({ view: 'directions' });
  const { plate } = bench.store.state;
  await bench.change({ ...plate, name: 'other', printer: { ...plate.printer, speed: 20 } });
  assert.equal(bench.calls.length, 2);
});

test('a first visit has none drawn before its plate has beads', async () => {
  const bench = new Bench({ view: 'appearance', welcome: true });
  await bench.change(plateOf(50));
  assert.equal(bench.calls.length, 0);
  bench.store.set({ result: { toolpath: {} } as PlateResult });
  await turn();
  assert.equal(bench.calls.length, 1);
});

test('a shape is read once, whatever changes within it', async () => {
  const bench = new Bench({ view: 'appearance' });
  const plate = plateOf(50);
  for (const fill of ['waves', 'spiral'] as const) {
    await bench.change(filledWith(plate, fill));
    await bench.last.finish();
  }
  assert.equal(bench.read.length, 1);
  await bench.change(plateOf(60));
  await bench.last.finish();
  assert.equal(bench.read.length, 2);
  assert.deepEqual(bench.store.state.directions?.shape.page, [1, 2]);
});

test('of plates that change while one is drawn only the newest is drawn', async () => {
  const bench = new Bench({ view: 'appearance' });
  for (const width of [50, 51, 52]) await bench.change(plateOf(width));
  assert.equal(bench.calls.length, 1);
  await bench.last.finish();
  assert.equal(bench.calls.length, 2);
  const { shape } = bench.last.input;
  assert.ok(shape && 'size' in shape);
  assert.deepEqual(shape.size, [52, 52]);
  await bench.last.finish();
  assert.equal(bench.shown, bench.last.raster);
  assert.equal(bench.calls.length, 2);
});

test('under a hand they are coarse, and fine once it rests', async () => {
  const bench = new Bench();
  await bench.change(plateOf(200), true);
  const { spacing } = bench.last;
  assert.equal(spacing, (4 * 200) / 256);
  await bench.last.finish();
  assert.equal(bench.calls.length, 1);
  await bench.change(bench.store.state.plate, false);
  assert.equal(bench.last.spacing, (4 * 200) / 1024);
  await bench.last.finish();
  // What is fine will do while a hand moves something else.
  await bench.change({ ...bench.store.state.plate, name: 'other' }, true);
  assert.equal(bench.calls.length, 2);
});

test('beads as wide as texels are drawn as they are', async () => {
  const calls: number[] = [];
  const engine = {
    drawLayers: (_: PlateInput, { spacing }: ToolpathParams) => {
      calls.push(spacing);
      return Promise.resolve({});
    },
  } as unknown as Engine;
  const wide: Plate = { ...plateOf(40), toolpath: { ...newPlate().toolpath, spacing: 2 } };
  await drawDirections(wide, engine, 1024);
  await drawDirections({ ...wide, height: 400 }, engine, 100);
  await drawDirections({ ...wide, shape: { ...wide.shape, offset: 30 } }, engine, 100);
  assert.deepEqual(calls, [2, 16, 4]);
});

test('one picture is solved for its lamp, else the last plate’s, else the usual one: the engine chooses none', async () => {
  const bench = new Bench({ view: 'appearance' });
  const cat = fileOf('cat.png');
  const lampAsked = (): unknown => {
    const [layer] = bench.last.input.layers ?? [];
    return layer?.kind === 'picture' && layer.pictures?.map(({ lamp }) => lamp);
  };
  const plateWith = (...lamps: ([number, number] | null)[]): Plate =>
    filledWith(plateOf(50), 'picture', { pictures: lamps.map((lamp) => ({ file: cat, lamp })) });
  await bench.change(plateWith(null));
  assert.deepEqual(lampAsked(), [[60, 35]]);
  await bench.last.finish();
  await bench.change(plateWith([10, 20]));
  assert.deepEqual(lampAsked(), [[10, 20]]);
  await bench.last.finish();
  const look = { lamps: [[200, 30]] };
  await bench.change(plateWith(null));
  assert.deepEqual(lampAsked(), [[60, 35]]);
  await bench.last.finish();
  bench.store.set({ result: { toolpath: { look } } as unknown as PlateResult }); // the lamp that was chosen
  await turn();
  assert.deepEqual(lampAsked(), [[200, 30]]);
  await bench.last.finish();
  await bench.change(plateWith(null, null));
  assert.deepEqual(lampAsked(), [null, null]);
});

test('what cannot be drawn stops nothing', async () => {
  const bench = new Bench({ view: 'appearance' });
  await bench.change(plateOf(50));
  await bench.last.fail();
  assert.equal(bench.shown, undefined);
  assert.equal(bench.calls.length, 1); // it is not tried again and again
  await bench.change(plateOf(51));
  await bench.last.finish();
  assert.equal(bench.shown, bench.last.raster);
});
