// G-code of the examples, and programs that read it.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { nativeProgram, root } from '../../wasm/test/support/projects.js';

/** The command's output. */
export function run(program, args) {
  const { status, stdout, stderr } = spawnSync(program, args, {
    env: { ...process.env, SOURCE_DATE_EPOCH: '0', LANG: 'en_US.UTF-8', LIBGL_ALWAYS_SOFTWARE: '1' },
    encoding: 'utf8',
    maxBuffer: 1 << 26,
  });
  assert.equal(status, 0, stderr);
  return stdout;
}

/** Whether a program is there and starts. */
export function has(program, args = ['--version']) {
  const { error, status } = spawnSync(program, args, { stdio: 'ignore' });
  return error === undefined && status === 0;
}

/** A Python that has a module: one named by SILLON_PYTHON, the one in out/python, or the system's. */
export function pythonWith(module) {
  const candidates = [process.env['SILLON_PYTHON'], join(root, 'out/python/bin/python'), '/usr/bin/python3', 'python3'];
  return candidates.find((program) => program !== undefined && has(program, ['-c', `import ${module}`]));
}

/** Plates of examples by name: their G-code, what it says of itself, what our own check finds. */
export function makePlates(names, folder) {
  const plates = {};
  for (const name of names) {
    const path = join(folder, `${name}.gcode`);
    run(nativeProgram, ['generate', join(root, 'examples', `${name}.json`), '--gcode', path, '--quiet']);
    const text = readFileSync(path, 'utf8');
    const [, time] = text.match(/^; estimated printing time \(normal mode\) = (.*)$/m);
    const units = { d: 86400, h: 3600, m: 60, s: 1 };
    plates[name] = {
      path,
      text,
      check: JSON.parse(run(nativeProgram, ['check', path, '--json'])),
      filament: Number(text.match(/^; filament used \[mm\] = (.*)$/m)[1]),
      seconds: [...time.matchAll(/(\d+)([dhms])/g)].reduce((sum, [, count, unit]) => sum + count * units[unit], 0),
    };
  }
  return plates;
}

export const close = (actual, expected, slack, what) =>
  assert.ok(Math.abs(actual - expected) <= slack, `${what}: ${actual}, ours ${expected}`);
