// Somebody's sliced print: dropped, its faces appear; new beads are laid on those that are chosen; what is downloaded is what the
// native program writes; and the plate is as it was.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gunzipSync, gzipSync } from 'node:zlib';

import { overlaps } from './support/covered.js';
import { sharedBench } from './support/shared.js';
import { sliced } from './support/sliced.js';
import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';
import { until } from './support/waits.js';

const bench = sharedBench(skip, start);
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const program = fileURLToPath(new URL('../../../build/release/sillon', import.meta.url));

/** What the native program makes of a file. */
function natively(name, bytes, ...options) {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-rebrush-'));
  try {
    writeFileSync(join(folder, name), bytes);
    const out = join(folder, `new_${name}`);
    execFileSync(program, ['rebrush', join(folder, name), ...options, '-o', out]);
    return readFileSync(out);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const view = ({ page }) => page.locator('sillon-rebrush');
const saves = (visit) => view(visit).getByRole('button', { name: /^Download / });

/** Once the beads of the choices are laid. */
async function downloaded(visit) {
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  const [download] = await Promise.all([visit.page.waitForEvent('download'), saves(visit).click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

const plateOf = (visit) => visit.state(({ plate }) => JSON.stringify(plate));

test(
  'dropped, turned, downloaded: the same bytes as the native program, and the plate as it was',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    const before = await plateOf(visit);
    const text = sliced();
    await visit.drop([fileOf('part.gcode', text)]);
    const faces = view(visit).getByRole('checkbox');
    await until(async () => (await faces.count()) === 2, 'two faces are listed');
    assert.deepEqual(await faces.evaluateAll((all) => all.map(({ checked }) => checked)), [true, true]);
    assert.match(await view(visit).locator('.faces').innerText(), /Layer 3, 0\.6 mm high[^]*mm²/);
    // One face is too narrow, and it is told.
    await view(visit).getByText('1 more face is left as it is').click();
    assert.match(await view(visit).locator('details').innerText(), /Narrower than three beads: 1 face/);

    // The fewest clicks: download what is there.
    const first = await downloaded(visit);
    assert.equal(first.name, 'part_brushed.gcode');
    assert.equal(first.bytes.compare(natively('part.gcode', text, '--angle', '30')), 0);

    await view(visit).getByLabel('Angle', { exact: true }).and(visit.page.locator('input')).fill('75');
    await until(async () => !(await saves(visit).isEnabled()), 'what was laid is out of date');
    const turned = await downloaded(visit);
    assert.equal(turned.bytes.compare(natively('part.gcode', text, '--angle', '75')), 0);
    assert.notEqual(turned.bytes.compare(first.bytes), 0);

    // One face alone, by its place in the list of the command line.
    await faces.nth(1).uncheck();
    const one = await downloaded(visit);
    const chosen = await view(visit).evaluate((element) => [...element.wish.chosen][0] + 1);
    assert.equal(one.bytes.compare(natively('part.gcode', text, '--angle', '75', '--only', String(chosen))), 0);
    assert.notEqual(one.bytes.compare(turned.bytes), 0);
    await view(visit).getByRole('button', { name: 'None' }).click();
    assert.match(await view(visit).locator('.foot').innerText(), /Choose a face/);
    assert.equal(await saves(visit).isEnabled(), false);

    await view(visit).getByRole('button', { name: 'Back to the plate' }).click();
    await view(visit).waitFor({ state: 'detached' });
    assert.equal(await plateOf(visit), before);
    assert.equal(await visit.state(({ dialog, sliced }) => `${dialog} ${sliced}`), 'undefined undefined');
    await visit.idle();
    assert.deepEqual(visit.problems, []);
  },
);

test('a packed print becomes a packed print, under a picture or as the plate', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const text = sliced();
  await visit.drop([fileOf('part.gcode.gz', gzipSync(text))]);
  await until(async () => (await view(visit).getByRole('checkbox').count()) === 2);
  // As the plate: its waves lie on each face.
  await view(visit).getByRole('radio', { name: 'As the plate' }).check({ force: true });
  const waves = await downloaded(visit);
  assert.equal(waves.name, 'part_brushed.gcode.gz');
  assert.equal(waves.bytes[0], 0x1f);
  const straight = natively('part.gcode', text, '--angle', '30');
  assert.notEqual(gunzipSync(waves.bytes).compare(straight), 0);

  // A picture that is dropped is laid under the lamp on the screen, and the plate has no part in it.
  const plate = await plateOf(visit);
  await visit.drop([fileAt(join(inputs, 'photo.png'))]);
  await until(async () => (await view(visit).locator('.picture').count()) === 1, 'the picture is taken');
  await view(visit).getByLabel('Stretched over').selectOption('all');
  const shown = await downloaded(visit);
  const lamp = await view(visit).evaluate(({ wish }) => wish.lamp.join());
  const spool = await view(visit).evaluate(({ wish }) => wish.spool);
  const options = ['--picture', join(inputs, 'photo.png'), '--lamp', lamp, '--spool', spool, '--fit', 'all'];
  assert.equal(gunzipSync(shown.bytes).compare(natively('part.gcode', text, ...options)), 0);
  assert.match(await view(visit).locator('.side').innerText(), /Seen under the lamp: \d+% like the picture/);
  assert.equal(await plateOf(visit), plate);
  assert.deepEqual(visit.problems, []);
});

test('what cannot be re-brushed is told in a sentence, and another file can be taken', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const before = await plateOf(visit);
  await visit.drop([fileOf('own.gcode', 'G28\nG1 X10 E1\n')]);
  const alert = view(visit).getByRole('alert');
  await alert.waitFor();
  assert.match(await alert.innerText(), /own\.gcode cannot be re-brushed\.[^]*does not mark its surfaces/);
  // Tops that are all too narrow.
  await visit.drop([fileOf('thin.gcode', sliced({ sides: [0.9] }))]);
  await until(async () => /no top face that can be re-brushed/.test(await alert.innerText()));
  assert.match(await alert.innerText(), /thin\.gcode[^]*Narrower than three beads/);
  // No file at all that it could be.
  await visit.drop([fileOf('broken.bgcode', 'GCDE nothing')]);
  await until(async () => /broken\.bgcode cannot be re-brushed/.test(await alert.innerText()));
  await visit.drop([fileOf('part.gcode', sliced())]);
  await until(async () => (await view(visit).getByRole('checkbox').count()) === 2);
  await visit.page.keyboard.press('Escape');
  await view(visit).waitFor({ state: 'detached' });
  assert.equal(await plateOf(visit), before);
  assert.deepEqual(visit.problems, []);
});

test('long work can be stopped and begun again', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.drop([fileOf('part.gcode', sliced({ sides: [120, 120] }))]);
  const bar = view(visit).getByRole('progressbar', { name: /Laying new beads/ });
  // By the page itself, in the frame that shows the button: no machine is too fast for that.
  await visit.page.waitForFunction(() => {
    const { shadowRoot } = document.querySelector('sillon-app').shadowRoot.querySelector('sillon-rebrush') ?? {};
    const button = shadowRoot?.querySelector('.foot .job button');
    button?.click();
    return button !== null && button !== undefined;
  });
  await bar.waitFor({ state: 'detached' });
  assert.match(await view(visit).locator('.foot').innerText(), /Cancelled/);
  assert.equal(await saves(visit).isEnabled(), false);
  await view(visit).getByRole('button', { name: 'Lay the beads' }).click();
  await until(() => saves(visit).isEnabled(), 'they are laid after all');
  await visit.page.keyboard.press('Escape');
  await view(visit).waitFor({ state: 'detached' });
  assert.deepEqual(visit.problems, []);
});

test('faces are chosen on the print itself, by pointer, and everything by keys', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.drop([fileOf('part.gcode', sliced())]);
  const faces = view(visit).getByRole('checkbox');
  await until(async () => (await faces.count()) === 2);
  const canvas = view(visit).locator('sillon-rebrush-bench');
  const box = await canvas.boundingBox();
  const place = await canvas.evaluate((element) => {
    const [face] = element.faces;
    const { corner, cell, columns, rows } = element.relief;
    const size = [columns * cell, rows * cell];
    const margin = (length) => length - 2 * Math.min(24, length * 0.06);
    const { width, height } = element.getBoundingClientRect();
    const scale = Math.min(margin(width) / size[0], margin(height) / size[1]);
    const middle = [0, 1].map((k) => face.corner[k] + face.region.page[k] / 2 - corner[k]);
    return [width / 2 + (middle[0] - size[0] / 2) * scale, height / 2 - (middle[1] - size[1] / 2) * scale];
  });
  await page.mouse.click(box.x + place[0], box.y + place[1]);
  await until(async () => !(await faces.first().isChecked()), 'a click leaves the face');
  await page.mouse.click(box.x + place[0], box.y + place[1]);
  await until(() => faces.first().isChecked(), 'and takes it again');
  // Dragged, the print moves and nothing is chosen.
  await page.mouse.move(box.x + place[0], box.y + place[1]);
  await page.mouse.down();
  await page.mouse.move(box.x + place[0] + 60, box.y + place[1] + 20, { steps: 4 });
  await page.mouse.up();
  assert.equal(await faces.first().isChecked(), true);

  await faces.first().focus();
  await page.keyboard.press('Space');
  assert.equal(await faces.first().isChecked(), false);
  await page.keyboard.press('Tab');
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement?.tagName), 'SILLON-APP');

  for (const way of ['One angle', 'As the plate', 'Picture']) {
    await view(visit).getByRole('radio', { name: way }).check({ force: true });
    const found = await page.evaluate(`(async () => {
      ${axe}
      const { violations } = await axe.run(document, { resultTypes: ['violations'] });
      return violations.map(({ id, nodes }) => id + ': ' + nodes.map(({ html }) => html.slice(0, 120)).join(' | '));
    })()`);
    assert.deepEqual(found, [], way);
  }
});

for (const language of ['en', 'fr']) {
  test(`no control of it is covered or cut, whatever the width, ${language}`, { skip }, async () => {
    const keep = await bench.browser.newContext({ reducedMotion: 'reduce', viewport: { width: 1000, height: 760 } });
    await keep.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null; // as in sweep.test.js
    });
    const visit = await bench.open({ small: true, keep, path: `/?lang=${language}` });
    const { page } = visit;
    await visit.drop([fileOf('a_print_with_a_rather_long_name_for_a_button.gcode', sliced())]);
    const save = view(visit).locator('.foot button.main');
    await until(() => save.isEnabled());
    await page.evaluate(() =>
      document.querySelector('sillon-app').studio.store.set({ notices: [], problem: undefined }),
    );
    const wrong = [];
    for (const way of [0, 1, 2]) {
      await view(visit).getByRole('radio').nth(way).check({ force: true });
      for (const [width, height] of [
        [320, 560],
        [360, 740],
        [480, 360],
        [721, 560],
        [1000, 600],
        [1440, 900],
        [2560, 1200],
      ]) {
        await page.setViewportSize({ width, height });
        await page.evaluate(
          () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
        );
        const found = await view(visit).evaluate(overlaps);
        const cut = await view(visit).evaluate((element) =>
          [...element.shadowRoot.querySelectorAll('button, select, input')]
            .filter(
              (one) => one.checkVisibility({ visibilityProperty: true }) && getComputedStyle(one).clipPath === 'none',
            )
            .filter((one) => {
              const { left, right, width } = one.getBoundingClientRect();
              return width > 0 && (left < -0.5 || right > globalThis.innerWidth + 0.5);
            })
            .map((one) => `${one.tagName} ${one.textContent.trim()} is cut by the window`),
        );
        wrong.push(...[...found, ...cut].map((what) => `${width} × ${height}, ${way}: ${what}`));
      }
    }
    assert.deepEqual(wrong, []);
  });
}
