// Photographs as people have them: dropped, they are solved for the lamp on the screen; a second one, and the lamp turns from
// one to the other; kept over reloads, in projects and in links.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';
import { settled } from './support/waits.js';

const bench = sharedBench(skip, start);
const photo = () => fileAt(join(inputs, 'photo.png'));

/** A picture of light and shade that the browser draws, as JPEG. */
const second = async (page) => {
  const data = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(120, 120);
    const context = canvas.getContext('2d');
    const shade = context.createRadialGradient(45, 40, 5, 60, 60, 70);
    shade.addColorStop(0, 'white');
    shade.addColorStop(0.55, 'gray');
    shade.addColorStop(1, 'black');
    context.fillStyle = shade;
    context.fillRect(0, 0, 120, 120);
    const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg' })).arrayBuffer());
    return String.fromCharCode(...bytes);
  });
  return fileOf('moon.jpg', Buffer.from(data, 'latin1'), 'image/jpeg');
};

const lamps = ({ plate }) => plate.directions.pictures?.map(({ file, lamp }) => [file.name, lamp]);
const small = (visit) =>
  visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({
      ...plate,
      width: 24,
      height: (24 * plate.height) / plate.width,
    }));
  });

test('a photograph under the lamp on the screen, and a second one with a lamp of its own', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.drop([photo()]);
  await visit.until('({ plate }) => plate.directions.kind === "lamp"');
  await visit.idle();
  assert.deepEqual(await visit.state(lamps), [['photo.png', [60, 35]]]);
  assert.deepEqual(await visit.state(({ made }) => made.toolpath.look.lamps), [[60, 35]]);
  assert.deepEqual(await visit.state(({ light }) => light), { azimuth: 60, elevation: 35 });

  // What this spool shows of it, in the panel and before a download: gold is told to be weak, blue is not.
  const panel = visit.page.locator('sillon-lamps').locator('li, .warning');
  assert.match((await panel.allInnerTexts()).join('\n'), /Contrast [\d.]+ : 1, about \d+ steps of grey/);
  assert.match((await panel.allInnerTexts()).join('\n'), /This spool shows pictures faintly/);
  await visit.page.locator('[popovertarget=export]').click();
  assert.match(await visit.page.locator('#export').innerText(), /This spool shows pictures faintly/);
  await visit.page.keyboard.press('Escape');
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, filament: 'bluePla' }));
  });
  await visit.until('({ plate, made }) => plate.filament === "bluePla" && made?.measured && made.plate === plate');
  assert.doesNotMatch((await panel.allInnerTexts()).join('\n'), /This spool shows pictures faintly/);
  const contrast = ({ made }) => made.report.pictures.map((one) => one.contrast);
  assert.ok((await visit.state(contrast))[0] > 5);

  await visit.drop([await second(visit.page)]);
  await visit.until('({ plate }) => plate.directions.pictures.length === 2');
  await visit.idle();
  assert.deepEqual(await visit.state(lamps), [
    ['photo.png', [60, 35]],
    ['moon.jpg', [115, 35]],
  ]);
  assert.equal((await visit.state(contrast)).length, 2);
  // Turned with motion reduced: at once. The light is then the second picture's, and stays there.
  await visit.button('Turn the lamp').click();
  await visit.until('({ light, lamp }) => lamp === 1 && light.azimuth === 115');
  await visit.button('Light the picture: photo.png').click();
  await visit.until('({ light, lamp }) => lamp === 0 && light.azimuth === 60');

  // The pointer leads the light away; it comes back once the pointer has gone.
  const box = await visit.canvas();
  await visit.page.mouse.move(box.x + box.width * 0.2, box.y + box.height * 0.5, { steps: 4 });
  await visit.until('({ light }) => Math.abs(light.azimuth - 60) > 60');
  await visit.page.mouse.move(3, 3);
  await visit.until('({ light }) => light.azimuth === 60 && light.elevation === 35');

  // The picture over the plate: the overlay has its greys where it had nothing.
  const covered = () =>
    visit.page.evaluate(() => {
      const find = (root, name) => root.querySelector(name).shadowRoot;
      const stage = find(find(document, 'sillon-app'), 'sillon-stage');
      const overlay = find(stage, 'sillon-canvas').querySelector('.overlay');
      const { width, height } = overlay;
      return overlay.getContext('2d').getImageData(Math.round(width / 2), Math.round(height / 2), 1, 1).data[3];
    });
  assert.equal(await covered(), 0);
  await visit.page.getByLabel('Picture over plate').fill('100');
  await visit.page.waitForFunction(() => document.querySelector('sillon-app').studio.store.state.wipe === 1);
  for (let tries = 0; (await covered()) === 0 && tries < 200; ++tries) await settled(visit.page);
  assert.equal(await covered(), 255);
  assert.deepEqual(visit.problems, []);
});

test('pictures under lamps come back after a reload, from a project and from a link', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.drop([photo(), await second(visit.page)]);
  await visit.until('({ plate }) => plate.directions.pictures?.length === 2');
  await visit.button('Done').click();
  await small(visit);
  await visit.idle();
  const before = await visit.state(lamps);
  assert.deepEqual(before, [
    ['photo.png', [60, 35]],
    ['moon.jpg', [115, 35]],
  ]);
  const digest = await visit.state(({ made }) => made.report.digest);
  const project = await visit.download('Project');
  const hash = await visit.page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    return new URL((await studio.services.link(studio.store.state.plate)).url).hash;
  });
  assert.ok(hash.length < 13_000, `the link has ${hash.length} characters`);

  await visit.page.reload();
  await visit.until('({ plate }) => plate.directions.pictures?.length === 2');
  await visit.idle();
  assert.deepEqual(await visit.state(lamps), before);
  assert.equal(await visit.state(({ made }) => made.report.digest), digest);

  const other = await bench.open({ path: `/${hash}` });
  await other.until('({ plate }) => plate.directions.pictures?.length === 2');
  await other.idle();
  assert.deepEqual(await other.state(lamps), before);
  await other.drop([fileOf('plate.sillon.zip', project.bytes)]);
  await other.until('({ plate }) => plate.directions.pictures?.[0].file.bytes.type === "image/png"');
  await other.idle();
  assert.equal(await other.state(({ made }) => made.report.digest), digest);
  assert.deepEqual([...visit.problems, ...other.problems], []);
});
