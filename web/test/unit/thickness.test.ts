// A plate is as thick as its layers together, and takes the nearest thickness that they allow.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import { thicknessOf, withThickness } from '../../src/model/thickness.js';

const plateOf = (print: Partial<Plate['print']>): Plate => {
  const plate = newPlate();
  return { ...plate, print: { ...plate.print, ...print } };
};
const near = (a: number, b: number): boolean => Math.abs(a - b) < 1e-9;

test('layers add up to the thickness, and the rim is no part of it', () => {
  assert.ok(near(thicknessOf(plateOf({ layers: 1, base: 2, layerHeight: 0.2, firstLayerHeight: 0 })), 0.6));
  assert.ok(near(thicknessOf(plateOf({ layers: 1, base: 2, layerHeight: 0.2, firstLayerHeight: 0.3 })), 0.7));
  assert.ok(near(thicknessOf(plateOf({ layers: 2, base: 3, layerHeight: 0.2, showSide: 'both' })), 1.4));
  assert.ok(near(thicknessOf(plateOf({ layers: 1, base: 2, layerHeight: 0.2, rim: 9 })), 0.6));
  // On a body that is there already, no layer is the first.
  assert.ok(near(thicknessOf(plateOf({ base: 2, layerHeight: 0.2, firstLayerHeight: 0.3, startHeight: 4 })), 0.6));
});

test('the bottom makes up for a thickness, to half a layer', () => {
  for (const print of [
    {},
    { firstLayerHeight: 0.28 },
    { layers: 3, showSide: 'both' as const },
    { layerHeight: 0.12 },
  ]) {
    const plate = plateOf(print);
    const least = thicknessOf(plateOf({ ...print, base: 0 }));
    for (const wanted of [0.6, 1, 2, 3, 7.77]) {
      const made = withThickness(plate, wanted);
      assert.deepEqual({ ...made.print, base: 0 }, { ...plate.print, base: 0 });
      const off = Math.abs(thicknessOf(made) - Math.max(wanted, least));
      assert.ok(off <= plate.print.layerHeight / 2 + 1e-9, `${wanted} is ${thicknessOf(made)}`);
    }
  }
  assert.equal(withThickness(plateOf({}), 0).print.base, 0);
  assert.ok(withThickness(plateOf({}), 1e6).print.base <= 1000);
});
