// Photographs as people have them: dropped, they are solved for the lamp on the screen; a second one, and the lamp turns from
// one to the other; kept over reloads, in projects and in links.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';
import { until } from './support/waits.js';

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

const lamps = ({ plate }) => plate.layers[0].pictures.map(({ file, lamp }) => [file.name, lamp]);
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
  await visit.until(({ plate }) => plate.width === 24); // of the link, which would take the photograph's place
  await visit.drop([photo()]);
  await visit.until('({ plate }) => plate.layers[0].kind === "picture"');
  await visit.idle();
  assert.deepEqual(await visit.state(lamps), [['photo.png', [60, 35]]]);
  await visit.until(({ result }) => JSON.stringify(result?.toolpath.look?.lamps) === '[[60,35]]');
  await visit.until(({ light }) => light.azimuth === 60 && light.elevation === 35);

  // What this spool shows of it, in the panel and before a download: gold is told to be weak, blue is not.
  const panel = visit.page.locator('sillon-lamps').locator('li, .warning');
  await panel
    .getByText(/contrast [\d.]+ : 1, about \d+ steps of grey/)
    .first()
    .waitFor();
  await panel
    .getByText(/This spool shows pictures faintly/)
    .first()
    .waitFor();
  await visit.page.locator('[popovertarget=export]').click();
  await visit.page
    .locator('#export')
    .getByText(/This spool shows pictures faintly/)
    .waitFor();
  await visit.page.keyboard.press('Escape');
  await visit.page.evaluate(() => {
    document
      .querySelector('sillon-app')
      .studio.change((plate) => ({ ...plate, pictures: { ...plate.pictures, spool: 'bluePla' } }));
  });
  await visit.until(
    '({ plate, result }) => plate.pictures.spool === "bluePla" && result?.measured && result.plate === plate',
  );
  await panel.getByText(/This spool shows pictures faintly/).waitFor({ state: 'detached' });
  await visit.until(({ result }) => result?.report.pictures?.[0].contrast > 5);

  await visit.drop([await second(visit.page)]);
  await visit.button('Show both, turn the lamp').click();
  await visit.until('({ plate }) => plate.layers[0].pictures.length === 2');
  await visit.idle();
  assert.deepEqual(await visit.state(lamps), [
    ['photo.png', [60, 35]],
    ['moon.jpg', [115, 35]],
  ]);
  await visit.until(({ result }) => result?.report.pictures?.length === 2);
  // The light is the new picture's. Turned with motion reduced: at once, and it stays there.
  await visit.until('({ light, lamp }) => lamp === 1 && light.azimuth === 115');
  await visit.button('Turn the lamp').click();
  await visit.until('({ light, lamp }) => lamp === 0 && light.azimuth === 60');
  await visit.button('Light the picture: moon.jpg').click();
  await visit.until('({ light, lamp }) => lamp === 1 && light.azimuth === 115');
  await visit.button('Light the picture: photo.png').click();
  await visit.until('({ light, lamp }) => lamp === 0 && light.azimuth === 60');

  // The pointer leads the light away; the picture brings it back.
  const box = await visit.canvas();
  await visit.page.mouse.move(box.x + box.width * 0.2, box.y + box.height * 0.3, { steps: 4 });
  await visit.until('({ light }) => Math.abs(light.azimuth - 60) > 60');
  await visit.page.mouse.move(3, 3);
  await visit.button('Light the picture: photo.png').click();
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
  await until(async () => (await covered()) === 0, 'a plate without anything over it');
  await visit.option('Compare with', 'picture');
  await visit.page.getByLabel('How much of the plate the original picture covers').focus();
  await visit.page.keyboard.press('End');
  await visit.page.waitForFunction(() => document.querySelector('sillon-app').studio.store.state.wipe === 1);
  await until(async () => (await covered()) === 255, 'the picture over the plate');

  // What is measured of each says which one it is.
  await visit.view('Check');
  const measures = visit.page.locator('sillon-quality-panel .verdicts b');
  await measures.filter({ hasText: 'Picture: photo.png' }).waitFor();
  await measures.filter({ hasText: 'Picture: moon.jpg' }).waitFor();
  assert.deepEqual(visit.problems, []);
});

/** Runs in the page: every place of the light in so many frames, as text. */
const placesOfLight = async (frames) => {
  const { store } = document.querySelector('sillon-app').studio;
  const places = new Set([JSON.stringify(store.state.light)]);
  const forget = store.subscribe(({ light }) => places.add(JSON.stringify(light)));
  for (let k = 0; k < frames; ++k) await new Promise(requestAnimationFrame);
  forget();
  return [...places];
};
/** Runs in the page before its own scripts: frames of 100 ms by its clock, as slower ones bring the light to rest. */
const evenFrames = () => {
  const frame = globalThis.requestAnimationFrame.bind(globalThis);
  let now = performance.now();
  globalThis.requestAnimationFrame = (run) =>
    frame(() => {
      run((now += 100));
    });
};
const moving = { small: true, reducedMotion: 'no-preference', prepare: evenFrames };
const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

test('the light stands where one’s own picture is to be seen until a hand moves it', { skip }, async () => {
  for (const device of [{}, phone]) {
    const visit = await bench.open({ ...moving, ...device });
    await visit.drop([photo()]);
    await visit.until('({ plate }) => plate.layers[0].kind === "picture"');
    await visit.idle();
    await visit.until('({ light }) => light.azimuth === 60 && light.elevation === 35');
    assert.deepEqual(await visit.page.evaluate(placesOfLight, 40), ['{"azimuth":60,"elevation":35}']);
    const moves = (await visit.options()).getByLabel('Light', { exact: true });
    const words = device === phone ? 'Stands still' : 'Follows the pointer';
    assert.equal(await moves.locator('option:checked').innerText(), words);
    assert.deepEqual(visit.problems, []);
  }
});

test('a picture can be made for the light that the pointer has aimed', { skip }, async () => {
  const visit = await bench.open(moving);
  await visit.drop([photo()]);
  await visit.until('({ plate }) => plate.layers[0].kind === "picture"');
  await visit.idle();
  /** A page that has not shown the plate yet forgets a move, and bars that come late move the plate under the pointer. */
  const aim = (across, down, stands) =>
    until(async () => {
      const { x, y, width, height } = await visit.canvas();
      await visit.page.mouse.move(x + across * width + 1, y + down * height);
      await visit.page.mouse.move(x + across * width, y + down * height);
      return visit.state(stands);
    }, `a light that is aimed at ${across}, ${down}`);
  const stands = ({ light }) => Math.abs(light.azimuth - 146.3) < 0.5 && Math.abs(light.elevation - 35.9) < 0.5;
  await aim(0.2, 0.3, stands);
  await visit.page.waitForTimeout(400); // the pointer rests, and goes on to the panel
  const button = visit.button('Make it for the light shown: photo.png');
  await button.hover();
  await visit.until(stands);
  await button.click();
  await visit.until('({ plate }) => JSON.stringify(plate.layers[0].pictures[0].lamp) === "[146,36]"');
  await visit.idle();
  // Aimed once more, and brought back.
  await aim(0.8, 0.7, ({ light }) => light.azimuth > 300);
  await visit.page.waitForTimeout(400);
  await button.hover();
  await visit.button('Light the picture: photo.png').click();
  await visit.until('({ light }) => light.azimuth === 146 && light.elevation === 36');
  assert.deepEqual(visit.problems, []);
});

test('pictures under lamps come back after a reload, from a project and from a link', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.until(({ plate }) => plate.width === 24);
  await visit.drop([photo(), await second(visit.page)]);
  await visit.until('({ plate }) => plate.layers[0].pictures.length === 2');
  await visit.button('Done').click();
  await small(visit);
  await visit.idle();
  const before = await visit.state(lamps);
  assert.deepEqual(before, [
    ['photo.png', [60, 35]],
    ['moon.jpg', [115, 35]],
  ]);
  const digest = await visit.state(({ result }) => result.report.digest);
  const project = await visit.download('Project');
  const hash = await visit.page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    return new URL((await studio.services.link(studio.store.state.plate)).url).hash;
  });
  assert.ok(hash.length < 13_000, `the link has ${hash.length} characters`);

  await visit.page.reload();
  await visit.until('({ plate }) => plate.layers[0].pictures.length === 2');
  await visit.idle();
  assert.deepEqual(await visit.state(lamps), before);
  assert.equal(await visit.state(({ result }) => result.report.digest), digest);

  const other = await bench.open({ path: `/${hash}` });
  await other.until('({ plate }) => plate.layers[0].pictures.length === 2');
  await other.idle();
  assert.deepEqual(await other.state(lamps), before);
  await other.drop([fileOf('plate.sillon.zip', project.bytes)]);
  await other.until('({ plate }) => plate.layers[0].pictures[0]?.file.bytes.type === "image/png"');
  await other.idle();
  assert.equal(await other.state(({ result }) => result.report.digest), digest);
  assert.deepEqual([...visit.problems, ...other.problems], []);
});

test(
  'a line is dragged between the plate and what it is compared with; sizes are those of life',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    /** Where the plate stands on the window, and how large, as of now: bars that come late move it [CSS pixels]. */
    const stand = () =>
      visit.page.evaluate(() => {
        const find = (root, name) => root.querySelector(name).shadowRoot;
        const canvas = find(find(document, 'sillon-app'), 'sillon-stage').querySelector('sillon-canvas');
        const { left, top, width, height } = canvas.plateBox();
        const box = canvas.getBoundingClientRect();
        return {
          x: box.x + left,
          width,
          scale: canvas.camera.scale / devicePixelRatio,
          inside: left >= 0 && top >= 0 && left + width <= box.width && top + height <= box.height,
          share: Math.max(width / box.width, height / box.height),
        };
      });
    const isScale = async (wanted) => {
      await until(async () => Math.abs((await stand()).scale - wanted) < 1e-3, `a scale of ${wanted}`);
    };
    const wipe = () => visit.state((state) => state.wipe);
    const besides = (await visit.options()).getByLabel('Compare with').locator('option');
    assert.deepEqual(await besides.allInnerTexts(), ['Plate alone', 'A slicer’s straight lines', 'Plain 45° zigzag']);
    await visit.page.keyboard.press('Escape');
    await visit.option('Compare with', 'zigzag');
    const grip = visit.page.locator('sillon-divider .grip');
    const isAt = (share) =>
      until(async () => {
        const { x, width } = await stand();
        const box = await grip.boundingBox();
        return box !== null && Math.abs(box.x + box.width / 2 - x - share * width) < 1.5 && box;
      }, `the grip at ${share} of the plate`);
    await isAt(0.5);
    await until(async () => {
      const { x, width } = await stand();
      const box = await grip.boundingBox();
      const middle = box.y + box.height / 2;
      await visit.page.mouse.move(box.x + box.width / 2, middle);
      await visit.page.mouse.down();
      await visit.page.mouse.move(x + 0.75 * width, middle, { steps: 3 });
      await visit.page.mouse.up();
      return Math.abs((await wipe()) - 0.75) < 0.01;
    }, 'a line at three quarters');
    await isAt(await wipe());
    const before = await wipe();
    await visit.page.keyboard.press('ArrowLeft');
    await until(async () => Math.abs((await wipe()) - before + 0.01) < 0.006, 'a line one step to the left');
    // Beside it instead: one or the other.
    await visit.option('Compare with', 'beside');
    await visit.until(({ over, compare }) => over === undefined && compare);
    await visit.option('Compare with', 'none');

    const size = (value) => visit.option('Size', value);
    await size('life');
    await isScale(96 / 25.4);
    await size('arm');
    await isScale(96 / 25.4); // a screen is looked at from there, too
    await visit.page.keyboard.press('Escape');
    await visit.page.mouse.move(500, 350);
    await visit.page.mouse.wheel(0, -200);
    await visit.until(({ sizing }) => sizing === 'free');
    // All of it, as large whether a notice lifts the bars or not.
    const whole = async () => {
      await size('whole');
      return until(async () => {
        const { inside, share, scale } = await stand();
        return inside && share > 0.6 && scale > 96 / 25.4 && scale;
      }, 'all of the plate');
    };
    const tell = (notices) =>
      visit.page.evaluate((notices) => {
        document.querySelector('sillon-app').studio.store.set({ notices });
      }, notices);
    await tell([]);
    const scale = await whole();
    await size('life');
    await tell([{ id: -1, text: 'A notice.' }]);
    await visit.page.getByText('A notice.').waitFor();
    assert.equal(await whole(), scale);
    assert.deepEqual(visit.problems, []);
  },
);
