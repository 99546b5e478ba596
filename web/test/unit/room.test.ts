import assert from 'node:assert/strict';
import { test } from 'node:test';

import { placeIn, type Room } from '../../src/layers/room.js';

const side = 300;
const roomOf = (inside: (x: number, y: number) => boolean, [width, height] = [side, side]): Room => ({
  width,
  height,
  key: 0,
  inside: Uint8Array.from({ length: width * height }, (_, k) =>
    inside(((k % width) + 0.5) / width, (Math.floor(k / width) + 0.5) / height) ? 1 : 0,
  ),
});
const near = (found: number, wanted: number): void => {
  assert.ok(Math.abs(found - wanted) < 0.012, `${found} instead of ${wanted}`);
};

void test('what fits as it is stays so, in the middle', () => {
  assert.deepEqual(
    placeIn(
      0.4,
      0.2,
      roomOf(() => true),
    ),
    { scale: 1, x: 0.5, y: 0.5 },
  );
});

void test('a square in a disc, in a triangle, and in an L: as large as geometry lets it be', () => {
  const disc = placeIn(
    1,
    1,
    roomOf((x, y) => Math.hypot(x - 0.5, y - 0.5) < 0.5),
  );
  near(disc.scale, Math.SQRT1_2);
  near(disc.x, 0.5);
  // Below the line from the upper left to the lower right corner, legs 1: the square of side 1/2 in its right angle.
  const triangle = placeIn(
    1,
    1,
    roomOf((x, y) => y > x),
  );
  near(triangle.scale, 0.5);
  near(triangle.x, 0.25);
  near(triangle.y, 0.75);
  // Of an L, each of whose bars is 0.4 wide.
  const angle = placeIn(
    1,
    1,
    roomOf((x, y) => x < 0.4 || y > 0.6),
  );
  near(angle.scale, 0.4);
});

void test('a line of letters finds the wide bar of a T', () => {
  const found = placeIn(
    0.9,
    0.15,
    roomOf((x, y) => y < 0.25 || Math.abs(x - 0.5) < 0.1),
  );
  assert.equal(found.scale, 1);
  assert.ok(found.y < 0.18, String(found.y));
});

void test('where nothing fits, it lies in the middle, and nothing hangs', () => {
  assert.deepEqual(
    placeIn(
      1,
      1,
      roomOf(() => false),
    ),
    { scale: 1, x: 0.5, y: 0.5 },
  );
});
