// Drawings that nobody here made, as they are read and as resvg paints them. The packages are fetched into a temporary
// folder: none of them is part of this project. Without a registry the tests show as skipped.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { nativeProgram } from '../../wasm/test/support/projects.js';

/** Where each package has its drawings, and how many of them are looked at. */
const packages = {
  'simple-icons@16.37.0': ['icons', 60],
  '@tabler/icons@3.51.0': ['icons', 90],
  'bootstrap-icons@1.13.2': ['icons', 60],
  '@mdi/svg@7.4.47': ['svg', 50],
  '@fortawesome/fontawesome-free@7.3.1': ['svgs', 60],
  'lucide-static@1.62.0': ['icons', 50],
  'feather-icons@4.29.2': ['dist/icons', 30],
};
const renderer = '@resvg/resvg-js@2.6.2';

/** Drawings that are further off than 3 %, and why. None is known in these versions. */
const exceptions = {};

const pixels = 800;
const folder = mkdtempSync(join(tmpdir(), 'sillon-drawings-'));
let missing;
let drawings;
let Resvg;

before(() => {
  const names = [...Object.keys(packages), renderer];
  const npm = spawnSync(
    'npm',
    ['install', '--silent', '--ignore-scripts', '--no-audit', '--no-fund', '--fetch-retries=0', '--prefix', folder, ...names],
    { encoding: 'utf8', shell: process.platform === 'win32' },
  );
  if (npm.status !== 0) {
    missing = 'skipped: the npm registry cannot be reached';
    return;
  }
  ({ Resvg } = createRequire(join(folder, 'package.json'))('@resvg/resvg-js'));
  drawings = Object.entries(packages).flatMap(([name, [place, count]]) => {
    const home = join(folder, 'node_modules', name.slice(0, name.lastIndexOf('@')), place);
    const files = readdirSync(home, { recursive: true })
      .filter((file) => file.endsWith('.svg'))
      .sort();
    // Spread evenly over all of them, the same each time.
    return Array.from({ length: count }, (_, k) => join(home, files[Math.floor(((k + 0.5) * files.length) / count)]));
  });
});
after(() => rmSync(folder, { recursive: true, force: true }));

test('what is read of at least 300 drawings has the area that resvg paints', (context) => {
  if (missing) return context.skip(missing);
  assert.ok(drawings.length >= 300, `${drawings.length} drawings`);
  const read = execFileSync(nativeProgram, ['shape', '--json', '--size', '40', ...drawings], { maxBuffer: 1 << 26 })
    .toString()
    .trim()
    .split('\n')
    .map((line) => JSON.parse(line));
  const off = [];
  read.forEach(({ file, page, areaMm2, error }) => {
    assert.equal(error, undefined, file);
    const painted = paintedShare(readFileSync(file, 'utf8')) * page[0] * page[1];
    if (Math.abs(areaMm2 / painted - 1) > 0.03) off.push([nameOf(file), areaMm2, painted]);
  });
  const unexplained = off.filter(([name]) => !(name in exceptions));
  assert.deepEqual(unexplained, [], 'not within 3 %, and not named as an exception');
  assert.ok(off.length <= 0.01 * read.length, `${off.length} of ${read.length} are off by more than 3 %`);
});

function nameOf(file) {
  return file.slice(join(folder, 'node_modules').length + 1).replaceAll('\\', '/');
}

/** Share of the page on which something is seen: pixels that are covered at least by half. */
function paintedShare(svg) {
  const { pixels: rgba, width, height } = new Resvg(svg, {
    fitTo: { mode: 'width', value: pixels },
    font: { loadSystemFonts: false },
  }).render();
  let sum = 0;
  for (let k = 3; k < rgba.length; k += 4) sum += rgba[k] >= 128 ? 1 : 0;
  return sum / (width * height);
}
