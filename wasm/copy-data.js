// Puts the core's tables into the package, where its exports name them.
import { cpSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
for (const name of ['presets', 'printers', 'filaments'])
  cpSync(at(`../core/data/${name}.json`), at(`dist/data/${name}.json`));
