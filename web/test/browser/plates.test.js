// Nothing is lost: several plates side by side, in several tabs, with their steps; links with pictures; files in their place.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { strFromU8, unzipSync } from 'fflate';

import { sharedBench } from './support/shared.js';
import { linkOf, named, sized } from './support/small.js';
import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';
import { keptPlate, stretchWaits, until } from './support/waits.js';

const bench = sharedBench(skip, start);

const rename = (visit, name) =>
  visit.page.evaluate((name) => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, name }));
  }, name);
const kept = (visit, name) => until(async () => (await keptPlate(visit.page))?.name === name, `${name} in the storage`);
const list = (visit) =>
  visit.page.evaluate(async () => {
    const plates = await document.querySelector('sillon-app').studio.services.plates().list();
    return plates.map(({ name, here, elsewhere, picture }) => ({ name, here, elsewhere, picture: picture?.size ?? 0 }));
  });
const names = async (visit) => (await list(visit)).map(({ name }) => name).sort();
async function showPlates(visit) {
  await visit.page.getByRole('button', { name: 'Menu' }).click();
  await visit.page.getByRole('button', { name: 'Your plates…' }).click();
  return visit.page.locator('sillon-plates dialog');
}

test('plates lie side by side: opened, renamed, duplicated, deleted, brought back', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.idle();
  await rename(visit, 'First');
  await until(
    async () => (await list(visit)).some(({ name, picture }) => name === 'First' && picture > 300),
    'a picture',
  );
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.services.newPlate());
  await rename(visit, 'Second');
  await kept(visit, 'Second');
  const dialog = await showPlates(visit);
  await dialog.getByRole('button', { name: 'Open First' }).waitFor();
  assert.equal(await dialog.locator('.here input').inputValue(), 'Second');
  await dialog.getByRole('button', { name: 'Duplicate First' }).click();
  await dialog.getByRole('button', { name: 'Open First, copy' }).waitFor();
  const field = dialog.getByRole('textbox', { name: 'Name of First, copy' });
  await field.fill('Third');
  await field.press('Tab');
  await dialog.getByRole('button', { name: 'Open Third' }).waitFor();
  await dialog.getByRole('button', { name: 'Delete Third' }).click();
  await until(async () => !(await names(visit)).includes('Third'), 'the deletion');
  const undo = dialog.getByRole('button', { name: 'Undo' });
  await until(() => undo.evaluate((one) => one.matches(':focus')), 'the focus, as the button that had it has gone');
  await undo.click();
  await dialog.getByRole('button', { name: 'Open Third' }).waitFor();
  await dialog.getByRole('button', { name: 'Open First', exact: true }).click();
  await visit.until((state) => state.plate.name === 'First' && state.dialog === undefined);
  assert.deepEqual(await names(visit), ['First', 'Second', 'Third']);
  assert.deepEqual(visit.problems, []);
});

/** Names the plate of the first tab, opens a second one, and asks for the first one's plate there. @returns the second tab */
async function takenOver(one) {
  await one.until((state) => state.result !== undefined);
  await rename(one, 'One');
  await kept(one, 'One');
  const two = await bench.open({ keep: one.context, path: '/' });
  await two.page.getByText('Your last plate is open in another tab').waitFor();
  await rename(two, 'Two');
  await kept(two, 'Two');
  await rename(one, 'One again');
  await kept(one, 'One again');
  await two.page.reload();
  await two.until((state) => state.plate.name === 'Two');
  assert.deepEqual(await names(two), ['One again', 'Two']);
  // Asked for in the second tab, it is taken from the first, which says so and goes on with a copy.
  const dialog = await showPlates(two);
  await dialog.getByRole('button', { name: 'Open One again' }).click();
  const told = one.page.getByText('Another tab continues with this plate').waitFor(); // for seven seconds
  await dialog.getByRole('button', { name: 'Continue here' }).click();
  await Promise.all([told, two.until((state) => state.plate.name === 'One again')]);
  return two;
}

test('two tabs never overwrite each other, and a plate may change hands', { skip }, async () => {
  const one = await bench.open({ small: true, fresh: true });
  const two = await takenOver(one);
  await rename(one, 'Copy');
  await rename(two, 'Original');
  await until(async () => (await names(two)).join() === 'Copy,Original,Two', 'all three');
});

test('undo and redo survive a reload', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.until((state) => state.result !== undefined);
  for (const name of ['a', 'b', 'c']) await rename(visit, name);
  await visit.page.keyboard.press('Control+z');
  await visit.until((state) => state.plate.name === 'b');
  await kept(visit, 'b');
  await visit.page.reload();
  await visit.until((state) => state.plate.name === 'b');
  await visit.page.keyboard.press('Control+Shift+z');
  await visit.until((state) => state.plate.name === 'c');
  for (const name of ['b', 'a']) {
    await visit.page.keyboard.press('Control+z');
    await visit.until(`(state) => state.plate.name === '${name}'`);
  }
});

const pictures = process.env.SILLON_PICTURES;

/** As if a later version had written the plate that is kept. */
const madeForeign = (visit) =>
  visit.page.evaluate(async () => {
    const answered = (request) => new Promise((resolve) => (request.onsuccess = () => resolve(request.result)));
    const database = await answered(indexedDB.open('sillon-studio'));
    const work = database.transaction('work', 'readwrite').objectStore('work');
    const key = (await answered(work.getAllKeys())).find((one) => one.startsWith('plate/'));
    const record = await answered(work.get(key));
    await answered(work.put({ ...record, plate: { ...record.plate, sparkle: true } }, key));
    database.close();
  });

test('a plate of another version stays, is handed out, and goes when it is deleted', { skip }, async () => {
  const told = /cannot be opened here/;
  const visit = await bench.open({ small: true, fresh: true });
  await visit.idle();
  await rename(visit, 'Theirs');
  await until(async () => (await list(visit)).some(({ picture }) => picture > 300), 'a picture');
  await madeForeign(visit);
  await visit.page.goto('about:blank');
  await visit.page.goto(bench.origin);
  await visit.page.locator('sillon-notices').getByText(told).first().waitFor();
  await visit.page.locator('sillon-notices').getByRole('button').first().click();
  const dialog = visit.page.locator('sillon-plates dialog');
  const badge = dialog.getByText('Of another version', { exact: true });
  await badge.waitFor();
  await dialog.locator('.open').click();
  assert.match(await dialog.locator('.told').innerText(), told);
  if (pictures !== undefined) await visit.page.screenshot({ path: `${pictures}/foreign.png` });
  const [saved] = await Promise.all([
    visit.page.waitForEvent('download'),
    dialog.locator('.told').getByRole('button', { name: 'Download' }).click(),
  ]);
  assert.equal(saved.suggestedFilename(), 'Theirs.sillon.zip');
  const { record } = JSON.parse(strFromU8(unzipSync(readFileSync(await saved.path()))['kept.json']));
  assert.ok(record.plate.sparkle && record.plate.project.studio.name === 'Theirs');
  await dialog.getByRole('button', { name: 'Delete Theirs' }).click();
  await until(async () => (await list(visit)).every(({ name }) => name !== 'Theirs'), 'the deletion');
  await until(async () => (await badge.count()) === 0, 'a list without it');
  assert.deepEqual(visit.problems, []);
});

test('a full storage is told', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.until((state) => state.result !== undefined);
  await visit.page.evaluate(() => {
    IDBObjectStore.prototype.put = () => {
      throw new DOMException('no room', 'QuotaExceededError');
    };
  });
  await rename(visit, 'Lost');
  const alert = visit.page.locator('sillon-notices .problem').first();
  await alert.waitFor();
  assert.match(await alert.innerText(), /no space left[^]*Save the project/);
});

test('a link carries a photo made small, and tells who opens it what it lacks', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until((state) => state.result !== undefined);
  await visit.drop([fileAt(join(inputs, 'photo.png'))]);
  await visit.until((state) => state.plate.layers[0].kind === 'picture');
  const url = await visit.page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    studio.change((plate) => {
      const [ground] = plate.layers;
      const told = { file: ground.pictures[0].file, pictures: [], kind: 'tones', from: 60, to: 150, smoothing: 0.1 };
      const points = Array.from({ length: 8000 }, (_, k) => 12 + 9 * Math.sin(k)); // more than a link carries
      const strokes = [{ tool: 'comb', points, radius: 2, soft: 0.5 }];
      return {
        ...plate,
        layers: [
          { ...ground, ...told },
          { ...ground, id: 2, pictures: [], kind: 'strokes', strokes },
        ],
      };
    });
    return (await studio.services.link(studio.store.state.plate)).url;
  });
  const hash = new URL(url).hash;
  assert.ok(hash.length < 16_000, `${hash.length} characters`);
  const other = await bench.open({ path: `/${hash}` });
  await other.until((state) => state.plate.layers[0].kind === 'tones');
  assert.ok((await other.state((state) => state.plate.layers[0].file.bytes.size)) <= 8000);
  await other.page.getByText(/could not carry .*your strokes/).waitFor();
  await other.idle();
  const plain = await bench.open({ path: `/${linkOf(sized(22))}` });
  await plain.page.getByText('Opened from a link.', { exact: true }).waitFor();
});

test('a project of the command line is opened with the drawing that tells its directions', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const halves = '<rect width="5" height="9" fill="#d00"/><rect x="5" width="5" height="9" fill="#00d"/>';
  const drawing = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 9">${halves}</svg>`;
  const colours = [
    { colour: '#dd0000', angle: 10 },
    { colour: '#0000dd', angle: 80 },
  ];
  const project = {
    sillon: 1,
    shape: { builtin: 'disc', size: [20, 20] },
    layers: [{ kind: 'tones', by: 'colours', colours, file: 'halves.svg' }],
  };
  await visit.drop([
    fileOf('halves.json', JSON.stringify(project)),
    fileOf('halves.svg', Buffer.from(drawing), 'image/svg+xml'),
  ]);
  await visit.until(({ plate }) => plate.layers[0].file?.name === 'halves.svg' && plate.width === 20);
  await visit.idle();
});

test('a project that was opened is saved back in its place', { skip }, async () => {
  const visit = await bench.open({ small: true, places: true });
  await visit.idle();
  await rename(visit, 'Before');
  const { bytes } = await visit.download('Project with its files');
  const project = fileOf('mine.sillon.zip', bytes);
  await visit.page.evaluate(async ({ name, data }) => {
    const folder = await navigator.storage.getDirectory();
    const handle = await folder.getFileHandle(name, { create: true });
    const stream = await handle.createWritable();
    await stream.write(Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0)));
    await stream.close();
    globalThis.showOpenFilePicker = async () => [handle];
  }, project);
  await visit.page.keyboard.press('Control+o');
  await visit.until((state) => state.plate.name === 'Before' && state.notices.length === 0);
  await rename(visit, 'After');
  await visit.page.keyboard.press('Control+s');
  await visit.page.getByText('Saved to mine.sillon.zip.').waitFor();
  const written = await visit.page.evaluate(async () => {
    const handle = await (await navigator.storage.getDirectory()).getFileHandle('mine.sillon.zip');
    return (await (await handle.getFile()).text()).length;
  });
  assert.ok(written > 1000);
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.services.newPlate());
  const [download] = await Promise.all([visit.page.waitForEvent('download'), visit.page.keyboard.press('Control+s')]);
  assert.match(download.suggestedFilename(), /\.sillon\.zip$/); // another plate is not that file
});

test('where the browser lends no locks, tabs ask each other and overwrite nothing', { skip }, async () => {
  const keep = await bench.browser.newContext({ reducedMotion: 'reduce', locale: 'en-US', serviceWorkers: 'block' });
  // As on pages without TLS.
  await keep.addInitScript(() => {
    delete Navigator.prototype.locks;
  });
  await stretchWaits(keep, 500, 5000); // for answers of other tabs
  const one = await bench.open({ keep, small: true });
  assert.equal(await one.page.evaluate(() => navigator.locks), undefined);
  await takenOver(one);
});

test('a new plate and an example stay on the visitor’s printer', { skip }, async () => {
  const visit = await bench.open({ path: '/?printer=prusa-mk4s' });
  const printer = ({ plate }) => plate.printer.name;
  await visit.until(({ result, plate }) => result?.plate === plate);
  const mk4s = await visit.state(printer);
  assert.match(mk4s, /MK4S/); // also of the plate that a first visit begins with
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.services.newPlate());
  await visit.until(({ plate }) => plate.layers[0].pattern === 'waves');
  assert.equal(await visit.state(printer), mk4s);
  await visit.button('Examples').click();
  await visit.page.getByRole('dialog').getByRole('button', { name: 'Rays' }).click();
  await visit.until(({ plate }) => plate.layers[0].pattern === 'radial');
  assert.equal(await visit.state(printer), mk4s);
});

test('the link on show is that of the plate as it is now', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until((state) => state.result !== undefined);
  await visit.menu('Share');
  const link = visit.page.getByRole('dialog').getByRole('textbox', { name: 'Share' });
  const first = await until(() => link.inputValue(), 'the link');
  await rename(visit, 'Another');
  const next = await until(async () => {
    const value = await link.inputValue();
    return value !== first && value;
  }, 'another link');
  const other = await bench.open({ path: `/${new URL(next).hash}` });
  await other.until(({ plate }) => plate.name === 'Another');
});

test('a link that is pasted or dropped is opened; of another address it is said what to do', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until((state) => state.result !== undefined);
  const { page } = visit;
  await visit.menu('Help');
  await page.getByRole('dialog').waitFor();
  await visit.paste([], ` https://sillon.example/${linkOf({ ...sized(22), ...named('Pasted') })}\n`);
  await visit.until(({ plate, dialog }) => plate.name === 'Pasted' && dialog === undefined);
  assert.equal(await page.evaluate(() => location.hash), '');
  /** As if it had been dragged from another page. @returns whether the browser would have gone there */
  const dropped = (address) =>
    page.evaluate((address) => {
      const app = document.querySelector('sillon-app');
      const dataTransfer = new DataTransfer();
      dataTransfer.setData('text/uri-list', address);
      const events = ['dragover', 'drop'].map(
        (type) => new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true }),
      );
      return events.map((event) => app.dispatchEvent(event));
    }, address);
  assert.deepEqual(await dropped(`https://sillon.example/${linkOf({ ...sized(21), ...named('Dropped') })}`), [
    false,
    false,
  ]);
  await visit.until(({ plate }) => plate.name === 'Dropped');
  assert.deepEqual(await dropped('https://pictures.example/cat.jpg'), [false, false]);
  await page.getByText('Nothing is fetched from pictures.example. Save the picture first').waitFor();
  assert.equal(await visit.state(({ plate }) => plate.name), 'Dropped');
  // What is pasted into a field is text.
  const name = page.getByRole('textbox', { name: 'Plate' });
  await name.evaluate((one) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData('text/plain', 'https://field.example/');
    one.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, composed: true, cancelable: true }));
  });
  await visit.paste([], 'https://other.example/');
  await page.getByText('Nothing is fetched from other.example.').waitFor();
  assert.equal(await page.getByText('field.example').count(), 0);
});

test('a name that is being typed is saved as it stands there; Escape gives the old one back', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await rename(visit, 'Old');
  const { page } = visit;
  const field = page.getByRole('textbox', { name: 'Plate' });
  const type = async (text) => {
    await field.selectText();
    await page.keyboard.type(text);
  };
  await type('Brand new');
  const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Control+s')]);
  assert.equal(download.suggestedFilename(), 'Brand new.sillon.zip');
  await page.keyboard.press('Enter');
  await type('Never mind');
  await page.keyboard.press('Escape');
  assert.equal(await field.inputValue(), 'Brand new');
  await visit.until(({ plate }) => plate.name === 'Brand new');
  await page.keyboard.press('Control+z'); // all that was typed is one step
  await visit.until(({ plate }) => plate.name === 'Old');
  assert.equal(await field.inputValue(), 'Old');
});
