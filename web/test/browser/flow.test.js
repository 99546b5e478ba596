// From a first visit to files that a printer takes, against the native program and another's reading of the G-code.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { unzipSync } from 'fflate';
import Toolpath from 'gcode-toolpath';

import { bodyNatively, natively } from './support/native.js';
import { sharedBench } from './support/shared.js';
import { fileAt, inputs, skip, start } from './support/studio.js';
import { settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);

/** Moves of a G-code as another program understands them. */
async function movesOf(text) {
  const moves = [];
  const toolpath = new Toolpath({
    addLine: (modal, from, to) => moves.push({ from, to }),
    addArcCurve: () => assert.fail('the file has arcs'),
  });
  await new Promise((resolve, reject) => {
    toolpath.loadFromString(text, (error) => (error ? reject(error) : resolve()));
  });
  return moves;
}

/** Where plastic is laid down, and how much filament is pushed in all [mm]. */
function beadsOf(text) {
  const at = { X: 0, Y: 0, Z: 0, E: 0 };
  let relative = false;
  let filament = 0;
  const beads = [];
  for (const line of text.split('\n')) {
    const command = line.split(';')[0].trim();
    if (command === 'M82' || command === 'M83') relative = command === 'M83';
    if (!/^G(0|1|92)\b/.test(command)) continue;
    const words = Object.fromEntries(
      [...command.matchAll(/([XYZE])(-?[\d.]+)/g)].map(([, name, value]) => [name, Number(value)]),
    );
    const pushed = words.E === undefined || command.startsWith('G92') ? 0 : relative ? words.E : words.E - at.E;
    const from = { ...at };
    Object.assign(at, words);
    filament += pushed;
    if (pushed > 0 && (words.X !== undefined || words.Y !== undefined)) beads.push({ from, to: { ...at } });
  }
  return { beads, filament };
}

function firstDifference(a, b) {
  const left = a.split('\n');
  const right = b.split('\n');
  const at = left.findIndex((line, k) => line !== right[k]);
  return at < 0 ? undefined : `line ${at + 1}: ${left[at]} | ${right[at]}`;
}

test('the plate shimmers: its picture follows the light', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const box = await visit.canvas();
  const clip = { x: box.x + box.width / 2 - 60, y: box.y + box.height / 2 - 60, width: 120, height: 120 };
  /** The picture under a light, other than the one before. */
  const under = async (dx, dy) => {
    const before = await visit.page.screenshot({ clip });
    const [x, y] = [box.x + box.width * (0.5 + dx), box.y + box.height * (0.5 + dy)];
    let last = before;
    return until(async () => {
      await visit.page.mouse.move(x - 1, y); // again and again: a notice may have lain there
      await visit.page.mouse.move(x, y);
      await settled(visit.page);
      const picture = await visit.page.screenshot({ clip });
      const still = picture.equals(last) && !picture.equals(before); // drawn: two in a row are the same
      last = picture;
      return still && picture;
    }, 'another picture');
  };
  const right = await under(0.3, 0.1);
  await under(0.1, 0.3);
  assert.ok(right.equals(await under(0.3, 0.1)), 'the same light gives another picture');
});

test(
  'a first visit shows a finished plate, isolated; its G-code is closed, inside the bed, fed as told, and the native program’s',
  { skip },
  async () => {
    const visit = await bench.open();
    await visit.idle();
    assert.equal(await visit.page.evaluate(() => crossOriginIsolated), true);
    assert.equal(await visit.state((state) => state.result.report.toolpaths), 1);
    assert.match((await visit.status()).join(' '), /80\s×\s80\smm/);
    assert.deepEqual(visit.problems, []);
    const { name, bytes } = await visit.download('G-code');
    assert.match(name, /^Sun and moon_0\.4mm_PLA_(\d+h)?\d+m\.gcode$/);
    const text = bytes.toString('utf8');
    const moves = await movesOf(text);
    assert.ok(moves.length > 1000, `only ${moves.length} moves`);
    for (const { to } of moves) {
      assert.ok(to.x >= 0 && to.x <= 220 && to.y >= 0 && to.y <= 220, `(${to.x}, ${to.y}) lies beside the bed`);
    }
    const { beads, filament } = beadsOf(text);
    const told = await visit.state((state) => state.summary.filamentMm);
    assert.ok(Math.abs(filament - told) < 0.02 * told, `${filament} mm are pushed, ${told} are told`);
    const top = Math.max(...beads.map(({ to }) => to.Z));
    const path = beads.filter(({ to }) => to.Z === top);
    assert.ok(top > 0.59 && path.length > 1000, `the top layer at ${top} mm has ${path.length} beads`);
    for (const [k, { from }] of path.slice(1).entries()) {
      assert.deepEqual([from.X, from.Y], [path[k].to.X, path[k].to.Y], 'the nozzle moves without a bead');
    }
    const [first, last] = [path[0].from, path.at(-1).to];
    assert.ok(Math.hypot(first.X - last.X, first.Y - last.Y) < 0.01, 'the path does not come back to its beginning');
    const project = await visit.download('Project with its files');
    assert.equal(project.name, 'Sun and moon.sillon.zip');
    assert.equal(firstDifference(text, natively(project.bytes, text)), undefined);
  },
);

test(
  'dropped files become a plate; what they are for can be changed; its files are the native program’s',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    await visit.drop([
      fileAt(join(inputs, 'logo.svg')),
      fileAt(join(inputs, 'logo_angle.png')),
      fileAt(join(inputs, 'logo_mode.png')),
    ]);
    const roles = visit.page.locator('sillon-files select');
    await roles.first().waitFor();
    const chosen = await roles.evaluateAll((all) => all.map((one) => one.value));
    assert.deepEqual(chosen, ['shape', 'angle', 'modes']);
    await roles.nth(2).selectOption('none');
    await visit.until((state) => state.plate.layers[0].modeFile === null);
    await roles.nth(2).selectOption('modes');
    await visit.until((state) => state.plate.layers[0].modeFile !== null);
    await visit.button('Done').click();
    await visit.idle();
    assert.equal(await visit.state((state) => state.plate.shape.kind), 'file');
    const { bytes } = await visit.download('G-code');
    const project = await visit.download('Project with its files');
    const text = bytes.toString('utf8');
    assert.equal(firstDifference(text, natively(project.bytes, text)), undefined);
    // One step back: the files are gone.
    await visit.page.keyboard.press('Control+z');
    await visit.until((state) => state.plate.shape.kind === 'disc' && state.plate.layers[0].pattern === 'waves');
    // The project brings all of it back.
    await visit.drop([{ name: 'logo.sillon.zip', type: 'application/zip', data: project.bytes.toString('base64') }]);
    await visit.until((state) => state.plate.shape.kind === 'file');
    await visit.idle();
    const again = await visit.download('G-code');
    const undated = (gcode) => gcode.replace(/\d{4}-\d\d-\d\d at \d\d:\d\d:\d\d UTC/g, '');
    assert.equal(firstDifference(undated(text), undated(again.bytes.toString('utf8'))), undefined);
    assert.deepEqual(visit.problems, []);
  },
);

test('a photograph becomes directions, and a drawing from the clipboard a shape', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.paste([fileAt(join(inputs, 'photo.png'))]);
  await visit.until((state) => state.plate.layers[0].kind === 'picture');
  await visit.idle();
  await visit.paste(
    [],
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20" width="40mm" height="20mm"><rect width="40" height="20" rx="5"/></svg>',
  );
  await visit.until((state) => state.plate.shape.kind === 'file');
  await visit.idle();
  const page = await visit.state((state) => [state.plate.width, state.plate.height]);
  assert.ok(Math.abs(page[0] / page[1] - 2) < 1e-6, `the page is ${page[0]} × ${page[1]} mm`);
});

test('drawings, pictures and zones download', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const svg = await visit.download('Drawing (SVG)');
  assert.match(svg.bytes.toString('utf8', 0, 400), /<svg\b/);
  const png = await visit.download('Picture (PNG)');
  assert.equal(png.bytes.toString('latin1', 1, 4), 'PNG');
  const [width, height] = [png.bytes.readUInt32BE(16), png.bytes.readUInt32BE(20)];
  assert.equal(width, 2400);
  assert.ok(height > 2000 && height < 2800, `${width} × ${height}`);
  const zones = await visit.download('Zones for your slicer (3MF)');
  assert.match(zones.name, /\.zones\.3mf$/);
  assert.ok(Object.keys(unzipSync(zones.bytes)).includes('3D/3dmodel.model'));
  assert.deepEqual(visit.problems, []);
});

test('the base goes to another slicer, the native program’s to the byte, and the rest above it', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const project = await visit.download('Project with its files');
  // What is offered then goes by itself after a while.
  const body = await visit.download('Base for your slicer (3MF)');
  await visit.button('Use this height').click();
  await visit.until((state) => state.plate.print.base === 0 && state.plate.print.startHeight === 0.4);
  assert.equal(body.name, 'plate.base.3mf');
  assert.ok(body.bytes.equals(bodyNatively(project.bytes)), 'another body than the native program’s');
  const { bytes } = await visit.download('G-code');
  const heights = [...bytes.toString('utf8').matchAll(/^;Z:(.*)$/gm)].map(([, z]) => z);
  assert.deepEqual(heights, ['0.6']);
  await visit.section('Print');
  await visit.page.getByText('A print of 0.4 mm stands on the bed while the printer homes').waitFor();
  // There is no base any more.
  await visit.page.locator('[popovertarget=export]').click();
  const entry = visit.page.locator('#export').getByRole('button', { name: 'Base for your slicer' });
  assert.equal(await entry.isDisabled(), true);
  assert.match(await entry.innerText(), /This plate has no bottom layers/);
  assert.deepEqual(visit.problems, []);
});

test('the printer comes from the owner’s own G-code, and a file that tells none is refused', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.section('Print');
  const take = async (name, buffer) => {
    const [chooser] = await Promise.all([
      visit.page.waitForEvent('filechooser'),
      visit.button('From your slicer’s file…').click(),
    ]);
    await chooser.setFiles({ name, mimeType: '', buffer });
  };
  const donor = fileURLToPath(new URL('../../../tests/fuzz/seeds/import/donor.gcode', import.meta.url));
  await take('donor.gcode', readFileSync(donor));
  await visit.until((state) => state.plate.printer.name === 'MK4S' && state.plate.printer.startGcode.includes('M862'));
  // One message of all, and a filament that is named as it is heated.
  const told = visit.page.locator('sillon-notices [role=status] .notice');
  assert.equal(await told.count(), 1);
  assert.match(await told.innerText(), /donor\.gcode: \d+ settings imported\. It prints PLA at 220 °C on a bed of 65/);
  const name = visit.page.locator('sillon-print-panel .field:has(.swatches) .note');
  assert.equal(await name.innerText(), 'Gold PLA at 220 °C');
  await visit.until((state) => state.summary !== undefined && state.progress === undefined);
  // A block that no profile has is shown before the first file with it.
  await visit.page.locator('[popovertarget=export]').click();
  await visit.page
    .locator('#export')
    .getByRole('button', { name: /^G-code/ })
    .click();
  const review = visit.page.locator('sillon-blocks');
  await review.getByText('G29 P9 X10 Y-4 W32 H4', { exact: true }).waitFor();
  const [download] = await Promise.all([
    visit.page.waitForEvent('download'),
    review.getByRole('button', { name: 'Download G-code' }).click(),
  ]);
  assert.match(readFileSync(await download.path(), 'utf8'), /^M862\.3 P "MK4S"$/m);
  await take('song.mp3', Buffer.from([1, 2, 3, 4]));
  const alert = visit.page.locator('sillon-notices .problem').first();
  await alert.waitFor();
  assert.match(await alert.innerText(), /song\.mp3 contains no printer settings/);
  assert.equal(await visit.state((state) => state.plate.printer.name), 'MK4S');
  // A file that heats and does not say for which filament asks once, and nothing changes before it is answered.
  await take(
    'heats.gcode',
    Buffer.from('G28\nM190 S80\nM109 S255\n;LAYER_CHANGE\nG1 X100 Y90 Z0.2\nG1 X130 E0.4\nM84\n'),
  );
  const answer = told.getByRole('button', { name: 'Take 255 °C of the file' });
  await answer.waitFor();
  assert.equal(await name.innerText(), 'Gold PLA at 220 °C');
  await answer.click();
  await visit.until(({ plate: { printer } }) => printer.nozzleTemperature === 255 && printer.bedTemperature === 80);
  assert.equal(await name.innerText(), 'Gold PLA at 255 °C');
});

/** What the browser's own reader finds in an animated WebP, which knows nothing of how ours was written. */
const decoded = (page, bytes) =>
  page.evaluate(async (base64) => {
    const data = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const decoder = new ImageDecoder({ data, type: 'image/webp' });
    await decoder.tracks.ready;
    const { frameCount, repetitionCount } = decoder.tracks.selectedTrack;
    const canvas = new OffscreenCanvas(1, 1);
    const context = canvas.getContext('2d', { willReadFrequently: true });
    const frames = [];
    for (let frameIndex = 0; frameIndex < frameCount; ++frameIndex) {
      const { image } = await decoder.decode({ frameIndex });
      Object.assign(canvas, { width: image.displayWidth, height: image.displayHeight });
      context.drawImage(image, 0, 0);
      frames.push({
        pixels: context.getImageData(0, 0, canvas.width, canvas.height).data,
        time: image.duration / 1000,
      });
      image.close();
    }
    const between = (a, b) =>
      a.pixels.reduce((sum, value, k) => sum + Math.abs(value - b.pixels[k]), 0) / a.pixels.length;
    return {
      size: [canvas.width, canvas.height],
      endless: repetitionCount === Infinity,
      times: frames.map(({ time }) => time),
      steps: frames.map((frame, k) => between(frame, frames[(k + 1) % frames.length])),
      quarter: between(frames[0], frames[Math.floor(frames.length / 4)]),
    };
  }, bytes.toString('base64'));

test(
  'a loop of the light going round, small enough for messengers, while the page stays as it is',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    const looked = () => visit.state(({ light, view }) => ({ light, view }));
    await visit.page.evaluate(() =>
      document.querySelector('sillon-app').studio.setLight({ azimuth: 60, elevation: 35 }),
    );
    const before = await looked();
    await visit.button('View and light').click();
    const [download] = await Promise.all([
      visit.page.waitForEvent('download'),
      visit.button('Save moving picture').click(),
    ]);
    assert.equal(download.suggestedFilename(), 'plate.webp');
    const bytes = readFileSync(await download.path());
    assert.ok(bytes.length < 1e6, `${bytes.length} bytes`);
    const { size, endless, times, steps, quarter } = await decoded(visit.page, bytes);
    assert.equal(Math.max(...size), 560);
    assert.ok(endless);
    assert.deepEqual(times, Array(36).fill(100));
    const farthest = Math.max(...steps.slice(0, -1));
    assert.ok(Math.min(...steps) > 0, 'two frames are the same');
    assert.ok(steps.at(-1) <= farthest, `${steps.at(-1)} where it begins anew, ${farthest} elsewhere`);
    assert.ok(quarter > farthest, `${quarter} in a quarter of a turn`);
    assert.deepEqual(await looked(), before);
  },
);

test('the loop of a plate is seen where it is shared', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.show('share'));
  const dialog = visit.page.locator('sillon-share');
  await dialog.getByRole('button', { name: 'Moving picture (WebP)' }).click();
  const picture = dialog.locator('img');
  await picture.waitFor();
  await visit.page.waitForFunction((image) => image.naturalWidth > 0, await picture.elementHandle());
  const [download] = await Promise.all([
    visit.page.waitForEvent('download'),
    dialog.getByRole('button', { name: 'Download' }).click(),
  ]);
  assert.equal(download.suggestedFilename(), 'plate.webp');
});

test('a link carries the settings, and says what it cannot carry', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.section('Print');
  await visit.page.getByRole('spinbutton', { name: 'Line width' }).fill('0.52');
  await visit.page.keyboard.press('Enter');
  await visit.until((state) => state.plate.toolpath.spacing === 0.52);
  await visit.menu('Share');
  const field = visit.page.locator('sillon-share input');
  await visit.page.waitForFunction((input) => input.value !== '', await field.elementHandle());
  const url = await field.inputValue();
  const other = await bench.open({ path: new URL(url).pathname + new URL(url).hash });
  await other.until((state) => state.plate.toolpath.spacing === 0.52 && state.plate.layers[0].pattern === 'waves');
  await other.idle();
});
