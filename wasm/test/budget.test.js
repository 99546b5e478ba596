// What a visitor has to fetch.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';

import { root } from './support/projects.js';

const dist = join(root, 'wasm/dist');
const forNode = ['node.js', 'platform-node.js', 'sillon.js', 'cli-texts.js'];
const wrapper = readdirSync(dist).filter((name) => name.endsWith('.js') && !forNode.includes(name));
const zipped = (names) =>
  names
    .map((name) => gzipSync(readFileSync(join(dist, name)), { level: 9 }).length)
    .reduce((sum, size) => sum + size, 0);

const scripts = {
  st: ['engine/worker.js', 'engine/sillon-st.js'],
  mt: ['engine/worker.js', 'engine/sillon-mt.js', 'engine/sillon-mt.worker.js'],
};
for (const [variant, names] of Object.entries(scripts)) {
  test(`the scripts of ${variant} are at most 43.2 KB, gzip`, () => {
    const size = zipped([...wrapper, ...names]);
    assert.ok(wrapper.includes('index.js') && size <= 43.2 * 1024, `${size} bytes`);
  });

  test(`sillon-${variant}.wasm is at most 664 KB, brotli`, () => {
    const bytes = readFileSync(join(dist, `engine/sillon-${variant}.wasm`));
    const size = brotliCompressSync(bytes, {
      params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length },
    }).length;
    assert.ok(size <= 664 * 1024, `${size} bytes`);
  });
}
