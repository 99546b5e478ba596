// A change is seen before its beads: the plate's directions stand in for them, in the new outline; also without WebGL 2, and
// without a graphics card.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);
const shots = process.env.SILLON_SHOTS;

/** Colours of what is on the screen, at places of the plate's page, as shares of it from the upper left.
 * @param name  of the picture that is kept where somebody asks for pictures */
async function coloursAt(visit, places, name) {
  await settled(visit.page);
  const png = await visit.page.screenshot();
  if (shots !== undefined && name !== undefined) writeFileSync(join(shots, `${name}.png`), png);
  return visit.page.evaluate(
    async ({ png, places }) => {
      const { stage } = document.querySelector('sillon-app').studio;
      const canvas = stage.getBoundingClientRect();
      const box = stage.plateBox();
      const bytes = Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes]));
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      const ratio = bitmap.width / innerWidth;
      return places.map(([x, y]) => {
        const at = [canvas.left + box.left + x * box.width, canvas.top + box.top + y * box.height];
        const { data } = context.getImageData(...at.map((one) => Math.round(one * ratio) - 1), 3, 3);
        return [0, 1, 2].map((k) => data.filter((_, at) => at % 4 === k).reduce((sum, one) => sum + one, 0) / 9);
      });
    },
    { png: png.toString('base64'), places },
  );
}

const differ = (a, b) => Math.max(...a.map((one, k) => Math.abs(one - b[k])));

/** From here on no beads come; only the directions of a plate tell what it is. */
const withholdBeads = (visit) =>
  visit.page.evaluate(() => {
    const { store } = document.querySelector('sillon-app').studio;
    const set = store.set.bind(store);
    store.set = ({ result: _, ...others }) => set(others);
  });
const change = (visit, to) => visit.page.evaluate(`document.querySelector('sillon-app').studio.change(${to})`);
const drawn = (visit) => visit.until(({ directions, plate }) => directions?.plate === plate);
const lightFrom = (visit, azimuth, elevation = 35) =>
  visit.page.evaluate((light) => document.querySelector('sillon-app').studio.setLight(light), { azimuth, elevation });

const middle = [0.5, 0.5];
const corner = [0.04, 0.04];
const places = [middle, corner, [0.3, 0.4], [0.7, 0.6], [0.5, 0.25]];

for (const view of ['appearance', 'toolpath']) {
  test(`${view}: a new shape is there before its beads, and nothing of the old one`, { skip }, async () => {
    const visit = await bench.open({
      small: true,
      fresh: true,
      deviceScaleFactor: 1,
      viewport: { width: 1000, height: 700 },
    });
    await visit.idle();
    await visit.page.evaluate((name) => document.querySelector('sillon-app').studio.setView(name), view);
    const [bead, ground] = await coloursAt(visit, [middle, [-0.1, -0.1]]);
    assert.ok(differ(bead, ground) > 20, 'beads look like the ground');
    await withholdBeads(visit);
    const shape = await visit.state(({ plate }) => plate.shape.kind);
    assert.notEqual(shape, 'heart');
    await change(visit, `(plate) => ({ ...plate, shape: { ...plate.shape, kind: 'heart' }, width: 60, height: 55 })`);
    await drawn(visit);
    const seen = await coloursAt(visit, places, `heart-${view}`);
    assert.ok(differ(seen[1], ground) < 12, `beside the heart is ${seen[1]}, the ground ${ground}`);
    for (const k of [0, 2, 3]) assert.ok(differ(seen[k], ground) > 20, `the heart is ${seen[k]} at ${places[k]}`);
    assert.equal(await visit.state(({ result }) => result.plate.width), 24, 'beads have come');
  });
}

test('another fill and strokes are seen before their beads, and follow the light', { skip }, async () => {
  const visit = await bench.open({
    small: true,
    fresh: true,
    deviceScaleFactor: 1,
    viewport: { width: 1000, height: 700 },
  });
  await visit.idle();
  await lightFrom(visit, 60);
  await withholdBeads(visit);
  const fill = (angle) =>
    `(plate) => ({ ...plate, layers: [{ ...plate.layers[0], kind: 'direction', angle: ${angle} }] })`;
  const tones = {};
  for (const angle of [60, 150]) {
    await change(visit, fill(angle));
    await drawn(visit);
    [tones[angle]] = await coloursAt(visit, [middle], `fill-${angle}`);
  }
  assert.ok(differ(tones[60], tones[150]) > 60, `along the light ${tones[60]}, across it ${tones[150]}`);
  await lightFrom(visit, 150);
  const [turned] = await coloursAt(visit, [middle]);
  assert.ok(differ(turned, tones[60]) < 30, `under the light turned by 90° ${turned}, not ${tones[60]}`);
});

test('while a hand drags its size, a plate fills its new page', { skip }, async () => {
  const visit = await bench.open({
    small: true,
    fresh: true,
    deviceScaleFactor: 1,
    viewport: { width: 1000, height: 700 },
  });
  await visit.idle();
  await drawn(visit);
  await withholdBeads(visit);
  await visit.page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    // Also before anybody has drawn the new directions.
    const set = studio.store.set;
    studio.store.set = ({ directions: _, ...others }) => set(others);
    studio.change((plate) => ({ ...plate, width: 80, height: 30 }), 'size');
  });
  const [inside, right, beside] = await coloursAt(visit, [middle, [0.9, 0.5], [0.5, -0.1]], 'stretched');
  for (const one of [inside, right]) assert.ok(differ(one, beside) > 20, `${one} on the page, ${beside} beside it`);
});

const withoutWebGl = () => {
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return kind === 'webgl2' ? null : getContext.call(this, kind, ...rest);
  };
};

test('without WebGL 2 the plate is drawn all the same, under the light, and follows changes', { skip }, async () => {
  const visit = await bench.open({
    small: true,
    fresh: true,
    deviceScaleFactor: 1,
    viewport: { width: 1000, height: 700 },
    prepare: withoutWebGl,
  });
  await visit.idle();
  await visit.page.locator('sillon-notices .problem').waitFor();
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.store.set({ notices: [] }));
  await lightFrom(visit, 60);
  const flat = `(plate) => ({ ...plate, layers: [{ ...plate.layers[0], kind: 'direction', angle: 150 }] })`;
  await change(visit, flat);
  await visit.idle();
  const [bright, ground] = await coloursAt(visit, [middle, [-0.1, -0.1]], 'flat-bright');
  assert.ok(differ(bright, ground) > 20, `the plate is ${bright}, the ground ${ground}`);
  await lightFrom(visit, 150);
  // It is there again once the light rests, bead by bead.
  await until(async () => {
    const [dark] = await coloursAt(visit, [middle], 'flat-dark');
    return differ(dark, bright) > 60 && dark;
  }, 'the plate under another light');
  await withholdBeads(visit);
  await change(visit, `(plate) => ({ ...plate, shape: { ...plate.shape, kind: 'heart' }, width: 60, height: 55 })`);
  await drawn(visit);
  const [heart, beside] = await coloursAt(visit, [middle, corner], 'flat-heart');
  assert.ok(differ(heart, ground) > 20, `the heart is ${heart}, the ground ${ground}`);
  assert.ok(differ(beside, ground) < 12, `beside the heart is ${beside}`);
  const picture = await visit.page.evaluate(async () => {
    const { blob } = await document.querySelector('sillon-app').studio.picture(300);
    return [(await createImageBitmap(blob)).width, blob.size];
  });
  assert.ok(picture[0] === 300 && picture[1] > 2000, `${picture}`);
});

/** Each frame is there 80 ms after it was asked for, as without a graphics card. */
const drawsSlowly = () => {
  const { fenceSync, clientWaitSync, clear } = WebGL2RenderingContext.prototype;
  const asked = new WeakMap();
  globalThis.widths = [];
  Object.assign(WebGL2RenderingContext.prototype, {
    fenceSync(...words) {
      const sync = fenceSync.apply(this, words);
      asked.set(sync, performance.now());
      return sync;
    },
    clientWaitSync(sync, ...rest) {
      return performance.now() - asked.get(sync) < 80 ? this.TIMEOUT_EXPIRED : clientWaitSync.call(this, sync, ...rest);
    },
    clear(...words) {
      globalThis.widths.push(this.drawingBufferWidth);
      clear.apply(this, words);
    },
  });
};

test(
  'where drawing is slow the canvas is half as fine while the light moves, then whole, and then at rest',
  { skip },
  async () => {
    const visit = await bench.open({ small: true, fresh: true, deviceScaleFactor: 1, prepare: drawsSlowly });
    await visit.idle();
    await drawn(visit);
    const { width } = await visit.canvas();
    const widths = () => visit.page.evaluate(() => globalThis.widths);
    let azimuth = 0;
    await until(async () => {
      await lightFrom(visit, (azimuth += 7) % 360);
      return (await widths()).at(-1) === Math.round(width / 2);
    }, 'a frame of half the width');
    await until(async () => (await widths()).at(-1) === Math.round(width), 'a whole frame');
    const rests = await until(async () => {
      const before = (await widths()).length;
      for (let k = 0; k < 10; ++k) await settled(visit.page);
      return (await widths()).length === before && before;
    }, 'the last frame');
    assert.equal((await widths())[rests - 1], Math.round(width));
  },
);
