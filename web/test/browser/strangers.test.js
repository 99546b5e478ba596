// Strangers' designs - links, dropped projects, projects that an address or a host names - and the machine of whoever opens
// them: nothing of theirs moves or heats it unseen.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { zipSync } from 'fflate';

import { languages } from './support/languages.js';
import { sharedBench } from './support/shared.js';
import { linkOf, named } from './support/small.js';
import { fileOf, skip, start } from './support/studio.js';
import { keptPlate, settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);

const harm = [
  'G28',
  'M302 S0',
  'M211 S0',
  'M502',
  'M997',
  'M104 T1 S480',
  'SET_HEATER_TEMPERATURE HEATER=extruder TARGET=480',
  'FORCE_MOVE STEPPER=stepper_z DISTANCE=-50 VELOCITY=50',
  'RUN_SHELL_COMMAND CMD=x',
  'G1 Z-10 F9000',
  'M30 /other.gco',
];
const spoof = {
  name: 'MK4S',
  flavor: 'prusa',
  startGcode: harm.join('\n'),
  endGcode: 'M104 S0\nM140 S0\nM112',
};
const hot = {
  name: 'MK4S',
  generalHeatLimits: true,
  nozzleTemperature: 300,
  firstLayerNozzleTemperature: 300,
  bedTemperature: 120,
};
const hotMarks = /M10[49] .*S300|M1[49]0 .*S120/;

const giftWith = (printer) => `/${linkOf({ ...named('gift'), printer })}`;
const projectOf = (printer) =>
  JSON.stringify({
    sillon: 1,
    shape: { builtin: 'disc', size: [20, 20] },
    layers: [{ kind: 'direction', angle: 30 }],
    print: { layers: 1, base: 0 },
    printer,
  });
const hostile = { name: 'MK4S', startGcode: harm.join('\n'), endGcode: 'M112' };

const bar = (visit) => visit.page.locator('sillon-brought .bar');
const dialog = (visit) => visit.page.locator('sillon-blocks dialog');
const hasNothing = (text) => {
  for (const line of [...harm.slice(1), 'M112']) assert.ok(!text.includes(`\n${line}\n`), line);
  assert.doesNotMatch(text, hotMarks);
};
const pictures = process.env.SILLON_PICTURES;
const draw = async (visit, name) => {
  if (pictures === undefined) return;
  await settled(visit.page);
  await visit.page.screenshot({ path: `${pictures}/${name}.png` });
};

for (const [what, printer, says] of [
  ['commands', spoof, /“MK4S”, 11 lines of start G-code, 3 lines of end G-code/],
  ['heat', hot, /“MK4S”, nozzle 300 °C, bed 120 °C, no temperature limits/],
]) {
  test(`a link with ${what} under the name of a printer of ours changes nothing of the file`, { skip }, async () => {
    const visit = await bench.open({ path: giftWith(printer) });
    await visit.idle();
    const said = await bar(visit).innerText();
    assert.match(said, says);
    assert.match(said, /Your printer: Generic/);
    await visit.section('Print');
    assert.doesNotMatch(await visit.page.locator('#printer').locator('option:checked').innerText(), /MK4S/);
    hasNothing((await visit.download('G-code')).bytes.toString());
    await draw(visit, `bar-${what}`);
  });
}

test('what a link brings is shown line by line, and used only when that is chosen', { skip }, async () => {
  const visit = await bench.open({ path: giftWith({ ...spoof, flavor: 'marlin' }) });
  await visit.idle();
  await bar(visit).getByRole('button', { name: 'Show' }).click();
  await dialog(visit).waitFor();
  const lines = await dialog(visit).locator('code').allInnerTexts();
  assert.deepEqual(lines, [...harm, 'M104 S0', 'M140 S0', 'M112']);
  await draw(visit, 'dialog');
  await dialog(visit).getByRole('button', { name: 'Keep mine' }).click();
  await until(async () => (await bar(visit).count()) === 0, 'the bar goes');
  // Keys belong to a dialog until its `close` has been told, which comes later.
  await visit.until((state) => state.dialog === undefined);
  assert.equal(await visit.state((state) => state.plate.printer.startGcode), '');
  // It is a step like any other.
  await visit.page.keyboard.press('Control+z');
  await bar(visit).getByRole('button', { name: 'Use', exact: true }).click();
  assert.match(await visit.state((state) => state.plate.printer.startGcode), /M997/);
  await visit.section('Print');
  assert.match(await visit.page.locator('#printer').locator('option:checked').innerText(), /MK4S \(own settings\)/);
});

test('used unseen, lines are shown before the first download, which may be given up', { skip }, async () => {
  const visit = await bench.open({
    path: giftWith({ startGcode: 'G28 ; home\nG29\nM300 S440' }),
    fresh: true,
  });
  await visit.idle();
  await bar(visit).getByRole('button', { name: 'Use', exact: true }).click();
  await visit.idle();
  const ask = async () => {
    await visit.page.locator('[popovertarget=export]').click();
    await visit.page
      .locator('#export')
      .getByRole('button', { name: /^G-code/ })
      .click();
  };
  let downloads = 0;
  visit.page.on('download', () => ++downloads);
  await ask();
  await dialog(visit).waitFor();
  assert.deepEqual(await dialog(visit).locator('code').allInnerTexts(), ['G28 ; home', 'G29', 'M300 S440']);
  await visit.page.keyboard.press('Escape');
  assert.equal(downloads, 0);
  await ask();
  const [download] = await Promise.all([
    visit.page.waitForEvent('download'),
    dialog(visit).getByRole('button', { name: 'Download G-code' }).click(),
  ]);
  assert.match(download.suggestedFilename(), /\.gcode$/);
  // Seen once, it is not shown again, also after a reload.
  await visit.download('G-code');
  await until(async () => (await keptPlate(visit.page))?.printer.startGcode !== '', 'the work is kept');
  await visit.page.reload();
  await visit.idle();
  assert.match(await visit.state((state) => state.plate.printer.startGcode), /M300/);
  await visit.download('G-code');
  // A changed line is.
  await visit.page.evaluate(() =>
    document
      .querySelector('sillon-app')
      .studio.change((plate) => ({ ...plate, printer: { ...plate.printer, startGcode: 'G28\nM300 S220' } })),
  );
  await visit.idle();
  await ask();
  await dialog(visit).getByRole('button', { name: 'Remove these lines' }).click();
  assert.equal(await visit.state((state) => state.plate.printer.startGcode), '');
});

test('the choice that waits, and the one that was made, outlive a reload', { skip }, async () => {
  const visit = await bench.open({ path: giftWith(spoof), fresh: true });
  await visit.idle();
  await bar(visit).waitFor();
  await until(async () => (await keptPlate(visit.page))?.name === 'gift', 'the work is kept');
  await visit.page.reload();
  await visit.idle();
  assert.match(await bar(visit).innerText(), /11 lines/);
  assert.equal(await visit.state((state) => state.plate.printer.startGcode), '');
  await bar(visit).getByRole('button', { name: 'Keep mine' }).click();
  await until(async () => (await keptPlate(visit.page))?.brought === undefined, 'the choice is kept');
  await visit.page.reload();
  await visit.idle();
  assert.equal(await bar(visit).count(), 0);
});

test('a link is opened on the printer of the work that was left here', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.idle();
  await visit.section('Print');
  await visit.page.locator('#printer').selectOption('prusa-mini');
  await until(async () => (await keptPlate(visit.page))?.printer.name === 'MINI', 'the work is kept');
  await visit.page.goto('about:blank');
  await visit.page.goto(bench.origin + giftWith(spoof));
  await visit.idle();
  assert.match(await bar(visit).innerText(), /Your printer: .*MINI/);
  assert.equal(await visit.state((state) => state.plate.printer.name), 'MINI');
});

for (const [what, file] of [
  ['project of the command line', () => fileOf('gift.json', projectOf(hostile))],
  ['zip of such a project', () => fileOf('gift.zip', zipSync({ 'project.json': Buffer.from(projectOf(hostile)) }))],
]) {
  test(`a dropped ${what} brings no lines into the file`, { skip }, async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    await visit.drop([file()]);
    await bar(visit).waitFor();
    await visit.idle();
    assert.match(await bar(visit).innerText(), /11 lines of start G-code, 1 line of end G-code/);
    hasNothing((await visit.download('G-code')).bytes.toString());
  });
}

test('links leave blocks out, and say so', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.page.evaluate(() =>
    document
      .querySelector('sillon-app')
      .studio.change((plate) => ({ ...plate, printer: { ...plate.printer, startGcode: 'M587 S"net" P"secret"' } })),
  );
  await visit.menu('Share');
  const share = visit.page.locator('sillon-share');
  await until(async () => /#plate=/.test(await share.locator('input').inputValue()), 'the link');
  assert.match(await share.locator('p').first().innerText(), /your printer’s start and end G-code/);
  const other = await bench.open({ path: new URL(await share.locator('input').inputValue()).hash.replace(/^/, '/') });
  await other.idle();
  assert.equal(await other.state((state) => JSON.stringify(state.plate).includes('secret')), false);
});

test('bar and lines can be read in every language, on a desk and on a phone', { skip }, async () => {
  const visit = await bench.open({ path: giftWith({ ...spoof, ...hot }) });
  await bar(visit).waitFor();
  for (const language of languages) {
    await visit.page.evaluate((name) => document.querySelector('sillon-app').studio.setLanguage(name), language);
    for (const width of [1440, 360]) {
      await visit.page.setViewportSize({ width, height: 760 });
      await settled(visit.page);
      const where = `${language}, ${width} pixels`;
      const box = await bar(visit).boundingBox();
      assert.ok(box.x >= 0 && box.x + box.width <= width, where);
      for (const button of await bar(visit).getByRole('button').all()) {
        const place = await button.boundingBox();
        assert.ok(place.x >= 0 && place.x + place.width <= width, `${where}: ${await button.innerText()}`);
      }
      await draw(visit, `bar-${language}-${width}`);
      await bar(visit).getByRole('button').first().click();
      await dialog(visit).waitFor();
      await draw(visit, `dialog-${language}-${width}`);
      const wide = await dialog(visit).evaluate((element) => element.scrollWidth - element.clientWidth);
      assert.equal(wide, 0, where);
      await visit.page.keyboard.press('Escape');
      await visit.until((state) => state.dialog === undefined);
    }
  }
});
