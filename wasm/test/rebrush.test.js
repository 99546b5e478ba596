// Other people's prints: surfaces are listed and replaced as the native program does it, in every kind of file.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync, gunzipSync } from 'node:zlib';

import { createEngine } from 'sillon';

import { nativeProgram, root } from './support/projects.js';

const samples = join(root, 'tests/fuzz/seeds/rebrush');
const names = readdirSync(samples).filter((name) => name.endsWith('.gcode'));
const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
let engine;

before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
  rmSync(folder, { recursive: true });
});

test('the surfaces of a sliced file are those that the native program lists', async () => {
  assert.ok(names.length >= 3);
  for (const name of names) {
    const file = readFileSync(join(samples, name));
    const read = await engine.listSurfaces(file);
    const { stdout } = spawnSync(nativeProgram, ['rebrush', join(samples, name), '--list', '--json'], {
      encoding: 'utf8',
    });
    const told = JSON.parse(stdout);
    assert.equal(read.slicer, told.slicer);
    assert.equal(read.layers, told.layers);
    assert.deepEqual(
      read.surfaces.map(({ side, layer, areaMm2 }) => [side, layer, areaMm2.toFixed(6)]),
      told.surfaces.map(({ side, layer, areaMm2 }) => [side, layer, areaMm2.toFixed(6)]),
    );
    assert.ok(read.surfaces[0].region.paths.length > 0);
    // Another kind of file, as a Blob.
    assert.deepEqual(await engine.listSurfaces(new Blob([gzipSync(file)])), read);
  }
});

test('a re-brushed file is that of the native program, byte for byte', async () => {
  for (const name of names) {
    const file = readFileSync(join(samples, name));
    const out = join(folder, name);
    const made = spawnSync(nativeProgram, [
      'rebrush',
      join(samples, name),
      '--angle',
      '30',
      '--surfaces',
      'both',
      '-o',
      out,
    ]);
    assert.equal(made.status, 0, String(made.stderr));
    const done = await engine.rebrush(file, { directions: { angle: 30 }, sides: 'both' });
    assert.equal(Buffer.from(await done.blob.arrayBuffer()).compare(readFileSync(out)), 0, name);
    assert.equal(done.surfaces.filter(({ replaced }) => replaced).length, 2);
    for (const { coverage, beyond, left } of done.surfaces) {
      assert.ok(coverage > 97 && beyond < 0.05, `${coverage} % ${beyond} mm ${left}`);
    }
    // What was packed is packed again.
    const packed = await engine.rebrush(gzipSync(file), { directions: { angle: 30 }, sides: 'both' });
    const text = gunzipSync(Buffer.from(await packed.blob.arrayBuffer()));
    assert.equal(text.compare(readFileSync(out)), 0);
  }
});

test('what cannot be re-brushed is refused in a sentence', async () => {
  const file = readFileSync(join(samples, names[0]));
  const refused = [
    [() => engine.listSurfaces(Buffer.from('G28\n')), 'InvalidFile', /does not mark its surfaces/],
    [() => engine.rebrush(file, { fit: 'bed', directions: { angle: 3 } }), 'InvalidArgument', /does not tell its bed/],
    [() => engine.rebrush(file, { sides: 'left' }), 'InvalidArgument', /how\.sides is "left"/],
    [() => engine.rebrush(file, { fit: 'page' }), 'InvalidArgument', /how\.fit is "page"/],
    [() => engine.rebrush(file, { angle: 3 }), 'InvalidArgument', /unknown key "how\.angle"/],
    [() => engine.rebrush(file, { toolpath: { seed: -1 } }), 'InvalidArgument', /seed/],
    [() => engine.rebrush('file'), 'InvalidArgument', /^file is "file"/],
  ];
  for (const [call, code, message] of refused) {
    await assert.rejects(call, (error) => {
      assert.equal(error.code, code);
      assert.match(error.message, message);
      return true;
    });
  }
});
