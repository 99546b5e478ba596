// Project files with the inputs they name, as the engine takes them.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { inputOf } from './plate.js';

export const root = fileURLToPath(new URL('../../../', import.meta.url));
export const publishedScenes = join(root, '../shared/scenes');

/** The program that the package is compared with; built by ./dev build. */
export const nativeProgram = join(root, 'build/release/sillon');

/** Paths of the example projects and, where they are at hand, of the scenes published with the paper. */
export function projectPaths() {
  return [join(root, 'examples'), publishedScenes]
    .filter((folder) => existsSync(folder))
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
