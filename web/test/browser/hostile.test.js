// Wrong files, broken links, cancelled work, reloads, and pages without threads, storage or graphics.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';

import { zipSync } from 'fflate';

import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';

let bench, visit;

before(async () => {
  if (!skip) bench = await start();
});
after(() => bench?.close());
afterEach(async () => {
  await visit?.close();
  visit = undefined;
});

const bytes = (text) => new TextEncoder().encode(text);
const wrongFiles = [
  ['an unknown kind', fileOf('song.mp3', [0x49, 0x44, 0x33, 3, 0, 0, 0, 0]), /song\.mp3/],
  ['an empty file', fileOf('nothing.png', [], 'image/png'), /nothing\.png/],
  ['a picture that ends too early', { ...fileAt(join(inputs, 'photo.png')), cut: 300 }, /cannot be read/],
  [
    'a drawing that is not XML',
    fileOf('broken.svg', bytes('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0'), 'image/svg+xml'),
    /cannot be read/,
  ],
  [
    'a drawing without areas',
    fileOf('lines.svg', bytes('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"/>'), 'image/svg+xml'),
    /nothing to fill/,
  ],
  ['a zip that is no project', fileOf('other.zip', zipSync({ 'readme.txt': bytes('hello') })), /other\.zip/],
  [
    'a project that is cut',
    fileOf('cut.sillon.zip', zipSync({ 'studio.json': bytes('{"studio": 1, "pla') })),
    /cut\.sillon\.zip/,
  ],
];

for (const [what, file, said] of wrongFiles) {
  test(`${what} is refused in words, and the plate stays`, { skip }, async () => {
    visit = await bench.open();
    await visit.idle();
    const before = await visit.state((state) => JSON.stringify(state.plate));
    const { cut, ...sent } = file;
    if (cut !== undefined) sent.data = Buffer.from(sent.data, 'base64').subarray(0, cut).toString('base64');
    await visit.drop([sent]);
    const alert = visit.page.locator('sillon-notices .problem').first();
    await alert.waitFor();
    assert.match(await alert.innerText(), said);
    // Whatever was put into the plate can be taken back, and the page goes on.
    await visit.page.evaluate(() => {
      const { store } = document.querySelector('sillon-app').studio;
      while (store.canUndo) store.undo();
    });
    await visit.idle();
    assert.equal(await visit.state((state) => JSON.stringify(state.plate)), before);
  });
}

test('a broken link is told, and the page begins as usual', { skip }, async () => {
  visit = await bench.open({ path: '/#plate=1.AAAA' });
  const alert = visit.page.locator('sillon-notices .problem').first();
  await alert.waitFor();
  assert.match(await alert.innerText(), /link/i);
  await visit.idle();
});

test('long work tells its progress, is cancelled, and begins again', { skip }, async () => {
  visit = await bench.open();
  await visit.idle();
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({
      ...plate,
      width: 300,
      height: 300,
      toolpath: { ...plate.toolpath, spacing: 0.25 },
    }));
  });
  await visit.until((state) => state.progress?.fraction > 0);
  const status = visit.page.locator('sillon-status');
  await status.getByRole('progressbar').waitFor();
  await visit.page.keyboard.press('Escape');
  await visit.until((state) => state.cancelled && state.progress === undefined);
  assert.match((await visit.status()).join(' '), /Cancelled/);
  await visit.page.keyboard.press('Control+z');
  await visit.idle();
  assert.equal(await visit.state((state) => state.plate.width), 70);
});

test('nothing holds the page’s thread for more than 100 ms while a plate is made', { skip }, async (t) => {
  visit = await bench.open();
  await visit.idle();
  // Another view draws no beads: graphics in software would be measured otherwise.
  await visit.view('Directions');
  await visit.page.waitForTimeout(500);
  const watch = (side) =>
    visit.page.evaluate(async (side) => {
      const { studio } = document.querySelector('sillon-app');
      let longest = 0;
      const observer = new PerformanceObserver((list) => {
        for (const { duration } of list.getEntries()) longest = Math.max(longest, duration);
      });
      observer.observe({ entryTypes: ['longtask'] }); // tasks above 50 ms
      studio.change((plate) => ({ ...plate, width: side, height: side }));
      const done = () => {
        const { made, plate, summary } = studio.store.state;
        return made?.plate === plate && made.measured && summary !== undefined;
      };
      while (!done()) await new Promise((resolve) => setTimeout(resolve, 50));
      await new Promise((resolve) => setTimeout(resolve, 300));
      observer.disconnect();
      const seen = new Promise((resolve) => {
        new PerformanceObserver((list) => resolve(list.getEntries()[0].duration)).observe({ entryTypes: ['longtask'] });
      });
      setTimeout(() => {
        const end = performance.now() + 130;
        while (performance.now() < end);
      }, 0);
      return { longest, control: await seen };
    }, side);
  // A machine that is busy with other things only makes tasks longer: the best of three counts.
  const found = [];
  for (const side of [180, 178, 176]) {
    const { longest, control } = await watch(side);
    assert.ok(control > 100, 'long tasks are not seen');
    found.push(longest);
    if (longest <= 100) break;
  }
  t.diagnostic(`longest ${found.join(', ')} ms`);
  assert.ok(Math.min(...found) <= 100, `${found.join(', ')} ms`);
});

test('unsaved work survives a reload', { skip }, async () => {
  visit = await bench.open();
  await visit.idle();
  await visit.drop([fileAt(join(inputs, 'relief.png'))]);
  await visit.until((state) => 'file' in state.plate.directions);
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, name: 'Kept' }));
  });
  await visit.page.waitForTimeout(1200);
  await visit.page.reload();
  await visit.until((state) => state.plate.name === 'Kept' && 'file' in state.plate.directions);
  await visit.idle();
});

test('without shared memory there is one thread, a reason, and the same plate', { skip }, async () => {
  visit = await bench.open();
  await visit.idle();
  const digest = (state) => state.made.report.digest;
  const threaded = await visit.state(digest);
  await visit.close();
  visit = await bench.open({ path: '/?threads=off' });
  await visit.idle();
  assert.equal(await visit.state((state) => state.engine.threads), 1);
  assert.equal(await visit.state((state) => state.engine.variant), 'st');
  assert.equal(await visit.state(digest), threaded);
});

test('without storage the page works', { skip }, async () => {
  const context = await bench.browser.newContext({ reducedMotion: 'reduce', serviceWorkers: 'block' });
  await context.addInitScript(() => {
    const denied = () => {
      throw new DOMException('denied', 'SecurityError');
    };
    Object.defineProperty(globalThis, 'indexedDB', { get: denied });
    Object.defineProperty(globalThis, 'localStorage', { get: denied });
  });
  visit = await bench.open({ keep: context });
  await visit.idle();
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, width: 50, height: 50 }));
  });
  await visit.idle();
  assert.equal(
    await visit.state((state) => state.notices.some((notice) => notice.problem?.code === 'Internal')),
    false,
  );
});

test('without graphics the page says so, and files can be had all the same', { skip }, async () => {
  const context = await bench.browser.newContext({ reducedMotion: 'reduce', acceptDownloads: true });
  await context.addInitScript(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind === 'webgl2' ? null : original.call(this, kind, ...rest);
    };
  });
  visit = await bench.open({ keep: context });
  const alert = visit.page.locator('sillon-notices .problem').first();
  await alert.waitFor();
  assert.match(await alert.innerText(), /WebGL 2 is missing/);
  await visit.idle();
  assert.ok((await visit.download('G-code')).bytes.length > 10_000);
});
