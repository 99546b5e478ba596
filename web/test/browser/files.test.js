// What files that were dropped are for can be changed, for as long as they are in the plate.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';
import { until } from './support/waits.js';

const bench = sharedBench(skip, start);
const photo = (name) => ({ ...fileAt(join(inputs, 'photo.png')), name });

async function dropped(options = {}) {
  const visit = await bench.open({ small: true, ...options });
  await visit.until(({ plate }) => plate.width === 24); // of the link, which would take the file's place
  await visit.drop([photo('first.png')]);
  await visit.page.getByText('first.png: Photo').waitFor();
  return visit;
}

test('what a file is for can be changed after other changes, which stay', { skip }, async () => {
  const visit = await dropped();
  await visit.section('Print');
  await visit.page.getByRole('spinbutton', { name: 'Bottom layers' }).fill('5');
  await visit.button('Change').click();
  await visit.page.getByRole('dialog').getByRole('combobox').selectOption('tone');
  await visit.until(({ plate }) => plate.layers[0].kind === 'tones');
  assert.equal(await visit.state(({ plate }) => plate.print.base), 5);
});

test('files are taken in however long their choice takes', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const { page, context } = visit;
  const browser = await context.newCDPSession(page);
  await browser.send('Page.enable');
  await browser.send('Page.setInterceptFileChooserDialog', { enabled: true });
  const asked = new Promise((resolve) => browser.once('Page.fileChooserOpened', resolve));
  await visit.ways();
  await page.getByRole('radio', { name: 'Direction map', exact: true }).press('Enter');
  const { backendNodeId } = await asked;
  await browser.send('HeapProfiler.collectGarbage');
  await browser.send('DOM.setFileInputFiles', { backendNodeId, files: [join(inputs, 'photo.png')] });
  await visit.until(({ plate }) => plate.layers[0].kind === 'map');
  await browser.detach();
});

test('what was said of files goes with them', { skip }, async () => {
  const visit = await dropped();
  await visit.drop([photo('second.png')]);
  await visit.page.getByText('second.png: Photo').waitFor();
  assert.equal(await visit.button('Change').count(), 1);
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.services.newPlate());
  await visit.button('Change').waitFor({ state: 'detached' });
  assert.equal(await visit.state(({ opened }) => opened === undefined), true);
});

test('what was said of a file goes when undo takes the file away', { skip }, async () => {
  const visit = await dropped();
  await visit.page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.change((plate) => ({ ...plate, name: 'Mine' }));
    studio.change((plate) => ({ ...plate, name: 'Yours' }));
    studio.store.undo();
  });
  await visit.until(({ plate }) => plate.name === 'Mine');
  assert.equal(await visit.button('Change').count(), 1);
  for (let k = 0; k < 2; ++k) await visit.page.getByRole('button', { name: 'Undo' }).click();
  await visit.until(({ opened, notices }) => opened === undefined && !notices.some(({ ofFiles }) => ofFiles));
  assert.equal(await visit.state(({ plate }) => plate.layers[0].kind === 'picture'), false);
});

test('what was said of a file goes when something of another kind takes its place', { skip }, async () => {
  const visit = await dropped();
  await visit.section('Shape');
  await visit.page.getByRole('radio', { name: 'Rounded' }).check(); // in place of the picture's rectangle: still the picture
  await visit.until(({ plate }) => plate.shape.kind === 'rounded');
  assert.equal(await visit.button('Change').count(), 1);
  await visit.drop([photo('second.png')]);
  await visit.button('Show both, turn the lamp').waitFor();
  await visit.section('Picture');
  await visit.ways();
  await visit.page.getByRole('radio', { name: 'Waves' }).check();
  await visit.button('Show both, turn the lamp').waitFor({ state: 'detached' });
  await visit.page.keyboard.press('Control+z');
  await visit.until(({ plate, opened }) => plate.layers[0].kind === 'picture' && opened === undefined);
});

test(
  'a second picture takes the place of the first, and is shown beside it where that is asked for',
  { skip },
  async () => {
    const visit = await dropped();
    await visit.drop([photo('second.png')]);
    const names = ({ plate }) => [plate.name, ...plate.layers[0].pictures.map(({ file }) => file.name)];
    await visit.until(({ plate }) => plate.name === 'second');
    assert.deepEqual(await visit.state(names), ['second', 'second.png']);
    await visit.button('Show both, turn the lamp').click();
    await visit.until(({ lamp }) => lamp === 1);
    assert.deepEqual(await visit.state(names), ['second', 'first.png', 'second.png']);
    const [one, other] = await visit.state(({ plate }) => plate.layers[0].pictures.map(({ lamp }) => lamp));
    assert.notDeepEqual(one, other);
  },
);

test('what is changed while a file is being read stays', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.until(({ plate }) => plate.width === 24);
  // A hand that is there at each step, the last of which makes the plate.
  await visit.page.evaluate(() => {
    const { store } = document.querySelector('sillon-app').studio;
    globalThis.steps = [];
    store.subscribe(({ reading }) => {
      if (reading === undefined || globalThis.steps.includes(reading.fraction)) return;
      globalThis.steps.push(reading.fraction);
      store.change((plate) => ({ ...plate, print: { ...plate.print, base: plate.print.base + 1 } }));
    });
  });
  const base = await visit.state(({ plate }) => plate.print.base);
  const drawing = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20"><rect width="40" height="20"/></svg>';
  await visit.drop([fileOf('wide.svg', Buffer.from(drawing), 'image/svg+xml')]);
  await visit.until(({ plate, reading }) => plate.shape.kind === 'file' && reading === undefined);
  const steps = await visit.page.evaluate(() => globalThis.steps);
  assert.ok(steps.length >= 4, String(steps));
  assert.equal(await visit.state(({ plate }) => plate.print.base), base + steps.length);
});

for (const way of ['drop', 'paste']) {
  test(`no plate changes behind a sheet: it closes for a file, ${way}`, { skip }, async () => {
    const visit = await bench.open({ small: true });
    await visit.until(({ plate }) => plate.width === 24);
    await visit.menu('Share');
    await visit.page.getByRole('dialog').waitFor();
    await visit[way]([photo('first.png')]);
    await visit.page.getByText('first.png: Photo').waitFor();
    assert.equal(await visit.state(({ dialog }) => dialog), undefined);
    assert.equal(await visit.page.getByRole('dialog').count(), 0);
  });
}

test('who tries other cards and comes back is asked for no file again', { skip }, async () => {
  const visit = await dropped({ fresh: true });
  const { page } = visit;
  await visit.drop([photo('second.png')]);
  await visit.button('Show both, turn the lamp').click();
  await visit.until(({ plate }) => plate.layers[0].pictures.length === 2);
  await page.evaluate(() => {
    globalThis.asked = 0;
    document.querySelector('sillon-app').studio.pick = async () => {
      ++globalThis.asked;
      return [];
    };
  });
  const card = async (name) => {
    await visit.ways();
    await page.getByRole('radio', { name, exact: true }).check();
  };
  const pictures = ({ plate }) => plate.layers[0].pictures.map(({ file, lamp }) => [file.name, lamp]);
  const both = await visit.state(pictures);
  for (const way of [['Waves'], ['Brightness'], ['Brightness', 'Waves']]) {
    for (const name of way) await card(name);
    await card('Photo');
    await visit.until(({ plate }) => plate.layers[0].kind === 'picture');
    assert.deepEqual(await visit.state(pictures), both, String(way));
  }
  // What was set is as it was left.
  await card('Waves');
  await page.getByRole('spinbutton', { name: 'Amplitude' }).fill('12');
  await card('Noise');
  await card('Waves');
  await visit.until(({ plate }) => plate.layers[0].pattern === 'waves' && plate.layers[0].amplitude === 12);

  const drawing = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20"><rect width="40" height="20"/></svg>';
  await visit.drop([fileOf('wide.svg', Buffer.from(drawing), 'image/svg+xml')]);
  await visit.until(({ plate }) => plate.shape.kind === 'file');
  const shape = ({ plate }) => [plate.shape.file?.name, plate.width, plate.height];
  const before = await visit.state(shape);
  await visit.section('Shape');
  await card('Disc');
  await card('From a file');
  await visit.until(({ plate }) => plate.shape.kind === 'file');
  assert.deepEqual(await visit.state(shape), before);
  assert.equal(await page.evaluate(() => globalThis.asked), 0);

  // Another plate has none of it.
  await page.evaluate(() => document.querySelector('sillon-app').studio.services.newPlate());
  await page.getByRole('radio', { name: 'From a file' }).click();
  await until(() => page.evaluate(() => globalThis.asked), 'the question for a file');
});
