// A drawing of several colours gets a direction for each; choices show the visitor's own plate; what nobody would recognise is
// told where the file is taken from.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { linkOf } from './support/small.js';
import { fileOf, skip, start } from './support/studio.js';
import { until } from './support/waits.js';

const bench = sharedBench(skip, start);

// As people have them: classes in a style sheet, a group, a stroke of its own colour, no size.
const flag = fileOf(
  'flag.svg',
  `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 40"><style>.sea { fill: navy }</style>
   <rect class="sea" width="60" height="40"/><g fill="#ffd700"><circle cx="20" cy="20" r="12"/></g>
   <path d="M40 5v30" stroke="rgb(220,20,60)" stroke-width="12"/></svg>`,
  'image/svg+xml',
);
const colours = (visit) => visit.state(({ plate }) => plate.directions.colours);

/** Of the plate's directions [degrees], at a share of the page from the left and from the top. */
const angleAt = (visit, x, y) =>
  visit.page.evaluate(
    ([x, y]) => {
      const { directions } = document.querySelector('sillon-app').studio.store.state;
      const { width, height, angle } = directions;
      return (angle[Math.floor(y * height) * width + Math.floor(x * width)] / 65535) * 180 - 90;
    },
    [x, y],
  );
const near = (a, b) => Math.abs(((((a - b) % 180) + 270) % 180) - 90) < 0.1;

test('each colour of a drawing gets a direction, which can be turned, undone and kept', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.drop([flag]);
  await visit.until(({ plate }) => plate.directions.kind === 'colours');
  assert.deepEqual(await colours(visit), [
    { colour: '#000080', angle: 60 },
    { colour: '#dc143c', angle: 105 },
    { colour: '#ffd700', angle: 150 },
  ]);
  assert.equal(await visit.state(({ plate }) => plate.shape.kind), 'file');
  await visit.page.getByText('flag.svg: Colours: a direction for each').waitFor();
  await visit.idle();
  for (const [x, angle] of [
    [0.05, 60],
    [0.33, 150],
    [0.66, 105],
  ]) {
    await until(async () => near(await angleAt(visit, x, 0.5), angle), `${angle} at ${x}`);
  }

  await visit.page.getByRole('spinbutton', { name: 'Colour 2', exact: true }).fill('20');
  await visit.page.keyboard.press('Enter');
  await visit.until(({ plate, directions }) => plate.directions.colours[1].angle === 20 && directions !== undefined);
  await until(async () => near(await angleAt(visit, 0.66, 0.5), 20), 'the stripe to turn');
  const slider = visit.page.getByRole('slider', { name: 'Colour 3, #ffd700' });
  await slider.press('ArrowUp');
  await visit.until(({ plate }) => plate.directions.colours[2].angle === 151);
  await visit.page.keyboard.press('Control+z');
  await visit.until(({ plate }) => plate.directions.colours[2].angle === 150);

  // Through a project file, and through a link.
  const changed = await colours(visit);
  const { bytes } = await visit.download('Project with its files');
  const url = await visit.page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    return (await studio.services.link(studio.store.state.plate)).url;
  });
  await visit.page.evaluate(() => document.querySelector('sillon-app').studio.services.newPlate());
  await visit.until(({ plate }) => plate.directions.kind === 'waves');
  await visit.drop([fileOf('flag.sillon.zip', bytes)]);
  await visit.until(({ plate }) => plate.directions.kind === 'colours');
  assert.deepEqual(await colours(visit), changed);
  const guest = await bench.open({ path: `/${new URL(url).hash}` });
  await guest.until(({ plate }) => plate.directions.kind === 'colours');
  assert.deepEqual(await colours(guest), changed);
  assert.deepEqual(visit.problems, []);
});

test('what the visitor has chosen stays: then a drawing is an outline, until it is asked for', { skip }, async () => {
  const directions = { kind: 'text', text: 'A', font: 'serif', bold: true, size: 0.3, letters: 90, ground: 0 };
  const visit = await bench.open({ path: `/${linkOf({ directions })}` });
  await visit.idle();
  await visit.drop([flag]);
  await visit.until(({ plate }) => plate.shape.kind === 'file');
  assert.equal(await visit.state(({ plate }) => plate.directions.kind), 'text');
  await visit.page.getByRole('radio', { name: 'A direction per colour' }).check();
  await visit.until(({ plate }) => plate.directions.kind === 'colours');
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
  const before = await until(() => drawn('sillon-directions-panel', ['Waves', 'Text', 'QR code']), 'generators');
  assert.equal(Object.fromEntries(before)['Picture by brightness'], ''); // there is no picture
  await visit.drop([flag]);
  await until(
    () => drawn('sillon-directions-panel', ['Waves', 'Picture by brightness', 'Picture under a lamp']),
    'own',
  );
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

const text = { kind: 'text', text: 'Hello', font: 'sans-serif', bold: true, size: 0.3, letters: 90, ground: 0 };
const doubts = (visit) => visit.page.locator('#export sillon-doubts');

test(
  'letters that are too fine for their beads are told above the print and in the menu of downloads, with the way out',
  { skip },
  async () => {
    const shape = { kind: 'rectangle' };
    const visit = await bench.open({ path: `/${linkOf({ shape, width: 12, height: 6, directions: text })}` });
    await visit.idle();
    await visit.section('Print');
    const summary = visit.page.getByRole('region', { name: 'Print', exact: true });
    await summary.getByText('These letters can hardly be read').waitFor();
    await visit.page.locator('[popovertarget=export]').click();
    await doubts(visit).getByText('These letters can hardly be read').waitFor();
    await visit.page.evaluate(() => {
      document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, width: 40, height: 20 }));
    });
    await visit.idle();
    await until(async () => (await doubts(visit).innerText()).trim() === '', 'nothing to be said of large letters');
    await visit.page.evaluate((text) => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({ ...plate, directions: { ...text, letters: 12 } }));
    }, text);
    await doubts(visit).getByText('Dark and bright places hardly differ').waitFor();
    await visit.page.evaluate((text) => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({ ...plate, directions: { ...text, text: 'one long line '.repeat(12) } }));
    }, text);
    await doubts(visit)
      .getByText(/^The letters are 0\.\d mm high and cannot be seen: .* about 6 mm/)
      .waitFor();
    await visit.page.keyboard.press('Escape');
    await visit.section('Quality');
    await visit.page.locator('sillon-quality-panel').getByText('cannot be seen').waitFor();
    await visit.page.evaluate((text) => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({ ...plate, directions: { ...text, text: '' } }));
    }, text);
    await visit.page.locator('sillon-quality-panel').getByText('There are no letters').waitFor();
  },
);
