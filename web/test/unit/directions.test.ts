// Each kind of directions against what it promises, where that has a closed form.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';

import { createEngine, type DirectionEncoding, type Engine, type Picture } from 'sillon';

import { degreesOf, storeDegrees, storeDouble } from '../../src/generators/angle.js';
import { qrPicture } from '../../src/generators/qr.js';
import { rasterise, type Pictures } from '../../src/generators/rasterise.js';
import type { DirectionRaster } from '../../src/model/raster.js';
import type { DirectionSource, ModeSource } from '../../src/model/plate.js';
import type { Page } from '../../src/generators/texels.js';
import { newFileDirections, newGenerator } from '../../src/model/defaults.js';
import { between, chances, fileOf, greyPicture } from './support/pictures.js';

const square = [70, 70] as const;
const everywhere: ModeSource = { mode: 'constrained' };
const file = fileOf('picture.png');

const draw = (
  source: DirectionSource,
  pictures: Pictures = {},
  { page = square, resolution = 64, modes = everywhere }: { page?: Page; resolution?: number; modes?: ModeSource } = {},
): DirectionRaster => rasterise(source, modes, [], page, resolution, pictures);

/** Angle [degrees] at a place of the unit square, y up. */
function angleAt({ width, height, angle }: DirectionRaster, x: number, y: number): number {
  const column = Math.min(width - 1, Math.floor(x * width));
  const row = Math.min(height - 1, Math.floor((1 - y) * height));
  return degreesOf(angle[row * width + column] ?? NaN);
}

/** Of the texel there. */
const centreOf = (cells: number, at: number): number => (Math.floor(at * cells) + 0.5) / cells;

describe('stored angles', () => {
  test('are those of the engine, for any number of turns', () => {
    assert.deepEqual([-90, 0, 45, 90, 180, -360, 225].map(storeDegrees), [0, 32768, 49151, 0, 32768, 32768, 49151]);
    for (let degrees = -89; degrees < 90; ++degrees) {
      assert.ok(Math.abs(degreesOf(storeDegrees(degrees)) - degrees) < 0.002);
    }
  });

  test('come from double-angle vectors of any length', () => {
    for (const degrees of [-89, -45, 0, 10, 89]) {
      const double = (degrees * Math.PI) / 90;
      const stored = storeDouble(7 * Math.cos(double), 7 * Math.sin(double));
      assert.ok(between(degreesOf(stored), degrees) < 0.003);
    }
    assert.equal(storeDouble(0, 0), storeDegrees(0));
  });
});

describe('size of the raster', () => {
  test('follows the proportions of the page', () => {
    const { width, height, angle, mode } = draw({ kind: 'angle', angle: 30 }, {}, { page: [120, 40], resolution: 300 });
    assert.deepEqual([width, height, angle.length, mode.length], [300, 100, 30000, 30000]);
    const tall = draw({ kind: 'angle', angle: 30 }, {}, { page: [1, 1000], resolution: 300 });
    assert.deepEqual([tall.width, tall.height], [1, 300]);
  });
});

describe('generators', () => {
  test('one direction is the same everywhere', () => {
    const { angle } = draw({ kind: 'angle', angle: 30 });
    assert.ok(angle.every((stored) => stored === storeDegrees(30)));
  });

  test('rays point away from the centre, in true proportions, and 90° makes rings', () => {
    const page = [80, 40] as const;
    const options = { page, resolution: 160 };
    for (const turn of [0, 90]) {
      const raster = draw({ kind: 'radial', centre: [0.25, 0.5], angle: turn }, {}, options);
      for (const [x, y] of [
        [0.9, 0.51],
        [0.4, 0.91],
        [0.1, 0.11],
        [0.25, 0.955],
      ] as const) {
        const dx = (centreOf(160, x) - 0.25) * 80;
        const dy = (centreOf(80, y) - 0.5) * 40;
        const expected = (Math.atan2(dy, dx) * 180) / Math.PI + turn;
        assert.ok(between(angleAt(raster, x, y), expected) < 0.01, `${turn} at ${x}, ${y}`);
      }
    }
  });

  test('a spiral turns through 180° as often per page width as it is told', () => {
    const raster = draw({ kind: 'spiral', centre: [0, 0], turns: 3, angle: 10 }, {}, { resolution: 600 });
    for (const x of [0.1, 0.3, 0.5, 0.95]) {
      const away = Math.hypot(centreOf(600, x), 0.5 / 600);
      const ray = (Math.atan2(0.5, centreOf(600, x) * 600) * 180) / Math.PI;
      assert.ok(between(angleAt(raster, x, 0), ray + 10 + 540 * away) < 0.01);
    }
  });

  test('waves swing by the amplitude along their way, and not across it', () => {
    const source = { kind: 'waves', angle: 0, amplitude: 40, length: 0.5 } as const;
    const raster = draw(source, {}, { resolution: 800 });
    assert.ok(Math.abs(angleAt(raster, 0.125, 0.5) - 40) < 0.01);
    assert.ok(Math.abs(angleAt(raster, 0.375, 0.5) + 40) < 0.01);
    assert.ok(Math.abs(angleAt(raster, 0.625, 0.5) - 40) < 0.01);
    assert.equal(angleAt(raster, 0.3, 0.1), angleAt(raster, 0.3, 0.9));
    const upright = draw({ ...source, angle: 90 }, {}, { resolution: 800 });
    assert.ok(between(angleAt(upright, 0.5, 0.125), 130) < 0.01);
    assert.equal(angleAt(upright, 0.1, 0.3), angleAt(upright, 0.9, 0.3));
  });

  test('noise is smooth, within its swing, and one field per seed', () => {
    const source = { kind: 'noise', seed: 1, scale: 0.2, amplitude: 40, angle: 0 } as const;
    const raster = draw(source, {}, { resolution: 400 });
    const degrees = Array.from(raster.angle, degreesOf);
    assert.ok(degrees.every((one) => Math.abs(one) <= 40));
    assert.ok(degrees.some((one) => one > 20) && degrees.some((one) => one < -20));
    // Steepest: 15/8 of the swing from -40 to 40 within 80 texels.
    for (let k = 1; k < 400; ++k) assert.ok(Math.abs((degrees[k] ?? 0) - (degrees[k - 1] ?? 0)) < 2);
    assert.deepEqual(draw(source, {}, { resolution: 400 }), raster);
    for (const seed of [2, 2 ** 32 + 1, 2 ** 53 - 1]) {
      const other = draw({ ...source, seed }, {}, { resolution: 400 });
      const same = other.angle.filter((angle, k) => between(degreesOf(angle), degrees[k] ?? 0) < 1).length;
      assert.ok(same < 0.1 * degrees.length, `seed ${seed}`);
    }
    // The same spots on a finer raster.
    const fine = draw(source, {}, { resolution: 1200 });
    assert.ok(between(angleAt(fine, 0.37, 0.61), angleAt(raster, 0.37, 0.61)) < 2);
  });
});

describe('pictures by tone', () => {
  const ramp = greyPicture(64, 64, (x) => x / 63);
  const source = { ...newFileDirections('tone', file), smoothing: 0 };

  test('black is the one angle and white the other, with all between', () => {
    const raster = draw({ ...source, from: -60, to: 60 }, { source: ramp });
    for (let x = 0; x < 64; ++x) {
      const expected = -60 + (120 * Math.round((255 * x) / 63)) / 255;
      assert.ok(Math.abs(degreesOf(raster.angle[x] ?? 0) - expected) < 0.01);
    }
  });

  test('invert swaps the ends, contrast spreads about the middle and stops at the ends', () => {
    const inverted = draw({ ...source, from: -60, to: 60, invert: true }, { source: ramp });
    assert.ok(Math.abs(angleAt(inverted, 0, 0.5) - 60) < 0.01);
    const strong = draw({ ...source, from: -60, to: 60, contrast: 3 }, { source: ramp });
    assert.ok(Math.abs(angleAt(strong, 0.3, 0.5) + 60) < 0.01);
    assert.ok(Math.abs(degreesOf(strong.angle[36] ?? 0) - 3 * 120 * (146 / 255 - 0.5)) < 0.01);
  });

  test('smoothing keeps even tones and spreads a step as a Gaussian of that width', () => {
    const step = greyPicture(256, 16, (x) => (x < 128 ? 0 : 1));
    const sigma = 10;
    const options = { page: [256, 16] as const, resolution: 256 };
    const raster = draw({ ...source, from: 0, to: 80, smoothing: sigma / 256 }, { source: step }, options);
    const tone = (x: number): number => degreesOf(raster.angle[x] ?? 0) / 80;
    assert.ok(Math.abs(tone(20)) < 0.001 && Math.abs(tone(235) - 1) < 0.001);
    // The Gaussian's integral at one sigma: 0.841; texel 137 has its middle 9.5 texels from the step.
    assert.ok(Math.abs(tone(137) - 0.829) < 0.015);
    assert.ok(Math.abs(tone(137) + tone(118) - 1) < 0.001);
  });

  test('a picture is shrunk by means and enlarged without steps', () => {
    const board = greyPicture(512, 512, (x, y) => (x + y) % 2);
    const even = draw({ ...source, from: 0, to: 80 }, { source: board });
    assert.ok(even.angle.every((angle) => Math.abs(degreesOf(angle) - 40) < 0.01));
    const small = greyPicture(2, 1, (x) => x);
    const smooth = draw({ ...source, from: 0, to: 80 }, { source: small }, { page: [64, 32] as const });
    for (let x = 1; x < 64; ++x) {
      const rise = degreesOf(smooth.angle[x] ?? 0) - degreesOf(smooth.angle[x - 1] ?? 0);
      assert.ok(rise >= 0 && rise < 2.6);
    }
  });

  test('colours weigh as the eye sees them, and what is transparent is white', () => {
    const colours: Picture = {
      width: 4,
      height: 1,
      channels: 4,
      samples: Uint8Array.of(255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 0),
    };
    const options = { page: [4, 1] as const, resolution: 4 };
    const { angle } = draw({ ...source, from: 0, to: 80 }, { source: colours }, options);
    const shares = Array.from(angle, (stored) => degreesOf(stored) / 80);
    [0.2126, 0.7152, 0.0722, 1].forEach((share, k) => {
      assert.ok(Math.abs((shares[k] ?? 0) - share) < 0.001);
    });
  });

  test('two levels part at the threshold', () => {
    const levels = { ...newFileDirections('levels', file), dark: 20, light: -70, threshold: 0.25 };
    const raster = draw(levels, { source: ramp });
    const expected = (x: number): number => (Math.round((255 * x) / 63) / 255 < 0.25 ? 20 : -70);
    raster.angle.forEach((angle, k) => {
      assert.equal(angle, storeDegrees(expected(k % 64)));
    });
    const inverted = draw({ ...levels, invert: true }, { source: ramp });
    assert.equal(inverted.angle[0], storeDegrees(-70));
  });
});

describe('pictures by edges', () => {
  const source = { ...newFileDirections('edges', file), smoothing: 0.02 };
  const stripes = (degrees: number): Picture => {
    const turn = (degrees * Math.PI) / 180;
    return greyPicture(256, 256, (x, y) => 0.5 + 0.5 * Math.sin((x * Math.sin(turn) + y * Math.cos(turn)) / 3));
  };

  test('beads run along stripes of any direction, or across them', () => {
    for (const degrees of [0, 20, 45, 90, 130]) {
      for (const across of [false, true]) {
        const raster = draw({ ...source, across }, { source: stripes(degrees) }, { resolution: 256 });
        const expected = degrees + (across ? 90 : 0);
        const worst = raster.angle.reduce((most, angle) => Math.max(most, between(degreesOf(angle), expected)), 0);
        assert.ok(worst < 6, `${degrees}: off by ${worst}`);
      }
    }
  });

  test('a disc makes rings, also where it is flat', () => {
    const disc = greyPicture(256, 256, (x, y) => (Math.hypot(x - 127.5, y - 127.5) < 60 ? 1 : 0));
    const raster = draw(source, { source: disc }, { resolution: 256 });
    for (let turn = 0; turn < 360; turn += 15) {
      for (const away of [0.1, 0.2, 0.235, 0.3, 0.45]) {
        const radians = (turn * Math.PI) / 180;
        const found = angleAt(raster, 0.5 + away * Math.cos(radians), 0.5 + away * Math.sin(radians));
        assert.ok(between(found, turn + 90) < 10, `${turn}, ${away}: ${found}`);
      }
    }
  });

  test('angles are those on the page, when it stretches the picture', () => {
    const raster = draw(source, { source: stripes(45) }, { page: [200, 100], resolution: 512 });
    const expected = (Math.atan(0.5) * 180) / Math.PI;
    assert.ok(between(angleAt(raster, 0.5, 0.5), expected) < 3);
    assert.ok(between(angleAt(raster, 0.2, 0.8), expected) < 3);
  });

  test('without edges there is one direction', () => {
    const raster = draw(source, { source: greyPicture(50, 50, () => 0.3) });
    assert.ok(raster.angle.every((angle) => angle === storeDegrees(0)));
  });
});

describe('maps', () => {
  let engine: Engine;
  before(async () => {
    engine = await createEngine({ threads: 'off' });
  });
  after(() => {
    engine.dispose();
  });

  /** Smooth, with all values somewhere; tangents of any length. */
  function anyMap(channels: Picture['channels'], wide: boolean): Picture {
    const chance = chances(channels + (wide ? 10 : 0));
    const phases = Array.from({ length: channels }, () => 7 * chance());
    const most = wide ? 65535 : 255;
    const values = Array.from({ length: 40 * 30 * channels }, (_, k) => {
      const pixel = Math.floor(k / channels);
      return most * (0.5 + 0.5 * Math.sin((pixel % 40) / 9 + pixel / 400 + (phases[k % channels] ?? 0)));
    });
    return { width: 40, height: 30, channels, samples: wide ? Uint16Array.from(values) : Uint8Array.from(values) };
  }

  const cases: [DirectionEncoding, Picture['channels'], boolean][] = [
    ['angle', 1, false],
    ['angle', 2, true],
    ['angle', 3, false],
    ['rotation', 1, true],
    ['rotation', 4, false],
    ['tangent', 3, false],
    ['tangent', 4, true],
  ];
  for (const [encoding, channels, wide] of cases) {
    test(`${encoding} of ${channels} channels, ${wide ? 16 : 8} bit: the plate is that of the picture itself`, async () => {
      const picture = anyMap(channels, wide);
      const { width, height, angle } = draw(
        { kind: 'map', file, encoding },
        { source: picture },
        { page: [20, 15], resolution: 64 },
      );
      const shape = { builtin: 'rectangle', size: [20, 15] as [number, number] } as const;
      const itself = await engine.generateToolpath({ shape, layers: [{ kind: 'map', file: picture, encoding }] });
      const ours = await engine.generateToolpath({
        shape,
        layers: [{ kind: 'map', file: { width, height, channels: 1, samples: angle } }],
      });
      assert.equal(ours.report.digest, itself.report.digest);
      const turned = await engine.generateToolpath({ shape, layers: [{ kind: 'direction' }] });
      assert.notEqual(turned.report.digest, itself.report.digest);
    });
  }

  test('far too large ones are shrunk by averaging lines, not numbers', () => {
    // 89° and -89° by turns: upright, though the numbers' mean is 0°.
    const samples = Uint16Array.from({ length: 256 * 256 }, (_, k) => storeDegrees(k % 2 === 0 ? 89 : -89));
    const picture: Picture = { width: 256, height: 256, channels: 1, samples };
    const raster = draw({ kind: 'map', file, encoding: 'angle' }, { source: picture }, { resolution: 32 });
    assert.equal(raster.width, 32);
    assert.ok(raster.angle.every((angle) => between(degreesOf(angle), 90) < 0.1));
  });

  test('far too small ones keep their texels', () => {
    const picture: Picture = { width: 2, height: 2, channels: 1, samples: Uint8Array.of(0, 60, 120, 180) };
    const raster = draw({ kind: 'map', file, encoding: 'angle' }, { source: picture });
    assert.deepEqual([...new Set(raster.angle)], [0, 60 * 257, 120 * 257, 180 * 257]);
    assert.equal(raster.angle[31], 0);
    assert.equal(raster.angle[32], 60 * 257);
  });
});

describe('modes', () => {
  test('a picture of modes is read as the engine reads it, else the base counts', () => {
    const greys = Uint8Array.of(0, 42, 43, 85, 127, 128, 170, 212, 213, 255, 0, 0, 0, 0, 0, 0);
    const picture: Picture = { width: 16, height: 1, channels: 1, samples: greys };
    const modes: ModeSource = { mode: 'smoothest', file };
    const options = { page: [16, 1] as const, resolution: 16, modes };
    const raster = draw(newGenerator('waves'), { modes: picture }, options);
    assert.deepEqual([...raster.mode], [0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 0, 0, 0, 0, 0, 0]);
    assert.ok(draw(newGenerator('waves'), {}, { modes: { mode: 'smoothest' } }).mode.every((mode) => mode === 2));
  });
});

describe('letters and codes', () => {
  test('letters run one way, their ground another', () => {
    const letters = greyPicture(64, 64, (x) => (x < 20 ? 1 : 0));
    const raster = draw({ ...newGenerator('text'), letters: 80, ground: 10 }, { source: letters });
    assert.equal(raster.angle[19], storeDegrees(80));
    assert.equal(raster.angle[20], storeDegrees(10));
  });

  test('each module of a code is where it belongs, in the middle of the page, within its margin', async () => {
    const picture = await qrPicture('https://example.org/ünïcode');
    const count = picture.width;
    assert.ok(count >= 21 && count % 4 === 1);
    assert.equal(picture.samples[0], 0); // the finder pattern's corner
    assert.equal(picture.samples[count + 1], 255);
    const source = { ...newGenerator('qr'), dark: 45, light: -45, margin: 3 };
    const cells = count + 6;
    const raster = draw(source, { source: picture }, { page: [2, 1], resolution: 2 * cells * 5 });
    for (let row = -3; row < count + 3; ++row) {
      for (let column = -3; column < count + 3; ++column) {
        const inside = row >= 0 && column >= 0 && row < count && column < count;
        const dark = inside && picture.samples[row * count + column] === 0;
        const x = cells / 2 + (column + 3) + 0.5;
        const found = angleAt(raster, x / (2 * cells), 1 - (row + 3.5) / cells);
        assert.ok(Math.abs(found - (dark ? 45 : -45)) < 0.01, `${row}, ${column}`);
      }
    }
  });

  test('a text that fits no code is refused with its length', async () => {
    await assert.rejects(qrPicture('x'.repeat(2332)), { code: 'TextTooLong', values: { length: 2332, most: 2331 } });
    await assert.rejects(qrPicture('é'.repeat(1166)), { code: 'TextTooLong' });
    assert.equal((await qrPicture('x'.repeat(2331))).width, 177);
  });

  test('kinds that need a picture say so without one', () => {
    assert.throws(() => draw(newFileDirections('tone', file)), /"tone" need a picture/);
  });
});
