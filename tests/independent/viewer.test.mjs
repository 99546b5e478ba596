// What PrusaSlicer's G-code viewer shows, read off its window: ./dev test viewer. Its window changes with its version, so
// this stands apart from ./dev test.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { close, has, makePlates, run } from './plates.mjs';

const here = fileURLToPath(new URL('./', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
const names = ['relief', 'photo', 'tiles', 'logo', 'mosaic', 'qr'];
let plates;
before(() => {
  plates = makePlates(names, folder);
});
after(() => rmSync(folder, { recursive: true }));

const needs = { 'prusa-slicer': ['--help'], 'xvfb-run': ['--help'], tesseract: [], xdotool: null, import: null, openbox: [] };
const packages = { tesseract: 'tesseract-ocr', import: 'imagemagick', 'xvfb-run': 'xvfb and xauth' };
const missing = Object.entries(needs).filter(([program, args]) =>
  args === null ? spawnSync(program).error !== undefined : !has(program, args.length > 0 ? args : undefined),
);
const noEnglish = spawnSync('locale', ['-a'], { encoding: 'utf8' }).stdout?.includes('en_US.utf8') !== true;
const noViewer =
  missing.length > 0
    ? `no ${missing.map(([program]) => packages[program] ?? program).join(', ')} here; install the Debian packages`
    : noEnglish && 'no locale en_US.UTF-8 here (Debian: locales, locale-gen); PrusaSlicer asks about it and waits';

/** Seconds of "1h 5m", "37m" or "22s", and how far they are rounded. */
function spoken(text) {
  const units = { d: 86400, h: 3600, m: 60, s: 1 };
  const parts = [...text.matchAll(/(\d+) ?([dhms])/g)].map(([, count, unit]) => [Number(count), units[unit]]);
  return { seconds: parts.reduce((sum, [count, unit]) => sum + count * unit, 0), step: parts.at(-1)?.[1] };
}

test("PrusaSlicer's viewer shows roles, widths, filament and a time within 3 %", { skip: noViewer }, () => {
  for (const name of names) {
    const { path, seconds, filament } = plates[name];
    const shown = run('xvfb-run', ['-a', '-s', '-screen 0 1400x900x24', 'sh', join(here, 'viewer.sh'), path, folder]);
    for (const role of ['Solid ?infill', 'Top ?solid ?infill', 'Skirt/Brim', 'Width']) {
      assert.match(shown, new RegExp(role), `${name}: ${shown}`);
    }
    const total = spoken(shown.match(/Total: *(.*)/)[1]);
    close(total.seconds, seconds, 0.03 * seconds + total.step, `${name}: time, ${shown}`);
    // Two decimals each; the point is easily overlooked.
    const amounts = [...shown.matchAll(/% +([\d.]+) ?m/g)].map(([, value]) => Number(value.replace('.', '')) / 100);
    const metres = amounts.reduce((sum, value) => sum + value, 0);
    close(metres, filament / 1000, 0.016, `${name}: filament, ${shown}`);
  }
});
