import assert from 'node:assert/strict';
import { test } from 'node:test';

import { pointsToDraw } from '../../src/views/thinned.js';

const cycle = (points: [number, number][], width: (k: number) => number = () => 0.4) => ({
  points: Float32Array.from(points.flat()),
  widths: Float32Array.from(points, (_, k) => width(k)),
});
const circle = (radius: number, count: number): [number, number][] =>
  Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
const kept = ({ points, widths }: ReturnType<typeof cycle>, tolerance: number) => [
  ...pointsToDraw(points, widths, tolerance),
];

void test('of a square as many points as it has corners, of tolerance 0 all', () => {
  const side = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];
  const square = cycle([
    ...side.map((x): [number, number] => [x, 0]),
    ...side.map((y): [number, number] => [10, y]),
    ...side.map((x): [number, number] => [10 - x, 10]),
    ...side.map((y): [number, number] => [0, 10 - y]),
  ]);
  assert.deepEqual(kept(square, 1e-6), [0, 10, 20, 30]);
  assert.deepEqual(kept(square, 0), [...square.widths.keys()]);
});

void test('of a circle chords that lie as far from it as they may, and turn no further than 30 degrees', () => {
  const tolerance = 0.01;
  for (const radius of [2, 10, 50]) {
    const found = kept(cycle(circle(radius, 5000)), tolerance).length;
    // A chord whose middle lies `s` inside, and as it may end anywhere within the tolerance, up to twice that.
    const chords = (s: number): number => Math.PI / Math.acos(1 - s / radius);
    assert.ok(found >= chords(2.01 * tolerance) && found <= chords(tolerance / 2), `${radius}: ${found}`);
  }
  assert.ok(kept(cycle(circle(0.02, 1000)), tolerance).length >= 12);
});

void test('a straight bead that grows wider evenly needs only its ends; a bulge stays', () => {
  const there = Array.from({ length: 100 }, (_, k): [number, number] => [k / 10, 0]);
  const back = Array.from({ length: 100 }, (_, k): [number, number] => [10 - k / 10, 5]);
  const even = cycle([...there, ...back], (k) => 0.4 + 0.001 * Math.min(k, 200 - k));
  assert.ok(kept(even, 1e-3).length <= 6);
  const bulge = cycle([...there, ...back], (k) => (k === 50 ? 0.6 : 0.4));
  assert.ok(kept(bulge, 1e-3).includes(50));
});

void test('no point that is left out lies further off than it may, on random paths', () => {
  let seed = 7;
  const random = (): number => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return seed / 2 ** 32;
  };
  for (let round = 0; round < 200; ++round) {
    const count = 3 + Math.floor(200 * random());
    let [x, y, angle] = [0, 0, 0];
    const { points, widths } = cycle(
      Array.from({ length: count }, () => {
        angle += (random() - 0.5) * (random() < 0.05 ? 6 : 0.3);
        const step = random() < 0.05 ? 0 : 0.3 * random();
        return [(x += step * Math.cos(angle)), (y += step * Math.sin(angle))];
      }),
      () => 0.4 + 0.02 * random(),
    );
    const tolerance = 0.03 * random();
    const found = [...pointsToDraw(points, widths, tolerance)];
    assert.equal(found[0], 0);
    found.push(count);
    const at = (k: number): [number, number, number] => [
      points[2 * (k % count)] ?? 0,
      points[2 * (k % count) + 1] ?? 0,
      widths[k % count] ?? 0,
    ];
    for (let k = 1; k < found.length; ++k) {
      const [from, to] = [found[k - 1] ?? 0, found[k] ?? 0];
      assert.ok(to > from);
      const [ax, ay, aw] = at(from);
      const [bx, by, bw] = at(to);
      const length2 = (bx - ax) ** 2 + (by - ay) ** 2;
      for (let j = from + 1; j < to; ++j) {
        const [px, py, pw] = at(j);
        const t = Math.min(1, Math.max(0, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length2));
        const off = Math.hypot(px - ax - t * (bx - ax), py - ay - t * (by - ay));
        assert.ok(off <= 1.01 * tolerance + 1e-6, `${off} of ${tolerance}`);
        assert.ok(Math.abs(pw - aw - t * (bw - aw)) / 2 <= 1.05 * tolerance + 1e-6);
      }
    }
  }
});
