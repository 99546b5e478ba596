// What the page does is said and can be stopped; tools work where one looks; phones leave the plate free.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { fileAt, inputs, skip, start } from './support/studio.js';
import { settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);
const plate = (state) => JSON.stringify(state.plate);
const strokes = (visit) => visit.state(({ plate }) => plate.layers[1]?.strokes ?? []);

test('a picture that is being read is said, and reading can be cancelled', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.idle();
  const before = await visit.state(plate);
  await visit.page.evaluate(() => {
    // A picture that never comes: nobody need wait for it.
    globalThis.createImageBitmap = () => new Promise(() => undefined);
  });
  const webp = Buffer.concat([Buffer.from('RIFF\0\0\0\0WEBP'), Buffer.alloc(40)]);
  const dropped = visit.drop([{ name: 'cat.webp', type: '', data: webp.toString('base64') }]);
  const status = visit.page.locator('sillon-status');
  await status.getByText('Reading cat.webp').waitFor();
  assert.doesNotMatch((await visit.status()).join(' '), /mm|min/); // no figures of another plate beside it
  await status.getByRole('button', { name: 'Cancel' }).click();
  await dropped;
  await visit.until((state) => state.reading === undefined);
  assert.equal(await visit.state(plate), before);
  assert.equal(await visit.state((state) => state.notices.filter(({ problem }) => problem).length), 0);
});

test('an alarm is told once', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    const problem = { code: 'NoWebGl', values: {}, detail: '' };
    studio.fail(problem);
    studio.store.set({ problem });
  });
  const alarms = visit.page.locator('sillon-notices .problem');
  await alarms.first().waitFor();
  assert.equal(await alarms.count(), 1);
});

test('combing in the shimmer stays there, under a light that keeps still', { skip }, async () => {
  const visit = await bench.open({ small: true, reducedMotion: 'no-preference' });
  await visit.idle();
  await visit.page.keyboard.press('b');
  await visit.until((state) => state.tool === 'comb');
  assert.equal(await visit.state((state) => state.view), 'appearance');
  const light = await visit.state((state) => JSON.stringify(state.light));
  await visit.stroke([0.5, 0.45], [0.6, 0.55]);
  await visit.until((state) => state.plate.layers[1]?.strokes.length === 1);
  assert.equal(await visit.state((state) => JSON.stringify(state.light)), light);
  assert.equal(await visit.page.locator('sillon-layers-panel').getByText('Comb', { exact: true }).count(), 0);
});

test('a brush works over a photograph, too, and what it drew can be wiped away again', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.until(({ plate }) => plate.width === 24);
  await visit.drop([fileAt(join(inputs, 'photo.png'))]);
  await visit.until((state) => state.plate.layers[0].kind === 'picture');
  await visit.idle();
  const digest = () => visit.state(({ result }) => result.report.digest);
  const before = await digest();
  await page.keyboard.press('b');
  await visit.until((state) => state.tool === 'comb');
  await visit.stroke([0.45, 0.45], [0.55, 0.55]);
  await visit.until((state) => state.plate.layers[1]?.strokes.length === 1 && !state.live);
  await visit.idle();
  assert.notEqual(await digest(), before);
  await page.keyboard.press('v');
  await page.locator('sillon-layers-panel').getByRole('button', { name: 'Strokes', exact: true }).click();
  await visit.button('Remove all strokes').click();
  await visit.until((state) => state.plate.layers.length === 1);
  await visit.idle();
  assert.equal(await digest(), before);
  assert.deepEqual(visit.problems, []);
});

test(
  'a brush shows where it went before beads follow it, and goes over beads without their being drawn again',
  { skip },
  async () => {
    const visit = await bench.open({ small: true, deviceScaleFactor: 1 });
    await visit.idle();
    await visit.page.evaluate(() => {
      const { store } = document.querySelector('sillon-app').studio;
      const set = store.set.bind(store);
      store.set = (patch) => 'result' in patch || 'directions' in patch || set(patch); // neither ever comes
      store.set({ tool: 'comb' });
      globalThis.drawn = 0;
      for (const name of ['drawElements', 'drawArrays']) {
        const draw = WebGL2RenderingContext.prototype[name];
        WebGL2RenderingContext.prototype[name] = function (...words) {
          ++globalThis.drawn;
          draw.apply(this, words);
        };
      }
    });
    await settled(visit.page);
    const count = () => visit.page.evaluate(() => globalThis.drawn);
    await until(async () => {
      const before = await count();
      for (let k = 0; k < 5; ++k) await settled(visit.page);
      return (await count()) === before;
    }, 'rest: with another tool the canvas is drawn anew');
    await visit.page.evaluate(() => (globalThis.drawn = 0));
    const box = await visit.canvas();
    const at = (x, y) => [box.x + box.width * x, box.y + box.height * y];
    /** Of a place that the brush's ring is far from. */
    const seen = () =>
      visit.page.evaluate(
        ([x, y]) => {
          const roots = (root) =>
            [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? roots(one.shadowRoot) : [])]);
          const overlay = roots(document).find((one) => one.matches('canvas.overlay'));
          return [...overlay.getContext('2d').getImageData(x, y, 1, 1).data].join();
        },
        [box.width * 0.45, box.height * 0.5].map(Math.round),
      );
    const before = await seen();
    await visit.page.mouse.move(...at(0.4, 0.5));
    await visit.page.mouse.move(...at(0.3, 0.2), { steps: 8 });
    await visit.page.mouse.move(...at(0.4, 0.5), { steps: 8 });
    await settled(visit.page);
    assert.equal(await visit.page.evaluate(() => globalThis.drawn), 0);
    await visit.page.mouse.down();
    await visit.page.mouse.move(...at(0.6, 0.5), { steps: 4 });
    await until(async () => (await seen()) !== before, 'the stroke');
    assert.equal(await visit.state((state) => state.result.plate.layers.length), 1);
    await visit.page.mouse.up();
  },
);

test(
  'undo while a stroke is drawn takes that stroke alone; Escape takes the pen of the keys up',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    const { page } = visit;
    await page.keyboard.press('b');
    await visit.until((state) => state.tool === 'comb');
    await visit.stroke([0.45, 0.45], [0.55, 0.55]);
    await visit.until((state) => state.plate.layers[1]?.strokes.length === 1 && !state.live);
    const [first] = await strokes(visit);
    const box = await visit.canvas();
    const move = (x, y) => page.mouse.move(box.x + x * box.width, box.y + y * box.height, { steps: 3 });
    await move(0.5, 0.4);
    await page.mouse.down();
    await move(0.5, 0.5);
    await visit.until((state) => state.plate.layers[1].strokes.length === 2);
    await page.keyboard.press('Control+z');
    await move(0.5, 0.6);
    await page.mouse.up();
    assert.deepEqual(await strokes(visit), [first]);
    assert.equal(await visit.state((state) => state.live), false);
    await page.locator('sillon-canvas .overlay').focus();
    await page.keyboard.press('Space');
    await page.keyboard.press('ArrowUp');
    await visit.until((state) => state.plate.layers[1].strokes.length === 2);
    const drawn = await strokes(visit);
    await page.keyboard.press('Escape');
    await page.keyboard.press('ArrowUp');
    assert.deepEqual(await strokes(visit), drawn);
    assert.deepEqual(await visit.state((state) => [state.tool, state.live]), ['comb', false]);
  },
);

test('undo in a field whose number was taken over is the plate’s; before, it is the text’s', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const { page } = visit;
  await visit.section('Shape');
  const field = page.getByRole('spinbutton', { name: 'Diameter' });
  await field.selectText();
  await page.keyboard.type('33');
  await visit.until((state) => state.plate.width === 33);
  await page.keyboard.press('Enter');
  await page.keyboard.press('Control+z');
  await visit.until((state) => state.plate.width === 24);
  assert.equal(await field.inputValue(), '24');
  await page.keyboard.press('Control+Shift+z');
  await visit.until((state) => state.plate.width === 33);
  const before = await visit.state((state) => state.plate.name);
  await page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, name: 'Named' }));
  });
  await field.selectText();
  await page.keyboard.type('40');
  await visit.until((state) => state.plate.width === 40);
  await page.keyboard.press('Control+z'); // of a letter, or of all that was typed
  await visit.until((state) => state.plate.width !== 40);
  assert.notEqual(await visit.state((state) => state.plate.name), before);
});

test('two fingers that zoom leave no trace of a brush: redo is as it was', { skip }, async () => {
  const visit = await bench.open({ small: true, hasTouch: true });
  await visit.idle();
  const { page } = visit;
  await page.keyboard.press('b');
  await visit.until((state) => state.tool === 'comb');
  await visit.stroke([0.45, 0.45], [0.55, 0.55]);
  await visit.until((state) => state.plate.layers[1]?.strokes.length === 1 && !state.live);
  const drawn = await strokes(visit);
  await page.keyboard.press('Control+z');
  await visit.until((state) => state.plate.layers.length === 1);
  const box = await visit.canvas();
  const fingers = await visit.context.newCDPSession(page);
  const touch = (type, ...places) =>
    fingers.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: places.map(([x, y], id) => ({ x: box.x + x * box.width, y: box.y + y * box.height, id })),
    });
  await touch('touchStart', [0.45, 0.5]);
  await touch('touchMove', [0.46, 0.5]);
  await visit.until((state) => state.plate.layers[1]?.strokes.length === 1);
  await touch('touchStart', [0.46, 0.5], [0.55, 0.5]);
  await touch('touchMove', [0.4, 0.5], [0.6, 0.5]);
  await touch('touchEnd');
  await visit.until((state) => state.sizing === 'free' && state.plate.layers.length === 1 && !state.live);
  await page.keyboard.press('Control+Shift+z');
  await visit.until((state) => state.plate.layers[1]?.strokes.length === 1);
  assert.deepEqual(await strokes(visit), drawn);
});

test('every action is found by its name', { skip }, async () => {
  const visit = await bench.open({ small: true, viewport: { width: 1024, height: 720 } });
  await visit.idle();
  await visit.page.keyboard.press('Control+k');
  const field = visit.page.getByRole('combobox', { name: 'All actions' });
  await field.fill('check');
  await field.press('Enter');
  await visit.until((state) => state.view === 'quality' && state.dialog === undefined);
  await visit.page.keyboard.press('Control+k');
  await field.fill('your pla');
  await field.press('Enter');
  await visit.page.locator('sillon-plates dialog').waitFor();
  await visit.page.keyboard.press('Escape');
  await visit.until((state) => state.dialog === undefined); // it goes later than the key
  await visit.page.keyboard.press('Control+k');
  await field.fill('nothing like it');
  await visit.page.getByText('No action has such a name.').waitFor();
});

test('on a phone buttons leave the plate free, are large enough, and a finger leads no light', { skip }, async () => {
  const visit = await bench.open({
    small: true,
    viewport: { width: 360, height: 740 },
    hasTouch: true,
    isMobile: true,
  });
  await visit.idle();
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.setPanel(''));
  const look = () =>
    visit.page.evaluate(async () => {
      for (let n = 0; n < 3; ++n) await new Promise((resolve) => requestAnimationFrame(resolve));
      const stage = document.querySelector('sillon-app').shadowRoot.querySelector('sillon-stage').shadowRoot;
      const canvas = stage.querySelector('sillon-canvas');
      const { x, y, width, height } = canvas.getBoundingClientRect();
      const plate = canvas.plateBox();
      const [left, top] = [x + plate.left, y + plate.top];
      const over = [...stage.querySelectorAll('.views, sillon-tools, .actions, .bottom > *')]
        .map((one) => ({ name: one.className || one.tagName, box: one.getBoundingClientRect() }))
        .filter(({ box }) => box.width > 0)
        .filter(
          ({ box }) =>
            box.left < left + plate.width - 1 &&
            box.right > left + 1 &&
            box.top < top + plate.height - 1 &&
            box.bottom > top + 1,
        )
        .map(({ name }) => name);
      return {
        over,
        share: plate.width / width,
        inside: plate.left >= 0 && plate.left + plate.width <= width + 1,
        height,
      };
    });
  // Words of what has happened push buttons up for a moment.
  const covered = await until(async () => {
    const seen = await look();
    return seen.over.length === 0 && seen;
  }, 'a plate without buttons over it');
  assert.deepEqual(covered.over, []);
  assert.ok(covered.inside && covered.share > 0.5, JSON.stringify(covered));
  const small = await visit.page.evaluate(() => {
    const all = (root) =>
      [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
    return all(document)
      .filter((one) => one.matches('button, select') && one.checkVisibility({ visibilityProperty: true }))
      .filter((one) => !one.closest('[popover], aside') && getComputedStyle(one).clipPath === 'none')
      .map((one) => [one.ariaLabel ?? one.textContent.trim(), one.getBoundingClientRect()])
      .filter(([, { width, height }]) => width > 0 && Math.min(width, height) < 43.5)
      .map(([name, { width, height }]) => `${name} ${width}x${height}`);
  });
  assert.deepEqual(small, []);
  const light = await visit.state((state) => JSON.stringify(state.light));
  const box = await visit.canvas();
  await visit.page.touchscreen.tap(box.x + box.width * 0.7, box.y + box.height * 0.5);
  assert.equal(await visit.state((state) => JSON.stringify(state.light)), light);
});

test('a photo that another app shares is opened', { skip }, async () => {
  const visit = await bench.open({ small: true, serviceWorkers: 'allow' });
  await visit.idle();
  await visit.page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  // As the system does it: a page's own forms are not let out.
  const app = await visit.context.newPage();
  await app.setContent(
    `<form method="post" enctype="multipart/form-data" action="${bench.origin}/"><input type="file" name="files"><button>`,
  );
  await app.locator('input').setInputFiles(join(inputs, 'photo.png'));
  await app.locator('button').click();
  await app.waitForFunction(
    () => document.querySelector('sillon-app')?.studio.store.state.plate.layers[0].kind === 'picture',
  );
  assert.equal(new URL(app.url()).hash, '');
  const manifest = JSON.parse(readFileSync(new URL('../../public/manifest.webmanifest', import.meta.url), 'utf8'));
  assert.equal(manifest.share_target.params.files[0].name, 'files');
});
