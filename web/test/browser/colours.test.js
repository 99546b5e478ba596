// A drawing of several colours gets a direction for each; choices show the visitor's own plate; what nobody would recognise is
// told where the file is taken from.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { linkOf } from './support/small.js';
import { fileOf, skip, start } from './support/studio.js';
import { settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);

// As people have them: classes in a style sheet, a group, a stroke of its own colour, no size.
const flag = fileOf(
  'flag.svg',
  `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 40"><style>.sea { fill: navy }</style>
   <rect class="sea" width="60" height="40"/><g fill="#ffd700"><circle cx="20" cy="20" r="12"/></g>
   <path d="M40 5v30" stroke="rgb(220,20,60)" stroke-width="12"/></svg>`,
  'image/svg+xml',
);
const colours = (visit) => visit.state(({ plate }) => plate.layers[0].colours);

/** Of the directions that the view shows [degrees], at a share of the page from the left and from the top. */
const angleAt = (visit, x, y) =>
  visit.page.evaluate(
    ([x, y]) => {
      const { directions } = document.querySelector('sillon-app').studio.store.state;
      const { width, height, angle } = directions?.raster ?? { width: 0, height: 0, angle: [] };
      return (angle[Math.floor(y * height) * width + Math.floor(x * width)] / 65535) * 180 - 90;
    },
    [x, y],
  );
const near = (a, b) => Math.abs(((((a - b) % 180) + 270) % 180) - 90) < 0.1;

test('each colour of a drawing gets a direction, which can be turned, undone and kept', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.drop([flag]);
  await visit.until(({ plate }) => plate.layers[0].by === 'colours');
  assert.deepEqual(await colours(visit), [
    { colour: '#000080', angle: 60 },
    { colour: '#dc143c', angle: 105 },
    { colour: '#ffd700', angle: 150 },
  ]);
  assert.equal(await visit.state(({ plate }) => plate.shape.kind), 'file');
  await visit.page.getByText('flag.svg: Colours').waitFor();
  await visit.idle();
  await visit.directions();
  for (const [x, angle] of [
    [0.05, 60],
    [0.33, 150],
    [0.66, 105],
  ]) {
    await until(async () => near(await angleAt(visit, x, 0.5), angle), `${angle} at ${x}`);
  }

  await visit.page.getByRole('spinbutton', { name: 'Colour 2', exact: true }).fill('20');
  await visit.page.keyboard.press('Enter');
  await visit.until(({ plate, directions }) => plate.layers[0].colours[1].angle === 20 && directions !== undefined);
  await until(async () => near(await angleAt(visit, 0.66, 0.5), 20), 'the stripe to turn');
  const slider = visit.page.getByRole('slider', { name: 'Colour 3, #ffd700' });
  await slider.press('ArrowUp');
  await visit.until(({ plate }) => plate.layers[0].colours[2].angle === 151);
  await visit.page.keyboard.press('Control+z');
  await visit.until(({ plate }) => plate.layers[0].colours[2].angle === 150);

  // Through a project file, and through a link.
  const changed = await colours(visit);
  const { bytes } = await visit.download('Project with its files');
  const url = await visit.page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    return (await studio.services.link(studio.store.state.plate)).url;
  });
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.services.newPlate());
  await visit.until(({ plate }) => plate.layers[0].pattern === 'waves');
  await visit.drop([fileOf('flag.sillon.zip', bytes)]);
  await visit.until(({ plate }) => plate.layers[0].by === 'colours');
  assert.deepEqual(await colours(visit), changed);
  const guest = await bench.open({ path: `/${new URL(url).hash}` });
  await guest.until(({ plate }) => plate.layers[0].by === 'colours');
  assert.deepEqual(await colours(guest), changed);
  assert.deepEqual(visit.problems, []);
});

/** An address of a plate that a drawing fills, black one way and white another. @param changes  of its only layer */
const twoTones = (size, svg, changes) =>
  `/${linkOf(
    {
      shape: { builtin: 'rectangle', size },
      layers: [{ kind: 'tones', by: 'levels', file: '0/tones.svg', from: 90, to: 0, ...changes }],
    },
    { files: { '0/tones.svg': Buffer.from(svg).toString('base64url') } },
  )}`;
const disc =
  '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20"><path d="M0 0h40v20H0z" fill="#fff"/><circle cx="20" cy="10" r="7"/></svg>';

test('what the visitor has chosen stays: then a drawing is an outline, until it is asked for', { skip }, async () => {
  const visit = await bench.open({ path: twoTones([24, 12], disc) });
  await visit.idle();
  await visit.drop([flag]);
  await visit.until(({ plate }) => plate.shape.kind === 'file');
  assert.equal(await visit.state(({ plate }) => plate.layers[0].by), 'levels');
  await visit.page.getByRole('radio', { name: 'Colours' }).check();
  await visit.until(({ plate }) => plate.layers[0].by === 'colours');
  assert.equal((await colours(visit)).length, 3);
});

/** Mean colours of the cards' pictures, by their labels. */
const cards = (visit, panel) =>
  visit.page.locator(`${panel} .cards label`).evaluateAll((labels) =>
    labels.map((label) => {
      const image = label.querySelector('img');
      return [label.textContent.trim(), image?.complete === true && image.naturalWidth > 0 ? image.src : ''];
    }),
  );

test('kinds of directions and shapes show what they make of this very plate', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const drawn = async (panel, names) => {
    const found = await cards(visit, panel);
    return names.every((name) => found.some(([label, src]) => label === name && src !== '')) && found;
  };
  await visit.ways();
  const before = await until(() => drawn('sillon-layers-panel', ['Waves', 'Rays', 'Noise']), 'generators');
  assert.equal(Object.fromEntries(before).Brightness, ''); // there is no picture
  await visit.drop([flag]);
  await until(() => drawn('sillon-layers-panel', ['Waves', 'Brightness', 'Photo']), 'own');
  await visit.section('Shape');
  const shapes = [
    'Disc',
    'Rectangle',
    'Rounded rectangle',
    'Hexagon',
    'Heart',
    'Shield',
    'Star',
    'Ring',
    'Tag',
    'From a file',
  ];
  await until(() => drawn('sillon-shape-panel', shapes), 'shapes');
  assert.deepEqual(visit.problems, []);
});

const doubts = (visit) => visit.page.locator('#export sillon-doubts');
const inMenu = async (visit, words) => {
  await visit.page.locator('[popovertarget=export]').click();
  await doubts(visit).getByText(words).waitFor();
  await visit.page.keyboard.press('Escape');
};

test(
  'what is too fine for its beads or too alike is told where the file is taken from, with the way out',
  { skip },
  async () => {
    const squares = Array.from({ length: 50 }, (_, k) => `M${4 * (k % 10)} ${4 * Math.floor(k / 10)}h4v4h-4z`);
    const path = squares.filter((_, k) => (k + Math.floor(k / 10)) % 2 === 0).join('');
    const board = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20"><path d="M0 0h40v20H0z" fill="#fff"/><path d="${path}"/></svg>`;
    const visit = await bench.open({ path: twoTones([12, 6], board) });
    const { page } = visit;
    await visit.idle();
    await inMenu(visit, 'The plate hardly shows what it is made from');
    await visit.section('Print');
    await page.locator('sillon-print-panel').getByText('finer details').waitFor();

    await page.evaluate(() => {
      document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, width: 48, height: 24 }));
    });
    await visit.idle();
    await page.locator('[popovertarget=export]').click();
    await page.evaluate(async () => {
      const { services, store } = document.querySelector('sillon-app').studio;
      await services.directions(store.state.plate); // as they are asked for there
    });
    await settled(page);
    assert.deepEqual(await doubts(visit).locator('p').allInnerTexts(), []);
    await page.keyboard.press('Escape');

    await page.evaluate(() => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({ ...plate, layers: [{ ...plate.layers[0], from: 12 }] }));
    });
    await inMenu(visit, 'Dark and bright places hardly differ');
    await visit.view('Check');
    await page.locator('sillon-quality-panel').getByText('Dark and bright places hardly differ').waitFor();
    assert.deepEqual(visit.problems, []);
  },
);

test('letters that are too fine or too alike are told below the list and before the print', { skip }, async () => {
  const text = { kind: 'text', text: 'Hello', font: 'Nunito', textSize: 3, fill: 'angle', angle: 90 };
  const visit = await bench.open({
    path: `/${linkOf({ shape: { builtin: 'rectangle', size: [24, 12] }, layers: [{ kind: 'direction' }, text] })}`,
  });
  await visit.idle();
  const panel = visit.page.locator('sillon-layers-panel .warning');
  const change = (values) =>
    visit.page.evaluate((values) => {
      const { studio } = document.querySelector('sillon-app');
      const [ground, text] = studio.store.state.plate.layers;
      studio.change((plate) => ({ ...plate, layers: [ground, { ...text, ...values }] }));
    }, values);
  await panel.getByText('narrower than two beads and hard to read').waitFor();
  await visit.section('Print');
  const summary = visit.page.locator('sillon-print-panel');
  await summary.getByText('narrower than two beads and hard to read').waitFor();
  await visit.section('Picture');
  await change({ textSize: 6, text: 'Hi', font: 'Bebas Neue' });
  await visit.idle();
  await until(async () => (await panel.count()) === 0, 'nothing to be said of large letters');
  await change({ angle: 12 });
  await panel.getByText('within 15° of what is below and cannot be seen').waitFor();
  await change({ text: '' });
  await visit.page.getByRole('button', { name: 'Text', exact: true }).click();
  await panel.getByText('Nothing is drawn without letters.').waitFor();
  assert.deepEqual(visit.problems, []);
});
