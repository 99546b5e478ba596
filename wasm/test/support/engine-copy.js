// Copies of the engine's folder with something changed, to be used as assetBase.
import { cpSync, mkdtempSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { engineFolder } from './pages.js';

/**
 * @param {Record<string, string | null>} changes  new content by file name; null removes the file
 * @returns {{folder: string, remove(): void}}
 */
export function copyEngine(changes) {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-engine-'));
  cpSync(engineFolder, folder, { recursive: true });
  writeFileSync(join(folder, 'package.json'), '{ "type": "module" }');
  for (const variant of ['st', 'mt'])
    renameSync(join(folder, `sillon-${variant}.js`), join(folder, `real-${variant}.js`));
  const glue = { 'sillon-st.js': wrapped('st'), 'sillon-mt.js': wrapped('mt') };
  for (const [name, content] of Object.entries({ ...glue, ...changes })) {
    if (content === null) rmSync(join(folder, name), { force: true });
    else writeFileSync(join(folder, name), content);
  }
  return { folder, remove: () => rmSync(folder, { recursive: true }) };
}

/**
 * The real glue code with changes around it.
 * @param {string} before  runs before the module is made
 * @param {string} after  changes the finished `module`
 */
export const wrapped = (variant, { before = '', after = '' } = {}) => `
import real from './real-${variant}.js';
${before}
export default async (args) => {
  const module = await real(args);
  if (!args.ENVIRONMENT_IS_PTHREAD) {
    ${after}
  }
  return module;
};
`;
