// A direction for each flat colour.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { degreesOf } from '../../src/generators/angle.js';
import { coloursAngles } from '../../src/generators/colours.js';
import { Unfit } from '../../src/model/check.js';
import { directionsFrom } from '../../src/model/check-plate.js';
import { newColours } from '../../src/model/defaults.js';
import { directionsFor, flatColours } from '../../src/model/flat-colours.js';
import { colourPicture, fileOf } from './support/pictures.js';

const file = fileOf('flag.svg');
type Colour = [number, number, number];
const blue: Colour = [0, 0, 1];
const white: Colour = [1, 1, 1];
const red: Colour = [1, 0, 0];

/** Three upright bands, softly parted as browsers draw them. */
const flag = colourPicture(60, 30, (x) => {
  const mix = (a: Colour, b: Colour): Colour => a.map((value, k) => (value + (b[k] as number)) / 2) as Colour;
  if (x === 20) return mix(blue, white);
  if (x === 40) return mix(white, red);
  return x < 20 ? blue : x < 40 ? white : red;
});

test('flat colours are found from dark to light, and edges between them are none', () => {
  assert.deepEqual(flatColours(flag), ['#0000ff', '#ff0000', '#ffffff']);
});

test('what is not painted is no colour, and specks are none', () => {
  const picture = { ...flag, channels: 4 as const, samples: new Uint8Array(4 * 60 * 30) };
  for (let k = 0; k < 60 * 30; ++k) picture.samples.set(k % 60 < 30 ? [9, 99, 199, 255] : [200, 0, 0, 0], 4 * k);
  picture.samples.set([0, 255, 0, 255], 4 * (5 * 60 + 5));
  assert.deepEqual(flatColours(picture), ['#0963c7']);
});

test('a gradient gives a few steps', () => {
  const found = flatColours(colourPicture(256, 16, (x) => [x / 255, x / 255, x / 255]));
  assert.ok(found.length >= 3 && found.length <= 12, String(found));
});

test('dark colours get the direction that is dark under the usual light; what was chosen stays', () => {
  const found = flatColours(flag);
  assert.deepEqual(
    directionsFor(found).map(({ angle }) => angle),
    [60, 105, 150],
  );
  assert.deepEqual(
    directionsFor(found, [{ colour: '#ff0000', angle: -20 }]).map(({ angle }) => angle),
    [60, -20, 150],
  );
  assert.deepEqual(
    directionsFor(['#123456']).map(({ angle }) => angle),
    [150],
  );
});

test('each texel runs as its colour says, edges as what is beside them', () => {
  const source = newColours(file, [
    { colour: '#0000ff', angle: 10 },
    { colour: '#ff0000', angle: -80 },
    { colour: '#ffffff', angle: 45 },
  ]);
  for (const size of [
    { width: 60, height: 30 },
    { width: 240, height: 120 },
    { width: 30, height: 15 },
  ]) {
    const angles = coloursAngles(source, size, flag);
    for (let x = 0; x < size.width; ++x) {
      const at = ((x + 0.5) * 60) / size.width;
      const angle = degreesOf(angles[(size.height >> 1) * size.width + x] as number);
      const wanted = at < 20 ? [10] : at < 21 ? [10, 45] : at < 40 ? [45] : at < 41 ? [45, -80] : [-80];
      assert.ok(
        wanted.some((one) => Math.abs(one - angle) < 0.01),
        `${angle} at ${at}, of ${size.width} texels`,
      );
    }
  }
});

test('around what is painted go the directions of its rim', () => {
  const picture = { width: 8, height: 8, channels: 4 as const, samples: new Uint8Array(4 * 64) };
  for (let y = 2; y < 6; ++y) for (let x = 2; x < 6; ++x) picture.samples.set([0, 0, 0, 255], 4 * (8 * y + x));
  const angles = coloursAngles(newColours(file, [{ colour: '#000000', angle: 30 }]), picture, picture);
  assert.ok(angles.every((angle) => Math.abs(degreesOf(angle) - 30) < 0.01));
  const none = coloursAngles(newColours(file, []), picture, picture);
  assert.ok(none.every((angle) => degreesOf(angle) === degreesOf(32768)));
});

test('what comes from elsewhere is read only as far as the panel could have set it', () => {
  const told = newColours(file, [{ colour: '#00ff00', angle: 12 }]);
  const read = (changed: object): unknown => directionsFrom({ ...told, ...changed }, () => file);
  assert.deepEqual(read({}), told);
  for (const colours of [
    [{ colour: 'red', angle: 0 }],
    [{ colour: '#00ff00', angle: 1000 }],
    [{ colour: '#00ff00', angle: 0, more: 1 }],
    Array.from({ length: 13 }, () => ({ colour: '#00ff00', angle: 0 })),
    'none',
  ]) {
    assert.throws(() => read({ colours }), Unfit, JSON.stringify(colours));
  }
  assert.throws(() => directionsFrom(told), Unfit); // no files where none are allowed
});
