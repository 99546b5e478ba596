// Puts the core's tables and fonts into the package, where its exports and the engine's addresses name them.
import { cpSync, readdirSync, rmSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
for (const name of ['presets', 'printers', 'filaments'])
  cpSync(at(`../core/data/${name}.json`), at(`dist/data/${name}.json`));
// It is in engine/text.js, with the libraries that it imports.
rmSync(at('dist/text'), { recursive: true, force: true });
for (const name of readdirSync(at('../core/data/fonts')).filter((name) => name.endsWith('.ttf')))
  cpSync(at(`../core/data/fonts/${name}`), at(`dist/engine/${name}`));
