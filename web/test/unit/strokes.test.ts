import assert from 'node:assert/strict';
import { describe, test } from 'node:test';

import { degreesOf, storeDegrees } from '../../src/generators/angle.js';
import type { DirectionRaster } from '../../src/model/raster.js';
import { applyStroke, copyOf, replayed, withStrokes, type Replay } from '../../src/generators/strokes.js';
import type { Stroke } from '../../src/model/plate.js';
import { between, chances } from './support/pictures.js';

const square = [70, 70] as const;

function even(width: number, height: number, degrees: number, mode = 3): DirectionRaster {
  const length = width * height;
  return {
    width,
    height,
    angle: new Uint16Array(length).fill(storeDegrees(degrees)),
    mode: new Uint8Array(length).fill(mode),
  };
}

const stroke = (given: Partial<Stroke>): Stroke => ({
  tool: 'comb',
  points: [0.1, 0.1, 0.9, 0.9],
  radius: 0.1,
  softness: 0,
  ...given,
});

const texel = ({ width, height }: DirectionRaster, x: number, y: number): number =>
  Math.floor((1 - y) * height) * width + Math.floor(x * width);
const angleAt = (raster: DirectionRaster, x: number, y: number): number =>
  degreesOf(raster.angle[texel(raster, x, y)] ?? NaN);
const modeAt = (raster: DirectionRaster, x: number, y: number): number => raster.mode[texel(raster, x, y)] ?? NaN;

describe('comb', () => {
  const base = even(200, 200, 0);

  test('beads run as the brush went, within its radius only', () => {
    const raster = withStrokes(base, [stroke({})], square);
    assert.ok(between(angleAt(raster, 0.5, 0.5), 45) < 0.1);
    assert.ok(between(angleAt(raster, 0.2, 0.25), 45) < 0.1);
    raster.angle.forEach((angle, k) => {
      const x = ((k % 200) + 0.5) / 200;
      const y = 1 - (Math.floor(k / 200) + 0.5) / 200;
      const along = Math.min(0.9, Math.max(0.1, (x + y) / 2));
      const away = Math.hypot(x - along, y - along);
      if (Math.abs(away - 0.1) < 0.001) return;
      assert.equal(angle !== base.angle[k], away < 0.1, `${x}, ${y}`);
    });
  });

  test('to and fro are the same', () => {
    const back = withStrokes(base, [stroke({ points: [0.9, 0.9, 0.1, 0.1] })], square);
    const raster = withStrokes(base, [stroke({})], square);
    raster.angle.forEach((angle, k) => {
      assert.ok(between(degreesOf(angle), degreesOf(back.angle[k] ?? NaN)) < 0.01);
    });
  });

  test('a soft rim fades from the stroke to what was there, without steps', () => {
    const raster = withStrokes(base, [stroke({ points: [0.1, 0.5, 0.9, 0.6], radius: 0.2, softness: 1 })], square);
    const heading = (Math.atan2(0.1, 0.8) * 180) / Math.PI;
    const across = Array.from({ length: 60 }, (_, k) => angleAt(raster, 0.5, 0.55 + (k + 0.5) / 200));
    assert.ok(between(across[0] ?? NaN, heading) < 0.1);
    assert.equal(across.at(-1), angleAt(base, 0.5, 0.9));
    for (let k = 1; k < across.length; ++k) {
      const fall = (across[k - 1] ?? NaN) - (across[k] ?? NaN);
      assert.ok(fall >= 0 && fall < 0.5, `${fall}`);
    }
  });

  test('corners are rounded: between both headings, no others', () => {
    const raster = withStrokes(base, [stroke({ points: [0.2, 0.2, 0.8, 0.2, 0.8, 0.8] })], square);
    assert.ok(between(angleAt(raster, 0.4, 0.2), 0) < 0.1 && between(angleAt(raster, 0.8, 0.6), 90) < 0.1);
    raster.angle.forEach((angle) => {
      assert.ok(degreesOf(angle) > -0.01 || degreesOf(angle) < -89.9);
    });
  });

  test('the page’s proportions count: radius in page widths, headings in millimetres', () => {
    const wide = even(400, 100, 0);
    const raster = withStrokes(wide, [stroke({ points: [0, 0, 1, 1], radius: 0.05 })], [80, 20]);
    const heading = (Math.atan2(20, 80) * 180) / Math.PI;
    assert.ok(between(angleAt(raster, 0.5, 0.5), heading) < 0.1);
    // 4 mm straight up from the middle line is 3.88 mm away from it, within 4; 4.2 mm up is 4.07 away.
    assert.ok(between(angleAt(raster, 0.5, 0.5 + 4 / 20), heading) < 0.1);
    assert.equal(angleAt(raster, 0.5, 0.5 + 4.3 / 20), angleAt(wide, 0, 0.99));
  });

  test('what it touches becomes constrained; where it was not, the stroke counts whole', () => {
    const free = even(200, 200, 0, 2);
    const soft = stroke({ points: [0.1, 0.5, 0.5, 0.9], radius: 0.2, softness: 1 });
    const raster = withStrokes(free, [soft], square);
    let touched = 0;
    raster.mode.forEach((mode, k) => {
      if (mode === 2) {
        assert.equal(raster.angle[k], free.angle[k]);
      } else {
        assert.equal(mode, 3);
        assert.ok(between(degreesOf(raster.angle[k] ?? NaN), 45) < 0.1);
        ++touched;
      }
    });
    assert.ok(touched > 2000);
  });

  test('a dab has no direction and changes nothing; nor does a stroke beside the page', () => {
    for (const points of [[0.5, 0.5], [0.5, 0.5, 0.5, 0.5], [], [3, 3, 4, 4], [-5, 0.5, -4, 0.5]]) {
      assert.deepEqual(withStrokes(base, [stroke({ points })], square), base);
    }
    assert.deepEqual(withStrokes(base, [stroke({ radius: 0 })], square), base);
  });

  test('the source stays as it is', () => {
    const source = copyOf(base);
    withStrokes(source, [stroke({}), stroke({ tool: 'mode', mode: 'parallel' })], square);
    assert.deepEqual(source, base);
    assert.equal(withStrokes(source, [], square), source);
  });
});

describe('modes and eraser', () => {
  const base = even(200, 200, 20);

  test('a mode is painted over, up to the middle of a soft rim, and a dab makes a disc', () => {
    const paint = stroke({ tool: 'mode', mode: 'orthogonal', points: [0.5, 0.5], radius: 0.2, softness: 0.5 });
    const raster = withStrokes(base, [paint], square);
    assert.deepEqual(raster.angle, base.angle);
    for (const [away, mode] of [
      [0, 1],
      [0.14, 1],
      [0.16, 3],
    ] as const) {
      assert.equal(modeAt(raster, 0.5 + away, 0.5), mode);
      assert.equal(modeAt(raster, 0.5, 0.5 - away), mode);
    }
  });

  test('the eraser brings the source back, exactly', () => {
    const strokes = [
      stroke({ softness: 0.7 }),
      stroke({ tool: 'mode', mode: 'smoothest', points: [0.2, 0.8, 0.8, 0.2] }),
    ];
    const combed = withStrokes(base, strokes, square);
    const all = stroke({ tool: 'erase', points: [0.5, 0.5], radius: 2 });
    assert.notDeepEqual(combed, base);
    assert.deepEqual(withStrokes(base, [...strokes, all], square), base);
    const half = withStrokes(base, [...strokes, stroke({ tool: 'erase', points: [0, 0.5], radius: 0.4 })], square);
    assert.equal(angleAt(half, 0.25, 0.25), angleAt(base, 0.25, 0.25));
    assert.equal(angleAt(half, 0.75, 0.75), angleAt(combed, 0.75, 0.75));
  });

  test('its soft rim fades from the source to what was there, without steps', () => {
    const source = even(200, 200, 25);
    const combed = withStrokes(source, [stroke({ points: [0.1, 0.1, 0.9, 0.9], radius: 2 })], square);
    const soft = stroke({ tool: 'erase', points: [0.5, 0.5], radius: 0.4, softness: 1 });
    const raster = withStrokes(combed, [], square);
    applyStroke(raster, source, soft, square);
    const away = Array.from({ length: 50 }, (_, k) => angleAt(raster, 0.5 + (k + 0.5) / 100, 0.5));
    const [from, to] = [angleAt(source, 0.5, 0.5), angleAt(combed, 0.99, 0.5)];
    assert.ok(between(away[0] ?? NaN, from) < 0.5);
    assert.equal(away.at(-1), to);
    const rising = Math.sign(to - from);
    for (let k = 1; k < away.length; ++k) {
      const rise = rising * ((away[k] ?? NaN) - (away[k - 1] ?? NaN));
      assert.ok(rise >= 0 && rise < 5, `${rise}`);
    }
  });
});

describe('replay', () => {
  const page = [70, 50] as const;
  const base = even(140, 100, 0, 2);
  const chance = chances(5);
  const anyStroke = (): Stroke => {
    const tools = ['comb', 'comb', 'mode', 'erase'] as const;
    const points = Array.from({ length: 2 * Math.ceil(6 * chance()) }, () => 1.2 * chance() - 0.1);
    const tool = tools[Math.floor(4 * chance())] ?? 'comb';
    return { tool, points, radius: 0.02 + 0.2 * chance(), softness: chance(), mode: 'parallel' };
  };

  test('piece by piece, with undo, redo and strokes that grow, it is the same as from the beginning', () => {
    let replay: Replay | undefined;
    let strokes: Stroke[] = [];
    for (let round = 0; round < 120; ++round) {
      const dice = chance();
      const last = strokes.at(-1);
      if (dice < 0.5) strokes = [...strokes, anyStroke()];
      else if (dice < 0.7 && last !== undefined) {
        strokes = [...strokes.slice(0, -1), { ...last, points: [...last.points, chance(), chance()] }];
      } else if (dice < 0.95) strokes = strokes.slice(0, -1);
      else strokes = [];
      const done = replayed(replay, base, strokes, page);
      replay = done.replay;
      assert.deepEqual(done.raster, withStrokes(base, strokes, page), `round ${round}`);
    }
  });

  test('another source or page begins anew', () => {
    const strokes = [anyStroke(), stroke({}), stroke({ tool: 'mode', mode: 'orthogonal' })];
    const { replay } = replayed(undefined, base, strokes, page);
    const other = even(140, 100, 50);
    assert.deepEqual(replayed(replay, other, strokes, page).raster, withStrokes(other, strokes, page));
    assert.deepEqual(replayed(replay, base, strokes, [70, 70]).raster, withStrokes(base, strokes, [70, 70]));
  });

  test('the raster may be given away', () => {
    const strokes = [stroke({}), stroke({ tool: 'mode', mode: 'orthogonal' })];
    const first = replayed(undefined, base, strokes, page);
    structuredClone(first.raster, { transfer: [first.raster.angle.buffer, first.raster.mode.buffer] });
    const second = replayed(first.replay, base, strokes, page);
    assert.deepEqual(second.raster, withStrokes(base, strokes, page));
  });

  test('one more stroke writes the texels around it alone', () => {
    const large = even(1024, 1024, 0);
    const points = Array.from({ length: 200 }, (_, k) => 0.5 + 0.3 * (k % 2 === 0 ? Math.cos : Math.sin)(k / 100));
    const usual = stroke({ points, radius: 0.04, softness: 0.5 });
    let written = 0;
    const counted = new Proxy(large.angle, {
      get: (angles, name) => Reflect.get(angles, name, angles) as unknown,
      set: (angles, name, value) => {
        ++written;
        return Reflect.set(angles, name, value, angles);
      },
    });
    applyStroke({ ...large, angle: counted }, large, usual, square);
    const box = (k: number): number => {
      const own = points.filter((_, j) => j % 2 === k);
      return (Math.max(...own) - Math.min(...own) + 2 * 0.04) * 1024 + 2;
    };
    assert.ok(written > 1000 && written <= box(0) * box(1), `${written} texels`);
  });
});
