// Wrong files, broken links, cancelled work, reloads, and pages without threads, storage or graphics.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';

import { zipSync } from 'fflate';

import { sharedBench } from './support/shared.js';
import { smallPlate } from './support/small.js';
import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';
import { keptPlate, settled, stretchWaits, until } from './support/waits.js';

const bench = sharedBench(skip, start);

const bytes = (text) => new TextEncoder().encode(text);
const wrongFiles = [
  ['an unknown kind', fileOf('song.mp3', [0x49, 0x44, 0x33, 3, 0, 0, 0, 0]), /song\.mp3/],
  ['an empty file', fileOf('nothing.png', [], 'image/png'), /nothing\.png is empty/],
  ['a document', fileOf('page.png', bytes('%PDF-1.7'), 'image/png'), /page\.png is a PDF file/],
  [
    'a picture that ends too early',
    { ...fileAt(join(inputs, 'photo.png')), cut: 300 },
    /photo\.png cannot be read as PNG: it is cut off/,
  ],
  [
    'a drawing that is not XML',
    fileOf('broken.svg', bytes('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0'), 'image/svg+xml'),
    /broken\.svg: The file is not well-formed XML in line 1/,
  ],
  [
    'a drawing without areas',
    fileOf('lines.svg', bytes('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"/>'), 'image/svg+xml'),
    /no area to fill/,
  ],
  ['a zip that is no project', fileOf('other.zip', zipSync({ 'readme.txt': bytes('hello') })), /other\.zip/],
  [
    'a project that is cut',
    fileOf('cut.sillon.zip', zipSync({ 'project.json': bytes('{"sillon": 1, "pla') })),
    /cut\.sillon\.zip/,
  ],
];

for (const [what, file, said] of wrongFiles) {
  test(`${what} is refused in words, and the plate stays`, { skip }, async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    const before = await visit.state((state) => JSON.stringify(state.plate));
    const { cut, ...sent } = file;
    if (cut !== undefined) sent.data = Buffer.from(sent.data, 'base64').subarray(0, cut).toString('base64');
    await visit.drop([sent]);
    const alert = visit.page.locator('sillon-notices .problem').first();
    await alert.waitFor();
    await until(async () => said.test(await alert.innerText()), String(said)); // exact words come with the first problem
    // Whatever was put into the plate can be taken back, and the page goes on.
    await visit.page.evaluate((before) => {
      const { store } = document.querySelector('sillon-app').studio;
      while (store.canUndo && JSON.stringify(store.state.plate) !== before) store.undo();
    }, before);
    await visit.idle();
    assert.equal(await visit.state((state) => JSON.stringify(state.plate)), before);
  });
}

test('of several files those that can be used are opened', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.drop([fileOf('nothing.png', [], 'image/png'), fileAt(join(inputs, 'photo.png'))]);
  await visit.until(({ plate }) => plate.layers[0].kind === 'picture');
  await visit.page.locator('sillon-notices').getByText('nothing.png is empty').waitFor();
});

test('a value that is too high, and a plate that does not fit, are told with names and numbers', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const change = (how) => visit.page.evaluate(`document.querySelector('sillon-app').studio.change(${how})`);
  const notices = visit.page.locator('sillon-notices');
  await change('(plate) => ({ ...plate, printer: { ...plate.printer, nozzleTemperature: 450 } })');
  await notices.getByText('printer.nozzleTemperature is 450').waitFor();
  await change('(plate) => ({ ...plate, printer: { ...plate.printer, nozzleTemperature: 215 } })');
  await visit.until(({ problem }) => problem === undefined);
  await change('(plate) => ({ ...plate, print: { ...plate.print, layers: 1000, layerHeight: 0.3 } })');
  await notices.getByText('the print is 301 mm high').waitFor();
});

test('a broken link is told, and the page begins as usual', { skip }, async () => {
  const visit = await bench.open({ path: '/#plate=2.AAAA', fresh: true });
  const alert = visit.page.locator('sillon-notices .problem').first();
  await alert.waitFor();
  assert.match(await alert.innerText(), /link/i);
  await visit.idle();
});

test('no other plate is made while a link’s is on its way', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await stretchWaits(visit.page, 1500, 0); // then a page without a link begins (`restoreWithin`): at once
  await stretchWaits(visit.page, 10_000, 170_000); // then a page begins without its link's plate (`linkWithin`)
  let begun;
  await visit.page.route(/files-[^/]*\.js$/, async (route) => {
    await visit.page.waitForTimeout(1000);
    begun = await visit.state(({ progress, result }) => progress !== undefined || result !== undefined);
    await route.continue();
  });
  await visit.page.goto(`${bench.origin}/?again${smallPlate}`);
  await visit.until((state) => state.result?.plate.width === 24);
  assert.equal(begun, false);
});

test('long work tells its progress, is cancelled, and begins again', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({
      ...plate,
      width: 300,
      height: 300,
      // So many rounds that it is not done before the page comes to look, however slow that is.
      toolpath: { ...plate.toolpath, spacing: 0.25, relaxationRounds: 100 },
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
  assert.equal(await visit.state((state) => state.plate.width), 24);
});

test('what cannot be made is told for as long as it cannot, whatever mends it', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const alarms = visit.page.locator('sillon-notices .problem');
  const change = (section, values) =>
    visit.page.evaluate(
      ([section, values]) =>
        document.querySelector('sillon-app').studio.change((plate) => ({
          ...plate,
          [section]: { ...plate[section], ...values },
        })),
      [section, values],
    );
  // No file can be written: mended by hand, and by the alarm's own button.
  await change('printer', { nozzleTemperature: 450 });
  await alarms.waitFor();
  await change('printer', { nozzleTemperature: 215 });
  await alarms.waitFor({ state: 'detached' });
  await change('printer', { bedMax: [20, 20] });
  await alarms.waitFor();
  await alarms.getByRole('button', { name: 'Undo' }).click();
  await alarms.waitFor({ state: 'detached' });
  // A layer cannot be drawn.
  await visit.page.evaluate(() =>
    document.querySelector('sillon-app').studio.change((plate) => {
      const [ground] = plate.layers;
      return { ...plate, layers: [ground, { ...ground, id: 2, kind: 'code', text: 'x'.repeat(4000) }] };
    }),
  );
  await alarms.waitFor();
  await alarms.getByRole('button', { name: 'Undo' }).click();
  await alarms.waitFor({ state: 'detached' });
  await visit.idle();
});

test('the page’s thread goes on while a plate is made', { skip }, async (t) => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  // Another view draws no beads: graphics in software would hold the thread.
  await visit.directions();
  await settled(visit.page);
  const turns = await visit.page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    const before = studio.store.state.result;
    const written = ({ result, summary }) => result !== before && !result.coarse && summary !== undefined;
    studio.change((plate) => ({ ...plate, width: 120, height: 120 }));
    let turns = 0; // of the thread between the stages of the work, as they are told
    const stages = new Set();
    for (; !written(studio.store.state); ++turns) {
      const { progress } = studio.store.state;
      if (progress !== undefined) stages.add(`${progress.job} ${progress.stage}`);
      await new Promise((resolve) => setTimeout(resolve));
    }
    return { turns, stages: stages.size };
  });
  t.diagnostic(JSON.stringify(turns));
  // Work on the page's own thread would let it turn once before and once after.
  assert.ok(turns.turns > 20 && turns.stages > 2, JSON.stringify(turns));
});

test('unsaved work survives a reload', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.idle();
  await visit.drop([fileAt(join(inputs, 'relief.png'))]);
  await visit.until((state) => state.plate.layers[0].kind === 'picture');
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, name: 'Kept' }));
  });
  await until(async () => (await keptPlate(visit.page))?.name === 'Kept', 'the work in the storage');
  await visit.page.reload();
  await visit.until((state) => state.plate.name === 'Kept' && state.plate.layers[0].pictures.length === 1);
  await visit.idle();
});

test('a link does not put away what was kept: it is offered', { skip }, async () => {
  const first = await bench.open({ small: true, fresh: true });
  await first.until((state) => state.result !== undefined);
  await first.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, name: 'Kept' }));
  });
  await until(async () => (await keptPlate(first.page))?.name === 'Kept', 'the work in the storage');
  await first.page.close(); // while its tab is there, it shows the plate itself
  const second = await bench.open({ small: true, keep: first.context });
  await second.button('Show it').click();
  await second.until((state) => state.plate.name === 'Kept');
});

test('without shared memory there is one thread, a reason, and the same plate', { skip }, async () => {
  const digest = (state) => state.result.report.digest;
  const usual = await bench.open({ small: true });
  await usual.idle();
  const threaded = await usual.state(digest);
  const visit = await bench.open({ path: `/?threads=off${smallPlate}` });
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
  const visit = await bench.open({ small: true, keep: context });
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
  const options = { reducedMotion: 'reduce', acceptDownloads: true, serviceWorkers: 'block' };
  const context = await bench.browser.newContext(options);
  await context.addInitScript(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind === 'webgl2' ? null : original.call(this, kind, ...rest);
    };
  });
  const visit = await bench.open({ small: true, keep: context });
  const alert = visit.page.locator('sillon-notices .problem').first();
  await alert.waitFor();
  assert.match(await alert.innerText(), /without WebGL 2: its light follows in steps/);
  await visit.idle();
  assert.ok((await visit.download('G-code')).bytes.length > 10_000);
});
