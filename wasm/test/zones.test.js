// Bodies with zones of straight lines for other slicers: those of the native program, of everything that layers can say.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { createEngine } from 'sillon';

import { nativeProgram } from './support/projects.js';

const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
let engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
  rmSync(folder, { recursive: true });
});

const shape = { builtin: 'rectangle', size: [40, 20] };
/** Whole degrees, and tens of square millimetres: areas are counted in cells. */
const roughly = (zones) => zones.map(({ degrees, areaMm2 }) => [Math.round(degrees), Math.round(areaMm2 / 10)]);
const bytesOf = async (blob) => Buffer.from(await blob.arrayBuffer());

/** The file that the native program makes of these layers. */
function native(layers, ...options) {
  const [project, file] = ['project.json', 'zones.3mf'].map((name) => join(folder, name));
  writeFileSync(project, JSON.stringify({ sillon: 1, shape, layers }));
  const words = ['zones', project, '--output', file, ...options];
  const { status, stderr } = spawnSync(nativeProgram, words, { encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  return readFileSync(file);
}

/** A box as binary STL. */
function boxStl(low, high) {
  const corner = (k) => [0, 1, 2].map((axis) => ((k >> axis) & 1 ? high : low)[axis]);
  const faces = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
  ];
  const triangles = faces.flatMap(([a, b, c, d]) => [
    [a, b, c],
    [a, c, d],
  ]);
  const file = Buffer.alloc(84 + 50 * triangles.length);
  file.writeUInt32LE(triangles.length, 80);
  for (const [k, triangle] of triangles.entries()) {
    const values = triangle.flatMap(corner);
    for (const [j, value] of values.entries()) file.writeFloatLE(value, 84 + 50 * k + 12 + 4 * j);
  }
  return file;
}

test('one direction is one zone of the whole shape, in a 3MF', async () => {
  const layers = [{ kind: 'direction', angle: 30 }];
  const { file, zones, error, openEdges, notes, warnings } = await engine.makeZones({ shape, layers });
  assert.equal(file.type, 'model/3mf');
  assert.equal((await bytesOf(file)).toString('latin1', 0, 4), 'PK\x03\x04');
  assert.deepEqual(roughly(zones), [[30, 80]]);
  assert.ok(error < 0.01, error);
  assert.equal(openEdges, 0);
  assert.deepEqual([notes, warnings], [[], []]);
});

test('zones come by their angles', async () => {
  const layers = [
    { kind: 'direction', angle: 90 },
    { kind: 'direction', angle: 15, size: [10, 20], at: [5, 10] },
    { kind: 'direction', angle: -10, size: [10, 20], at: [35, 10] },
  ];
  const { zones, file } = await engine.makeZones({ shape, layers });
  assert.deepEqual(roughly(zones), [
    [15, 20],
    [90, 40],
    [170, 20],
  ]);
  assert.ok((await bytesOf(file)).equals(native(layers)));
});

test('text over waves becomes the zones of the native program', async () => {
  const layers = [
    { kind: 'pattern', pattern: 'waves', waveLength: 30, amplitude: 40 },
    { kind: 'text', text: 'HI', textSize: 14, fill: 'angle', angle: 90 },
  ];
  const how = { most: 4, least: 1, layerHeight: 0.15 };
  const { zones, file, error } = await engine.makeZones({ shape, layers }, how);
  assert.equal(zones.length, 4);
  const letters = zones.filter(({ degrees }) => Math.abs(degrees - 90) < 10);
  assert.ok(letters.length === 1 && letters[0].areaMm2 > 40, JSON.stringify(zones));
  assert.ok(error > 1, error); // waves become steps
  const expected = native(layers, '--zones', '4', '--least', '1', '--layer-height', '0.15');
  assert.ok((await bytesOf(file)).equals(expected));
  const without = await engine.makeZones({ shape, layers: layers.slice(0, 1) }, how);
  assert.ok(without.zones.every(({ degrees }) => Math.abs(degrees - 90) > 30));
});

test('a face of a body carries the plate, as natively', async () => {
  const body = boxStl([100, 50, 0], [130, 60, 3]);
  const path = join(folder, 'box.stl');
  writeFileSync(path, body);
  const layers = [{ kind: 'direction', angle: 20 }];
  const { zones, file } = await engine.makeZones({ shape, layers }, { body, face: [95, 45, 3] });
  assert.deepEqual(roughly(zones), [[20, 80]]);
  assert.ok((await bytesOf(file)).equals(native(layers, '--body', path, '--face', '95,45,3')));
  const refused = (how, message) => assert.rejects(engine.makeZones({ shape, layers }, how), { message });
  await refused({ face: [0, 0, 3] }, /^unknown key "how\.face"/);
  await refused({ body, face: [0, 0] }, /^how\.face is .*; it must be three numbers$/);
  await refused({ body, face: [0, 0, NaN] }, /^how\.face\[2\]/);
});

test('a body takes the place of the shape, as bytes or as a Blob', async () => {
  const stl = boxStl([100, 50, 0], [130, 60, 3]);
  const path = join(folder, 'body.stl');
  writeFileSync(path, stl);
  const layers = [
    { kind: 'direction', angle: 20 },
    { kind: 'direction', angle: 110, size: [15, 10], at: [7.5, 5] },
  ];
  const { zones, file, openEdges } = await engine.makeZones({ layers }, { body: stl });
  assert.deepEqual(roughly(zones), [
    [20, 15],
    [110, 15],
  ]);
  assert.equal(openEdges, 0);
  const made = await bytesOf(file);
  assert.ok(made.equals(native(layers, '--body', path)));
  const other = await engine.makeZones({ layers }, { body: new Blob([stl]) });
  assert.ok(made.equals(await bytesOf(other.file)));
  const open = await engine.makeZones({ layers }, { body: Buffer.concat([Buffer.alloc(80), withoutLast(stl)]) });
  assert.ok(open.openEdges > 0);
});

/** The triangles of an STL but the last, with their number. */
function withoutLast(stl) {
  const rest = Buffer.from(stl.subarray(80, -50));
  rest.writeUInt32LE(stl.readUInt32LE(80) - 1, 0);
  return rest;
}

test('what cannot be cut into zones is refused by name', async () => {
  const layers = [{ kind: 'direction', angle: 30 }];
  for (const [how, code, message] of [
    [{ zones: 4 }, 'InvalidArgument', /^unknown key "how\.zones"; known are body, height, most, least, layerHeight$/],
    [7, 'InvalidArgument', /^how is 7/],
    [{ body: 7 }, 'InvalidArgument', /^how\.body is 7; it must be bytes/],
    [{ body: 'part.stl' }, 'InvalidArgument', /^how\.body is "part\.stl"/],
    [{ body: Buffer.from('solid') }, 'InvalidFile', /^the STL is cut off/],
    [{ body: new Uint8Array(0) }, 'InvalidFile', /^the STL is cut off/],
    [{ height: NaN }, 'InvalidArgument', /^how\.height is NaN/],
    [{ height: 0 }, 'InvalidArgument', /height.* 0/],
    [{ most: 2.5 }, 'InvalidArgument', /^how\.most is 2\.5; it must be a whole number from 2 to 12$/],
    [{ most: 2 ** 32 + 6 }, 'InvalidArgument', /^how\.most is 4294967302/],
    [{ most: 13 }, 'InvalidArgument', /13/],
    [{ least: 0 }, 'InvalidArgument', /least|narrow/],
    [{ layerHeight: 3 }, 'InvalidArgument', /3/],
  ]) {
    await assert.rejects(engine.makeZones({ shape, layers }, how), { name: 'SillonError', code, message });
  }
  for (const mode of ['parallel', 'orthogonal', 'smoothest']) {
    await assert.rejects(engine.makeZones({ shape, layers: [{ kind: 'direction', mode }] }), {
      code: 'InvalidArgument',
      message: /the mode must be constrained/,
    });
  }
  await assert.rejects(engine.makeZones({ shape, directions: { angle: 30 } }), { message: /unknown key "directions"/ });
});
