// Puts the core's tables and fonts into the package, where its exports and the engine's addresses name them.
import { cpSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
for (const name of ['presets', 'printers', 'filaments'])
  cpSync(at(`../core/data/${name}.json`), at(`dist/data/${name}.json`));
// It is in engine/text.js, with the libraries that it imports.
rmSync(at('dist/text'), { recursive: true, force: true });
for (const name of readdirSync(at('../core/data/fonts')).filter((name) => name.endsWith('.ttf')))
  cpSync(at(`../core/data/fonts/${name}`), at(`dist/engine/${name}`));
// The compiler has taken all comments out. By these bundlers leave alone an import whose address they cannot know.
for (const path of ['dist/texts.js', 'dist/engine/worker.js'].map(at)) {
  const [before, after, ...more] = readFileSync(path, 'utf8').split(/\bimport\((?=\w)/);
  if (after === undefined || more.length > 0) throw new Error(`${path} has not one import of an address`);
  writeFileSync(path, `${before}import(/* @vite-ignore */ /* webpackIgnore: true */ ${after}`);
}
