// Frames are drawn one at a time where drawing is slow.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Pace } from '../../src/stage/pace.js';

/** Draws one frame that takes so long. */
async function frame(pace: Pace, ms: number, fineness = 1): Promise<void> {
  let clock = 0;
  await pace.follow(
    0,
    Promise.resolve().then(() => void (clock = ms)),
    fineness,
    () => clock,
  );
}

void test('three slow frames in a row tell a slow machine, three quick ones a quick one', async () => {
  const pace = new Pace(() => undefined);
  for (const ms of [100, 100, 10, 100, 100]) await frame(pace, ms);
  assert.equal(pace.slow, false);
  await frame(pace, 100);
  assert.equal(pace.slow, true);
  // A frame of a quarter of the pixels says how long a whole one takes.
  for (let k = 0; k < 5; ++k) await frame(pace, 20, 0.5);
  assert.equal(pace.slow, true);
  for (let k = 0; k < 3; ++k) await frame(pace, 5, 0.5);
  assert.equal(pace.slow, false);
});

void test('where it is slow a frame waits for the one before, and is drawn when that is there', async () => {
  let again = 0;
  const pace = new Pace(() => ++again);
  let come: () => void = () => undefined;
  const long = (): Promise<void> => pace.follow(0, new Promise((resolve) => (come = resolve)), 1, () => 100);
  const quick = long();
  assert.equal(pace.holds(), false, 'where it is quick none waits');
  come();
  await quick;
  for (let k = 0; k < 2; ++k) await frame(pace, 100);
  assert.equal(pace.slow, true);
  const flying = long();
  assert.equal(pace.holds(), true);
  assert.equal(again, 0);
  come();
  await flying;
  assert.equal(again, 1);
  assert.equal(pace.holds(), false);
});
