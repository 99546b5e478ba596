// Each view, and the page in two sizes, against pictures that were looked at. Text differs between machines by a pixel or
// two, so blocks of 20 pixels are compared. SILLON_SCREENS=write draws the references anew: look at them.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { createEngine } from 'sillon';

import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { patience, settled } from './support/waits.js';

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
  for (const view of ['Look', 'Path', 'Check']) {
    await visit.view(view);
    await compare(view.toLowerCase(), () => canvas.screenshot(picture));
  }
  await visit.view('Look');
  await visit.option('Compare with', 'beside');
  await compare('compared', () => canvas.screenshot(picture));
  await visit.view('Path');
  await visit.page.locator('sillon-stage select').selectOption('width');
  await compare('widths', () => canvas.screenshot(picture));
});

/** Runs in the page. How opaque its picture is at places of the plate that lie inside beads, and outside of all: by the path itself.
 * @returns the least inside, the most outside, 0..255, and how many were looked at */
function coverage() {
  const { studio } = document.querySelector('sillon-app');
  const { camera, renderRoot } = studio.stage;
  const { cycles, shape } = studio.store.state.result.toolpath;
  const { page } = shape;
  const drawing = renderRoot.querySelector('.drawing');
  const gl = drawing.getContext('webgl2');
  const opaque = (x, y) => {
    const pixel = new Uint8Array(4);
    const column = Math.floor(drawing.width / 2 + (x - camera.x) * camera.scale);
    const row = Math.floor(drawing.height / 2 + (y - camera.y) * camera.scale);
    gl.readPixels(column, row, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return pixel[3];
  };
  const segments = cycles.flatMap(({ points, widths }) =>
    Array.from(widths, (width, k) => {
      const next = (k + 1) % widths.length;
      const at = (n) => [points[2 * n], points[2 * n + 1]];
      return {
        a: at(k),
        b: at(next),
        radius: Math.min(width, widths[next]) / 2,
        most: Math.max(width, widths[next]) / 2,
      };
    }),
  );
  /** How far beyond the edges of the nearest bead [mm]; negative: inside, by no less than that. */
  const beyond = (x, y) => {
    let [least, surely] = [Infinity, Infinity];
    for (const { a, b, radius, most } of segments) {
      const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
      const share = ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1);
      const t = Math.min(1, Math.max(0, share));
      const away = Math.hypot(x - a[0] - t * dx, y - a[1] - t * dy);
      least = Math.min(least, away - most);
      surely = Math.min(surely, away - radius);
    }
    return { least, surely };
  };
  const found = { inside: 255, outside: 0, insides: 0, outsides: 0 };
  const pixel = 1 / camera.scale;
  for (let k = 0; k < 3000; ++k) {
    // Around joints, where something might be missing; every third anywhere on the page, of which corners stay free.
    const { a } = segments[(k * 7919) % segments.length];
    const [turn, away] = [k * 2.399963, ((k % 13) / 13) * 0.2];
    const place =
      k % 3 === 0
        ? [(k * 0.618034) % 1, (k * 0.754878) % 1].map((share, axis) => share * page[axis])
        : [a[0] + away * Math.cos(turn), a[1] + away * Math.sin(turn)];
    // The middle of its pixel.
    const [x, y] = place.map((v, axis) => {
      const [middle, half] = axis === 0 ? [camera.x, drawing.width / 2] : [camera.y, drawing.height / 2];
      return middle + (Math.floor(half + (v - middle) * camera.scale) + 0.5 - half) * pixel;
    });
    const { least, surely } = beyond(x, y);
    if (surely < -0.3 * pixel) {
      found.inside = Math.min(found.inside, opaque(x, y));
      found.insides += 1;
    } else if (least > pixel) {
      found.outside = Math.max(found.outside, opaque(x, y));
      found.outsides += 1;
    }
  }
  return found;
}

test('beads are drawn whole, wherever pieces of the path meet, and nothing else is', { skip }, async () => {
  const visit = await bench.open({
    small: true,
    deviceScaleFactor: 1,
    prepare: () => {
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function (kind, options) {
        return getContext.call(this, kind, kind === 'webgl2' ? { ...options, preserveDrawingBuffer: true } : options);
      };
    },
  });
  await visit.idle();
  await visit.view('Path');
  await settled(visit.page);
  const { inside, outside, insides, outsides } = await visit.page.evaluate(coverage);
  assert.ok(insides > 1500 && outsides > 100, `${insides} inside, ${outsides} outside`);
  assert.ok(inside >= 254, `${inside}`); // blending two edges rounds down
  assert.equal(outside, 0);
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
