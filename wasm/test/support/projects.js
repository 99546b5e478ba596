// Project files with the inputs they name, as the engine takes them, and the native program's plates of them.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readdirSync, readFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { inputOf } from './plate.js';

export const root = fileURLToPath(new URL('../../../', import.meta.url));
export const publishedScenes = join(root, 'examples/paper');

/** The program that the package is compared with; built by ./dev build. */
export const nativeProgram = join(root, 'build/release/sillon');

/** Paths of the example projects and of the scenes published with the paper. */
export function projectPaths() {
  return [join(root, 'examples'), publishedScenes]
    .flatMap((folder) => readdirSync(folder).map((name) => join(folder, name)))
    .filter((path) => path.endsWith('.json') && basename(path) !== 'package.json')
    .sort();
}

/** @returns {Promise<{input: import('sillon').PlateInput, project: import('sillon').Project}>} */
export async function openProject(engine, path) {
  const project = await engine.readProject(readFileSync(path, 'utf8'));
  const read = (name) => new File([readFileSync(join(dirname(path), name))], basename(name));
  return { project, input: await inputOf(project, read) };
}

/** The native program's files, or what it says of a project that it refuses. @param folder  for the files */
export function nativePlate(folder, path, ...options) {
  const gcode = join(folder, 'plate.gcode');
  const report = join(folder, 'report.json');
  const { status, stderr } = spawnSync(
    nativeProgram,
    ['generate', path, '--gcode', gcode, '--report', report, '--quiet', ...options],
    { env: { ...process.env, SOURCE_DATE_EPOCH: '0' }, encoding: 'utf8' },
  );
  if (status === 2) return { refusal: stderr };
  assert.equal(status, 0, stderr);
  return { gcode: readFileSync(gcode, 'utf8'), report: JSON.parse(readFileSync(report, 'utf8')) };
}
