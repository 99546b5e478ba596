// Same input, same bytes: the package against the native program, with and without threads.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { after, before, test } from 'node:test';

import { createEngine } from 'sillon';

import { atWork, turning } from './support/jobs.js';
import { png } from './support/png.js';
import { nativePlate, nativeProgram, openProject, projectPaths, root } from './support/projects.js';

const date = new Date(0);
const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
const engines = [];

before(async () => {
  for (const threads of ['off', 2, 4]) engines.push(await createEngine({ threads }));
});
after(() => {
  for (const engine of engines) engine.dispose();
  rmSync(folder, { recursive: true });
});

const native = (path, ...options) => nativePlate(folder, path, ...options);

/** What the report says of the plate, without what it says of the run and of the G-code. */
function plateOf({
  time: _1,
  peakBytes: _2,
  threads: _3,
  warnings: _4,
  pictures: _5,
  print: _6,
  neighbourDelay: _7,
  ...plate
}) {
  return plate;
}

test('the engines run with the threads they were asked for', () => {
  assert.deepEqual(
    engines.map(({ info }) => [info.variant, info.threads, info.reason]),
    [
      ['st', 1, ''],
      ['mt', 2, ''],
      ['mt', 4, ''],
    ],
  );
});

test('a base layer across the beads is that of the native program, byte for byte, and needs its path', async () => {
  const path = join(root, 'examples/strokes.json');
  const { gcode } = native(path, '--base-pattern', 'across');
  for (const engine of engines) {
    const { input, project } = await openProject(engine, path);
    const { toolpath } = await engine.generateToolpath(input, project.toolpath);
    const { toolpath: below } = await engine.generateToolpath(input, project.toolpath, { across: true });
    assert.deepEqual(below.shape, toolpath.shape);
    const print = { ...project.print, basePattern: 'across', date };
    const { blob } = await engine.writeGcode(toolpath, project.printer, print, { below });
    assert.ok((await blob.text()) === gcode, `G-code of ${engine.info.variant} differs`);
    await assert.rejects(engine.writeGcode(toolpath, project.printer, print), {
      code: 'InvalidArgument',
      message: /^print\.basePattern is across/,
    });
    // What was kept of the plate is still its own.
    assert.deepEqual((await engine.generateToolpath(input, project.toolpath)).toolpath, toolpath);
  }
});

test('packed G-code is that of the native program, and both read it', async () => {
  const path = join(folder, 'bambu.json');
  const printer = { flavor: 'bambu', startGcode: 'G28\nM190 S60\nM620 S2A\nT2\nM621 S2A\nM109 S220\n' };
  writeFileSync(path, JSON.stringify({ sillon: 1, shape: { builtin: 'disc', size: [12, 12] }, printer }));
  const packed = join(folder, 'plate.gcode.3mf');
  const args = ['generate', path, '--gcode', packed, '--quiet'];
  const { status, stderr } = spawnSync(nativeProgram, args, { env: { ...process.env, SOURCE_DATE_EPOCH: '0' } });
  assert.equal(status, 0, stderr);
  const expected = readFileSync(packed);
  const [engine] = engines;
  const { gcode } = native(path);
  const zip = await engine.packGcode(Buffer.from(gcode));
  assert.ok(expected.equals(Buffer.from(await zip.arrayBuffer())));
  assert.deepEqual(await engine.checkGcode(zip), await engine.checkGcode(Buffer.from(gcode)));
  const checked = JSON.parse(spawnSync(nativeProgram, ['check', packed, '--json'], { encoding: 'utf8' }).stdout);
  assert.deepEqual((await engine.checkGcode(zip)).unchecked, ['flow', 'speed']);
  assert.deepEqual((await engine.checkGcode(zip, { profile: 'prusa-mini' })).unchecked, []);
  assert.deepEqual(await engine.checkGcode(zip), checked);
});

test('the base body is that of the native program, as 3MF and as STL, wherever the plate stands', async () => {
  for (const name of ['logo', 'strokes']) {
    const path = join(root, `examples/${name}.json`);
    const { input, project } = await openProject(engines[0], path);
    const print = { ...project.print, base: 3, rotate: 30, copies: [1, 2] };
    const shape = await engines[0].readShape(input.shape, input.layers);
    for (const format of ['3mf', 'stl']) {
      const file = join(folder, `body.${format}`);
      const args = ['generate', path, '--base', '3', '--rotate', '30', '--copies', '1x2', '--body', file, '--quiet'];
      const { status, stderr } = spawnSync(nativeProgram, args, { encoding: 'utf8' });
      assert.equal(status, 0, stderr);
      for (const engine of engines) {
        const body = await engine.writeBaseBody(shape, project.printer, print, { format });
        assert.equal(body.type, `model/${format}`);
        assert.ok(readFileSync(file).equals(Buffer.from(await body.arrayBuffer())), `${name}.${format}`);
      }
    }
  }
});

test('after any edit, and after calls that were given up, a plate is that of a new engine', async () => {
  const input = { shape: { builtin: 'rounded', size: [16, 12] }, layers: [{ kind: 'direction', angle: 20 }] };
  const params = { perimeterMode: 'soft' };
  const edits = [
    () => {},
    () => (input.layers = [{ kind: 'direction', angle: 65 }]),
    () => (params.widthBalance = 0.3),
    () => (params.borderWeight = 1),
    () => (input.layers = [{ kind: 'map', file: turning(40, 30) }]),
    () => (input.layers = [{ ...input.layers[0], mode: 'smoothest' }]),
    () => (params.directionTolerance = 4),
    () => (input.shape = { builtin: 'disc', size: [14, 14] }),
    () => (params.spacing = 0.5),
    () => (params.perimeterMode = 'none'),
  ];
  for (const [k, edit] of edits.entries()) {
    edit();
    const fresh = await createEngine({ threads: 'off' });
    const expected = await fresh.generateToolpath(input, params);
    fresh.dispose();
    for (const engine of engines) {
      const { running, onProgress } = atWork();
      const stop = new AbortController();
      const other = { ...input, layers: [{ kind: 'direction', angle: 3 * k, mode: input.layers[0].mode }] };
      const given = engine.generateToolpath(other, params, { signal: stop.signal, onProgress });
      await running;
      stop.abort();
      await given.catch(() => {});
      for (const what of ['after a call that was given up', 'again']) {
        const { toolpath, report } = await engine.generateToolpath(input, params);
        assert.deepEqual(toolpath, expected.toolpath, `edit ${k}, ${what}`);
        assert.deepEqual(plateOf(report), plateOf(expected.report), `edit ${k}, ${what}`);
        if (what === 'again') assert.ok(!('distance' in report.time) && !('phases' in report.time), `edit ${k}`);
      }
    }
  }
});

/** A project with a layer of every kind, and of every kind of file that layers read; no layer says a default. */
function everyKind() {
  const files = {
    'lines.png': png(16, 12, 1, turning(16, 12).samples),
    'modes.png': png(2, 1, 1, Uint8Array.of(170, 255)),
    'tones.png': png(32, 32, 1, turning(32, 32).samples),
    'drawing.svg':
      '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9"><path d="M1 1h7v3h-7z"/></svg>',
    'font.ttf': readFileSync(join(root, 'core/data/fonts/fredoka.ttf')),
  };
  for (const [name, content] of Object.entries(files)) writeFileSync(join(folder, name), content);
  const layers = [
    { kind: 'map', file: 'lines.png', modeFile: 'modes.png' },
    { kind: 'direction', angle: 15, size: [20, 20], at: [20, 20], soft: 3 },
    { kind: 'pattern', pattern: 'echo', file: 'drawing.svg', size: [14, 14], at: [10, 38], mask: 'disc' },
    { kind: 'tones', file: 'tones.png', size: [14, 14], at: [28, 38], by: 'levels', from: 20, to: 80 },
    { kind: 'drawing', file: 'drawing.svg', size: [14, 14], at: [46, 38], mask: 'inside', maskFile: 'tones.png' },
    { kind: 'picture', pictures: [{ file: 'tones.png', lamp: [60, 45] }], size: [14, 14], at: [62, 38] },
    { kind: 'code', text: 'SILLON', size: [17, 17], at: [58, 12] },
    { kind: 'text', text: 'Anna', font: 'font.ttf', textSize: 6, at: [20, 10], fill: 'along' },
    { kind: 'border', width: 1.6, fill: 'along' },
    {
      kind: 'strokes',
      strokes: [
        { tool: 'comb', radius: 2, soft: 0.25, points: [2, 24, 40, 26] },
        { tool: 'mode', radius: 3, soft: 0.5, mode: 'smoothest', points: [60, 26, 70, 26] },
        { tool: 'erase', radius: 4, soft: 0.5, points: [40, 26] },
      ],
    },
  ];
  const size = [72, 48];
  const toolpath = { spacing: 0.8 };
  return { sillon: 1, shape: { builtin: 'rectangle', size }, layers, pictures: { corrections: 0 }, toolpath };
}

test('a project with every kind of layer is read as it was written, and makes the native program’s plate', async () => {
  const written = everyKind();
  const [engine] = engines;
  assert.equal(new Set(written.layers.map(({ kind }) => kind)).size, 10);
  const text = await engine.writeProject(written);
  const project = await engine.readProject(text);
  assert.deepEqual(project.layers, written.layers);
  assert.deepEqual(await engine.readProject(await engine.writeProject(project)), project);
  assert.equal(await engine.writeProject(project), text);

  const path = join(folder, 'every-kind.json');
  writeFileSync(path, text);
  const expected = native(path);
  for (const each of engines) {
    const { input, project } = await openProject(each, path);
    const { report } = await each.generateToolpath(input, project.toolpath);
    assert.deepEqual(plateOf(report), plateOf(expected.report), each.info.variant);
    const pictures = report.pictures.map(({ layer, file, r }) => [layer, file, r > 0.5]);
    assert.deepEqual(pictures, [[6, 'layers[5].pictures[0].file', true]]);
  }
  // No layer is there for nothing.
  const { input } = await openProject(engine, path);
  for (const k of input.layers.keys()) {
    const layers = input.layers.filter((_, other) => other !== k);
    const { report } = await engine.generateToolpath({ ...input, layers }, project.toolpath, { measure: false });
    assert.notEqual(report.digest, expected.report.digest, `without layers[${k}]`);
  }
});

for (const path of projectPaths()) {
  test(`${basename(path, '.json')} is the native program's plate and G-code, byte for byte`, async () => {
    const expected = native(path);
    let notes;
    let told;
    for (const engine of engines) {
      const { input, project } = await openProject(engine, path);
      // Measuring costs more than making, and its figures are the same sums: once is enough.
      const measure = notes === undefined && expected.report !== undefined;
      const { toolpath, report } = await engine.generateToolpath(input, project.toolpath, { measure });
      if (measure) {
        assert.deepEqual(plateOf(report), plateOf(expected.report));
        notes = toolpath.notes;
        told = report.warnings; // of what is lost where it is measured
      }
      const written = engine.writeGcode({ ...toolpath, notes: notes ?? [] }, project.printer, {
        ...project.print,
        date,
      });
      if (expected.refusal !== undefined) {
        await assert.rejects(written, (error) => expected.refusal.includes(error.message));
        continue;
      }
      assert.equal(report.digest, expected.report.digest);
      const { blob, summary } = await written;
      assert.equal(summary.bytes, expected.gcode.length);
      assert.deepEqual([...told, ...summary.warnings], expected.report.warnings);
      assert.ok((await blob.text()) === expected.gcode, `G-code of ${engine.info.variant} differs`);
    }
  });
}
