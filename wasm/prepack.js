// npm pack and npm publish run this: a package without its licences, its types or its engines is not made.
import { existsSync, readFileSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = dirname(fileURLToPath(import.meta.url));
const { files } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
const engines = ['st', 'mt'].flatMap((name) => [`dist/engine/sillon-${name}.js`, `dist/engine/sillon-${name}.wasm`]);
const texts = ['dist/engine/text.js', 'dist/engine/harfbuzz.wasm', 'dist/engine/unpack.js', 'dist/engine/nunito.ttf'];
const program = ['dist/sillon.js', 'dist/cli/sillon.cjs', 'dist/cli/sillon.wasm'];
const elements = ['dist/elements/sillon-studio.js', 'dist/elements/sillon-view.js'];
const missing = [...files, ...engines, ...texts, ...program, ...elements].filter((name) => {
  const path = join(folder, name);
  return !existsSync(path) || (statSync(path).isFile() && statSync(path).size === 0);
});
if (missing.length > 0) {
  console.error(
    `sillon is not packed: ${missing.join(', ')} missing. ./dev package npm builds the package and gathers its licences.`,
  );
  process.exitCode = 1;
}
