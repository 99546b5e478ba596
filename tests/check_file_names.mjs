// Comments and Markdown name no file that the project does not have: a file that moves takes its mentions along. Names with
// capitals stand for others. Prints each fault as file:line, and ends with 1 if there is one.
//   node tests/check_file_names.mjs
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

import { root, sources } from '../site/pages.mjs';

const files = ['dev', ...sources()];
/** Every file by its name, and by its path from each folder above it. */
const known = new Set(files.flatMap((path) => path.split('/').map((_, k, parts) => parts.slice(k).join('/'))));
// Users of the package import its entries by these names.
const { exports } = JSON.parse(readFileSync(join(root, 'wasm/package.json'), 'utf8'));
for (const entry of Object.keys(exports)) known.add(entry.replace('.', 'sillon'));
// The build makes these, and a translator the last one.
const made = /^(dist|engine|embed)\/|^web\/src\/i18n\/it\.ts$/;

const named = /[\w./-]*\w\.(?:[ch]pp|cmake|mjs|sh)\b|[\w.-]+\/[\w./-]*\w\.[jt]s\b/g;
const comments = [
  [/\.md$/, /.*/],
  [/\.([ch]pp|[jt]s|mjs)(\.in)?$/, /\/\/.*|^\s*\/?\*.*/],
  [/\.(sh|cmake)$|CMakeLists\.txt$|^dev$/, /(^|\s)#.*/],
];

for (const file of files) {
  const comment = comments.find(([name]) => name.test(file))?.[1];
  if (comment === undefined) continue;
  let inCode = false;
  readFileSync(join(root, file), 'utf8')
    .split('\n')
    .forEach((line, k) => {
      if (file.endsWith('.md') && /^\s*```/.test(line)) inCode = !inCode;
      const text = inCode ? '' : (comment.exec(line)?.[0] ?? '').replace(/https?:\S+/g, '');
      for (const [name] of text.matchAll(named)) {
        const path = name.replace(/^(\.{0,2}\/)+/, '');
        if (known.has(path) || made.test(path) || /[A-Z]{4}/.test(path)) continue;
        console.log(`${file}:${k + 1}: there is no ${name}`);
        process.exitCode = 1;
      }
    });
}
