// A new box lies where nothing else does.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { freePlace, freePlaceOn } from '../../src/layers/free-place.js';
import type { Room } from '../../src/layers/room.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Taken, Wanted } from '../../src/model/free-place.js';
import type { Point } from '../../src/model/layer-frame.js';

const side = 200;
const page: Point = [40, 40];
const roomOf = (inside: (x: number, y: number) => boolean): Room => ({
  ...{ width: side, height: side, key: 0 },
  inside: Uint8Array.from({ length: side * side }, (_, k) =>
    inside(((k % side) + 0.5) / 5, page[1] - (Math.floor(k / side) + 0.5) / 5) ? 1 : 0,
  ),
});
const square = roomOf(() => true);
const disc = roomOf((x, y) => Math.hypot(x - 20, y - 20) < 20);
const box = (x: number, y: number, wide: number, tall: number, free = 0): Taken => ({
  ...{ middle: [x, y], size: [wide, tall], turn: 0, free },
});
const wanted = (wide: number, tall: number, more: Partial<Wanted> = {}): Wanted => ({
  ...{ size: [wide, tall], gap: 1, edge: 0, least: 0.5 },
  ...more,
});
const apart = (a: Taken, b: Taken): number =>
  Math.max(...([0, 1] as const).map((k) => Math.abs(a.middle[k] - b.middle[k]) - (a.size[k] + b.size[k]) / 2));

test('the first lies in the middle, the second just below it, the third just above', () => {
  assert.deepEqual(freePlace(square, page, [], wanted(16, 7)).middle.map(Math.round), [20, 20]);
  const first = box(20, 20, 16, 7);
  const { middle, scale } = freePlace(square, page, [first], wanted(16, 7));
  assert.equal(scale, 1);
  assert.ok(Math.abs(middle[0] - 20) < 0.3 && Math.abs(middle[1] - 12) < 0.5, String(middle));
  const third = freePlace(square, page, [first, box(middle[0], middle[1], 16, 7)], wanted(16, 7));
  assert.ok(third.middle[1] > 27.5 && third.scale === 1, String(third.middle));
});

test('five texts in a disc lie apart and inside of it, none smaller than allowed', () => {
  const texts: Taken[] = [box(20, 20, 15, 7)];
  for (let k = 1; k < 5; ++k) {
    const { middle, scale } = freePlace(disc, page, texts, wanted(15, 7));
    assert.ok(scale >= 0.5);
    texts.push({ ...box(20, 20, 15 * scale, 7 * scale), middle });
  }
  texts.forEach((one, k) => {
    for (const other of texts.slice(k + 1)) assert.ok(apart(one, other) > 0.4, JSON.stringify([one, other]));
    const corner = Math.hypot(
      Math.abs(one.middle[0] - 20) + one.size[0] / 2,
      Math.abs(one.middle[1] - 20) + one.size[1] / 2,
    );
    assert.ok(corner < 20, JSON.stringify(one));
  });
});

test('what is turned, and a circle of letters, take no more than they cover', () => {
  const ring = box(20, 20, 40, 40, 14);
  const inside = freePlace(disc, page, [ring], wanted(12, 5));
  assert.deepEqual(inside.middle.map(Math.round), [20, 20]);
  assert.equal(inside.scale, 1);
  const turned: Taken = { ...box(20, 20, 50, 3), turn: 45 };
  const beside = freePlace(square, page, [turned], wanted(10, 10));
  assert.equal(beside.scale, 1);
  assert.ok(Math.abs(beside.middle[0] - beside.middle[1]) > 12, String(beside.middle));
});

test('nothing lies under a border, and a box becomes smaller before it lies over another', () => {
  const edged = freePlace(square, page, [box(20, 25, 40, 30)], wanted(10, 6, { edge: 3 }));
  assert.ok(edged.middle[1] - (edged.scale * 6) / 2 >= 3, JSON.stringify(edged));
  assert.ok(edged.middle[1] + (edged.scale * 6) / 2 <= 10, JSON.stringify(edged));
  const small = freePlace(square, page, [box(20, 24, 40, 32)], wanted(10, 8));
  assert.ok(small.scale < 0.8 && small.scale > 0.6, String(small.scale));
});

test('where there is no room it lies over others as little as it can, and off the shape last', () => {
  const full = [box(20, 20, 40, 40), box(10, 20, 20, 40)];
  const { middle, scale } = freePlace(square, page, full, wanted(12, 12));
  assert.equal(scale, 0.5);
  assert.ok(middle[0] > 22, String(middle));
  const edge = freePlace(disc, page, [box(20, 20, 40, 40)], wanted(8, 8, { least: 1 }));
  assert.ok(Math.hypot(edge.middle[0] - 20, edge.middle[1] - 20) < 0.5);
});

test('a shape that cannot be read is guessed', async () => {
  const plate = { ...newPlate(), width: 40, height: 40 };
  const failed = Promise.reject<Room>(new Error('no engine'));
  const { middle, scale } = await freePlaceOn(plate, failed, [box(20, 20, 16, 7)], wanted(16, 7));
  assert.equal(scale, 1);
  assert.ok(Math.abs(middle[1] - 12) < 0.7, String(middle));
});
