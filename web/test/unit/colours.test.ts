// A direction for each flat colour.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { createEngine } from 'sillon';

import { newShape } from '../../src/model/defaults.js';
import { filledWith } from '../../src/model/fills.js';
import { directionsFor, flatColours } from '../../src/model/flat-colours.js';
import { engineInput } from '../../src/model/input.js';
import { newPlate } from '../../src/model/new-plate.js';
import { colourPicture, degreesOf, fileOf } from './support/pictures.js';

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

test('each place of a picture runs as its colour says, edges as what is beside them', async () => {
  const engine = await createEngine({ threads: 'off' });
  try {
    const colours = [
      { colour: '#0000ff', angle: 10 },
      { colour: '#ff0000', angle: -80 },
      { colour: '#ffffff', angle: 45 },
    ];
    const page = { ...newPlate(), shape: newShape('rectangle'), width: 60, height: 30 };
    const plate = filledWith(page, 'colours', { file: fileOf('flag.png'), colours });
    const { input, params } = engineInput(plate);
    const layers = (input.layers ?? []).map((layer) => ({ ...layer, file: flag }));
    const { width, height, angle } = await engine.drawLayers({ ...input, layers }, params);
    for (let x = 0; x < width; ++x) {
      const at = ((x + 0.5) * 60) / width;
      const found = degreesOf(angle[(height >> 1) * width + x] as number);
      const wanted = at < 20 ? [10] : at < 21 ? [10, 45] : at < 40 ? [45] : at < 41 ? [45, -80] : [-80];
      assert.ok(
        wanted.some((one) => Math.abs(one - found) < 0.01),
        `${found} at ${at}, of ${width} texels`,
      );
    }
  } finally {
    engine.dispose();
  }
});
