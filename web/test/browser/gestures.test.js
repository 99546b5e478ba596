// What hands do without thinking: going back, pasting a sentence, dropping pictures of unusual kinds.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { fileOf, skip, start } from './support/studio.js';

const bench = sharedBench(skip, start);
const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const desk = { viewport: { width: 1000, height: 600 } };

/** A visit behind which another page lies in the history. */
async function arrived(options) {
  const visit = await bench.open({ small: true, fresh: true, visited: true, ...options });
  await visit.until(({ plate }) => plate.width === 24);
  return visit;
}

const back = ({ page }) => page.evaluate(() => history.back());
/** Until the browser is there, from where the page goes on. */
const forward = ({ page }) =>
  page.evaluate(
    () =>
      new Promise((resolve) => {
        addEventListener('popstate', () => resolve(), { once: true });
        history.forward();
      }),
  );
/** How many entries stand for open things, once the browser has gone there. */
const entriesAre = ({ page }, count) => page.waitForFunction((n) => (history.state?.open ?? 0) === n, count);
const noDialog = (visit) => visit.page.getByRole('dialog').waitFor({ state: 'detached' });

for (const [name, options] of Object.entries({ desk, phone })) {
  test(`Back closes a sheet and stays on the page: ${name}`, { skip }, async () => {
    const visit = await arrived(options);
    const { page } = visit;
    const entries = await page.evaluate(() => history.length);
    const open = (dialog) => page.evaluate((d) => document.querySelector('sillon-app').studio.show(d), dialog);
    for (const dialog of ['help', 'gallery']) {
      await open(dialog);
      await page.getByRole('dialog').waitFor();
      await entriesAre(visit, 1);
      await page.goBack();
      await noDialog(visit);
      await visit.until((state) => state.dialog === undefined);
      await entriesAre(visit, 0);
    }
    // Closed otherwise its entry goes, too: the next Back leaves the page, as it should.
    await open('help');
    await page.getByRole('dialog').waitFor();
    await entriesAre(visit, 1);
    await page.keyboard.press('Escape');
    await noDialog(visit);
    await entriesAre(visit, 0);
    // One that takes another's place has its entry, and Forward opens nothing.
    await open('help');
    await page.getByRole('dialog').waitFor();
    await open('share');
    await page.getByRole('dialog', { name: 'Share' }).waitFor();
    await entriesAre(visit, 1);
    await back(visit);
    await noDialog(visit);
    await entriesAre(visit, 0);
    await forward(visit);
    await entriesAre(visit, 0);
    assert.equal(await page.evaluate(() => history.length), entries + 1);
    assert.equal(await page.locator('sillon-app').count(), 1);
    await page.goBack();
    assert.equal(page.url(), 'about:blank');
  });
}

test('on a phone Back closes the sheet over a section first, then the section', { skip }, async () => {
  const visit = await arrived(phone);
  const { page } = visit;
  await visit.section('Print');
  await visit.until(({ panel }) => panel === 'print');
  await entriesAre(visit, 1);
  await page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await page.getByRole('dialog').waitFor();
  await entriesAre(visit, 2);
  await page.goBack();
  await noDialog(visit);
  assert.equal(await visit.state(({ panel }) => panel), 'print');
  await page.goBack();
  await visit.until(({ panel }) => panel === '');
  await entriesAre(visit, 0);
  // From one section to the next there is one entry; the grip takes it away.
  await visit.section('Shape');
  await visit.section('Print');
  await visit.until(({ panel }) => panel === 'print');
  await entriesAre(visit, 1);
  await visit.section('Print');
  await visit.until(({ panel }) => panel === '');
  await entriesAre(visit, 0);
});

test('a link that is followed while a sheet is open closes it, and opens its plate', { skip }, async () => {
  const visit = await arrived(desk);
  const { page } = visit;
  const { hash } = new URL(
    await page.evaluate(async () => {
      const { studio } = document.querySelector('sillon-app');
      const { url } = await studio.services.link({ ...studio.store.state.plate, name: 'linked' });
      return url;
    }),
  );
  for (const follow of [(to) => (location.hash = to), (to) => location.replace(to)]) {
    await page.evaluate(() => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({ ...plate, name: 'own' }));
      studio.show('help');
    });
    await page.getByRole('dialog').waitFor();
    await entriesAre(visit, 1);
    await page.evaluate(`(${follow})(${JSON.stringify(hash)})`);
    await visit.until(({ plate, dialog }) => plate.name === 'linked' && dialog === undefined);
    await noDialog(visit);
    assert.equal(await page.evaluate(() => location.hash), '');
  }
  // And Back works on.
  await page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await page.getByRole('dialog').waitFor();
  await entriesAre(visit, 1);
  await page.goBack();
  await noDialog(visit);
  assert.equal(await visit.state(({ plate }) => plate.name), 'linked');
});

test('in a frame the history is another page’s', { skip }, async () => {
  const { page } = await bench.open({ path: '/404' });
  await page.evaluate(() => document.body.append(Object.assign(document.createElement('iframe'), { src: '/' })));
  await page.frameLocator('iframe').locator('sillon-app').waitFor({ state: 'attached' });
  const entries = await page.evaluate(() => history.length);
  const frame = page.frames()[1];
  await frame.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await frame.locator('dialog[open]').waitFor();
  await frame.evaluate(() => new Promise((resolve) => setTimeout(resolve))); // entries are made a turn later
  assert.deepEqual(await page.evaluate(() => [history.length, history.state]), [entries, null]);
});

test('a page that is loaded again under an open sheet has its Back', { skip }, async () => {
  const visit = await arrived(desk);
  const { page } = visit;
  await page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await page.getByRole('dialog').waitFor();
  await entriesAre(visit, 1);
  await page.reload();
  await visit.until(({ result }) => result !== undefined);
  await page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await page.getByRole('dialog').waitFor();
  await page.goBack();
  await noDialog(visit);
  assert.equal(await page.locator('sillon-app').count(), 1);
});

const texts = ({ plate }) => plate.layers.filter(({ kind }) => kind === 'text').map(({ text }) => text);

for (const way of ['paste', 'drop']) {
  test(`a sentence on a plate that nobody has touched can become a name sign: ${way}`, { skip }, async () => {
    const visit = await bench.open({ fresh: true, visited: true });
    await visit.until(({ plate, result }) => result?.plate === plate);
    const before = await visit.state(({ plate }) => plate.shape.kind);
    await visit[way]([], 'For Amélie, with love from all of us');
    await visit.button('Make a text of it').click();
    await visit.until(({ plate, result }) => plate.layers.length === 3 && result?.plate === plate);
    assert.deepEqual(await visit.state(texts), ['For Amélie, with\nlove from all of us']);
    const [shape, width, name, warnings] = await visit.state(({ plate, result }) => [
      plate.shape.kind,
      plate.width,
      plate.name,
      result.report.warnings.map(({ code }) => code),
    ]);
    assert.deepEqual([shape, width, name, warnings], ['rounded', 120, 'For Amélie, with love from all of us', []]);
    // It lies within the border.
    const [wide, tall] = await visit.page.evaluate(async () => {
      const { store, services } = document.querySelector('sillon-app').studio;
      const { plate } = store.state;
      const { id } = plate.layers.find(({ kind }) => kind === 'text');
      return (await services.layerBoxes(plate)).get(id).size;
    });
    assert.ok(wide > 60 && wide <= 100 && tall > 12 && tall <= 27.1, `${wide} × ${tall}`);
    await visit.page.locator('sillon-notices').getByRole('button', { name: 'Undo' }).click();
    await visit.until(({ plate }) => plate.layers.length === 1);
    assert.equal(await visit.state(({ plate }) => plate.shape.kind), before);
  });
}

test('on one’s own plate a sentence becomes letters where there is room', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until(({ plate }) => plate.width === 24);
  await visit.paste([], 'Anna');
  await visit.button('Make a text of it').click();
  await visit.until(({ plate }) => plate.layers.length === 2);
  assert.deepEqual(await visit.state(texts), ['Anna']);
  assert.deepEqual(await visit.state(({ plate }) => [plate.shape.kind, plate.width]), ['disc', 24]);
  // The next is a layer at once, as plates with layers take it.
  await visit.paste([], 'Tom');
  await visit.until(({ plate }) => plate.layers.length === 3);
  assert.deepEqual(await visit.state(texts), ['Anna', 'Tom']);
});

test('of a long text its limit is told, and of nothing nothing', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until(({ plate }) => plate.width === 24);
  await visit.paste([], ' \n');
  await visit.paste([], 'word '.repeat(100));
  await visit.page.getByText('That text has 499 characters; at most 120 can be read on a plate.').waitFor();
  assert.equal(await visit.button('Make a text of it').count(), 0);
  assert.equal(await visit.state(({ notices }) => notices.length), 1);
});

/** A picture that the page itself draws. @param draw  run in the page with its context and side */
async function drawn({ page }, name, draw, [width, height], type = 'image/png') {
  const data = await page.evaluate(
    async ([draw, width, height, type]) => {
      const canvas = Object.assign(document.createElement('canvas'), { width, height });
      eval(draw)(canvas.getContext('2d'), width, height);
      const blob = await new Promise((resolve) => canvas.toBlob(resolve, type));
      return Array.from(new Uint8Array(await blob.arrayBuffer()));
    },
    [String(draw), width, height, type],
  );
  return fileOf(name, data, type);
}

const ramp = (context, width, height) => {
  const fill = context.createLinearGradient(0, 0, width, height);
  fill.addColorStop(0, 'black');
  fill.addColorStop(1, 'white');
  context.fillStyle = fill;
  context.fillRect(0, 0, width, height);
};
const white = (context, width, height) => {
  context.fillStyle = 'white';
  context.fillRect(width / 4, height / 4, width / 2, height / 2);
};

test('a panorama stays a plate, and it is told', { skip }, async () => {
  const visit = await bench.open({ fresh: true, visited: true });
  await visit.until(({ plate }) => plate.width === 70);
  await visit.drop([await drawn(visit, 'alps.png', ramp, [1600, 100])]);
  await visit.page.getByText('It is a long strip: 161.7 × 10.11 mm').waitFor();
  const box = await visit.state(({ plate }) => [plate.width, Math.round(10 * plate.height) / 10]);
  assert.deepEqual(box, [161.7, 10.1]);
});

test('white artwork on a transparent ground is seen, by brightness too', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until(({ plate }) => plate.width === 24);
  await visit.drop([await drawn(visit, 'logo.png', white, [64, 64])]);
  await visit.page.getByText('It is white on nothing, so its ground is black here.').waitFor();
  assert.deepEqual(
    await visit.state(({ notices, plate }) => [notices.filter(({ problem }) => problem).length, plate.layers[0].by]),
    [0, 'levels'],
  );
  /** Directions in the middle of the plate and near its edge. */
  const lines = async () => {
    await visit.until(({ plate, directions }) => directions?.plate === plate || plate.layers.length > 0);
    await visit.idle();
    return visit.page.evaluate(async () => {
      const { store } = document.querySelector('sillon-app').studio;
      const [{ file }] = store.state.plate.layers;
      const bitmap = await createImageBitmap(file.bytes);
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext('2d');
      context.drawImage(bitmap, 0, 0);
      return [32, 4].map((at) => Array.from(context.getImageData(at, at, 1, 1).data));
    });
  };
  assert.deepEqual(await lines(), [
    [255, 255, 255, 255],
    [0, 0, 0, 255],
  ]);
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.services.setRole(0, 'tone'));
  await visit.until(({ plate }) => plate.layers[0].by === 'brightness');
  assert.deepEqual((await lines())[0], [255, 255, 255, 255]);
});

test('of an animation it is told that the first picture is used', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until(({ plate }) => plate.width === 24);
  // Two pictures of 2 × 1 pixels, black and white and the other way round.
  const picture = (bits) => [0x21, 0xf9, 4, 0, 10, 0, 0, 0, 0x2c, 0, 0, 0, 0, 2, 0, 1, 0, 0, 2, 2, bits, 0x0a, 0];
  const head = [...Buffer.from('GIF89a'), 2, 0, 1, 0, 0x80, 0, 0, 0, 0, 0, 255, 255, 255];
  await visit.drop([fileOf('blink.gif', [...head, ...picture(0x44), ...picture(0x0c), 0x3b], 'image/gif')]);
  await visit.page.getByText('Only the first picture of the animation is used.').waitFor();
});
