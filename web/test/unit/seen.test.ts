// How well a plate shows what its directions ask for, by beads of which that is known.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import type { Toolpath } from 'sillon';

import { storeDegrees } from '../../src/generators/angle.js';
import { newGenerator, newPlate, newShape } from '../../src/model/defaults.js';
import { doubtsOf } from '../../src/model/doubts.js';
import type { Plate } from '../../src/model/plate.js';
import { seenOf } from '../../src/quality/seen.js';

const side = 40; // [mm]
const plate: Plate = {
  ...newPlate(),
  shape: newShape('rectangle'),
  width: side,
  height: side,
  directions: newGenerator('text'),
};
const { spacing } = plate.toolpath;

/** The left half runs one way, the right half another [degrees]. */
const raster = (left: number, right: number) => ({
  width: 64,
  height: 64,
  angle: Uint16Array.from({ length: 64 * 64 }, (_, k) => storeDegrees(k % 64 < 32 ? left : right)),
  mode: new Uint8Array(64 * 64).fill(3),
});

/** Straight beads, level or upright, in each half. */
function beads(left: 'level' | 'upright', right: 'level' | 'upright'): Toolpath {
  const points: number[][] = [];
  const half = (from: number, how: 'level' | 'upright'): void => {
    const count = how === 'level' ? side / spacing : side / 2 / spacing;
    for (let k = 0; k < count; ++k) {
      const at = (k + 0.5) * spacing;
      points.push(how === 'level' ? [from, at, from + side / 2, at] : [from + at, 0, from + at, side]);
    }
  };
  half(0, left);
  half(side / 2, right);
  const cycles = points.map((one) => ({ points: Float32Array.from(one), widths: new Float32Array(2) }));
  return { cycles } as unknown as Toolpath;
}

test('beads that run as they are asked to show it all', () => {
  const seen = seenOf({ plate, toolpath: beads('level', 'upright') }, raster(0, 90));
  assert.ok(seen.r > 0.99, String(seen.r));
  assert.ok(Math.abs(seen.contrast - 1 / 0.16) < 0.3, String(seen.contrast));
  assert.deepEqual(doubtsOf(plate, undefined, seen), []);
});

test('what is finer than two beads is not kept', () => {
  const stripes = (wide: number) => {
    const texels = 800; // 20 a millimetre
    const angle = Uint16Array.from({ length: texels * texels }, (_, k) =>
      storeDegrees(Math.floor((k % texels) / (20 * wide)) % 2 === 0 ? 0 : 90),
    );
    return { width: texels, height: texels, angle, mode: new Uint8Array(angle.length) };
  };
  const toolpath = beads('level', 'upright');
  assert.ok(seenOf({ plate, toolpath }, stripes(4 * spacing)).kept > 0.99); // a cell lies in one stripe
  assert.ok(seenOf({ plate, toolpath }, stripes(spacing)).kept < 0.01); // and here in two
});

test('beads that run one way alone show nothing', () => {
  const seen = seenOf({ plate, toolpath: beads('level', 'level') }, raster(0, 90));
  assert.ok(Math.abs(seen.r) < 0.01 && Math.abs(seen.contrast - 1) < 0.01);
  assert.deepEqual(doubtsOf(plate, undefined, seen), ['faint']);
});

test('beads that run the other way show the opposite', () => {
  assert.ok(seenOf({ plate, toolpath: beads('upright', 'level') }, raster(0, 90)).r < -0.99);
});

test('letters that are far too small are told as such, whatever the beads show, and so is a text of nothing', () => {
  const seen = { r: 0, contrast: 1, kept: 0.1 };
  assert.deepEqual(doubtsOf(plate, undefined, { ...seen, letters: 7 * spacing }), ['small']);
  assert.deepEqual(doubtsOf(plate, undefined, { ...seen, letters: 8 * spacing }), ['faint']);
  const blank = { ...plate, directions: { ...newGenerator('text'), text: ' \n' } } as Plate;
  assert.deepEqual(doubtsOf(blank, undefined, undefined), ['blank']);
});

test('letters are doubted sooner than pictures, and other directions not at all', () => {
  const seen = { r: 0.9, contrast: 4, kept: 0.9 };
  const levels = { ...plate, directions: { kind: 'levels' } } as unknown as Plate;
  assert.deepEqual(doubtsOf(plate, undefined, seen), ['letters']);
  assert.deepEqual(doubtsOf(levels, undefined, seen), []);
  assert.deepEqual(doubtsOf(levels, undefined, { ...seen, r: 0.8 }), ['fine']);
  assert.deepEqual(
    doubtsOf({ ...plate, directions: newGenerator('waves') }, undefined, { r: 0, contrast: 1, kept: 0 }),
    [],
  );
  assert.deepEqual(doubtsOf(levels, undefined, { ...seen, kept: 0.3 }), ['fine']);
});
