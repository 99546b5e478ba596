// From a plate to the printer and to the wall: whose printer it is, asked once, and where the lamp must stand.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { strFromU8, unzipSync } from 'fflate';

import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { linkOf } from './support/small.js';
import { settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);
const sheet = (visit) => visit.page.locator('sillon-printer-sheet dialog');
const main = (visit) => visit.page.locator('sillon-header button.main').first();
const settingOf = (gcode, name) => new RegExp(`^; ${name} = (.*)$`, 'm').exec(gcode)?.[1];

/** Of the file that a press brings. */
async function saved(visit, press) {
  const [download] = await Promise.all([visit.page.waitForEvent('download'), press()]);
  return readFileSync(await download.path(), 'utf8');
}

test('the printer is asked for before the first file, remembered, and stands on the button', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true, asks: true });
  await visit.idle();
  let downloads = 0;
  visit.page.on('download', () => ++downloads);
  assert.equal(await main(visit).innerText(), 'G-code');
  await main(visit).click();
  await sheet(visit).waitFor();
  // Nothing is guessed.
  const take = sheet(visit).locator('.end button');
  await take.click();
  await sheet(visit).getByRole('alert').getByText('Choose your printer first').waitFor();
  await visit.page.keyboard.press('Escape');
  await sheet(visit).waitFor({ state: 'detached' });
  assert.equal(downloads, 0);

  await main(visit).click();
  const printer = sheet(visit).getByLabel('Printer', { exact: true });
  const labels = await printer.locator('option').allInnerTexts();
  assert.equal(labels[0], 'Choose your printer');
  assert.equal(labels.at(-2), 'Another printer: Generic');
  await printer.selectOption({ label: 'Creality Ender-3' });
  await sheet(visit).getByText('We have not tried any file of Sillon on the Creality Ender-3 yet').waitFor();
  await sheet(visit).getByRole('radio', { name: 'Blue PLA' }).check();
  await sheet(visit).getByRole('button', { name: '2 mm', exact: true }).click();
  await visit.until((state) => state.plate.print.base === 9);
  const gcode = await saved(visit, () =>
    sheet(visit).getByRole('button', { name: 'G-code for Creality Ender-3' }).click(),
  );
  assert.equal(settingOf(gcode, 'printer_model'), 'Ender-3');
  assert.match(gcode, /^;Z:2$/m);
  assert.doesNotMatch(gcode, /^;Z:2\.[1-9]/m);
  // It was told in the sheet, and is not told again.
  const notices = visit.page.locator('sillon-notices');
  await notices.getByText('is in your downloads').waitFor();
  assert.equal(await notices.getByText('We have not tried').count(), 0);

  // The next visit, and a plate that begins.
  await visit.page.reload();
  await visit.idle();
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.services.newPlate());
  await visit.until(({ plate }) => plate.width === 70 && plate.pictures.spool === 'bluePla' && plate.print.base === 9);
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, width: 20, height: 20 }));
  });
  await visit.idle();
  assert.equal(await main(visit).innerText(), 'G-code for Creality Ender-3');
  assert.equal(settingOf(await saved(visit, () => main(visit).click()), 'printer_model'), 'Ender-3');
  assert.equal(await sheet(visit).count(), 0);

  // It can be changed at any time, from the list of all actions as well.
  await visit.page.keyboard.press('Control+k');
  await visit.page.keyboard.type('filament thick');
  await visit.page.getByRole('option', { name: 'Printer, filament, thickness' }).first().click();
  await printer.selectOption({ label: 'Prusa MINI' });
  await sheet(visit).getByRole('button', { name: 'Done' }).click();
  await sheet(visit).waitFor({ state: 'detached' });
  assert.equal(await main(visit).innerText(), 'G-code for Prusa MINI');
  assert.deepEqual(visit.problems, []);
});

test('a Bambu printer leads to its slicer’s file, which brings filament and temperatures, too', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true, asks: true });
  await visit.idle();
  await visit.page.keyboard.press('Control+Shift+s');
  const printer = sheet(visit).getByLabel('Printer', { exact: true });
  await printer.selectOption({ label: 'Bambu Lab P1S: from your slicer’s file' });
  await sheet(visit).getByText('A Bambu Lab P1S begins with commands').waitFor();
  await sheet(visit).locator('.end button').click();
  const choose = sheet(visit).getByRole('button', { name: 'From your slicer’s file…' });
  assert.ok(await choose.evaluate((one) => one.matches(':focus')), 'the focus is not where the file is chosen');
  const [chooser] = await Promise.all([visit.page.waitForEvent('filechooser'), choose.click()]);
  const settings = [
    'printer_model = Bambu Lab P1S',
    'gcode_flavor = marlin',
    'filament_type = PETG-CF',
    'nozzle_temperature = 255',
    'nozzle_temperature_initial_layer = 255',
    'hot_plate_temp = 70',
    'hot_plate_temp_initial_layer = 70',
  ];
  const text = `; generated by OrcaSlicer 2.1\nG28\nM190 S70\nM109 S255\n;LAYER_CHANGE\nG1 X100 Y90 Z0.2 F6000\nG1 X130 E0.4\nM84\n${settings.map((line) => `; ${line}\n`).join('')}`;
  await chooser.setFiles({ name: 'p1s.gcode', mimeType: '', buffer: Buffer.from(text) });
  await visit.until(({ plate }) => plate.printer.name === 'Bambu Lab P1S');
  await sheet(visit).getByText('It prints PETG-CF at 255 °C on a bed of 70 °C').waitFor();
  assert.equal(await sheet(visit).locator('.field:has(.swatches) .note').innerText(), 'PETG-CF, from your file');
  assert.equal(await visit.state(({ plate }) => plate.pictures.spool), 'redPetg');
  await visit.idle();
  await sheet(visit).getByRole('button', { name: 'G-code for Bambu Lab P1S' }).click();
  // Lines of a start block are shown before the first file with them.
  const blocks = visit.page.locator('sillon-blocks');
  await blocks.getByText('M109 S{first_layer_temperature}', { exact: true }).waitFor();
  const [download] = await Promise.all([
    visit.page.waitForEvent('download'),
    blocks.getByRole('button', { name: 'Download G-code' }).click(),
  ]);
  const inside = unzipSync(readFileSync(await download.path()));
  const gcode = strFromU8(inside['Metadata/plate_1.gcode']);
  assert.match(gcode, /^M190 S70\nM109 S255$/m);
  assert.equal(settingOf(gcode, 'filament_type'), 'PETG-CF');
});

test(
  'whoever means no printer in particular is asked once, and a printer that came with a file is known',
  { skip },
  async () => {
    const visit = await bench.open({ small: true, fresh: true, asks: true });
    await visit.idle();
    await main(visit).click();
    await sheet(visit).getByLabel('Printer', { exact: true }).selectOption({ label: 'Another printer: Generic' });
    const gcode = await saved(visit, () => sheet(visit).getByRole('button', { name: 'Download G-code' }).click());
    assert.equal(settingOf(gcode, 'printer_model'), 'Generic');
    await visit.page.reload();
    await visit.idle();
    await saved(visit, () => main(visit).click());

    const other = await bench.open({
      fresh: true,
      asks: true,
      path: `/${linkOf({ printer: { profile: 'prusa-mini' } })}`,
    });
    await other.until((state) => state.plate.printer.name === 'MINI');
    await other.idle();
    assert.equal(await main(other).innerText(), 'G-code for Prusa MINI');
    assert.equal(settingOf(await saved(other, () => main(other).click()), 'printer_model'), 'MINI');
    // What was not seen in the sheet is told of that printer beside the file.
    await other.page.locator('sillon-notices').getByText('not tried any file of Sillon on the Prusa MINI').waitFor();
  },
);

test('the button shrinks with the window, and both of its parts are reached', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.change((plate) => ({
      ...plate,
      printer: { ...plate.printer, name: 'A printer with a name that never ends' },
    }));
    studio.change((plate) => ({ ...plate, printer: { ...plate.printer, bedMax: [300, 300] } }));
  });
  for (const width of [1366, 1000, 900, 600, 412, 360, 320]) {
    await visit.page.setViewportSize({ width, height: 700 });
    await settled(visit.page);
    const boxes = await visit.page.locator('sillon-header button').evaluateAll((all) =>
      all
        .map((one) => one.getBoundingClientRect())
        .filter(({ width }) => width > 0)
        .map(({ left, right, top, bottom }) => ({ left, right, top, bottom })),
    );
    for (const [k, box] of boxes.entries()) {
      assert.ok(box.left >= 0 && box.right <= width, `${width}: button ${k} is cut`);
      const next = boxes[k + 1];
      if (next !== undefined) assert.ok(next.left >= box.right - 0.5, `${width}: ${k} and the next overlap`);
    }
    const all = await visit.page.locator('[popovertarget=export]').boundingBox();
    assert.ok(all.width >= 24 && all.height >= 24, `${width}: ${all.width} × ${all.height}`);
  }
});

/** The share of pixels of a box that are no paper. */
async function inked(page, clip) {
  const picture = (await page.screenshot({ clip })).toString('base64');
  return page.evaluate(async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes]));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let dark = 0;
    for (let k = 0; k < data.length; k += 4) if (data[k] + data[k + 1] + data[k + 2] < 700) ++dark;
    return (4 * dark) / data.length;
  }, picture);
}

test('after the file a card tells where each lamp must stand, and is what is printed', { skip }, async () => {
  const visit = await bench.open({ fresh: true, viewport: { width: 1000, height: 900 } }); // sun and moon
  const { page } = visit;
  await visit.idle();
  await page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, width: 30, height: 30 }));
  });
  await visit.idle();
  await saved(visit, () => main(visit).click());
  await page.locator('sillon-notices').getByRole('button', { name: 'Where the lamp must stand' }).click();
  const card = page.locator('sillon-lamp-card dialog');
  await card.waitFor();
  const rows = card.locator('.lamps > li');
  assert.equal(await rows.count(), 2);
  assert.match(
    await rows.nth(0).innerText(),
    /sun\.png\s+The lamp stands at 1 o’clock \(exactly 20° clockwise from 12\), 45° above the plate: for example 42 cm to that side and 42 cm up/,
  );
  assert.match(await rows.nth(1).innerText(), /moon\.png\s+The lamp stands at 11 o’clock \(exactly 340° /);
  assert.match(await card.innerText(), /30 × 30 mm, 0\.6 mm thick\s+Blue PLA/);
  await until(async () => (await rows.locator('img').count()) === 2, 'pictures of the plate');
  await settled(page);
  const looks = await Promise.all([0, 1].map((k) => rows.nth(k).locator('img').screenshot()));
  assert.ok(!looks[0].equals(looks[1]), 'the plate looks the same under both lamps');
  await page.evaluate(() => {
    globalThis.printed = 0;
    globalThis.print = () => ++globalThis.printed;
  });
  await card.getByRole('button', { name: 'Print this card' }).click();
  assert.equal(await page.evaluate(() => globalThis.printed), 1);

  // On paper there is the card alone.
  await page.emulateMedia({ media: 'print' });
  await settled(page);
  for (const name of ['sillon-header', 'nav', '.work', 'sillon-lamp-card button']) {
    for (const one of await page.locator(name).all()) assert.equal(await one.isVisible(), false, name);
  }
  const paper = await card.boundingBox();
  assert.ok(paper.x === 0 && paper.y === 0 && paper.width === 1000, JSON.stringify(paper));
  for (const what of ['img', 'svg']) {
    for (const one of await rows.locator(what).all()) {
      const box = await one.boundingBox();
      assert.ok(box.width > 60 && box.x >= 0 && box.x + box.width <= 1000, what);
      const share = await inked(page, box);
      assert.ok(share > 0.005, `${what}: ${share} of it is drawn`);
    }
  }
  const bare = await inked(page, { x: 700, y: 4, width: 290, height: 40 });
  assert.equal(bare, 0, 'something of the page is printed beside the title');
  await page.emulateMedia({ media: 'screen' });
  await page.keyboard.press('Escape');
  await card.waitFor({ state: 'detached' });

  // The keys for printing open it, and without it only the plate is printed.
  await page.keyboard.press('Control+p');
  await card.waitFor();
  await page.keyboard.press('Escape');
  await card.waitFor({ state: 'detached' });
  await page.emulateMedia({ media: 'print' });
  assert.equal(await page.locator('sillon-header').isVisible(), false);
  assert.equal(await page.locator('sillon-canvas').isVisible(), true);
});
