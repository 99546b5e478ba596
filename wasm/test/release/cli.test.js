// npx sillon: the command line compiled for Node writes and says what the native program does.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

import { nativeProgram, root } from '../support/projects.js';

const folders = ['native', 'node'].map((name) => mkdtempSync(join(tmpdir(), `sillon-${name}-`)));
const programs = [
  [nativeProgram, []],
  [process.execPath, [join(root, 'wasm/dist/sillon.js')]],
];
after(() => {
  for (const folder of folders) rmSync(folder, { recursive: true });
});

/** Runs both programs, each in its folder. @returns what each said, without the time it took and its folder. */
function both(...words) {
  return programs.map(([program, first], k) => {
    const { status, stdout, stderr } = spawnSync(program, [...first, ...words], {
      cwd: folders[k],
      env: { ...process.env, SOURCE_DATE_EPOCH: '0' },
      encoding: 'utf8',
      maxBuffer: 1 << 26,
    });
    const plain = (text) => text.replaceAll(folders[k], '').replace(/^time .*\n/gm, '');
    return { status, stdout: plain(stdout), stderr: plain(stderr) };
  });
}

function same(...words) {
  const [native, node] = both(...words);
  assert.deepEqual(node, native, words.join(' '));
  return node;
}

const written = () => folders.map((folder) => readdirSync(folder).sort());

test('it writes the same files, bytes and all', () => {
  const disc = ['generate', '--shape', 'disc', '--size', '20', '--angle', '30'];
  assert.equal(
    same(...disc, '--gcode', 'a.gcode', '--svg', 'a.svg', '--preview', 'a.png', '--project', 'a.json').status,
    0,
  );
  assert.equal(same('generate', join(root, 'examples/qr.json'), '--gcode', 'sub.gcode', '--body', 'b.3mf').status, 0);
  const [native, node] = written();
  assert.deepEqual(node, native);
  assert.ok(native.length >= 6, String(native));
  for (const name of native) {
    assert.ok(readFileSync(join(folders[0], name)).equals(readFileSync(join(folders[1], name))), name);
  }
});

test('every command that reads a drawing or a project reads one with letters', () => {
  const label =
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="30mm" viewBox="0 0 60 30"><rect x="2" y="2" ' +
    'width="56" height="6"/><text x="30" y="24" font-family="Nunito" font-size="14" text-anchor="middle">Anna</text></svg>';
  for (const folder of folders) {
    writeFileSync(join(folder, 'label.svg'), label);
    writeFileSync(
      join(folder, 'letters.json'),
      '{"sillon": 1, "shape": {"builtin": "text", "text": "Anna", "size": [60, 20]}}',
    );
  }
  assert.match(same('shape', 'label.svg').stdout, /area 475\.05 mm2/);
  const plate = ['generate', '--shape', 'rect', '--size', '70x40', '--layer'];
  for (const words of [
    ['shape', 'label.svg', '--json'],
    ['generate', '--shape', 'label.svg', '--quiet', '--gcode', 'shape.gcode', '--project', 'shape.json'],
    ['generate', 'shape.json', '--gcode', 'project.gcode'],
    [...plate, '{"kind": "drawing", "file": "label.svg"}', '--gcode', 'drawn.gcode', '--project', 'drawn.json'],
    [...plate, '{"kind": "text", "text": "Anna"}', '--gcode', 'text.gcode'],
    [...plate, '{"kind": "code", "text": "Anna", "size": [20, 20]}', '--gcode', 'code.gcode'],
    ['generate', 'letters.json', '--gcode', 'letters.gcode'],
    ['zones', '--shape', 'label.svg', '--output', 'shape.3mf'],
    ['zones', 'drawn.json', '--output', 'drawn.3mf'],
    ['calibrate', 'flow', 'drawn.json', '--output', 'flow.gcode'],
  ]) {
    assert.equal(same(...words).status, 0, words.join(' '));
  }
  const [native, node] = written();
  assert.deepEqual(node, native);
  for (const name of native) {
    assert.ok(readFileSync(join(folders[0], name)).equals(readFileSync(join(folders[1], name))), name);
  }
});

test('it reads what others wrote, and what it wrote itself', () => {
  assert.equal(same('generate', 'a.json', '--gcode', 'again.gcode', '--quiet').status, 0);
  assert.equal(same('check', 'a.gcode').status, 0);
  assert.equal(same('check', 'a.gcode', '--json').status, 0);
  assert.equal(same('import', 'a.gcode').status, 0);
});

test('it says the same of wrong input, with the same exit code, and writes nothing', () => {
  const before = written();
  for (const words of [
    ['generate', '--shape', 'disc', '--spacing', '-1', '--gcode', 'x.gcode'],
    ['generate', '--shape', 'nothing.svg', '--gcode', 'x.gcode'],
    ['generate', '--shape', 'disc', '--gcode', 'no/such/folder/x.gcode'],
    ['generate', '--sise', '3'],
    ['check', 'missing.gcode'],
  ]) {
    assert.equal(same(...words).status, 2);
  }
  assert.deepEqual(written(), before);
});

test('it lists and helps alike', () => {
  for (const words of [[], ['--version'], ['printers'], ['settings', '--json'], ['generate', '--help']]) same(...words);
});
