// How long large sliced files take, and what memory: natively, and in a page of Chromium that lists, looks at and re-brushes one.
// Prints; asserts nothing.   ./dev bench prints [MB..]
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { zipSync } from 'fflate';

import { startChromium } from '../wasm/test/support/browsers.js';
import { serve } from '../wasm/test/support/server.js';
import { sliced } from './test/browser/support/sliced.js';

const sizes = process.argv.length > 2 ? process.argv.slice(2).map(Number) : [50];
const rounds = 3;
const program = fileURLToPath(new URL('../build/release/sillon', import.meta.url));
const engine = fileURLToPath(new URL('../wasm/dist', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sillon-prints-'));
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** Memory of this program's children and theirs, shared pages counted once [MB]; 0 where /proc does not tell. */
function memory() {
  const told = (path) => {
    try {
      return readFileSync(path, 'utf8');
    } catch {
      return ''; // a process that has ended meanwhile
    }
  };
  const pids = readdirSync('/proc').filter((name) => /^\d+$/.test(name));
  const parents = new Map(pids.map((pid) => [pid, told(`/proc/${pid}/stat`).replace(/^.*\) . (\d+).*$/s, '$1')]));
  const ours = (pid) => pid !== undefined && (pid === String(process.pid) || ours(parents.get(pid)));
  return pids
    .filter((pid) => pid !== String(process.pid) && ours(pid))
    .reduce((sum, pid) => sum + Number(/^Pss:\s+(\d+)/m.exec(told(`/proc/${pid}/smaps_rollup`))?.[1] ?? 0) / 1024, 0);
}

/** A print with two tops, and as much infill below them as makes it so large. */
function print(mb) {
  const [head, tail] = String(sliced({ sides: [40, 20] })).split(/(?<=\n);LAYER_CHANGE\n;Z:0\.4\n/);
  const infill = ['G1 X62 Y62 F7800', ';TYPE:Internal infill', ';WIDTH:0.45', 'G1 F3600'];
  const lines = Math.round((mb * 1e6 - head.length - tail.length) / 29);
  for (let k = 0; k < lines; ++k) {
    const [column, row] = [k % 90, Math.floor(k / 90) % 90];
    const [x, y] = [62 + 0.4 * (row % 2 === 0 ? column : 89 - column), 62 + 0.4 * row];
    infill.push(`G1 X${x.toFixed(3)} Y${y.toFixed(3)} E0.${String(1000 + (k % 700)).padStart(5, '0')}`);
  }
  return Buffer.from(`${head}${infill.join('\n')}\n;LAYER_CHANGE\n;Z:0.4\n${tail}`);
}

function native(path, ...options) {
  const begin = performance.now();
  const { stderr, status } = spawnSync('/usr/bin/time', ['-f', '%M', program, 'rebrush', path, ...options], {
    encoding: 'utf8',
  });
  if (status !== 0) throw new Error(stderr);
  return { seconds: (performance.now() - begin) / 1000, mb: Number(stderr.trim().split('\n').at(-1)) / 1024 };
}

async function inPage(path, site) {
  const browser = await startChromium();
  try {
    const page = await browser.newPage();
    await page.goto(`${site.origin}/page.html`);
    await page.setInputFiles('input', path);
    await page.evaluate(async () => {
      const { createEngine } = await import('/sillon/index.js');
      globalThis.engine = await createEngine({ threads: 'off', assetBase: '/sillon/engine/' });
      await engine.listSurfaces(new Blob(['G28\n'])).catch(() => undefined); // modules are there
      await engine.printRelief(new Blob(['G28\n']), 16).catch(() => undefined);
    });
    const before = memory();
    let most = before;
    const watch = setInterval(() => {
      most = Math.max(most, memory());
    }, 100);
    const seconds = await page.evaluate(async () => {
      const [file] = document.querySelector('input').files;
      const begin = performance.now();
      await engine.listSurfaces(file);
      await engine.printRelief(file, 1600);
      const listed = performance.now();
      const { blob } = await engine.rebrush(file, { layers: [{ kind: 'direction', angle: 30 }] });
      return [listed - begin, performance.now() - listed, blob.size].map((value) => value / 1000);
    });
    clearInterval(watch);
    return { listed: seconds[0], brushed: seconds[1], mb: most - before };
  } finally {
    await browser.close();
  }
}

writeFileSync(join(folder, 'page.html'), '<!doctype html><title>A print</title><input type="file" />');
const site = await serve({ '/': `${folder}/`, '/sillon/': `${engine}/` });
console.log(`medians of ${rounds} runs; memory of the page: what it and its workers take more while they work`);
console.log('file                  size   native list        native re-brush    page list + look   re-brush   memory');
try {
  for (const mb of sizes) {
    const text = print(mb);
    const plain = join(folder, 'part.gcode');
    const packed = join(folder, 'part.gcode.3mf');
    writeFileSync(plain, text);
    writeFileSync(packed, zipSync({ 'Metadata/plate_1.gcode': text }, { level: 6 }));
    for (const path of [plain, packed]) {
      const out = join(folder, `new_${path.endsWith('3mf') ? 'part.gcode.3mf' : 'part.gcode'}`);
      const runs = [];
      for (let k = 0; k < rounds; ++k) {
        runs.push([native(path, '--list'), native(path, '--angle', '30', '-o', out), await inPage(path, site)]);
      }
      const of = (k, value) => median(runs.map((run) => run[k][value]));
      const told = (k) => `${of(k, 'seconds').toFixed(1)} s, ${of(k, 'mb').toFixed(0)} MB`.padEnd(17);
      console.log(
        `${path === plain ? '.gcode    ' : '.gcode.3mf'}  of ${mb} MB ${(statSync(path).size / 1e6).toFixed(0).padStart(4)} MB  ${told(0)}  ${told(1)}  ` +
          `${of(2, 'listed').toFixed(1).padStart(8)} s ${of(2, 'brushed').toFixed(1).padStart(15)} s ${of(2, 'mb').toFixed(0).padStart(6)} MB`,
      );
    }
  }
} finally {
  site.close();
  rmSync(folder, { recursive: true });
}
