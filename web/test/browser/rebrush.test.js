// Somebody's sliced print: dropped, its faces appear; new beads are laid on those that are chosen; what is downloaded is what the
// native program writes; and the plate is as it was.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { crc32, gunzipSync, gzipSync } from 'node:zlib';

import * as fflate from 'fflate';

import { violations } from './support/axe.js';
import { overlaps } from './support/covered.js';
import { sharedBench } from './support/shared.js';
import { sliced } from './support/sliced.js';
import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';
import { until } from './support/waits.js';

const bench = sharedBench(skip, start);
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

/** Changes a choice, and waits until other beads are laid for it: the button may be disabled for too short to be seen. */
async function relaid(visit, change) {
  const before = await view(visit).evaluateHandle(({ work }) => work.known.done);
  await change();
  await until(
    () =>
      view(visit).evaluate(({ work: { known } }, before) => known.done !== undefined && known.done !== before, before),
    'new beads',
  );
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

    const angle = view(visit).getByLabel('Angle', { exact: true }).and(visit.page.locator('input'));
    await relaid(visit, () => angle.fill('75'));
    const turned = await downloaded(visit);
    assert.equal(turned.bytes.compare(natively('part.gcode', text, '--angle', '75')), 0);
    assert.notEqual(turned.bytes.compare(first.bytes), 0);

    // One face alone, by its place in the list of the command line.
    await faces.nth(1).uncheck();
    const one = await downloaded(visit);
    const chosen = await view(visit).evaluate((element) => [...element.work.wish.chosen][0] + 1);
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
  await view(visit).getByRole('radio', { name: 'Same as the plate' }).check();
  const waves = await downloaded(visit);
  assert.equal(waves.name, 'part_brushed.gcode.gz');
  assert.equal(waves.bytes[0], 0x1f);
  const straight = natively('part.gcode', text, '--angle', '30');
  assert.notEqual(gunzipSync(waves.bytes).compare(straight), 0);

  // A picture that is dropped is laid under the lamp on the screen, and the plate has no part in it.
  const plate = await plateOf(visit);
  await visit.drop([fileAt(join(inputs, 'photo.png'))]);
  await until(async () => (await view(visit).locator('.picture').count()) === 1, 'the picture is taken');
  await view(visit).getByLabel('Covers').selectOption('all');
  const shown = await downloaded(visit);
  const lamp = await view(visit).evaluate(({ work: { wish } }) => wish.lamp.join());
  const spool = await view(visit).evaluate(({ work: { wish } }) => wish.spool);
  const options = ['--picture', join(inputs, 'photo.png'), '--lamp', lamp, '--spool', spool, '--fit', 'all'];
  assert.equal(gunzipSync(shown.bytes).compare(natively('part.gcode', text, ...options)), 0);
  assert.match(await view(visit).locator('.side').innerText(), /Seen under the lamp: \d+% like the picture/);
  assert.match(await view(visit).locator('.side').innerText(), /\d+% of the picture is cut off/);
  assert.equal(await plateOf(visit), plate);
  assert.deepEqual(visit.problems, []);
});

/** Another slicer's package around a text, as the native tests make it. */
function repacked(text) {
  const { zipSync, strToU8 } = fflate;
  return Buffer.from(
    zipSync({
      '[Content_Types].xml': strToU8('<?xml version="1.0"?><Types/>'),
      'Metadata/plate_1.gcode': new Uint8Array(text),
      'Metadata/plate_1.gcode.md5': strToU8(createHash('md5').update(text).digest('hex').toUpperCase()),
      'Metadata/slice_info.config': strToU8('<config><plate><metadata key="prediction" value="180"/></plate></config>'),
    }),
  );
}

/** A sliced print as binary G-code, without compression. */
function binary(text) {
  const block = (type, encoding, data, size = data.length) => {
    const head = Buffer.alloc(8);
    head.writeUInt16LE(type, 0);
    head.writeUInt16LE(0, 2);
    head.writeUInt32LE(size, 4);
    const parameters = Buffer.alloc(2);
    parameters.writeUInt16LE(encoding, 0);
    const bytes = Buffer.concat([head, parameters, data]);
    const sum = Buffer.alloc(4);
    sum.writeUInt32LE(crc32(bytes));
    return Buffer.concat([bytes, sum]);
  };
  const head = Buffer.from('GCDE\x01\0\0\0\x01\0', 'latin1'); // version 1, CRC-32
  const settings = 'filament_diameter=1.75\nnozzle_diameter=0.4\n';
  return Buffer.concat([
    head,
    block(3, 0, Buffer.from('printer_model=MK4\n')), // printer
    block(4, 0, Buffer.from('estimated printing time (normal mode)=3m 0s\n')), // print
    block(2, 0, Buffer.from(settings)), // slicer
    ...[...Array(Math.ceil(text.length / 60000)).keys()].map((k) =>
      block(1, 0, text.subarray(60000 * k, 60000 * (k + 1))),
    ),
  ]);
}

test(
  'packages and binary files become files of their kind, with the bytes of the native program',
  { skip },
  async () => {
    const text = sliced();
    for (const [name, bytes] of [
      ['part.gcode.3mf', repacked(text)],
      ['part.bgcode', binary(text)],
    ]) {
      const visit = await bench.open({ small: true });
      await visit.drop([fileOf(name, bytes)]);
      const made = await downloaded(visit);
      assert.equal(made.name, name.replace('part', 'part_brushed'));
      assert.equal(made.bytes.compare(natively(name, bytes, '--angle', '30')), 0, name);
      assert.equal(made.bytes.subarray(0, 4).compare(bytes.subarray(0, 4)), 0);
      assert.deepEqual(visit.problems, []);
    }
  },
);

test('the bottom is re-brushed as by the native program, alone or with the tops', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const text = sliced();
  await visit.drop([fileOf('part.gcode', text)]);
  for (const [label, side] of [
    ['Bottom', 'bottom'],
    ['Both', 'both'],
  ]) {
    await until(() => saves(visit).isEnabled(), 'beads are laid');
    await relaid(visit, () => view(visit).getByRole('radio', { name: label }).check());
    const made = await downloaded(visit);
    assert.equal(made.bytes.compare(natively('part.gcode', text, '--angle', '30', '--surfaces', side)), 0, side);
  }
  assert.match(await view(visit).locator('.faces').innerText(), /Layer 3[^]*Bottom, 0\.2 mm high/);
  assert.deepEqual(visit.problems, []);
});

/** A window in which a print that is drawn in software is drawn soon. */
const littleWindow = { width: 740, height: 400 };

/** Place at which the largest face is seen [CSS pixels of the print]. */
async function placeOfFirst(print) {
  const place = await print.evaluate((element) => {
    const { width, height } = element.getBoundingClientRect();
    const [face] = element.faces;
    for (let k = 0; k < 900; ++k) {
      const [x, y] = [((k % 30) + 0.5) * (width / 30), (Math.floor(k / 30) + 0.5) * (height / 30)];
      if (element.faceAt(x, y) === face.index) return [x, y];
    }
    return undefined;
  });
  assert.ok(place !== undefined, 'the face lies under some place');
  return place;
}

test('the print is seen from aside: turned by pointer and keys, faces chosen on it, and back', { skip }, async () => {
  const visit = await bench.open({ small: true, viewport: littleWindow });
  const { page } = visit;
  await visit.drop([fileOf('part.gcode', sliced())]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  await view(visit).getByRole('button', { name: 'See it from the side' }).click();
  const print = view(visit).locator('sillon-rebrush-tilted');
  const canvas = print.locator('canvas');
  await canvas.waitFor();
  const shot = async () => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    return (await canvas.screenshot()).toString('base64');
  };
  const first = await shot();
  assert.equal(await shot(), first, 'it stands still by itself');
  await canvas.press('ArrowRight');
  const turned = await shot();
  assert.notEqual(turned, first);
  const box = await canvas.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 80, y - 30, { steps: 3 });
  await page.mouse.up();
  assert.notEqual(await shot(), turned);
  // The largest face, where it is seen.
  const faces = view(visit).getByRole('checkbox');
  assert.equal(await faces.first().isChecked(), true);
  const place = await placeOfFirst(print);
  await page.mouse.click(box.x + place[0], box.y + place[1]);
  await until(async () => !(await faces.first().isChecked()), 'a click on the face leaves it');
  await print.getByRole('button', { name: 'See it from above' }).click();
  await view(visit).locator('sillon-rebrush-bench').waitFor();
  assert.equal(await print.count(), 0);
  assert.deepEqual(visit.problems, []);
});

test('bottoms are seen from below: they glow, a click chooses, and their beads turn', { skip }, async () => {
  const visit = await bench.open({ small: true, viewport: littleWindow });
  const { page } = visit;
  const text = sliced({ sides: [24, 10] });
  await visit.drop([fileOf('part.gcode', text)]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  await view(visit).getByRole('radio', { name: 'Bottom' }).check();
  await until(() => saves(visit).isEnabled(), 'beads are laid on the bottoms');
  await view(visit).getByRole('button', { name: 'See it from the side' }).click();
  const print = view(visit).locator('sillon-rebrush-tilted');
  const canvas = print.locator('canvas');
  await canvas.waitFor();
  const below = print.getByRole('button', { name: 'See it from below' });
  assert.equal(await below.getAttribute('aria-pressed'), 'true', 'bottoms alone are first seen from below');
  // Without the buttons, which look otherwise while they are pointed at.
  const box = await canvas.boundingBox();
  const clip = { ...box, height: box.height - 60 };
  const shot = async () => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    return createHash('sha256')
      .update(await page.screenshot({ clip }))
      .digest('hex');
  };
  const first = await shot();
  if (process.env.SILLON_SHOTS) await page.screenshot({ path: join(process.env.SILLON_SHOTS, 'below.png') });
  await below.click();
  assert.equal(await below.getAttribute('aria-pressed'), 'false');
  const above = await shot();
  assert.notEqual(above, first);
  await below.click();
  assert.equal(await shot(), first, 'the same side again');
  await canvas.press('0');
  const home = await shot(); // with the mark of what has the focus
  await canvas.press('ArrowRight');
  assert.notEqual(await shot(), home, 'it turns');
  await canvas.press('0');
  assert.equal(await shot(), home, 'and back, still from below');

  // A click on the larger bottom leaves it: its beads and its glow go.
  const faces = view(visit).getByRole('checkbox');
  assert.equal(await faces.first().isChecked(), true);
  const place = await placeOfFirst(print);
  await page.mouse.click(box.x + place[0], box.y + place[1]);
  await until(async () => !(await faces.first().isChecked()), 'a click on the bottom leaves it');
  assert.notEqual(await shot(), first);
  await page.mouse.click(box.x + place[0], box.y + place[1]);
  await until(() => faces.first().isChecked(), 'and takes it again');
  // Another angle is seen on it.
  await until(() => saves(visit).isEnabled());
  const before = await shot();
  await relaid(visit, () => view(visit).getByLabel('Angle', { exact: true }).and(page.locator('input')).fill('75'));
  assert.notEqual(await shot(), before);
  const made = await downloaded(visit);
  assert.equal(made.bytes.compare(natively('part.gcode', text, '--angle', '75', '--surfaces', 'bottom')), 0);
  // Tops are first seen from above.
  await view(visit).getByRole('radio', { name: 'Tops' }).check();
  await until(async () => (await below.getAttribute('aria-pressed')) === 'false');
  assert.deepEqual(visit.problems, []);
});

test('faces are combed from aside; with Shift the print moves and nothing is drawn', { skip }, async () => {
  const visit = await bench.open({ small: true, viewport: littleWindow });
  const { page } = visit;
  await visit.drop([fileOf('part.gcode', sliced({ sides: [24] }))]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  await view(visit).getByRole('radio', { name: 'By hand' }).check();
  await view(visit).getByRole('button', { name: 'See it from the side' }).click();
  const print = view(visit).locator('sillon-rebrush-tilted');
  const canvas = print.locator('canvas');
  await canvas.waitFor();
  const box = await canvas.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const drag = async () => {
    await page.mouse.move(x - 20, y);
    await page.mouse.down();
    await page.mouse.move(x + 20, y, { steps: 5 });
    await page.mouse.up();
  };
  const strokes = () => view(visit).evaluate(({ work: { wish } }) => wish.strokes);
  const shot = async () => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    return (await canvas.screenshot()).toString('base64');
  };
  const before = await shot();
  await page.keyboard.down('Shift');
  await drag();
  await page.keyboard.up('Shift');
  assert.deepEqual(await strokes(), []);
  await until(async () => (await shot()) !== before, 'the print moves');
  await canvas.press('0');
  await until(() => saves(visit).isEnabled(), 'beads are laid at the angle');
  await drag();
  await until(async () => (await strokes()).length === 1, 'the drag is a stroke');
  const [{ tool, points }] = await strokes();
  const [corner, size] = await print.evaluate(({ faces }) => [faces[0].corner, faces[0].region.page]);
  assert.equal(tool, 'comb');
  assert.ok(points.length >= 6, `${points}`);
  points.forEach((value, k) => {
    const from = value - corner[k % 2];
    assert.ok(from > -1 && from < size[k % 2] + 1, `${value} beside the face`);
  });
  await until(() => saves(visit).isEnabled(), 'beads follow the stroke');
  assert.equal(await view(visit).getByRole('checkbox', { checked: true }).count(), 1);
  assert.deepEqual(visit.problems, []);
});

/** Beside what the page tells of other things. */
const refusal = (visit) => view(visit).locator('.alone').getByRole('alert');

test('on a page in German the engine refuses in German', { skip }, async () => {
  const visit = await bench.open({ small: true, language: 'de' });
  await visit.idle();
  await visit.drop([fileOf('broken.bgcode', 'GCDE nothing')]);
  const alert = refusal(visit);
  await until(async () => /auf eine Art gepackt, die hier nicht bekannt ist/.test(await alert.innerText()));
  assert.equal(await alert.locator('[lang=en]').count(), 0);
});

test('what cannot be re-brushed is told in a sentence, and another file can be taken', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const before = await plateOf(visit);
  await visit.drop([fileOf('own.gcode', 'G28\nG1 X10 E1\n')]);
  const alert = refusal(visit);
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

/** Where the middle of the largest face is seen before the view is moved [CSS pixels of the bench], and a millimetre's size. */
const middleOfFirst = (canvas) =>
  canvas.evaluate((element) => {
    const [face] = element.faces;
    const { corner, cell, columns, rows } = element.relief;
    const size = [columns * cell, rows * cell];
    const margin = (length) => length - 2 * Math.min(24, length * 0.06);
    const { width, height } = element.getBoundingClientRect();
    const scale = Math.min(margin(width) / size[0], margin(height) / size[1]);
    const middle = [0, 1].map((k) => face.corner[k] + face.region.page[k] / 2 - corner[k]);
    return [width / 2 + (middle[0] - size[0] / 2) * scale, height / 2 - (middle[1] - size[1] / 2) * scale, scale];
  });

/** How far the beads of the largest face lie from an angle [degrees], within or beyond a distance from the line y = middle [mm]. */
const awayFrom = (canvas, degrees, [least, most]) =>
  canvas.evaluate(
    (element, { degrees, least, most }) => {
      const [face] = element.faces;
      const middle = face.region.page[1] / 2;
      let [sum, length] = [0, 0];
      for (const { points } of element.laid.get(face.index)) {
        for (let k = 0; k + 3 < points.length; k += 2) {
          const [x0, y0, x1, y1] = points.slice(k, k + 4);
          const away = Math.abs((y0 + y1) / 2 - middle);
          const inside = Math.min(x0, x1) > 2 && Math.max(x0, x1) < face.region.page[0] - 2;
          if (!inside || away < least || away > most) continue;
          const step = Math.hypot(x1 - x0, y1 - y0);
          const turn = Math.atan2(y1 - y0, x1 - x0) - (degrees * Math.PI) / 180;
          sum += step * Math.abs(Math.asin(Math.sin(turn)));
          length += step;
        }
      }
      return ((sum / length) * 180) / Math.PI;
    },
    { degrees, least, most },
  );

test('faces are combed by hand: beads follow the stroke, and lie at the angle elsewhere', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.drop([fileOf('part.gcode', sliced({ sides: [24, 8] }))]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  const canvas = view(visit).locator('sillon-rebrush-bench');
  await view(visit).getByRole('radio', { name: 'By hand' }).check();
  const angle = view(visit).getByLabel('Angle', { exact: true }).and(page.locator('input'));
  await angle.fill('90');
  const straight = await downloaded(visit);
  assert.ok((await awayFrom(canvas, 90, [0, 99])) < 12);

  const brush = view(visit).locator('#hand-across');
  await brush.fill('5');
  await brush.press('Tab');
  const box = await canvas.boundingBox();
  const [x, y, scale] = await middleOfFirst(canvas);
  const wide = await canvas.evaluate((element) => element.faces[0].region.page[0]);
  await relaid(visit, async () => {
    await page.mouse.move(box.x + x - (wide / 2) * scale, box.y + y);
    await page.mouse.down();
    await page.mouse.move(box.x + x + (wide / 2) * scale, box.y + y, { steps: 6 });
    await page.mouse.up();
    assert.equal(await view(visit).evaluate(({ work: { wish } }) => wish.strokes.length), 1);
  });
  const combed = await downloaded(visit);
  assert.notEqual(combed.bytes.compare(straight.bytes), 0);
  assert.ok((await awayFrom(canvas, 0, [0, 1.5])) < 20, 'along the stroke');
  assert.ok((await awayFrom(canvas, 90, [6, 10])) < 20, 'at the angle elsewhere');
  // Nothing was chosen or left by it.
  assert.equal(await view(visit).getByRole('checkbox', { checked: true }).count(), 2);

  // By keys, too; and back again.
  await canvas.locator('.overlay').focus();
  await page.keyboard.press('Space');
  for (let k = 0; k < 3; ++k) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Space');
  assert.equal(await view(visit).evaluate(({ work: { wish } }) => wish.strokes.length), 2);
  await view(visit).getByRole('button', { name: 'Undo the last stroke' }).click();
  assert.equal((await downloaded(visit)).bytes.compare(combed.bytes), 0);
  await view(visit).getByRole('button', { name: 'Remove all strokes' }).click();
  assert.equal((await downloaded(visit)).bytes.compare(straight.bytes), 0);
  assert.deepEqual(visit.problems, []);
});

test('a reload takes up the work again: the file, what was chosen, and the strokes', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  const { page } = visit;
  await visit.until((state) => state.result !== undefined);
  const text = sliced();
  await visit.drop([fileOf('part.gcode', text)]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  await view(visit).getByRole('checkbox').nth(1).uncheck();
  await view(visit).getByRole('radio', { name: 'By hand' }).check();
  const overlay = view(visit).locator('sillon-rebrush-bench .overlay');
  await overlay.focus();
  for (const key of ['Space', 'ArrowRight', 'Space']) await page.keyboard.press(key);
  const wished = () =>
    view(visit).evaluate(({ work: { wish } }) => [
      wish.way,
      [...wish.chosen],
      wish.strokes.map(({ points }) => points),
    ]);
  const before = await wished();
  assert.equal(before[2].length, 1);
  // What waits is written when the page is left.
  await page.reload();
  await view(visit).getByText('part.gcode is open again').waitFor();
  await until(() => saves(visit).isEnabled(), 'beads are laid again');
  assert.deepEqual(await wished(), before);
  const made = await downloaded(visit);
  assert.equal(made.name, 'part_brushed.gcode');
  assert.equal(made.bytes.subarray(0, 40).compare(text.subarray(0, 40)), 0);

  // Left with strokes on it, it is offered at the next visit, too; left without, it is not.
  await view(visit).getByRole('button', { name: 'Back to the plate' }).click();
  await view(visit).waitFor({ state: 'detached' });
  await page.reload();
  await page.getByText('Your strokes on part.gcode are kept').waitFor();
  assert.equal(await view(visit).count(), 0);
  await visit.button('Continue').click();
  await until(() => saves(visit).isEnabled(), 'beads are laid once more');
  assert.deepEqual(await wished(), before);
  await view(visit).getByRole('button', { name: 'Remove all strokes' }).click();
  await view(visit).getByRole('button', { name: 'Back to the plate' }).click();
  await view(visit).waitFor({ state: 'detached' });
  await page.reload();
  await page.getByText('has been restored').waitFor();
  assert.equal(await page.getByText('part.gcode').count(), 0);
  assert.deepEqual(visit.problems, []);
});

test('chosen faces that stay as they were are counted, with the reason, in the page’s language', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.drop([fileOf('part.gcode', sliced({ sides: [12, 3] }))]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  const side = () => view(visit).locator('.side').innerText();
  assert.match(await side(), /2 of 2 chosen[^]*1 chosen face stays as it was/);
  assert.match(await side(), /The new beads would leave too much of it free: 1 face/);
  assert.match(await side(), /1 face has new beads/);
  await page.evaluate(() => document.querySelector('sillon-app').studio.setLanguage('de'));
  await until(async () => /1 gewählte Fläche bleibt, wie sie war/.test(await side()), 'German');
  assert.match(await side(), /ließen zu viel davon frei/);
  assert.doesNotMatch(await side(), /would|cover/);
  assert.deepEqual(visit.problems, []);
});

test('a print without marks is refused in the page’s language', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.setLanguage('de'));
  await visit.drop([fileOf('hand.gcode', 'G28\nG1 X1 Y1 E1\n')]);
  const told = view(visit).getByRole('alert').filter({ hasText: 'hand.gcode' });
  await told.waitFor();
  assert.match(await told.innerText(), /kennzeichnet ihre Flächen nicht/);
  assert.doesNotMatch(await told.innerText(), /it does not/);
});

test('what is told while a print is open can be read and pressed', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.drop([fileOf('part.gcode', sliced())]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  await page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    const run = () => (globalThis.pressed = true);
    studio.tell({ text: 'A new version is ready.', actions: [{ label: 'Reload', run }], stays: true });
  });
  await view(visit).getByRole('button', { name: 'Reload' }).click();
  assert.equal(await page.evaluate(() => globalThis.pressed), true);
  assert.deepEqual(await view(visit).evaluate(overlaps), []);
});

test('a drawing is a picture, too; what is none is named, and the beads stay', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.drop([fileOf('part.gcode', sliced())]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  await visit.drop([fileOf('notes.txt', 'hello')]);
  const told = view(visit).getByRole('alert').filter({ hasText: 'notes.txt' });
  await told.waitFor();
  assert.match(await told.innerText(), /cannot open files like notes\.txt/);
  assert.equal(await saves(visit).isEnabled(), true);
  await visit.drop([fileOf('plan.dxf', '0')]);
  await view(visit).getByText('plan.dxf is a DXF file').waitFor();
  const drawing =
    '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm"><circle cx="40" cy="40" r="30"/></svg>';
  await visit.drop([fileOf('logo.svg', drawing)]);
  await until(async () => (await view(visit).locator('.picture').count()) === 1, 'the drawing is taken');
  await until(() => saves(visit).isEnabled(), 'beads are laid for it');
  assert.match(await view(visit).locator('.picture').innerText(), /logo\.svg/);
  assert.deepEqual(visit.problems, []);
});

test('faces have the names of their objects, as the package tells them', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const text = sliced().toString().replaceAll(';TYPE:Top', 'M624 AgAAAAAAAAA=\n;TYPE:Top');
  const { strToU8, zipSync } = fflate;
  const info =
    '<config><plate><metadata key="index" value="1"/><object identify_id="7" name="base.stl"/>' +
    '<object identify_id="9" name="lid.stl"/></plate></config>';
  const packed = zipSync({ 'Metadata/plate_1.gcode': strToU8(text), 'Metadata/slice_info.config': strToU8(info) });
  await visit.drop([fileOf('part.gcode.3mf', Buffer.from(packed))]);
  await until(async () => (await view(visit).getByRole('checkbox').count()) > 0, 'faces are listed');
  assert.match(await view(visit).locator('.faces').innerText(), /\blid\b/);
  assert.doesNotMatch(await view(visit).locator('.faces').innerText(), /AAAA/);
});

test('strokes are undone by keys, and Escape loses none: one goes on with them', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.drop([fileOf('part.gcode', sliced())]);
  await until(() => saves(visit).isEnabled(), 'beads are laid');
  await view(visit).getByRole('radio', { name: 'By hand' }).check();
  await view(visit).getByLabel('Angle', { exact: true }).and(page.locator('input')).fill('75');
  await view(visit).getByRole('checkbox').nth(1).uncheck();
  const overlay = view(visit).locator('sillon-rebrush-bench .overlay');
  const strokes = () => view(visit).evaluate(({ work: { wish } }) => wish.strokes.map(({ points }) => points.length));
  await overlay.focus();
  for (const end of ['Space', 'Escape', 'Space']) {
    await page.keyboard.press('Space');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press(end); // which takes the pen up, and no more
  }
  assert.deepEqual(await strokes(), [4, 4, 4]);
  await page.keyboard.press('Control+z');
  assert.deepEqual(await strokes(), [4, 4]);
  await page.keyboard.press('Escape');
  await view(visit).waitFor({ state: 'detached' });
  await page.getByText('Your strokes on part.gcode are kept').waitFor();
  await visit.button('Continue').click();
  await until(() => saves(visit).isEnabled(), 'beads are laid again');
  assert.deepEqual(await strokes(), [4, 4]);
  assert.deepEqual(await view(visit).evaluate(({ work: { wish } }) => [wish.way, wish.angle, wish.chosen.size]), [
    'hand',
    75,
    1,
  ]);
  assert.equal(await page.getByText('Your strokes on part.gcode are kept').count(), 0);
});

test('faces are chosen on the print itself, by pointer, and everything by keys', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.drop([fileOf('part.gcode', sliced())]);
  const faces = view(visit).getByRole('checkbox');
  await until(async () => (await faces.count()) === 2);
  const canvas = view(visit).locator('sillon-rebrush-bench');
  const box = await canvas.boundingBox();
  const place = await middleOfFirst(canvas);
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

  for (const way of ['One angle', 'By hand', 'Same as the plate', 'Picture']) {
    await view(visit).getByRole('radio', { name: way }).check();
    assert.deepEqual(await violations(page), [], way);
  }
});

test('no control of it is covered or cut, whatever the width and the language', { skip }, async () => {
  const withoutGraphics = () => {
    HTMLCanvasElement.prototype.getContext = () => null; // as in sweep.test.js
  };
  const visit = await bench.open({ small: true, prepare: withoutGraphics });
  const { page } = visit;
  await visit.drop([fileOf('a_print_with_a_rather_long_name_for_a_button.gcode', sliced())]);
  const save = view(visit).locator('.foot button.main');
  await until(() => save.isEnabled());
  // Words about the page may come at any time.
  await page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.notify = () => undefined;
    studio.store.set({ notices: [], problem: undefined });
  });
  const wrong = [];
  for (const language of ['en', 'fr', 'de']) {
    await page.evaluate((name) => document.querySelector('sillon-app').studio.setLanguage(name), language);
    for (const way of [0, 1, 2, 3]) {
      await view(visit).getByRole('radio').nth(way).check();
      for (const [width, height] of [
        [320, 560],
        [480, 360],
        [721, 560],
        [1000, 600],
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
        wrong.push(...[...found, ...cut].map((what) => `${width} × ${height}, ${language}, ${way}: ${what}`));
      }
    }
  }
  assert.deepEqual(wrong, []);
});
