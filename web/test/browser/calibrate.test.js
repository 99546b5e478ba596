// Calibration in the studio: files that are the native program's, values that go to the plate, a photograph that becomes a
// spool, spools as files, and a first print in at most six clicks.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { strFromU8, unzipSync } from 'fflate';

import { walkToFirstPrint } from './support/first-walk.js';
import { sharedBench } from './support/shared.js';
import { fileAt, fileOf, skip, start } from './support/studio.js';
import { until } from './support/waits.js';

const bench = sharedBench(skip, start);
const at = (path) => fileURLToPath(new URL(`../../../${path}`, import.meta.url));
const program = at('build/release/sillon');
const photograph = at('docs/pictures/coupon-photograph.jpg');

const open = async (options) => {
  const visit = await bench.open({ small: true, ...options });
  await visit.until((state) => state.result !== undefined);
  return visit;
};
const show = (visit, dialog) =>
  visit.page.evaluate((dialog) => document.querySelector('sillon-app').studio.show(dialog), dialog);
const choose = (visit, name) => visit.page.getByRole('radio', { name, exact: true }).check();
const kind = (visit, name) => visit.page.locator(`sillon-calibrate-prints input[value=${name}]`).check();

const fileOfDownload = async (download) => ({
  name: download.suggestedFilename(),
  text: readFileSync(await download.path(), 'utf8'),
});

async function saved(visit, press) {
  const [download] = await Promise.all([visit.page.waitForEvent('download'), press()]);
  return fileOfDownload(download);
}

/** What the native program makes of the same printer and print, on the same day. */
function natively(what, gcode, { printer, print }, spool) {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-calibrate-'));
  try {
    const date = /(\d{4}-\d\d-\d\d) at (\d\d:\d\d:\d\d) UTC/.exec(gcode);
    writeFileSync(join(folder, 'mine.json'), JSON.stringify({ sillon: 1, printer, print }));
    execFileSync(program, ['calibrate', what, 'mine.json', '--spool', spool, '-o', 'out.gcode'], {
      cwd: folder,
      env: { ...process.env, SOURCE_DATE_EPOCH: String(Date.parse(`${date[1]}T${date[2]}Z`) / 1000) },
    });
    return readFileSync(join(folder, 'out.gcode'), 'utf8');
  } finally {
    rmSync(folder, { recursive: true });
  }
}

test('a print is chosen, saved as the native program writes it, and its value is taken', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  await page.locator('[popovertarget=menu]').click();
  await visit.button('Calibrate…').click();
  await page.getByRole('img', { name: 'Coupon, as it would look in your filament' }).waitFor();
  await page.getByText('Rendered, not printed').waitFor();
  const costs = page.locator('sillon-calibrate-prints .kinds .cost');
  await until(async () => (await costs.allInnerTexts()).every((text) => /min · [\d.]+ g$/.test(text)), 'all figures');
  assert.equal(await costs.count(), 7);

  await page.getByLabel('Printer', { exact: true }).selectOption({ label: 'Prusa MK4S' });
  await kind(visit, 'flow');
  await page.getByRole('img', { name: 'Flow, as it would look' }).waitFor();
  const file = await saved(visit, () =>
    page.getByRole('dialog').getByRole('button', { name: 'Download G-code' }).click(),
  );
  assert.match(file.name, /^flow_0\.4mm_PLA_\d+m\.gcode$/);
  assert.equal(file.text, natively('flow', file.text, await visit.state((state) => state.plate), 'goldPla'));

  const use = page.locator('sillon-calibrate-prints button.use');
  assert.ok(await use.isDisabled());
  await choose(visit, '.92');
  await use.click();
  await visit.until((state) => state.plate.print.flow === 0.92);
  await kind(visit, 'width');
  await page.getByRole('spinbutton', { name: 'Narrowest even width' }).fill('0.32');
  await page.getByRole('spinbutton', { name: 'Widest even width' }).fill('0.5');
  await use.click();
  await visit.until(({ plate: { toolpath } }) => toolpath.spacing === 0.4 && toolpath.spacingVariation === 0.22);
  await page.keyboard.press('Escape');
  await visit.until((state) => state.dialog === undefined);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await visit.until(({ plate }) => plate.print.flow === 0.95 && plate.printer.name === 'MK4S');
  assert.deepEqual(visit.problems, []);
});

test('what the printer cannot do is said where its print would be', { skip }, async () => {
  const visit = await open();
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({
      ...plate,
      printer: { ...plate.printer, bedMin: [0, 0], bedMax: [40, 40] },
    }));
  });
  await show(visit, 'calibrate');
  await visit.page.getByRole('alert').getByText('over the edge of the bed').waitFor();
  await visit.page.getByText('Not on this printer').first().waitFor();
});

test('photographs become a spool that the plate, its project and its link take', { skip }, async () => {
  const visit = await open({ fresh: true });
  const { page } = visit;
  await show(visit, 'calibrate');
  await page.getByRole('button', { name: 'Photograph it…' }).click();
  await page.getByText('A photograph as it should be (rendered)').waitFor();

  const rows = page.getByRole('list', { name: 'Photographs' }).getByRole('listitem');
  await visit.drop([fileAt(at('examples/inputs/relief.png')), fileOf('broken.png', 'nothing', 'image/png')]);
  await rows.filter({ hasText: /relief\.png\s+Cannot be read: .*coupon/ }).waitFor();
  await rows.filter({ hasText: /broken\.png\s+Cannot be read: / }).waitFor();
  const [refused, broken] = await rows.locator('.why').allInnerTexts();
  assert.notEqual(refused, broken);
  assert.ok(await page.getByText('A photograph as it should be (rendered)').isVisible());

  const bytes = readFileSync(photograph);
  await visit.drop([fileAt(photograph)]);
  await page.getByText('What the photograph shows').waitFor();
  const shown = page.locator('sillon-calibrate-photo dd');
  const figures = async () => (await shown.allInnerTexts()).map((text) => text.match(/[\d.]+/g)?.map(Number) ?? []);
  const one = await figures();
  await visit.drop([fileOf('again.jpg', bytes, 'image/jpeg')]);
  await page.getByText('What 2 photographs show together').waitFor();
  await rows.filter({ hasText: /2\. again\.jpg/ }).waitFor();
  const both = await figures();
  const natively = (...photographs) =>
    JSON.parse(spawnSync(program, ['calibrate', 'read', ...photographs, '--json'], { encoding: 'utf8' }).stdout);
  // Browsers decode a JPEG a little otherwise than the engine does.
  for (const [told, native] of [
    [one, natively(photograph)],
    [both, natively(photograph, photograph)],
  ]) {
    for (const [k, what] of ['along', 'across', 'flow', 'width'].entries()) {
      assert.ok(Math.abs(told[k][0] / native[what].value - 1) < 0.03, `${what}: ${told[k]} ${native[what].value}`);
    }
    assert.ok(Math.abs(told[2][0] - native.flow.value) < 0.01, `${told[2]} ${native.flow.value}`);
  }
  assert.deepEqual(both[3], one[3]); // the same photograph twice is no surer
  assert.match(await shown.first().innerText(), /^\d+\.\d+\s±\s0\.\d+°$/);

  await page.getByRole('button', { name: 'Remove relief.png' }).click();
  await page.getByRole('button', { name: 'Remove broken.png' }).click();
  await page.getByRole('button', { name: 'Remove coupon-photograph.jpg' }).click();
  await page.getByText('What the photograph shows').waitFor();
  assert.equal(await rows.count(), 1);
  assert.deepEqual(await figures(), one);

  await page.getByLabel('Name of the spool').fill('Blue silk');
  await page.getByRole('button', { name: 'Keep as a spool' }).click();
  await visit.until((state) => state.plate.spool?.key === 'Blue-silk');
  const { spool } = await visit.state((state) => state.plate);
  await page.keyboard.press('Escape');
  await visit.until((state) => state.dialog === undefined);

  const project = await visit.download('Project');
  const { studio: own } = JSON.parse(strFromU8(unzipSync(project.bytes)['project.json']));
  assert.deepEqual(own.spool, spool);
  const link = await page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    return (await studio.services.link(studio.store.state.plate)).url;
  });
  const other = await bench.open({ path: `/${new URL(link).hash}` });
  await other.until((state) => state.plate.spool?.key === 'Blue-silk');
  // In another visit it is among the filaments.
  await page.reload();
  await visit.until((state) => state.result !== undefined);
  await visit.section('Print');
  await page.getByRole('radio', { name: 'Blue-silk' }).waitFor();
  assert.deepEqual(visit.problems, []);
});

test(
  'spools are renamed, saved as a file that the native program reads, deleted and opened again',
  { skip },
  async () => {
    const visit = await open();
    const { page } = visit;
    const entry = { colour: [10, 120, 30], fine: { nozzleSide: [3, 14], bedSide: [2, 9] }, source: 'by hand' };
    const text = JSON.stringify({ version: 1, spools: { green: entry } });
    await show(visit, 'spools');
    await page.getByText('None yet.').waitFor();
    const pick = async (name, content) => {
      const [chooser] = await Promise.all([
        page.waitForEvent('filechooser'),
        page.getByRole('button', { name: 'Open a file…' }).click(),
      ]);
      await chooser.setFiles({ name, mimeType: 'application/json', buffer: Buffer.from(content) });
    };
    await pick('wrong.json', text.replace('14', '140'));
    await page.locator('sillon-calibrate').getByText('wrong.json is not a spool file').waitFor();
    await pick('mine.json', text);
    await page.getByRole('button', { name: 'Use green' }).click();
    await visit.until((state) => state.plate.spool?.key === 'green');
    await page.getByRole('textbox', { name: 'Name of green' }).fill('grün 2');
    await page.getByRole('textbox', { name: 'Name of green' }).press('Enter');
    await visit.until((state) => state.plate.spool?.key === 'grun-2');

    const file = await saved(visit, () => page.getByRole('button', { name: 'Save as a file' }).click());
    assert.deepEqual(JSON.parse(file.text), { version: 1, spools: { 'grun-2': entry } });
    const folder = mkdtempSync(join(tmpdir(), 'sillon-spools-'));
    try {
      writeFileSync(join(folder, file.name), file.text);
      const listed = execFileSync(program, ['spools', '--spools', join(folder, file.name)], { encoding: 'utf8' });
      assert.match(listed, /grun-2/);
    } finally {
      rmSync(folder, { recursive: true });
    }
    await page.getByRole('button', { name: 'Delete grun-2' }).click();
    await page.getByText('None yet.').waitFor();
    await page.getByRole('button', { name: 'Undo' }).last().click();
    await page.getByRole('button', { name: 'Use grun-2' }).waitFor();
    assert.equal(await visit.state((state) => state.plate.spool?.key), 'grun-2');
  },
);

test('blocks of an own printer are seen before a calibration print is saved', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  await page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({
      ...plate,
      printer: { ...plate.printer, startGcode: 'G28\nM140 S60\nM104 S210\nM190 S60\nM109 S210\nG92 E0' },
    }));
  });
  await show(visit, 'calibrate');
  await page.locator('sillon-calibrate-prints figure img').waitFor();
  await page.getByRole('dialog').getByRole('button', { name: 'Download G-code' }).click();
  await visit.until((state) => state.dialog === 'blocks');
  const file = await saved(visit, () =>
    page.locator('sillon-blocks').getByRole('button', { name: 'Download G-code' }).click(),
  );
  assert.match(file.name, /^coupon_/);
  assert.match(file.text, /\nG28\n/);
});

for (const [first, name] of [
  ['coupon', /^coupon_0\.4mm_PLA_\d+m\.gcode$/],
  ['coaster', /^Whirl_0\.4mm_PLA_\w+\.gcode$/],
]) {
  test(`a first visit has a ${first} for its printer within six clicks`, { skip }, async () => {
    const visit = await bench.open();
    await visit.until((state) => state.welcome);
    const { clicks, download } = await walkToFirstPrint(visit, first);
    const file = await fileOfDownload(download);
    assert.ok(clicks <= 6, `${clicks} clicks`);
    assert.match(file.name, name);
    assert.match(file.text, /K1/);
    await visit.until((state) => state.plate.printer.name === 'K1');
    await visit.page.getByText('What to look at afterwards').waitFor();
    const folder = mkdtempSync(join(tmpdir(), 'sillon-first-'));
    try {
      writeFileSync(join(folder, file.name), file.text);
      execFileSync(program, ['check', join(folder, file.name)]);
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
}
