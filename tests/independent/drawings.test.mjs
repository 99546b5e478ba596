// Drawings that nobody here made, as they are read and as resvg paints them. The packages are fetched into a temporary
// folder: none of them is part of this project. Without a registry the tests show as skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { nativeProgram } from '../../wasm/test/support/projects.js';
import { drawingsIn, fetchDrawings } from './drawings.mjs';

const renderer = '@resvg/resvg-js@2.6.2';

/** Drawings with faint shadows or fading edges, which count as solid. Beside all others they are looked at, too. */
const faint = [
  'cassandra/cassandra-original-wordmark.svg',
  'cassandra/cassandra-original.svg',
  'cypressio/cypressio-original.svg',
  'dot-net/dot-net-original-wordmark.svg',
  'dot-net/dot-net-original.svg',
  'gimp/gimp-original-wordmark.svg',
  'gimp/gimp-original.svg',
  'linux/linux-original.svg',
  'neovim/neovim-original-wordmark.svg',
  'python/python-original.svg',
].map((file) => `devicon/icons/${file}`);

/** Those of them with gradients that fade out: they end where little is seen, before the last paint. */
const fading = new Set(faint.filter((file) => /gimp|linux/.test(file)));

const painter = fileURLToPath(new URL('painted.mjs', import.meta.url));
const batch = 40; // the renderer does not give back its memory before its process ends
const folder = mkdtempSync(join(tmpdir(), 'sillon-drawings-'));
let missing;
let drawings;

before(() => {
  missing = fetchDrawings(folder, [renderer]);
  if (missing !== '') return;
  drawings = drawingsIn(folder);
});
after(() => rmSync(folder, { recursive: true, force: true }));

test('what is read of at least 300 drawings has the area that resvg paints', (context) => {
  if (missing !== '') return context.skip(missing);
  assert.ok(drawings.length >= 300, `${drawings.length} drawings`);
  const known = new Set(faint.map((name) => join(folder, 'node_modules', name)));
  const read = measured(drawings.filter((file) => !known.has(file)));
  const areas = painted(read);
  const off = read.filter(({ area }, k) => Math.abs(area / areas[k].solid - 1) > 0.03);
  assert.deepEqual(off.map(({ file }) => nameOf(file)), [], 'not within 3 %, and not named as an exception');
});

test('what is off counts faint paint as solid', (context) => {
  if (missing !== '') return context.skip(missing);
  const read = measured(faint.map((name) => join(folder, 'node_modules', name)));
  painted(read).forEach(({ solid, touched }, k) => {
    const { file, area } = read[k];
    assert.ok(area > 1.03 * solid, `${nameOf(file)} is no exception any more`);
    const told = `${nameOf(file)}: ${area} mm2 read, ${touched} mm2 painted at all`;
    if (fading.has(faint[k])) assert.ok(area < 0.97 * touched, told);
    else assert.ok(Math.abs(area / touched - 1) <= 0.03, told);
  });
});

/** As the program reads them at 40 mm. */
function measured(files) {
  const lines = execFileSync(nativeProgram, ['shape', '--json', '--size', '40', ...files], { maxBuffer: 1 << 26 });
  return lines
    .toString()
    .trim()
    .split('\n')
    .map((line) => JSON.parse(line))
    .map(({ file, page, areaMm2, error }) => {
      assert.equal(error, undefined, file);
      return { file, page, area: areaMm2 };
    });
}

function nameOf(file) {
  return file.slice(join(folder, 'node_modules').length + 1).replaceAll('\\', '/');
}

/** [mm2] of each by resvg. */
function painted(read) {
  const areas = [];
  for (let k = 0; k < read.length; k += batch) {
    const files = read.slice(k, k + batch).map(({ file }) => file);
    const shares = JSON.parse(execFileSync(process.execPath, [painter, folder, ...files]).toString());
    areas.push(...shares.map((share, n) => scaled(share, read[k + n].page)));
  }
  return areas;
}

const scaled = ({ solid, touched }, [width, height]) => ({ solid: solid * width * height, touched: touched * width * height });
