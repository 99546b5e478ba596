// The ground of a plate, what it may be filled with, and what of it is left when something else is tried.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { createEngine, type DirectionRaster, type Engine } from 'sillon';
import {
  changeGround,
  filledWith,
  fillOf,
  groundFill,
  groundOf,
  groundPictures,
  isPictureFill,
  newFill,
  patternFills,
  pictureFills,
  withGround,
  type Fill,
} from '../../src/model/fills.js';
import { engineInput } from '../../src/model/input.js';
import { mostLayers, newLayer, withLayer } from '../../src/model/layer-list.js';
import type { LayerValues } from '../../src/model/layers.js';
import { filesFor, leaving, leftOf, nothingLeft } from '../../src/model/left.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate, SourceFile } from '../../src/model/plate.js';
import { newShape } from '../../src/model/defaults.js';
import { sourceFile } from '../../src/files/source-file.js';
import { between, degreesOf, fileOf } from './support/pictures.js';
import { encodeGreyPng } from './support/png16.js';

const [cat, dog] = [fileOf('cat.png'), fileOf('dog.png')];
const fills: readonly Fill[] = [...pictureFills, ...patternFills];
const text = newLayer(newPlate(), 'text', { text: 'A' });
const layersOnly = (...layers: LayerValues[]): Plate => layers.reduce(withLayer, { ...newPlate(), layers: [] });

/** What a fill is told from, where it needs any file. */
const told = (fill: Fill, file: SourceFile): Partial<LayerValues> =>
  fill === 'picture' ? { pictures: [{ file, lamp: null }] } : isPictureFill(fill) ? { file } : {};

describe('the ground', () => {
  test('is the lowest layer, where that fills the page', () => {
    for (const fill of fills) {
      const plate = withLayer(layersOnly(newFill(newPlate(), fill, told(fill, cat))), text);
      assert.equal(groundOf(plate), plate.layers[0], fill);
      assert.equal(groundFill(plate), fill);
      assert.equal(fillOf(plate.layers[0] as LayerValues), fill);
    }
  });

  const waves = newFill(newPlate(), 'waves');
  const others: [string, LayerValues[]][] = [
    ['no layer at all', []],
    ['letters', [text]],
    ['an echo', [newFill(newPlate(), 'radial', {}), text].map((one) => ({ ...one, pattern: 'echo' as const }))],
    ['strokes', [newLayer(newPlate(), 'strokes'), waves]],
    ['a border', [newLayer(newPlate(), 'border'), waves]],
    ['a layer with a size', [{ ...waves, size: [10, 0] }]],
    ['a layer elsewhere', [{ ...waves, at: [1, 2] }]],
    ['a layer that is turned', [{ ...waves, rotation: 10 }]],
    ['a layer in a disc', [{ ...waves, mask: 'disc' }]],
    ['a layer behind a mask', [{ ...waves, mask: 'inside', maskFile: cat }]],
  ];
  for (const [what, layers] of others) {
    test(`is none where the lowest is ${what}`, () => {
      const plate = layersOnly(...layers);
      assert.equal(groundOf(plate), undefined);
      assert.equal(groundFill(plate), undefined);
      assert.deepEqual(groundPictures(plate), []);
      assert.equal(changeGround(plate, { angle: 7 }), plate);
    });
  }

  test('of the mask "page" fills the page wherever it lies', () => {
    const plate = layersOnly({ ...waves, mask: 'page', at: [1, 2], rotation: 10 });
    assert.equal(groundOf(plate), plate.layers[0]);
  });

  test('is found while it is hidden, or lacks its picture', () => {
    const lacking = layersOnly(newFill(newPlate(), 'picture'), text);
    assert.equal(groundFill(lacking), 'picture');
    assert.deepEqual(groundPictures(lacking), []);
    const shown = changeGround(lacking, told('picture', cat));
    assert.deepEqual(groundPictures(shown), [{ file: cat, lamp: null }]);
    assert.deepEqual(groundPictures(changeGround(shown, { visible: false })), []);
  });
});

describe('filling', () => {
  test('changes the ground alone, in its place', () => {
    const plate = withLayer(newPlate(), text);
    for (const fill of fills) {
      const filled = filledWith(plate, fill, told(fill, cat));
      assert.equal(groundFill(filled), fill);
      assert.deepEqual(
        filled.layers.map(({ id }) => id),
        [1, 2],
      );
      assert.equal(filled.layers[1], plate.layers[1]);
    }
  });

  test('keeps what beads may do', () => {
    const plate = changeGround(newPlate(), { mode: 'smoothest', modeFile: dog, angle: 12 });
    const { mode, modeFile, angle } = groundOf(filledWith(plate, 'radial')) ?? assert.fail();
    assert.deepEqual([mode, modeFile, angle], ['smoothest', dog, 0]);
    assert.equal(groundOf(filledWith(plate, 'radial', { mode: 'parallel' }))?.mode, 'parallel');
  });

  test('lays a ground under what is there', () => {
    const plate = layersOnly(text, newLayer(newPlate(), 'border'));
    const filled = filledWith(plate, 'direction', { angle: 30 });
    assert.deepEqual(
      filled.layers.map(({ kind, id }) => [kind, id]),
      [
        ['direction', 3],
        ['text', 1],
        ['border', 2],
      ],
    );
    const full = layersOnly(...Array<LayerValues>(mostLayers).fill(text));
    assert.equal(filledWith(full, 'direction'), full); // there is no room for one more
    const rim = withGround(layersOnly(newFill(newPlate(), 'noise'), ...full.layers.slice(1)), newFill(full, 'waves'));
    assert.deepEqual([rim.layers.length, groundFill(rim)], [mostLayers, 'waves']);
  });
});

describe('what was left', () => {
  test('comes back without its file being asked for', () => {
    const begun = filledWith(newPlate(), 'brightness', { file: cat, from: 12 });
    const left = leaving(begun, nothingLeft);
    const waves = filledWith(begun, 'waves');
    assert.deepEqual(filesFor(waves, left), [cat]);
    const before = leftOf(left, 'brightness', cat);
    assert.equal(before?.from, 12);
    assert.deepEqual(withGround(waves, before), begun);
  });

  test('is the plate’s own file first, then those of the last fill', () => {
    const one = filledWith(newPlate(), 'brightness', { file: cat });
    const two = filledWith(newPlate(), 'picture', { pictures: [cat, dog].map((file) => ({ file, lamp: null })) });
    const left = leaving(two, leaving(one, nothingLeft));
    assert.deepEqual(filesFor(newPlate(), left), [cat, dog, cat]);
    assert.deepEqual(filesFor(filledWith(newPlate(), 'edges', { file: dog }), left), [dog, cat, dog, cat]);
    assert.deepEqual(filesFor(newPlate(), leaving(one, left)), [cat, cat, dog]); // left again: it is the last
    assert.deepEqual(filesFor(layersOnly(text), nothingLeft), []);
  });

  test('counts for its own file alone', () => {
    const left = leaving(filledWith(newPlate(), 'edges', { file: cat, smoothing: 3 }), nothingLeft);
    assert.equal(leftOf(left, 'edges', cat)?.smoothing, 3);
    assert.equal(leftOf(left, 'edges', dog), undefined);
    assert.equal(leftOf(left, 'edges', undefined), undefined);
    assert.equal(leftOf(left, 'levels', cat), undefined);
    const two = filledWith(newPlate(), 'picture', { pictures: [cat, dog].map((file) => ({ file, lamp: [1, 2] })) });
    for (const file of [cat, dog]) assert.equal(leftOf(leaving(two, left), 'picture', file), groundOf(two));
    assert.equal(leftOf(leaving(two, left), 'picture', fileOf('owl.png')), undefined);
    const waves = leaving(filledWith(newPlate(), 'waves', { amplitude: 7 }), left);
    assert.equal(leftOf(waves, 'waves', undefined)?.amplitude, 7);
    assert.equal(leftOf(waves, 'waves', cat)?.amplitude, 7); // it is told from no file
  });

  test('is nothing where a plate has no ground', () => {
    assert.equal(leaving(layersOnly(text), nothingLeft), nothingLeft);
  });
});

describe('as the engine draws them', () => {
  let engine: Engine;
  let ramp: SourceFile;
  before(async () => {
    engine = await createEngine({ threads: 'off' });
    const samples = Uint8Array.from({ length: 64 * 64 }, (_, k) => 4 * (k % 64));
    const png = await encodeGreyPng(64, 64, samples);
    ramp = await sourceFile('ramp.png', new Uint8Array(await png.arrayBuffer()));
  });
  after(() => {
    engine.dispose();
  });

  const side = 40; // [mm]
  const plate: Plate = { ...newPlate(), shape: newShape('rectangle'), width: side, height: side };
  const drawn = (filled: Plate): Promise<DirectionRaster> => {
    const { input, params } = engineInput(filled);
    return engine.drawLayers(input, params);
  };
  /** At a place in mm from the lower left corner, and the place in the middle of that texel. */
  const at = ({ width, height, angle }: DirectionRaster, x: number, y: number) => {
    const [column, row] = [Math.floor((x / side) * width), Math.floor((1 - y / side) * height)];
    const middle = [((column + 0.5) / width) * side, (1 - (row + 0.5) / height) * side] as const;
    return { degrees: degreesOf(angle[row * width + column] ?? NaN), middle };
  };
  const places = [
    [3, 5],
    [31, 4],
    [12, 33],
    [36, 37],
    [24, 9],
  ] as const;

  test('each begins with directions that the engine takes', async () => {
    for (const fill of fills) {
      const { angle } = await drawn(filledWith(plate, fill, told(fill, ramp)));
      const same = new Set(angle).size === 1;
      assert.equal(same, fill === 'direction' || fill === 'colours', fill); // no colour has a direction yet
    }
  });

  test('a spiral turns by 180° as often as its wave length fits', async () => {
    const raster = await drawn(filledWith(plate, 'spiral', { waveLength: 9, angle: 10 }));
    for (const [x, y] of places) {
      const { degrees, middle } = at(raster, x, y);
      const [dx, dy] = [middle[0] - side / 2, middle[1] - side / 2];
      const expected = (Math.atan2(dy, dx) * 180) / Math.PI + 10 + (180 * Math.hypot(dx, dy)) / 9;
      assert.ok(between(degrees, expected) < 0.1, `${x}, ${y}: ${degrees} is not ${expected}`);
    }
  });

  test('noise is smooth, within its swing, and one field per seed', async () => {
    const noise = { waveLength: 8, amplitude: 40, angle: 0 };
    const raster = await drawn(filledWith(plate, 'noise', { ...noise, seed: 1 }));
    const degrees = Array.from(raster.angle, degreesOf);
    assert.ok(degrees.every((one) => Math.abs(one) <= 40.01));
    assert.ok(degrees.some((one) => one > 20) && degrees.some((one) => one < -20));
    // Steepest: 15/8 of the swing from -40 to 40 within a wave length.
    const most = (((15 / 8) * 80) / 8) * (side / raster.width) + 0.1;
    for (let k = 1; k < raster.width; ++k) assert.ok(Math.abs((degrees[k] ?? 0) - (degrees[k - 1] ?? 0)) < most);
    for (const seed of [2, 2 ** 32 + 1, 2 ** 53 - 1]) {
      const other = await drawn(filledWith(plate, 'noise', { ...noise, seed }));
      const same = other.angle.filter((angle, k) => between(degreesOf(angle), degrees[k] ?? 0) < 1).length;
      assert.ok(same < 0.1 * degrees.length, `seed ${seed}`);
    }
  });

  test('white of a picture is bright under the usual light, black is dark', async () => {
    for (const fill of ['brightness', 'levels'] as const) {
      const filled = filledWith(plate, fill, { file: ramp, smoothing: 0 });
      const { from, to } = groundOf(filled) ?? assert.fail();
      const raster = await drawn(filled);
      assert.ok(between(at(raster, 0.5, 20).degrees, from) < 4, fill);
      assert.ok(between(at(raster, side - 0.5, 20).degrees, to) < 4, fill);
    }
  });
});
