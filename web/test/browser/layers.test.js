// Layers: their panel, and the frame that a hand moves on the plate. Boxes of letters are told as the engine would tell them, so
// that no test waits for it.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';

import { violations } from './support/axe.js';
import { overlaps } from './support/covered.js';
import { sharedBench } from './support/shared.js';
import { fileAt, fileOf, inputs, skip, start } from './support/studio.js';
import { settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);

/** A visit with the panel open. Letters are as high as they are wide. */
async function open(options = {}) {
  const visit = await bench.open({ small: true, ...options });
  await visit.page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.services.layerBoxes = async ({ width, height, layers }) =>
      new Map(
        layers.map(({ id, at, kind, text, textSize, size: [wide, tall] }) => {
          const known =
            kind === 'text' ? [text.length * textSize, textSize] : [wide || tall || width, tall || wide || height];
          return [id, { at: at ?? [width / 2, height / 2], size: known, thin: 0 }];
        }),
      );
    studio.setPanel('layers');
  });
  await visit.page.locator('sillon-layers-panel').locator('.start, .tiles').first().waitFor();
  return visit;
}

/** Those on top of the ground. */
const layers = (visit) =>
  visit.state(({ plate }) =>
    plate.layers.slice(1).map((layer) => ({ ...layer, file: null, pictures: [], maskFile: null, font: '' })),
  );
const undos = (visit) => visit.page.evaluate(() => document.querySelector('sillon-app').studio.store.steps.past.length);

/** Presses the tile of a kind, which may be among those that are not there unasked. */
async function choose(panel, name) {
  await panel.locator('.start, .tiles').first().waitFor();
  const places = ['Text', 'QR code'].includes(name) ? '.start, .tiles' : '.tiles';
  const tile = panel.locator(places).getByRole('button', { name, exact: true });
  if ((await tile.count()) === 0) await panel.locator('#more-kinds, .start [aria-expanded=false]').click();
  await tile.click();
}

async function add(visit, name) {
  const { page } = visit;
  const panel = page.locator('sillon-layers-panel');
  const count = (await layers(visit)).length;
  if (count > 0) await panel.locator('#add').click();
  await choose(panel, name);
  await visit.until(`({ plate }) => plate.layers.length === ${count + 2}`);
  await settled(page);
}

/** A place of the page [mm] on the screen. */
const screen = (visit, x, y) =>
  visit.page.evaluate(
    ([x, y]) => {
      const { studio } = document.querySelector('sillon-app');
      const canvas = studio.stage;
      const { left, top, width, height } = canvas.plateBox();
      const box = canvas.getBoundingClientRect();
      const { plate } = studio.store.state;
      return [box.left + left + (x / plate.width) * width, box.top + top + (1 - y / plate.height) * height];
    },
    [x, y],
  );

/** The share that the overlay covers around a place of the page [mm], 0..1. */
const cover = async (visit, x, y) => {
  const place = await screen(visit, x, y);
  return visit.page.evaluate(([x, y]) => {
    const overlay = document.querySelector('sillon-app').studio.stage.shadowRoot.querySelector('.overlay');
    const { left, top, width } = overlay.getBoundingClientRect();
    const scale = overlay.width / width;
    const { data } = overlay
      .getContext('2d')
      .getImageData(Math.round((x - left) * scale) - 1, Math.round((y - top) * scale) - 1, 3, 3);
    return data.filter((_, k) => k % 4 === 3).reduce((sum, alpha) => sum + alpha, 0) / (9 * 255);
  }, place);
};

/** A drag over the plate, in mm. @param keys  that are held meanwhile */
async function drag(visit, from, to, keys = []) {
  const { mouse, keyboard } = visit.page;
  await mouse.move(...(await screen(visit, ...from)));
  await mouse.down();
  for (const key of keys) await keyboard.down(key);
  await mouse.move(...(await screen(visit, ...to)), { steps: 6 });
  await mouse.up();
  for (const key of keys) await keyboard.up(key);
  await settled(visit.page);
}

const near = (found, wanted, within = 0.1) => {
  wanted.forEach((value, k) => assert.ok(Math.abs(found[k] - value) <= within, `${found} is not ${wanted}`));
};

test('cards fill the ground, alone or chosen, and leave what lies on top of it', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  const panel = page.locator('sillon-layers-panel');
  const card = (name) => panel.getByRole('radio', { name, exact: true });
  const list = () => visit.state(({ plate }) => plate.layers.map(({ id, kind, pattern }) => [id, kind, pattern]));
  const [ground, text] = [1, 2];
  assert.equal(await card('Waves').isChecked(), true);
  assert.equal(await panel.locator('li[data-layer]').count(), 0);
  await add(visit, 'Text');
  assert.equal(await panel.locator('.cards, .tiles').count(), 0);
  await panel.getByRole('button', { name: 'Waves', exact: true }).click();
  await card('Spiral').check();
  await visit.until(({ plate }) => plate.layers[0].pattern === 'spiral');
  assert.deepEqual(await list(), [
    [ground, 'pattern', 'spiral'],
    [text, 'text', 'radial'],
  ]);
  await page.keyboard.press('Control+z');
  await visit.until(({ plate }) => plate.layers[0].pattern === 'waves');
  assert.equal(await card('Waves').isChecked(), true);
  assert.equal((await layers(visit)).length, 1);
  assert.deepEqual(visit.problems, []);
});

test(
  'a text is added, typed, and moved, scaled and turned by its frame, each as one step of undo',
  { skip },
  async () => {
    const visit = await open();
    const { page } = visit;
    await add(visit, 'Text');
    // Its letters are what comes next: the field has the focus, and all of it is chosen.
    await page.keyboard.type('AB');
    await page.locator('#layer-text').blur();
    await visit.until(({ plate, layerBoxes }) => layerBoxes.get(2)?.layer === plate.layers[1]);
    await settled(page);
    const [text] = await layers(visit);
    assert.deepEqual([text.text, text.kind, text.at, text.textSize], ['AB', 'text', null, 4]);

    // 8 by 4 mm about the middle of 24 by 24: handles at the corners, and nothing beside them.
    assert.ok((await cover(visit, 16, 14)) > 0.9, 'no handle at the corner');
    assert.ok((await cover(visit, 16, 12)) > 0.5, 'no frame');
    assert.equal(await cover(visit, 18, 12), 0);

    const before = await undos(visit);
    await drag(visit, [12, 12], [7, 17.3], ['Control']); // without snapping
    near((await layers(visit))[0].at, [7, 17.3]);
    assert.equal(await undos(visit), before + 1);
    assert.ok((await cover(visit, 11, 19.3)) > 0.9, 'the handle did not follow');
    assert.equal(await cover(visit, 16, 14), 0);

    await drag(visit, [7, 17.3], [12.1, 12.08]);
    assert.deepEqual((await layers(visit))[0].at, [12, 12], 'it did not snap');

    await drag(visit, [16, 14], [20, 16]); // twice as far from the lower left corner, at 8, 10
    near([(await layers(visit))[0].textSize], [6]);
    near((await layers(visit))[0].at, [14, 13]);

    const knob = await visit.page.evaluate(
      () => 26 / (document.querySelector('sillon-app').studio.stage.plateBox().height / 24),
    );
    await drag(visit, [14, 16 + knob], [10, 17], ['Shift']); // a little more than a quarter
    assert.equal((await layers(visit))[0].rotation, 45);
    assert.equal(await undos(visit), before + 4);

    await page.keyboard.press('Control+z');
    assert.equal((await layers(visit))[0].rotation, 0);
    assert.deepEqual(visit.problems, []);
  },
);

test(
  'sides scale freely with Shift, but letters are never stretched; lines to snap to are seen',
  { skip },
  async () => {
    const visit = await open();
    const { page } = visit;
    await add(visit, 'Direction');
    near((await layers(visit))[0].size, [12, 12]);
    await drag(visit, [18, 18], [20, 14], ['Shift']);
    near((await layers(visit))[0].size, [14, 8]);
    near((await layers(visit))[0].at, [13, 10]);
    await page.mouse.move(...(await screen(visit, 13, 10)));
    await page.mouse.down();
    await page.mouse.move(...(await screen(visit, 12.05, 4.1)), { steps: 4 });
    await settled(page);
    assert.deepEqual((await layers(visit))[0].at, [12, 4]); // on the middle line, and on the page's lower edge
    const along = await Promise.all([0, 0.1, 0.2, 0.3, 0.4, 0.5].map((more) => cover(visit, 12, 20 + more)));
    assert.ok(Math.max(...along) > 0.3, `no line across the page: ${along}`);
    await page.mouse.up();
    await settled(page);
    assert.equal(await cover(visit, 12, 20), 0);
  },
);

test('a corner snaps to the edges and the middle of the page, and lies on lines that are seen', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  await add(visit, 'Direction');
  await drag(visit, [18, 18], [23.9, 23.8]); // 12 mm about the middle; the proportions stay
  near((await layers(visit))[0].size, [18, 18], 1e-9);
  near((await layers(visit))[0].at, [15, 15], 1e-9);
  await drag(visit, [24, 24], [20, 23.9], ['Shift']); // each side by itself
  near((await layers(visit))[0].size, [14, 18], 0.05);
  assert.equal((await layers(visit))[0].size[1], 18);

  await page.mouse.move(...(await screen(visit, 20, 24)));
  await page.mouse.down();
  await page.keyboard.down('Shift');
  await page.mouse.move(...(await screen(visit, 12.1, 20)), { steps: 4 });
  await settled(page);
  const line = async (x) =>
    Math.max(...(await Promise.all([0, 0.1, 0.2, 0.3, 0.4].map((more) => cover(visit, x, 1 + more)))));
  assert.ok((await line(12)) > 0.3, 'no line on the middle of the page');
  await page.keyboard.down('Control'); // it goes where the hand is
  await page.mouse.move(...(await screen(visit, 12.15, 20.1)));
  await settled(page);
  assert.equal(await line(12), 0);
  await page.mouse.up();
  await page.keyboard.up('Control');
  await page.keyboard.up('Shift');
  near((await layers(visit))[0].size, [6.15, 14.1], 0.05);
});

test('rays over all of the page move by their middle, and an inner knob turns waves', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  await add(visit, 'Pattern');
  const before = await undos(visit);
  await drag(visit, [12, 12], [7, 16]);
  const [rays] = await layers(visit);
  near([...rays.at, ...rays.size], [7, 16, 0, 0]); // it still covers all of the page
  assert.equal(await undos(visit), before + 1);

  const set = (values) =>
    page.evaluate((values) => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({ ...plate, layers: [plate.layers[0], { ...plate.layers[1], ...values }] }));
      studio.settle();
    }, values);
  const arm = await page.evaluate(
    () => 44 / (document.querySelector('sillon-app').studio.stage.plateBox().height / 24),
  );
  await settled(page);
  assert.equal(await cover(visit, 7 + arm, 16), 0, 'a knob where there are no waves');
  await set({ pattern: 'waves', at: null, angle: 0 });
  await settled(page);
  assert.ok((await cover(visit, 12 + arm, 12)) > 0.9, 'no knob');
  await drag(visit, [12 + arm, 12], [12, 16]);
  const [waves] = await layers(visit);
  assert.deepEqual([waves.angle, waves.at, waves.size, waves.rotation], [90, null, [0, 0], 0]);
  assert.equal(await undos(visit), before + 3);
  assert.ok((await cover(visit, 12, 12 + arm)) > 0.9, 'the knob did not follow');
  // On a turned frame the waves are turned with it.
  await set({ rotation: 90 });
  await settled(page);
  assert.ok((await cover(visit, 12 - arm, 12)) > 0.9, 'the knob is not where the waves run to');
  assert.equal(await page.getByText('The inner knob turns the waves.').count(), 1);
});

test(
  'keys move, delete and let go of a layer; clicks choose; brushes and the view keep working',
  { skip },
  async () => {
    const visit = await open();
    const { page } = visit;
    await add(visit, 'Text');
    await page.evaluate(() => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({
        ...plate,
        layers: [plate.layers[0], { ...plate.layers[1], at: [6, 18], text: 'A' }],
      }));
    });
    await add(visit, 'Direction');
    await page.evaluate(() => document.querySelector('sillon-app').studio.stage.focus());
    const before = await undos(visit);
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Shift+ArrowUp');
    await page.keyboard.press('Alt+ArrowLeft');
    near((await layers(visit))[1].at, [12.9, 22], 1e-9);
    assert.equal(await undos(visit), before + 3);

    await page.mouse.click(...(await screen(visit, 6, 18)));
    await visit.until((state) => state.layer === 2);
    await page.mouse.click(...(await screen(visit, 2, 2)));
    await visit.until((state) => state.layer === undefined);
    await page.mouse.click(...(await screen(visit, 6, 18)));
    await visit.until((state) => state.layer === 2);
    await page.keyboard.press('Delete');
    await visit.until(({ plate }) => plate.layers.length === 2);
    await page.keyboard.press('Control+z');
    await visit.until(({ plate }) => plate.layers.length === 3);
    await page.keyboard.press('Escape');
    await visit.until((state) => state.layer === undefined);

    // Nothing is chosen: the view moves, and no layer.
    const was = await layers(visit);
    const camera = () => page.evaluate(() => document.querySelector('sillon-app').studio.stage.camera.x);
    const at = await camera();
    await drag(visit, [20, 3], [17, 3]);
    assert.notEqual(await camera(), at);
    await page.keyboard.press('b');
    await drag(visit, [6, 18], [9, 15]);
    const now = await layers(visit);
    assert.deepEqual([now.length, now[2].kind, now[2].strokes.length], [3, 'strokes', 1]);
    assert.deepEqual(now.slice(0, 2), was);
    await page.keyboard.press('v');
    await page.locator('sillon-layers-panel').getByRole('button', { name: 'A', exact: true }).click();
    assert.equal(await visit.state((state) => state.layer), 2);
  },
);

test(
  'while layers are in use, what is dropped or pasted is a layer, or on its own target the shape',
  { skip },
  async () => {
    const visit = await open();
    const { page } = visit;
    const drop = (files) =>
      page.locator('sillon-layers-panel').evaluate((panel, files) => {
        const transfer = new DataTransfer();
        for (const { name, type, data } of files) {
          const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
          transfer.items.add(new File([bytes], name, { type }));
        }
        const options = { dataTransfer: transfer, bubbles: true, composed: true, cancelable: true };
        panel.dispatchEvent(new DragEvent('dragover', options));
        panel.dispatchEvent(new DragEvent('drop', options));
      }, files);
    const star = fileOf(
      'star.svg',
      '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M0 0h9v9z"/></svg>',
    );
    const font = fileOf('mine', Buffer.from([0, 1, 0, 0, 0, 0]));
    await add(visit, 'Direction'); // with the ground alone, files are for that and for the shape
    const before = await undos(visit);
    await drop([star, fileAt(join(inputs, 'moon.png')), font]);
    await visit.until(({ plate }) => plate.layers.length === 5);
    assert.deepEqual(
      (await layers(visit)).map(({ kind }) => kind),
      ['direction', 'drawing', 'picture', 'text'],
    );
    assert.deepEqual(
      await visit.state(({ plate: { layers } }) => [
        layers[2].file.name,
        layers[3].pictures[0].file.name,
        layers[4].font.name,
      ]),
      ['star.svg', 'moon.png', 'mine.ttf'],
    );
    assert.equal(await visit.state(({ plate }) => plate.shape.kind), 'disc');
    assert.equal(await undos(visit), before + 1);
    await drop([fileOf('notes.txt', 'hello')]);
    await page.getByText('This page cannot open files like notes.txt.').waitFor();
    assert.equal((await layers(visit)).length, 4);
    // On the plate: where it is let go, and also where another section is open.
    await visit.section('Shape');
    await settled(page); // words of what has happened make the plate smaller for a while
    const shape = await visit.state(({ plate }) => plate.shape.kind);
    const over = async (place, files, text = '') =>
      page.evaluate(
        async ([[clientX, clientY], files, text]) => {
          const transfer = new DataTransfer();
          for (const { name, type, data } of files) {
            const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
            transfer.items.add(new File([bytes], name, { type }));
          }
          if (text !== '') transfer.setData('text/plain', text);
          const options = { dataTransfer: transfer, bubbles: true, cancelable: true, clientX, clientY };
          const app = document.querySelector('sillon-app');
          const targets = () => [
            ...(app.shadowRoot.querySelector('sillon-drop')?.shadowRoot.querySelectorAll('.target') ?? []),
          ];
          app.dispatchEvent(new DragEvent('dragover', options));
          while (targets().length === 0) await new Promise((resolve) => setTimeout(resolve, 20));
          app.dispatchEvent(new DragEvent('dragover', options));
          await new Promise((resolve) => setTimeout(resolve, 50));
          const boxes = targets().map((one) => {
            const { width, height, top, left } = one.getBoundingClientRect();
            return { text: one.querySelector('b').textContent, over: one.matches('.over'), width, height, top, left };
          });
          app.dispatchEvent(new DragEvent('drop', options));
          return boxes;
        },
        [place, files, text],
      );
    const targets = await over(await screen(visit, 8, 15), [star]);
    assert.deepEqual(
      targets.map(({ text, over }) => [text, over]),
      [
        ['New layer', true],
        ['Shape of the plate', false],
      ],
    );
    for (const { width, height } of targets) assert.ok(width > 300 && height >= 96, JSON.stringify(targets));
    await visit.until(({ plate, panel }) => plate.layers.length === 6 && panel === 'layers');
    near((await layers(visit))[4].at, [8, 15]);
    assert.equal(await visit.state(({ plate }) => plate.shape.kind), shape);
    await over(await screen(visit, 15, 8), [], 'Hello');
    await visit.until(({ plate }) => plate.layers.length === 7);
    const { kind, text, at } = (await layers(visit))[5];
    assert.deepEqual([kind, text], ['text', 'Hello']);
    near(at, [15, 8]);
    // A font is the chosen text's.
    await visit.drop([font]);
    await visit.until(({ plate }) => plate.layers[6].font.name === 'mine.ttf');
    assert.equal((await layers(visit)).length, 6);
    await page.keyboard.press('Control+z');
    // Pasted: letters, and a picture; beside the plate, each where there is room.
    await page.mouse.move(...(await screen(visit, 6, 10)));
    await visit.paste([], 'Good\nday');
    await visit.until(({ plate }) => plate.layers.length === 8);
    near((await layers(visit))[6].at, [6, 10]);
    assert.equal((await layers(visit))[6].text, 'Good\nday');
    await page.mouse.move(3, 300);
    await visit.paste([fileAt(join(inputs, 'moon.png'))]);
    await visit.until(({ plate }) => plate.layers.length === 9 && plate.layers[8].kind === 'picture');
    assert.equal(await visit.state(({ plate }) => plate.shape.kind), shape);
    // The other target.
    const [, { left, top, width, height }] = targets;
    const onShape = await over([left + width / 2, top + height / 2], [star]);
    assert.deepEqual(
      onShape.map(({ over }) => over),
      [false, true],
    );
    await visit.until(({ plate }) => plate.shape.kind === 'file');
    assert.equal((await layers(visit)).length, 8);
    assert.deepEqual(visit.problems, []);
  },
);

test('a warning about a layer marks its row and its frame, once the whole plate is there', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  for (const kind of ['Text', 'Text']) await add(visit, kind);
  await visit.idle();
  /** As the engine would tell it, of a kind that the panel has never heard of. */
  // The lowest layer is the ground.
  const tell = (change) =>
    page.evaluate((change) => {
      const { store } = document.querySelector('sillon-app').studio;
      const { result } = store.state;
      const warnings = [{ code: 'Unheard', values: { layer: 2 }, message: 'Layer 2 lies beside the plate.' }];
      store.set({ result: { ...result, report: { ...result.report, warnings }, ...change } });
    }, change);
  const rows = page.locator('sillon-layers-panel li.warned');
  /** Whether a frame is drawn there in the colour of warnings. */
  const red = async (x, y) => {
    const place = await screen(visit, x, y);
    return page.evaluate(([x, y]) => {
      const overlay = document.querySelector('sillon-app').studio.stage.shadowRoot.querySelector('.overlay');
      const { left, top, width } = overlay.getBoundingClientRect();
      const scale = overlay.width / width;
      const at = [Math.round((x - left) * scale) - 2, Math.round((y - top) * scale) - 2];
      const { data } = overlay.getContext('2d').getImageData(...at, 5, 5);
      let most = 0; // redder than the accent, which is a brown
      for (let k = 0; k < data.length; k += 4) if (data[k + 3] > 100) most = Math.max(most, data[k] - data[k + 1]);
      return most > 70;
    }, place);
  };
  await tell({ coarse: true });
  await settled(page);
  assert.equal(await red(9, 14), false);
  assert.equal(await rows.count(), 0);
  await tell({ coarse: false });
  await page.locator('sillon-layers-panel').getByText('Layer 2 lies beside the plate.').waitFor();
  assert.equal(await rows.count(), 1);
  assert.equal(await rows.getAttribute('data-layer'), '2');
  await settled(page);
  assert.ok(await red(9, 14), 'the frame of a layer that is not chosen');
  await page.locator('li[data-layer="2"] .row').click();
  await settled(page);
  assert.ok(await red(9, 14), 'the frame of the chosen layer');
  // It is about the layer as it was.
  await page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    const { result } = studio.store.state;
    studio.change((plate) => ({
      ...plate,
      layers: plate.layers.map((one, k) => (k === 1 ? { ...one, angle: 5 } : one)),
    }));
    studio.store.set({ result });
  });
  assert.equal(await rows.count(), 0);
});

test('a font that is dropped on a plate that has but its ground makes a text', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until(({ plate }) => plate.width === 24);
  await visit.drop([fileOf('lobster.ttf', Buffer.from([0, 1, 0, 0, 0, 0]))]);
  await visit.until(({ plate, panel }) => panel === 'layers' && plate.layers[1]?.font.name === 'lobster.ttf');
  assert.equal(await visit.state(({ notices }) => notices.length), 0);
});

test('a web font that is dropped makes letters, and a packed drawing is opened', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.until(({ plate }) => plate.width === 24);
  await visit.drop([fileAt(join(inputs, '../../tests/fuzz/seeds/font/kerned.woff2'))]);
  await visit.until(({ plate }) => plate.layers[1]?.font.name === 'kerned.woff2');
  await visit.page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    // Without the size that a new layer gets once its place is known: letters have their own then.
    const write = (one, k) => (k === 1 ? { ...one, text: 'AV', textSize: 6, size: [0, 0] } : one);
    studio.change((plate) => ({ ...plate, layers: plate.layers.map(write) }));
  });
  const drawn = await visit.page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    const boxes = await studio.services.layerBoxes(studio.store.state.plate);
    return [...boxes.values()].map(({ size, reason }) => ({ size, reason: reason ?? '' }));
  });
  const letters = drawn.find(({ size }) => size[1] > 5.9 && size[1] < 6.2);
  assert.ok(letters !== undefined && letters.size[0] > 6 && letters.size[0] < 12, JSON.stringify(drawn));
  assert.equal(await visit.state(({ notices }) => notices.length), 0);
  await visit.drop([fileAt(join(inputs, '../../tests/data/field/packed.svgz'))]);
  await visit.until(
    ({ plate }) =>
      plate.layers.some(({ file }) => file?.name === 'packed.svg') || plate.shape.file?.name === 'packed.svg',
  );
});

test('new layers and copies lie beside those that are there, inside the shape', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  for (const kind of ['Text', 'Text']) await add(visit, kind);
  await page.getByRole('button', { name: /^Duplicate/ }).click();
  await visit.until(({ plate, layer }) => plate.layers.length === 4 && layer === 4);
  const found = await layers(visit);
  assert.equal(found[0].at, null); // the first lies in the middle
  const boxes = found.map(({ kind, at, text, textSize, size }) => ({
    at: at ?? [12, 12],
    size: kind === 'text' ? [text.length * textSize, textSize] : [size[0], size[0]],
  }));
  boxes.forEach((one, k) => {
    const far = Math.hypot(...[0, 1].map((side) => Math.abs(one.at[side] - 12) + one.size[side] / 2));
    assert.ok(far <= 12.1, JSON.stringify(one));
    for (const other of boxes.slice(k + 1)) {
      const apart = Math.max(
        ...[0, 1].map((side) => Math.abs(one.at[side] - other.at[side]) - (one.size[side] + other.size[side]) / 2),
      );
      assert.ok(apart > 0, JSON.stringify([one, other]));
    }
  });
  assert.deepEqual(visit.problems, []);
});

test('a picture is cropped where it lies, and what is cut off is seen', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  const [chooser] = await Promise.all([
    page.waitForEvent('filechooser'),
    choose(page.locator('sillon-layers-panel'), 'Picture'),
  ]);
  await chooser.setFiles(join(inputs, 'moon.png'));
  await visit.until(({ plate }) => plate.layers[1]?.pictures[0]?.file.name === 'moon.png');
  await page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.change((plate) => ({ ...plate, layers: [plate.layers[0], { ...plate.layers[1], size: [16, 16] }] }));
  });
  await settled(page);
  assert.equal(await cover(visit, 17, 12), 0);
  await page.locator('sillon-layers-panel').getByRole('button', { name: 'Crop', exact: true }).click();
  await until(async () => (await cover(visit, 17, 12)) > 0.9, 'the picture over the plate');
  await drag(visit, [20, 12], [12, 12]);
  const [cropped] = await layers(visit);
  near([...cropped.size, ...cropped.at], [8, 16, 8, 12]);
  near([...cropped.cropMin, ...cropped.cropMax], [0, 0, 0.5, 1], 0.01);
  assert.ok((await cover(visit, 17, 12)) > 0.9, 'what is cut off is not seen');
  await drag(visit, [8, 12], [4, 12]); // the picture under its box
  near((await layers(visit))[0].cropMin, [0.25, 0], 0.01);
  await page.keyboard.press('Escape');
  await visit.until((state) => !state.cropping && state.layer === 2);
  await settled(page);
  assert.equal(await cover(visit, 17, 12), 0);
  await page.locator('sillon-layers-panel').getByRole('button', { name: 'Whole picture' }).click();
  near((await layers(visit))[0].cropMax, [1, 1], 0);
});

test('the list is worked by keys alone: order, copies, sight', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  for (const kind of ['Border', 'Pattern', 'Direction']) await add(visit, kind);
  const panel = page.locator('sillon-layers-panel');
  const names = () => panel.locator('li[data-layer] .name').allInnerTexts();
  assert.deepEqual(await names(), ['One direction', 'Rays', 'Border', 'Waves']);
  const row = (name) => panel.getByRole('button', { name, exact: true });
  await row('One direction').focus();
  await page.keyboard.press('ArrowDown');
  assert.equal(await row('Rays').evaluate((one) => one.matches(':focus')), true);
  await page.keyboard.press('Alt+ArrowDown');
  await until(async () => (await names()).join() === 'One direction,Border,Rays,Waves', 'the other order');
  await until(() => row('Rays').evaluate((one) => one.matches(':focus')), 'the focus to stay');
  await page.keyboard.press('Enter');
  await visit.until((state) => state.layer === 3);
  await row('Move Rays up').press('Enter');
  await until(async () => (await names()).join() === 'One direction,Rays,Border,Waves', 'the first order');
  await row('Duplicate Rays').press('Enter');
  await visit.until((state) => state.plate.layers.length === 5 && state.layer === 5);
  await row('Hide Border').press('Enter');
  await visit.until(({ plate }) => plate.layers[1].visible === false);
  await row('Show Border').waitFor();
  await panel.locator('li.chosen .row').focus();
  await page.keyboard.press('Delete');
  await visit.until(({ plate }) => plate.layers.length === 4);
  await until(() => panel.locator('li.chosen .row').evaluate((one) => one.matches(':focus')), 'the focus');
});

/** The middle of a part of a row, on the screen. */
const partOf = async (visit, name, part) => {
  const row = visit.page.locator('sillon-layers-panel li', {
    has: visit.page.getByRole('button', { name, exact: true }),
  });
  const { x, y, width, height } = await row.locator(part).boundingBox();
  return [x + width / 2, y + height / 2];
};

const namesIn = (visit) => visit.page.locator('sillon-layers-panel li[data-layer] .name').allInnerTexts();

test('rows are dragged to other places, each time as one step of undo', { skip }, async () => {
  const visit = await open();
  const { page } = visit;
  for (const kind of ['Border', 'Pattern', 'Direction']) await add(visit, kind);
  await page.evaluate(() => document.querySelector('sillon-app').studio.store.set({ layer: undefined }));
  await settled(page);
  const before = await undos(visit);
  const [border, pattern, direction, ground] = ['Border', 'Rays', 'One direction', 'Waves'];
  const pull = async (from, to) => {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(...to, { steps: 8 });
  };
  const [x, top] = await partOf(visit, direction, '.row');
  await pull(await partOf(visit, border, '.grip'), [x, top - 4]);
  await settled(page);
  assert.deepEqual(await namesIn(visit), [border, direction, pattern, ground]); // already while it is held
  assert.equal(await page.locator('li.held .name').innerText(), border);
  await page.mouse.up();
  await settled(page);
  assert.equal(await page.locator('li.held').count(), 0);
  assert.equal(await undos(visit), before + 1);

  // A mouse may take the row itself, which then is not clicked.
  await pull(
    await partOf(visit, border, '.row'),
    (await partOf(visit, direction, '.row')).map((at) => at + 4),
  );
  await page.mouse.up();
  await settled(page);
  assert.deepEqual(await namesIn(visit), [direction, border, pattern, ground]);
  assert.equal(await visit.state(({ layer }) => layer), undefined);
  assert.equal(await undos(visit), before + 2);

  // There and back again is nothing to undo, and no click; a click still chooses.
  const place = await partOf(visit, pattern, '.row');
  await pull(place, [x, top - 4]);
  await page.mouse.move(...place, { steps: 8 });
  await page.mouse.up();
  await settled(page);
  assert.deepEqual(await namesIn(visit), [direction, border, pattern, ground]);
  assert.equal(await undos(visit), before + 2);
  assert.equal(await visit.state(({ layer }) => layer), undefined);
  // Escape means the drag: the row goes back where it was.
  await pull(place, [x, top - 4]);
  await page.keyboard.press('Escape');
  assert.deepEqual(await namesIn(visit), [direction, border, pattern, ground]);
  await page.mouse.move(x, top + 4);
  await page.mouse.up();
  await settled(page);
  assert.deepEqual(await namesIn(visit), [direction, border, pattern, ground]);
  assert.equal(await undos(visit), before + 2);
  assert.equal(await visit.state(({ layer }) => layer), undefined);
  await page.mouse.click(...(await partOf(visit, pattern, '.row')));
  await visit.until((state) => state.layer === 3);
  await page.keyboard.press('Control+z');
  assert.deepEqual(await namesIn(visit), [border, direction, pattern, ground]);
});

test('a finger drags rows by their handles, and elsewhere it scrolls the panel', { skip }, async () => {
  const visit = await open({ viewport: { width: 390, height: 640 }, hasTouch: true, isMobile: true, fresh: true });
  const { page } = visit;
  for (const kind of ['Border', 'Pattern', 'Direction', 'Text']) await add(visit, kind);
  const panel = page.locator('aside');
  const scrolled = () => panel.evaluate((one) => one.scrollTop);
  await panel.evaluate((one) => (one.scrollTop = 0));
  await settled(page);
  const client = await page.context().newCDPSession(page);
  const swipe = async (from, to) => {
    const touch = (type, ...touchPoints) => client.send('Input.dispatchTouchEvent', { type, touchPoints });
    await touch('touchStart', { x: from[0], y: from[1] });
    for (let k = 1; k <= 8; ++k) {
      const [x, y] = [0, 1].map((axis) => from[axis] + (k / 8) * (to[axis] - from[axis]));
      await touch('touchMove', { x, y });
    }
    await touch('touchEnd');
    await settled(page);
  };
  const names = ['Abc', 'One direction', 'Rays', 'Border', 'Waves'];
  assert.deepEqual(await namesIn(visit), names);
  const before = await undos(visit);
  const [x, y] = await partOf(visit, 'One direction', '.grip');
  await swipe([x, y], [x, (await partOf(visit, 'Rays', '.grip'))[1] + 4]);
  assert.deepEqual(await namesIn(visit), ['Abc', 'Rays', 'One direction', 'Border', 'Waves']);
  assert.equal(await scrolled(), 0);
  assert.equal(await undos(visit), before + 1);
  const row = await partOf(visit, 'One direction', '.row');
  await swipe(row, [row[0], row[1] - 80]);
  await until(async () => (await scrolled()) > 20, 'the panel to scroll');
  assert.deepEqual(await namesIn(visit), ['Abc', 'Rays', 'One direction', 'Border', 'Waves']);
  assert.equal(await undos(visit), before + 1);
});

const narrow = [
  { viewport: { width: 390, height: 844 }, language: 'fr' },
  { viewport: { width: 320, height: 640 }, language: 'de' },
];
for (const { viewport, language } of narrow) {
  test(`${viewport.width} pixels are enough, and axe finds nothing`, { skip }, async () => {
    const visit = await open({ viewport, language, hasTouch: true });
    const { page } = visit;
    const look = async (what) => {
      await page.evaluate(() => {
        const { store } = document.querySelector('sillon-app').studio;
        store.set({ notices: [], problem: undefined });
      });
      await settled(page);
      assert.deepEqual(await page.evaluate(overlaps), [], what);
      assert.deepEqual(await violations(page), [], what);
      const cut = await page
        .locator('sillon-layers-panel')
        .evaluate((panel) =>
          [...panel.shadowRoot.querySelectorAll('button, label, .segments, .measure')]
            .filter((one) => one.checkVisibility() && !one.closest('.row') && one.scrollWidth > one.clientWidth + 1)
            .map((one) => one.textContent.trim()),
        );
      assert.deepEqual(cut, [], what);
    };
    await look('the ground alone');
    for (const kind of ['text', 'code', 'pattern', 'border', 'picture', 'tones', 'strokes']) {
      await page.evaluate((kind) => {
        const { studio } = document.querySelector('sillon-app');
        studio.change((plate) => ({
          ...plate,
          layers: [
            plate.layers[0],
            {
              ...{ id: 2, kind, visible: true, at: null, size: [0, 0], rotation: 0, mirror: false, mask: 'inside' },
              ...{ maskFile: null, soft: 0, angle: 0, ground: 12, fill: 'angle', file: null, encoding: 'angle' },
              ...{ cropMin: [0, 0], cropMax: [1, 1], pictures: [], text: 'Hallo', font: 'Nunito', textSize: 4 },
              ...{ circle: 0, align: 'middle', correction: 'medium', pattern: 'noise', waveLength: 5, amplitude: 20 },
              ...{ mode: 'constrained', modeFile: null, seed: 7, colours: [], strokes: [], width: 2 },
              ...{ by: 'levels', from: 0, to: 90, threshold: 0.5, contrast: 1, smoothing: 0 },
            },
          ],
        }));
        studio.settle();
        studio.store.set({ layer: 2 });
      }, kind);
      const folded = page.locator('sillon-layers-panel details:not([open]) summary');
      if ((await folded.count()) > 0) await folded.click();
      await look(kind);
    }
    await page.evaluate(() => document.querySelector('sillon-app').studio.store.set({ layer: 1 }));
    await page.locator('sillon-layers-panel .cards').first().waitFor();
    await look('the ground below another');
  });
}

test('a finger has larger handles, and a chosen layer stays in hand when the panel is put away', { skip }, async () => {
  const visit = await open({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, fresh: true });
  const { page } = visit;
  await add(visit, 'Direction');
  await page.evaluate(() => document.querySelector('sillon-app').studio.setPanel(''));
  await settled(page);
  assert.ok((await cover(visit, 18, 18)) > 0.9, 'no handle');
  const client = await page.context().newCDPSession(page);
  const touch = async (type, place) => {
    const [x, y] = place === undefined ? [] : await screen(visit, ...place);
    await client.send('Input.dispatchTouchEvent', { type, touchPoints: place === undefined ? [] : [{ x, y }] });
  };
  await touch('touchStart', [17.4, 18.5]); // beside the corner
  await touch('touchMove', [14.4, 15.5]);
  await touch('touchMove', [13.4, 14.5]);
  await touch('touchEnd');
  await settled(page);
  near((await layers(visit))[0].size, [8, 8], 0.3);
});
