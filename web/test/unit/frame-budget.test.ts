// Whose turn it is to be drawn: on a clock of its own, so that nothing here is a matter of speed.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { FrameBudget, type Waiting } from '../../src/embed/frame-budget.js';

const frameSpan = 1000 / 60; // [ms]

/** Frames of a page with such views. @returns names drawn in each frame, and the share of the time that drawing took */
function frames(count: number, cost: number, views: readonly (Partial<Waiting> & { name: string })[]) {
  let clock = 0;
  const budget = new FrameBudget(() => clock);
  const drawnAt = new Map<string, number>();
  const drawn: string[][] = [];
  let spent = 0;
  for (let k = 0; k < count; ++k) {
    const names: string[] = [];
    const now = k * frameSpan;
    budget.spend(
      views.map(({ name, why = 'orbits', fromMiddle = () => 0 }) => ({
        why,
        fromMiddle,
        drawnAt: drawnAt.get(name) ?? 0,
        draw() {
          names.push(name);
          drawnAt.set(name, now + 1);
          clock += cost;
          spent += cost;
        },
      })),
    );
    drawn.push(names);
  }
  return { drawn, share: spent / (count * frameSpan) };
}

const named = (count: number, why: Waiting['why'] = 'orbits') =>
  Array.from({ length: count }, (_, k) => ({ name: String(k), why, fromMiddle: () => k }));

test('cheap pictures: all orbit, at most twelve are drawn in a frame, in turn', () => {
  const { drawn } = frames(40, 0.05, named(24));
  for (const names of drawn) assert.equal(names.length, 12);
  const counts = new Map<string, number>();
  for (const name of drawn.flat()) counts.set(name, (counts.get(name) ?? 0) + 1);
  assert.equal(counts.size, 24);
  assert.deepEqual(new Set(counts.values()), new Set([20]));
});

test('pictures of less than the share take it and no more', () => {
  const { drawn, share } = frames(2000, 3, named(24));
  assert.ok(share > 0.1 && share < 0.25, String(share));
  assert.ok(drawn.every(({ length }) => length <= 2));
});

for (const cost of [15, 60, 400]) {
  test(`pictures of ${cost} ms: one a frame at most, and a sixth of all frames is lost at most`, () => {
    const { drawn } = frames(2000, cost, named(24));
    assert.ok(drawn.every(({ length }) => length <= 1));
    const lost = drawn.flat().length * Math.ceil((cost - 4) / frameSpan);
    assert.ok(lost > 0 && lost / (drawn.length + lost) <= 1 / 6, String(lost));
  });
}

test('dear pictures: only the one in the middle of the window orbits', () => {
  const { drawn } = frames(600, 15, named(24));
  const late = drawn.slice(300).flat();
  assert.ok(late.length > 10);
  assert.deepEqual(new Set(late), new Set(['0']));
});

test('what somebody moves comes first, then what is wrong, then what moves by itself', () => {
  const views = [...named(3), { name: 'wrong', why: 'stale' as const }, { name: 'led', why: 'led' as const }];
  assert.deepEqual(frames(1, 0.1, views).drawn[0]?.slice(0, 2), ['led', 'wrong']);
  assert.deepEqual(frames(1, 15, views).drawn, [['led']]);
});

test('nothing waits, nothing is drawn', () => {
  assert.deepEqual(frames(3, 1, []).drawn, [[], [], []]);
});
