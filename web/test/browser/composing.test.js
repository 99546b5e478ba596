// The templates of the examples: each is opened, made one's own, and downloaded; their panels are for everybody.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { violations } from './support/axe.js';
import { composingTasks, walkToComposed } from './support/compose-walk.js';
import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { settled } from './support/waits.js';

const bench = sharedBench(skip, start);
const side = 240; // [pixels] of pictures of plates

/** The plate as it is drawn: grey values of its pixels, -1 beside it. */
const drawn = (visit) =>
  visit.page.evaluate(async (side) => {
    const { studio } = document.querySelector('sillon-app');
    const bitmap = await createImageBitmap(await studio.stage.capture(side));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    return Array.from({ length: data.length / 4 }, (_, k) =>
      data[4 * k + 3] < 128 ? -1 : Math.round((data[4 * k] + data[4 * k + 1] + data[4 * k + 2]) / 3),
    );
  }, side);

/** A bead is never as dark or as bright as all others where directions differ. */
function assertNotBlank(greys, what) {
  const plate = greys.filter((grey) => grey >= 0);
  const mean = plate.reduce((sum, grey) => sum + grey, 0) / plate.length;
  const spread = Math.sqrt(plate.reduce((sum, grey) => sum + (grey - mean) ** 2, 0) / plate.length);
  assert.ok(
    plate.length > greys.length / 2 && spread > 8,
    `${what}: ${plate.length} of ${greys.length}, spread ${spread}`,
  );
}

/** Complaints of the page and the engine about the plate; its printer is as for every other plate. */
const said = (visit) =>
  visit.state(({ problem, notices, result, summary, layer, panel }) => ({
    problem: problem ?? null,
    problems: notices.filter((notice) => notice.problem !== undefined).map(({ text }) => text),
    warnings: [...result.report.warnings, ...summary.warnings]
      .map(({ code }) => code)
      .filter((code) => code !== 'NoPressureAdvance'),
    layer: layer ?? null,
    panel,
  }));
const nothing = { problem: null, problems: [], warnings: [], layer: null, panel: 'layers' };

for (const task of composingTasks) {
  test(`${task}: a template without a warning becomes one's own, and a file`, { skip }, async () => {
    const visit = await bench.open({ small: true, viewport: { width: 1280, height: 800 } });
    let before;
    const { download, wanted } = await walkToComposed(visit, task, async () => {
      await visit.idle();
      assert.deepEqual(await said(visit), nothing);
      assert.equal(await visit.page.locator('sillon-layers-panel .warning').count(), 0);
      before = await drawn(visit);
      assertNotBlank(before, 'the template');
    });
    const text = readFileSync(await download.path(), 'latin1');
    assert.match(download.suggestedFilename(), /\.gcode$/);
    assert.ok(text.split('\n').filter((line) => /^G1 .*E/.test(line)).length > 1000, 'no print');
    const told = await visit.state(({ plate }) =>
      plate.layers
        .flatMap(({ text, file, pictures }) => [text, file?.name, ...pictures.map((one) => one.file.name)])
        .filter((one) => one),
    );
    for (const one of wanted) assert.ok(told.includes(one), `${one} is not in ${told}`);
    assert.ok(!told.includes('strokes.svg'), 'an echo of the drawing that is gone');
    const after = await drawn(visit);
    assertNotBlank(after, 'the visitor’s own');
    const other = after.filter((grey, k) => Math.abs(grey - before[k]) > 12).length;
    assert.ok(after.length === before.length && other > after.length / 100, `${other} pixels differ`);
    assert.deepEqual(visit.problems, []);
  });
}

test(
  'a photograph and a logo take the place of others without being stretched, turned or too large',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    const { page } = visit;
    const panel = page.locator('sillon-layers-panel');
    const undos = () => page.evaluate(() => document.querySelector('sillon-app').studio.store.steps.past.length);
    /** Opens the template and puts a file into one of its layers; nobody waits for the plates. */
    const replace = async (template, row, file) => {
      await visit.button('Examples').click();
      await page.locator('sillon-gallery').getByRole('button', { name: template }).click();
      await panel.getByRole('button', { name: row, exact: true }).first().click();
      // Layers of another template have the same numbers: the box must be that of this one.
      await visit.until(({ layer, layerBoxes, plate }) =>
        plate.layers.some((one) => one.id === layer && one === layerBoxes.get(layer)?.layer),
      );
      const [chooser] = await Promise.all([
        page.waitForEvent('filechooser'),
        panel.getByRole('button', { name: /^Replace/ }).click(),
      ]);
      const steps = await undos();
      const size = await visit.state(({ layer, layerBoxes }) => layerBoxes.get(layer).size);
      await chooser.setFiles(file);
      const named = ({ plate }) =>
        plate.layers.map((one) => ({ ...one, file: (one.file ?? one.pictures[0]?.file)?.name, pictures: [] }));
      await visit.until(`(state) => (${named})(state).some(({ file }) => file === '${file.name}')`);
      assert.equal(await undos(), steps + 1);
      const layers = await visit.state(named);
      return { layers, size };
    };
    const wide = Buffer.from(
      await page.evaluate(async () => {
        const canvas = new OffscreenCanvas(60, 30);
        const context = canvas.getContext('2d');
        context.fillRect(0, 0, 60, 30);
        return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer()).toBase64();
      }),
      'base64',
    );
    const { layers: ring } = await replace('Picture in a ring', 'moon.png', {
      name: 'me.png',
      mimeType: 'image/png',
      buffer: wide,
    });
    const { size, cropMin, cropMax } = ring.find(({ kind }) => kind === 'picture');
    assert.deepEqual(
      [size, cropMin, cropMax],
      [
        [70, 70],
        [0.25, 0],
        [0.75, 1],
      ],
    );

    const svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 40"><path d="M0 0h30v40H0z"/></svg>';
    const logo = { name: 'logo.svg', mimeType: 'image/svg+xml', buffer: Buffer.from(svg) };
    const { layers, size: before } = await replace('Logo coaster', 'strokes.svg', logo);
    for (const { file, size, rotation } of layers) {
      assert.deepEqual([file, size[1], rotation], ['logo.svg', 0, 0]);
      assert.ok(Math.abs((size[0] * 5) / 3 - Math.hypot(...before)) < 0.1, `${size}, ${before}`); // as far from corner to corner
    }
  },
);

/** Controls of a panel that are wider than the page, or too small for a finger. */
const unfit = (visit, name) =>
  visit.page.locator(name).evaluate((panel) => {
    const all = (root) =>
      [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
    return all(panel.shadowRoot)
      .filter((one) => one.matches('button, select, input, textarea, summary, a[href], .grip') && one.checkVisibility())
      .map((one) => [one, (one.closest('label') ?? one).getBoundingClientRect()])
      .filter(([, { left, right, width, height }]) => {
        const outside = left < -1 || right > globalThis.innerWidth + 1;
        return width > 0 && (outside || Math.min(width, height) < 24);
      })
      .map(
        ([one, { left, right, width, height }]) =>
          `${one.outerHTML.slice(0, 90)} ${left}..${right}, ${width} × ${height}`,
      );
  });

for (const width of [1280, 390]) {
  test(`the panels of layers and of the shape at ${width} pixels, for everybody`, { skip }, async () => {
    const phone = width < 720 ? { hasTouch: true, isMobile: true } : {};
    const visit = await bench.open({ small: true, viewport: { width, height: 844 }, ...phone });
    const { page } = visit;
    await visit.button('Examples').click();
    await page.locator('sillon-gallery').getByRole('button', { name: 'Key ring tag' }).click();
    await visit.until(({ plate }) => plate.layers.length === 3);
    const look = async (what, panel) => {
      await page.evaluate(() => document.querySelector('sillon-app').studio.store.set({ notices: [] }));
      await settled(page);
      assert.deepEqual(await violations(page), [], what);
      if (width < 720) assert.deepEqual(await unfit(visit, panel), [], what);
    };
    if (width < 720) await visit.section('Picture');
    await page.locator('sillon-layers-panel li').first().waitFor();
    await look('the list', 'sillon-layers-panel');
    for (const row of ['LÉON', 'Border', 'One direction']) {
      await page.locator('sillon-layers-panel').getByRole('button', { name: row, exact: true }).click();
      const folded = page.locator('sillon-layers-panel details:not([open]) summary');
      if ((await folded.count()) > 0) await folded.click();
      await look(row, 'sillon-layers-panel');
    }
    await visit.section('Shape');
    await page.locator('sillon-shape-panel section').first().waitFor();
    await look('the shape', 'sillon-shape-panel');
  });
}
