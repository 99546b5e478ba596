// Other people's prints: surfaces are listed and replaced as the native program does it, in every kind of file.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, openAsBlob, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync, gunzipSync } from 'node:zlib';

import { createEngine } from 'sillon';

import { png } from './support/png.js';
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
    // A Blob that stands for a file on disk, whose text is kept for the next call.
    const onDisk = await openAsBlob(join(samples, name));
    assert.deepEqual(await engine.listSurfaces(onDisk), read);
    assert.deepEqual(await engine.printRelief(onDisk, 64), await engine.printRelief(file, 64));
    const [one, other] = await Promise.all(
      [onDisk, file].map((it) => engine.rebrush(it, { layers: [{ kind: 'direction', angle: 3 }] })),
    );
    assert.ok(Buffer.from(await one.blob.arrayBuffer()).equals(Buffer.from(await other.blob.arrayBuffer())));
    // A Blob goes in by pieces of 4 MiB: the same as whole, and not what was there before.
    const long = Buffer.concat([Buffer.from(file), Buffer.from('; a comment\n'.repeat(800_000))]);
    const whole = await engine.listSurfaces(long);
    assert.deepEqual(await engine.listSurfaces(new Blob([long])), whole);
    assert.deepEqual(whole.surfaces, read.surfaces);
    assert.deepEqual(await engine.listSurfaces(new Blob([file])), read);
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
    const done = await engine.rebrush(file, { layers: [{ kind: 'direction', angle: 30 }], sides: 'both' });
    assert.equal(Buffer.from(await done.blob.arrayBuffer()).compare(readFileSync(out)), 0, name);
    assert.equal(done.surfaces.filter(({ replaced }) => replaced).length, 2);
    for (const { coverage, beyond, left } of done.surfaces) {
      assert.ok(coverage > 97 && beyond < 0.05, `${coverage} % ${beyond} mm ${left}`);
    }
    // What was packed is packed again.
    const packed = await engine.rebrush(gzipSync(file), { layers: [{ kind: 'direction', angle: 30 }], sides: 'both' });
    const text = gunzipSync(Buffer.from(await packed.blob.arrayBuffer()));
    assert.equal(text.compare(readFileSync(out)), 0);
  }
});

test('chosen surfaces under a picture become what the native program makes of them', async () => {
  const name = 'prusa.gcode';
  const picture = join(root, 'examples/inputs/photo.png');
  const out = join(folder, 'picture.gcode');
  const made = spawnSync(nativeProgram, [
    'rebrush',
    join(samples, name),
    ...['--picture', picture, '--lamp', '60,35', '--only', '2', '--fit', 'all', '-o', out],
  ]);
  assert.equal(made.status, 0, String(made.stderr));
  const fractions = [];
  const done = await engine.rebrush(
    readFileSync(join(samples, name)),
    {
      layers: [{ kind: 'picture', pictures: [{ file: readFileSync(picture), lamp: [60, 35] }] }],
      only: [1],
      fit: 'all',
    },
    { onProgress: ({ fraction }) => fractions.push(fraction) },
  );
  assert.equal(Buffer.from(await done.blob.arrayBuffer()).compare(readFileSync(out)), 0);
  const [face] = done.surfaces;
  assert.deepEqual([done.surfaces.length, face.index, face.replaced, face.cycles.length], [1, 1, true, 1]);
  assert.deepEqual(face.pictures[0].lamp, [60, 35]);
  assert.ok(face.cycles[0].widths.length > 100);
  assert.equal(fractions.at(-1), 1);
});

test('letters across waves, and strokes, are laid on a face as the native program does', async () => {
  const name = 'prusa.gcode';
  const layers = [
    { kind: 'pattern', pattern: 'waves', waveLength: 12, amplitude: 30 },
    { kind: 'text', text: 'HI', font: 'Fredoka', textSize: 5, fill: 'across' },
    { kind: 'strokes', strokes: [{ tool: 'comb', radius: 3, points: [0, 2, 30, 4] }] },
  ];
  const made = async (...layers) => Buffer.from(await (await brushed(...layers)).blob.arrayBuffer());
  const brushed = (...layers) => engine.rebrush(readFileSync(join(samples, name)), { layers, sides: 'both' });
  const out = join(folder, 'layers.gcode');
  const options = layers.flatMap((layer) => ['--layer', JSON.stringify(layer)]);
  const native = spawnSync(nativeProgram, [
    ...['rebrush', join(samples, name), '--surfaces', 'both', '-o', out, ...options],
  ]);
  assert.equal(native.status, 0, String(native.stderr));
  const all = await made(...layers);
  assert.equal(all.compare(readFileSync(out)), 0);
  // Each of them is seen.
  for (const left of layers) assert.notEqual(all.compare(await made(...layers.filter((one) => one !== left))), 0);
  const { surfaces } = await brushed(...layers);
  assert.deepEqual(
    surfaces.map(({ replaced, pictures }) => [replaced, pictures]),
    surfaces.map(() => [true, []]),
  );
});

test('a picture that is wider than its face is cut or squeezed, as by the native program', async () => {
  const file = readFileSync(join(samples, 'prusa.gcode'));
  const tones = Uint8Array.from({ length: 60 * 20 }, (_, k) => (k % 60 < 20 || k % 60 > 50 ? 230 : 4 * (k % 60)));
  const picture = png(60, 20, 1, tones);
  writeFileSync(join(folder, 'wide.png'), picture);
  const made = [];
  for (const proportions of ['keep', 'stretch']) {
    const out = join(folder, `${proportions}.gcode`);
    const options = ['--picture', join(folder, 'wide.png'), '--lamp', '60,35', '--proportions', proportions];
    assert.equal(spawnSync(nativeProgram, ['rebrush', join(samples, 'prusa.gcode'), ...options, '-o', out]).status, 0);
    const layers = [{ kind: 'picture', pictures: [{ file: picture, lamp: [60, 35] }] }];
    const done = await engine.rebrush(file, { layers, pictures: { proportions } });
    made.push(Buffer.from(await done.blob.arrayBuffer()));
    const shares = done.surfaces.filter(({ replaced }) => replaced).map(({ pictures: [{ leftOut }] }) => leftOut);
    assert.ok(shares.length > 0 && shares.every((share) => (proportions === 'keep' ? share > 0.3 : share === 0)));
    assert.equal(made.at(-1).compare(readFileSync(out)), 0, proportions);
  }
  assert.notEqual(made[0].compare(made[1]), 0);
});

test('a print is seen from above as high as it is', async () => {
  const file = readFileSync(join(samples, 'prusa.gcode'));
  const { surfaces } = await engine.listSurfaces(file);
  const top = surfaces.find(({ side }) => side === 'top');
  const { corner, cell, columns, rows, heights } = await engine.printRelief(file, 256);
  assert.equal(heights.length, columns * rows);
  assert.ok(Math.max(columns, rows) <= 256);
  const column = Math.floor((top.corner[0] + top.region.page[0] / 2 - corner[0]) / cell);
  const row = rows - 1 - Math.floor((top.corner[1] + top.region.page[1] / 2 - corner[1]) / cell);
  assert.ok(Math.abs(heights[row * columns + column] - top.z) < top.height);
  assert.equal(heights[0], 0);
  assert.deepEqual(await engine.printRelief(gzipSync(file), 256), { corner, cell, columns, rows, heights });
});

test('what cannot be re-brushed is refused in a sentence', async () => {
  const file = readFileSync(join(samples, names[0]));
  const refused = [
    [() => engine.listSurfaces(Buffer.from('G28\n')), 'InvalidFile', /does not mark its surfaces/],
    [
      () => engine.rebrush(file, { fit: 'bed', layers: [{ kind: 'direction', angle: 3 }] }),
      'InvalidArgument',
      /does not give its bed/,
    ],
    [() => engine.rebrush(file, { sides: 'left' }), 'InvalidArgument', /how\.sides is "left"/],
    [() => engine.rebrush(file, { fit: 'page' }), 'InvalidArgument', /how\.fit is "page"/],
    [() => engine.rebrush(file, { angle: 3 }), 'InvalidArgument', /unknown key "how\.angle"/],
    [() => engine.rebrush(file, { directions: { angle: 3 } }), 'InvalidArgument', /unknown key "how\.directions"/],
    [() => engine.rebrush(file, { toolpath: { seed: -1 } }), 'InvalidArgument', /seed/],
    [() => engine.rebrush(file, { layers: 7 }), 'InvalidArgument', /^layers is 7; it must be a list/],
    [
      () => engine.rebrush(file, { layers: [{ kind: 'direction', font: 'Nunito' }] }),
      'InvalidArgument',
      /^layers\[0\]\.font is not for the kind "direction"/,
    ],
    [() => engine.rebrush('file'), 'InvalidArgument', /^file is "file"/],
    [() => engine.rebrush(file, { only: [] }), 'InvalidArgument', /how\.only is empty/],
    [() => engine.rebrush(file, { only: [0.5] }), 'InvalidArgument', /how\.only\[0\] is 0\.5/],
    [() => engine.rebrush(file, { only: [99] }), 'InvalidArgument', /surface 100 is chosen; the file has 2/],
    [() => engine.printRelief(Buffer.from('G28\n')), 'InvalidFile', /marks no layer/],
    [() => engine.printRelief(file, 3), 'InvalidArgument', /side is 3; it must be 16 to 4096/],
  ];
  for (const [call, code, message] of refused) {
    await assert.rejects(call, (error) => {
      assert.equal(error.code, code);
      assert.match(error.message, message);
      return true;
    });
  }
});
