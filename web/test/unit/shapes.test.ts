import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { test } from 'node:test';
import { newShape } from '../../src/model/defaults.js';
import { newPlate } from '../../src/model/new-plate.js';
import { pageOf } from '../../src/model/plate.js';
import { shapeTable } from '../../src/model/setting-table.js';
import { builtinShapes, ownHeight, usualHoles, withHole, withShape } from '../../src/model/shapes.js';

test('the panel offers every shape of the engine once', () => {
  assert.deepEqual([...builtinShapes].sort(), shapeTable.builtin.choices.filter((name) => name !== 'none').sort());
});

test('corners of a new shape are as round as the engine makes them where it is told nothing', () => {
  for (const kind of builtinShapes) assert.equal(newShape(kind).radius, shapeTable.radius.default, kind);
});

test('heights of their own are those that the engine makes', () => {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-shapes-'));
  try {
    for (const kind of builtinShapes) {
      if (kind === 'text') continue; // its letters have their own
      const svg = join(folder, `${kind}.svg`);
      const words = ['generate', '--shape', kind, '--size', '100', '--spacing', '5', '--svg', svg, '--quiet'];
      const { status, stderr } = spawnSync(resolve('build/release/sillon'), words, { encoding: 'utf8' });
      assert.equal(status, 0, stderr);
      const [, width, height] = /viewBox="0 0 (\S+) (\S+)"/.exec(readFileSync(svg, 'utf8')) ?? [];
      assert.ok(
        Math.abs(Number(height) / Number(width) - (ownHeight[kind] ?? 1)) < 1e-5,
        `${kind}: ${width} ${height}`,
      );
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('another shape keeps the longest side, and an offset; holes stay behind', () => {
  const disc = { ...newPlate(), shape: { ...newPlate().shape, offset: 3 } };
  const size = (kind: (typeof builtinShapes)[number], from = disc): unknown => {
    const { shape, width, height } = withShape(withHole(from, 'screw'), kind);
    assert.equal(shape.kind, kind);
    assert.equal(shape.offset, 3);
    assert.deepEqual(shape.holes, []);
    return [width, height];
  };
  assert.deepEqual(size('hexagon'), [70, 60.62]);
  assert.deepEqual(size('tag'), [70, 28]);
  assert.deepEqual(size('shield'), [58.36, 70]);
  assert.deepEqual(size('rounded'), [70, 70]);
  assert.deepEqual(size('disc', withShape(disc, 'tag')), [70, 70]);
  assert.deepEqual(size('ring', { ...withShape(disc, 'rectangle'), width: 90, height: 40 }), [40, 40]);
});

test('the page grows with an outline that moves outwards', () => {
  const page = (offset: number): unknown => pageOf({ ...newPlate(), shape: { ...newPlate().shape, offset } });
  assert.deepEqual(page(0), [70, 70]);
  assert.deepEqual(page(2.5), [75, 75]);
  assert.deepEqual(page(-5), [70, 70]);
});

test('new holes lie on the shape: in the middle, near the edge for a key ring, beside the hole of a ring', () => {
  const first = (kind: (typeof builtinShapes)[number], name: keyof typeof usualHoles): unknown =>
    withHole(withShape(newPlate(), kind), name).shape.holes[0];
  assert.deepEqual(first('disc', 'screw'), { x: 35, y: 35, diameter: 4.5 });
  assert.deepEqual(first('rectangle', 'keyring'), { x: 35, y: 63.5, diameter: 5 });
  assert.deepEqual(first('ring', 'magnet'), { x: 35, y: 61.25, diameter: 8.2 });
  const three = withHole(withHole(withHole(newPlate(), 'screw'), 'magnet'), 'keyring');
  assert.deepEqual(
    three.shape.holes.map(({ diameter }) => diameter),
    [4.5, 8.2, 5],
  );
});
