// What came from somewhere else is kept once it has been made.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import type { PlateResult } from '../../src/model/state.js';
import { Untried } from '../../src/model/untried.js';

const made = (plate: Plate): PlateResult => ({ plate }) as PlateResult;
const other = (): Plate => newPlate();

test('a plate of somebody else’s is kept once it has been made; one of one’s own at once', async () => {
  const untried = new Untried();
  const [mine, changed, theirs] = [other(), other(), other()];
  assert.ok(untried.mayKeep({ plate: changed, result: made(mine) }, mine));
  await untried.during(() => {
    assert.ok(!untried.mayKeep({ plate: theirs, result: made(mine) }, changed));
    return Promise.resolve();
  });
  const edited = { ...theirs, layers: [] };
  assert.ok(!untried.mayKeep({ plate: edited, result: made(mine) }, theirs));
  assert.ok(untried.mayKeep({ plate: edited, result: made(edited) }, edited));
  assert.ok(untried.mayKeep({ plate: other(), result: made(edited) }, edited));
});

test('undone and redone it still waits', async () => {
  const untried = new Untried();
  const [mine, theirs] = [other(), other()];
  await untried.during(() => Promise.resolve(untried.mayKeep({ plate: theirs, result: made(mine) }, mine)));
  assert.ok(untried.mayKeep({ plate: mine, result: made(mine) }, theirs));
  assert.ok(!untried.mayKeep({ plate: theirs, result: made(mine) }, mine));
});

test('work that fails ends it', async () => {
  const untried = new Untried();
  const mine = other();
  await assert.rejects(untried.during(() => Promise.reject(new Error('no file'))));
  assert.ok(untried.mayKeep({ plate: other(), result: undefined }, mine));
});
