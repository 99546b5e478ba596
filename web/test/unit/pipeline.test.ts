import assert from 'node:assert/strict';
import { mock, test } from 'node:test';
import { Pipeline } from '../../src/app/pipeline.js';
import type { StudioEngine } from '../../src/engine/studio-engine.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { PlateResult } from '../../src/model/state.js';
import { Store } from '../../src/model/store.js';
import { newShown, type Shown } from '../../src/studio/shown.js';

const turn = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));

test('a summary that was given up while its plate was waited for does not stop the next one', async () => {
  mock.timers.enable({ apis: ['setTimeout'] });
  try {
    const plate = newPlate();
    const result = { plate, measured: true, coarse: false, toolpath: { cycles: [] } } as unknown as PlateResult;
    const store = new Store<Shown>({ ...newShown(), plate, result });
    const engine = {
      gcode: (_plate: unknown, unwanted: AbortSignal) =>
        unwanted.aborted
          ? Promise.reject(new DOMException('given up', 'AbortError'))
          : Promise.resolve({ gcode: { summary: { seconds: 60 } }, check: {}, result }),
    } as unknown as StudioEngine;
    const pipeline = new Pipeline(store, engine, () => ({}) as Worker);
    const waiting: (() => void)[] = [];
    pipeline.finished = () =>
      new Promise((resolve) =>
        waiting.push(() => {
          resolve(result);
        }),
      );

    pipeline.onResult(result);
    mock.timers.tick(1000); // the first summary waits for its plate
    pipeline.onResult(result); // and is given up for the next one
    for (const go of waiting.splice(0)) go();
    await turn();
    mock.timers.tick(1000);
    for (const go of waiting.splice(0)) go();
    await turn();
    assert.equal(store.state.summary?.seconds, 60);
  } finally {
    mock.timers.reset();
  }
});
