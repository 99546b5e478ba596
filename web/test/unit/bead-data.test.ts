// A path as the renderer's shaders read it, laid out in slices.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { beadData, columns, segmentsPerRun } from '../../src/views/bead-data.js';
import { inSlices } from '../../src/views/slices.js';

/** A wave of so many points. */
const cycleOf = (count: number) => ({
  points: Float32Array.from({ length: 2 * count }, (_, k) => (k % 2 === 0 ? k / 20 : 5 * Math.sin(k / 400))),
  widths: Float32Array.from({ length: count }, () => 0.4),
});

function drained<Result>(work: Generator<undefined, Result>): { steps: number; result: Result } {
  for (let steps = 0; ; ++steps) {
    const next = work.next();
    if (next.done === true) return { steps, result: next.value };
  }
}

void test('a long path is laid out in steps; each segment finds its neighbours', () => {
  const cycles = [cycleOf(30_000), cycleOf(3)];
  const { steps, result } = drained(beadData({ cycles }, 0));
  assert.ok(steps >= 6, `${steps} steps`);
  const { rows, points, runs, delays } = result;
  assert.equal(points.length, 4 * columns * rows);
  assert.equal(delays.length, 2);
  assert.deepEqual(
    runs.map(({ segments }) => segments),
    [...Array.from({ length: 7 }, () => segmentsPerRun), 30_000 - 7 * segmentsPerRun, 3],
  );
  const at = (k: number): number[] => [...points.subarray(4 * k, 4 * k + 2)];
  const [first] = cycles;
  assert.deepEqual(at(1), [...(first?.points.subarray(0, 2) ?? [])]);
  assert.deepEqual(at(0), [...(first?.points.subarray(-2) ?? [])]); // before the first comes the last
  assert.deepEqual(at(30_001), at(1)); // and after the last the first
  const shares = [0, 1, 30_000, 30_004, 30_006].map((k) => points[4 * k + 3]);
  assert.deepEqual(
    shares.map((share) => Math.round(30_003 * (share ?? NaN))),
    [0, 0, 29_999, 30_000, 30_002],
  );
});

void test('parts of a cycle are thinned as the whole, but for one point where they meet', () => {
  const cycles = [cycleOf(30_000)];
  const { runs } = drained(beadData({ cycles }, 0.01)).result;
  const segments = runs.reduce((sum, run) => sum + run.segments, 0);
  assert.ok(segments > 100 && segments < 3000, `${segments}`);
});

void test('what is done in slices is done when it is asked for, and never after it was stopped', async () => {
  function* count(to: number): Generator<undefined, number> {
    for (let k = 0; k < to; ++k) yield;
    return to;
  }
  const told: number[] = [];
  inSlices(count(3), (n) => told.push(n));
  assert.deepEqual(told, [3], 'a short one is done at once');
  const busy = function* (): Generator<undefined, number> {
    for (const end = performance.now() + 30; performance.now() < end;) yield;
    return 30;
  };
  const long = inSlices(busy(), (n) => told.push(n));
  assert.deepEqual(told, [3]);
  assert.equal(long.finish(), 30);
  assert.deepEqual(told, [3, 30]);
  inSlices(busy(), (n) => told.push(n)).stop();
  await new Promise((resolve) => setTimeout(resolve, 60));
  assert.deepEqual(told, [3, 30]);
  await new Promise<void>((resolve) => {
    inSlices(busy(), () => {
      resolve();
    });
  });
});
