// Puts the core's tables and fonts into the package, where its exports and the engine's addresses name them.
import { cpSync, rmSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
for (const name of ['presets', 'printers', 'filaments'])
  cpSync(at(`../core/data/${name}.json`), at(`dist/data/${name}.json`));
// It is in engine/text.js, with the libraries that it imports.
rmSync(at('dist/text'), { recursive: true, force: true });
for (const name of ['nunito', 'bebas-neue', 'roboto-slab', 'fredoka', 'caveat'])
  cpSync(at(`../core/data/fonts/${name}.ttf`), at(`dist/engine/${name}.ttf`));
