// Each view, and the page in two sizes, against pictures that were looked at. Text differs between machines by a pixel or
// two, so blocks of 20 pixels are compared. SILLON_SCREENS=write draws the references anew: look at them.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { createEngine } from 'sillon';

import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { patience } from './support/waits.js';

const folder = fileURLToPath(new URL('reference/', import.meta.url));
const side = 20; // [pixels] of a block
/** Of 255; `share`: of the blocks that may differ by more than `block`, as labels do in another font. */
const most = { block: 40, mean: 4, share: 0.02 };
const bench = sharedBench(skip, start);
let engine;

before(async () => {
  if (!skip) engine = await createEngine({ threads: 'off' });
});
after(() => engine?.dispose());

/** Mean colour of each block. */
async function blocks(bytes) {
  const { width, height, channels, samples } = await engine.decodePicture(new Uint8Array(bytes));
  const scale = (samples instanceof Uint16Array ? 1 / 257 : 1) / side ** 2;
  const columns = Math.floor(width / side);
  const rows = Math.floor(height / side);
  const means = new Float64Array(3 * columns * rows);
  for (let y = 0; y < rows * side; ++y) {
    for (let x = 0; x < columns * side; ++x) {
      const block = Math.floor(y / side) * columns + Math.floor(x / side);
      for (let c = 0; c < 3; ++c) means[3 * block + c] += samples[(y * width + x) * channels + c] * scale;
    }
  }
  return { columns, rows, means };
}

/** Waits until it looks as it should. @param shoot  takes a picture */
async function compare(name, shoot) {
  const path = `${folder}${name}.jpg`;
  if (process.env.SILLON_SCREENS === 'write') {
    await pause(3000);
    mkdirSync(folder, { recursive: true });
    writeFileSync(path, await shoot());
  }
  for (const end = Date.now() + patience; ; await pause(300)) {
    const difference = await differenceFrom(path, await shoot());
    if (difference === undefined) return;
    assert.ok(Date.now() < end, `${name}: ${difference}`);
  }
}

const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));

/** In words; undefined: it looks like the reference. */
async function differenceFrom(path, bytes) {
  const [shown, reference] = await Promise.all([blocks(bytes), blocks(readFileSync(path))]);
  assert.deepEqual([shown.columns, shown.rows], [reference.columns, reference.rows], path);
  const differences = shown.means.map((mean, k) => Math.abs(mean - reference.means[k]));
  const mean = differences.reduce((sum, one) => sum + one, 0) / differences.length;
  const worst = Math.max(...differences);
  const far = differences.filter((difference) => difference > most.block).length / differences.length;
  const block = Math.floor(differences.indexOf(worst) / 3);
  const place = `(${(block % shown.columns) * side}, ${Math.floor(block / shown.columns) * side})`;
  if (mean <= most.mean && far <= most.share) return undefined;
  return `mean ${mean.toFixed(2)}, ${(100 * far).toFixed(1)} % of the blocks differ, most at ${place}: ${worst.toFixed(1)}`;
}

const picture = { type: 'jpeg', quality: 70 };

test('the views look as they should', { skip }, async () => {
  const visit = await bench.open({
    viewport: { width: 1000, height: 700 },
    colorScheme: 'light',
    deviceScaleFactor: 1,
    visited: true,
  });
  await visit.idle();
  await visit.page.evaluate(() => {
    const { store } = document.querySelector('sillon-app').studio;
    store.set({ light: { azimuth: 60, elevation: 40 }, lightMode: 'fixed', panel: '' });
  });
  const canvas = visit.page.locator('sillon-canvas');
  for (const view of ['Flow', 'Beads', 'Appearance', 'Check']) {
    await visit.view(view);
    await compare(view.toLowerCase(), () => canvas.screenshot(picture));
  }
  await visit.view('Appearance');
  await visit.button('Plain 45° zigzag').click();
  await compare('compared', () => canvas.screenshot(picture));
  await visit.view('Beads');
  await visit.page.locator('sillon-stage select').selectOption('width');
  await compare('widths', () => canvas.screenshot(picture));
});

for (const [name, options] of [
  ['wide-dark', { viewport: { width: 1280, height: 800 }, colorScheme: 'dark' }],
  ['narrow-light', { viewport: { width: 360, height: 740 }, colorScheme: 'light', isMobile: true, hasTouch: true }],
]) {
  test(`the page looks as it should, ${name}`, { skip }, async () => {
    const visit = await bench.open({ ...options, deviceScaleFactor: 1 });
    await visit.idle();
    await visit.page.evaluate(() => {
      const { store } = document.querySelector('sillon-app').studio;
      store.set({ notices: [] });
    });
    await compare(name, () => visit.page.screenshot(picture));
  });
}
