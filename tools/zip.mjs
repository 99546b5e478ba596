// Packs a folder as a zip whose bytes depend on those of its files alone: CMake's also hold when each was last read.
//   node tools/zip.mjs FOLDER FILE.zip
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';

import { zipSync } from 'fflate';

process.env.TZ = 'UTC';
const [folder, to] = process.argv.slice(2);
const names = readdirSync(folder, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) =>
    join(entry.parentPath ?? entry.path, entry.name)
      .slice(folder.length + 1)
      .replaceAll('\\', '/'),
  )
  .sort();
const mtime = new Date('1985-10-26T08:15:00Z'); // as npm's packages
const files = names.map((name) => [`${basename(folder)}/${name}`, readFileSync(join(folder, name))]);
writeFileSync(to, zipSync(Object.fromEntries(files), { level: 9, mtime }));
