// How well a plate shows what its directions ask for, by beads of which that is known.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import type { Toolpath } from 'sillon';

import { newShape } from '../../src/model/defaults.js';
import { newPlate } from '../../src/model/new-plate.js';
import { doubtsOf, type Doubt, type Seen } from '../../src/model/doubts.js';
import { withFilament } from '../../src/model/filaments.js';
import { changeGround, filledWith, patternFills, pictureFills, type Fill } from '../../src/model/fills.js';
import { newLayer, withLayer } from '../../src/model/layer-list.js';
import type { Plate } from '../../src/model/plate.js';
import { seenOf } from '../../src/quality/seen.js';
import { fileOf, storeDegrees } from './support/pictures.js';

const side = 40; // [mm]
const page: Plate = { ...newPlate(), shape: newShape('rectangle'), width: side, height: side };
/** Under a light from 0°. */
const plate = filledWith(page, 'levels', { file: fileOf('two tones.png') });
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

test('tones are doubted, other directions and what lies under layers are not', () => {
  const seen = { r: 0.9, contrast: 4, kept: 0.9 };
  const doubted: Fill[] = ['levels', 'brightness', 'colours'];
  for (const fill of [...pictureFills, ...patternFills]) {
    const filled = filledWith(withFilament(page, 'bluePla'), fill, { file: fileOf('a.png') });
    const doubts = (change: Partial<Seen>): Doubt[] => doubtsOf(filled, undefined, { ...seen, ...change });
    const fine: Doubt[] = doubted.includes(fill) ? ['fine'] : [];
    assert.deepEqual([doubts({}), doubts({ r: 0.8 }), doubts({ kept: 0.3 })], [[], fine, fine], fill);
    assert.deepEqual(doubts({ contrast: 1.5, r: 0 }), doubted.includes(fill) ? ['faint'] : [], fill);
    assert.deepEqual(doubtsOf(filled, undefined, undefined), [], fill);
  }
  const bad = { r: 0, contrast: 1, kept: 0 };
  assert.deepEqual(doubtsOf(withLayer(plate, newLayer(plate, 'border')), undefined, bad), []);
  const lacking = withLayer(plate, newLayer(plate, 'drawing'));
  assert.deepEqual(doubtsOf(lacking, undefined, bad), ['faint']); // nothing of that layer is drawn
  const hidden = changeGround(plate, { visible: false });
  assert.deepEqual(doubtsOf(hidden, undefined, bad), []);
  assert.deepEqual(doubtsOf(withLayer(hidden, newLayer(plate, 'border')), undefined, bad), []);
});
