// Nothing lies over anything that is to be pressed: in all sizes from a phone's to a desk's, in the page and in frames, with
// the words that come and go and without.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { fileAt, inputs, skip, start } from './support/studio.js';
import { settled, until } from './support/waits.js';
import { inWindows, pages } from './support/windows.js';

const bench = sharedBench(skip, start);

for (const page of pages) {
  test(`nothing lies over a button: ${page.path}`, { skip }, async () => {
    const sizes = [
      [320, 480],
      [480, 360],
      [721, 560],
      [1400, 900],
    ];
    assert.deepEqual(await inWindows(bench, page, sizes), []);
  });
}

test(
  'on the narrowest phones what is changed of the light keeps inside of the page in every language',
  { skip },
  async () => {
    const viewport = { width: 360, height: 740 };
    const visit = await bench.open({ small: true, viewport, hasTouch: true, isMobile: true });
    for (const language of ['en', 'fr', 'de']) {
      await visit.page.evaluate((name) => document.querySelector('sillon-app').studio.setLanguage(name), language);
      await settled(visit.page);
      const options = await visit.options();
      const { x, width } = await options.boundingBox();
      const slider = await options.locator('input[type=range]').boundingBox();
      assert.ok(x >= 0 && x + width <= 360 && slider.x + slider.width <= x + width, `${language}: ${x + width}`);
      await visit.page.keyboard.press('Escape');
    }
  },
);

const smallPhone = { viewport: { width: 320, height: 640 }, hasTouch: true, isMobile: true };

test('on the narrowest phones figures are whole in every language', { skip }, async () => {
  const visit = await bench.open({ small: true, ...smallPhone });
  await visit.idle();
  for (const language of ['en', 'fr', 'de']) {
    await visit.page.evaluate((name) => document.querySelector('sillon-app').studio.setLanguage(name), language);
    await settled(visit.page);
    const figures = visit.page.locator('sillon-status .figures');
    const whole = ({ scrollWidth, clientWidth, scrollHeight, clientHeight }) =>
      scrollWidth <= clientWidth && scrollHeight <= clientHeight;
    assert.ok(await figures.evaluate(whole), `${language}: ${await figures.innerText()}`);
  }
});

/** Runs in the page. The boxes of what tells how far the work is, by the parts of the status line; undefined: it tells nothing. */
function boxesOfWork() {
  const inside = (root, name) => root.querySelector(name).shadowRoot;
  const line = inside(inside(inside(document, 'sillon-app'), 'sillon-stage'), 'sillon-status');
  if (line.querySelector('.job') === null) return undefined;
  return ['.stage', '.share', '.bar', '.job button'].map((part) => {
    const { left, top, width, height } = line.querySelector(part).getClientRects()[0] ?? {};
    const whole = left >= 0 && top >= 0 && left + width <= innerWidth && top + height <= innerHeight;
    return { part, seen: whole && width > 0 && height > 0 };
  });
}

const windows = [
  [360, 740],
  [1024, 768],
  [1200, 800],
  [1440, 900],
  [1920, 1080],
];

test('stage, bar and Cancel are seen in every window while a photograph is made', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.drop([fileAt(join(inputs, 'photo.png'))]);
  await visit.until('({ plate }) => plate.layers[0].kind === "picture"');
  for (const [width, height] of windows) {
    await visit.page.setViewportSize({ width, height });
    await visit.page.evaluate((width) => {
      document.querySelector('sillon-app').studio.change((plate) => ({
        ...plate,
        width: 300,
        height: (300 * plate.height) / plate.width,
        // So many rounds that it is not done before the page comes to look, however slow that is.
        toolpath: { ...plate.toolpath, spacing: 0.25 + width / 1e5, relaxationRounds: 100 },
      }));
    }, width);
    const boxes = await until(() => visit.page.evaluate(boxesOfWork), 'work on the photograph');
    assert.deepEqual(
      boxes.filter(({ seen }) => !seen),
      [],
      `${width} x ${height}`,
    );
    await visit.button('Cancel').click();
    await visit.until((state) => state.cancelled && state.progress === undefined);
  }
});

/** Runs in the page. Words that are wider than what they stand in, or than the page. */
function cutWords() {
  const all = (root) =>
    [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
  return all(document)
    .filter((one) =>
      one.matches(
        'nav button, .cards label, .tiles button, .start button, .segments label, .views button, sillon-legend .kind',
      ),
    )
    .filter((one) => one.checkVisibility())
    .filter((one) => {
      const [box, text] = [one.getBoundingClientRect(), document.createRange()];
      text.selectNodeContents(one);
      const { left, right } = text.getBoundingClientRect();
      return left < box.left - 1 || right > box.right + 1;
    })
    .map((one) => one.textContent.trim());
}

/** The browser's letters, twice as large. */
const largeLetters = (page) =>
  page.evaluate(() => {
    document.documentElement.style.fontSize = '32px';
  });

for (const [what, options] of [
  ['a desk', { viewport: { width: 1280, height: 800 } }],
  ['a phone', { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }],
]) {
  test(`with letters twice as large all words are whole on ${what}`, { skip }, async () => {
    const visit = await bench.open({ small: true, ...options });
    const { page } = visit;
    await largeLetters(page);
    for (const section of ['Shape', 'Picture', 'Print']) {
      await visit.section(section);
      await page.locator('#panel').locator('.cards, .start').first().waitFor();
      await settled(page);
      assert.deepEqual(await page.evaluate(cutWords), [], section);
    }
    const { x, width } = await page.locator('.views').boundingBox();
    assert.ok(x + width <= options.viewport.width, `${x} + ${width}`);
    await page.evaluate(() => document.querySelector('sillon-app').studio.show('calibrate'));
    await page.getByRole('dialog').getByText('Spools', { exact: true }).waitFor();
    await settled(page);
    assert.deepEqual(await page.evaluate(cutWords), [], 'Calibrate');
    const tabs = await page.locator('.tabs .segments').evaluate((one) => one.scrollWidth - one.clientWidth);
    assert.equal(tabs, 0);
  });
}

for (const [width, language] of [
  [390, 'en'],
  [820, 'fr'],
]) {
  test(`the legend of places stays in the page, ${width} pixels wide, ${language}`, { skip }, async () => {
    const visit = await bench.open({ small: true, language, viewport: { width, height: 844 } });
    await visit.idle();
    await visit.page.evaluate(() => {
      const kinds = ['turn', 'narrow', 'wide', 'gap', 'lost', 'kept'];
      const marks = kinds.map((kind, k) => ({ kind, x: 4 + k, y: 12 }));
      document.querySelector('sillon-app').studio.store.set({ view: 'quality', marks });
    });
    await visit.page.locator('sillon-legend .kind').nth(5).waitFor();
    await settled(visit.page);
    for (const kind of await visit.page.locator('sillon-legend .kind').all()) {
      const box = await kind.boundingBox();
      assert.ok(box.x >= 0 && box.x + box.width <= width, await kind.innerText());
    }
  });
}

test('on a phone help begins with what fingers do', { skip }, async () => {
  const first = async (options) => {
    const visit = await bench.open({ small: true, ...options });
    await visit.page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
    return visit.page.getByRole('dialog').locator('h3').first().innerText();
  };
  assert.match(await first(smallPhone), /touch/i);
  assert.match(await first({}), /keyboard/i);
});

test('a long name has room where there is some, and is told whole', { skip }, async () => {
  const visit = await bench.open({ small: true, viewport: { width: 1280, height: 800 } });
  const name = 'Coaster for my sister in Lyon';
  const field = visit.page.getByRole('textbox', { name: 'Plate' });
  await field.fill(name);
  await field.press('Tab');
  assert.ok(await field.evaluate((one) => one.scrollWidth <= one.clientWidth));
  assert.equal(await field.getAttribute('title'), name);
});

test('on a phone all rows of the menu begin alike', { skip }, async () => {
  const visit = await bench.open({ small: true, ...smallPhone });
  await visit.page.locator('[popovertarget=menu]').click();
  await visit.page.locator('#menu .item').first().waitFor();
  const rows = await visit.page
    .locator('#menu .item:visible span')
    .evaluateAll((all) => all.map((one) => Math.round(one.getBoundingClientRect().left)));
  assert.ok(rows.length > 5 && new Set(rows).size === 1, rows.join());
});

test(
  'a size that cannot be is told until the next one, and what is taken is written as the page writes it',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.section('Shape');
    const field = visit.page.getByRole('spinbutton', { name: 'Diameter' });
    const error = visit.page.getByText('Diameter must be 1 to 1,000.');
    await field.fill('2000');
    await field.press('Tab');
    assert.equal(await field.inputValue(), '24');
    await error.waitFor();
    await field.fill('12,5');
    await field.press('Tab');
    assert.equal(await field.inputValue(), '12.5');
    assert.equal(await error.count(), 0);
    // With the field's own unit, or as a ruler says it.
    for (const [typed, taken] of [
      ['35 mm', '35'],
      ['2,3cm', '23'],
      ['+31', '31'],
    ]) {
      await field.fill(typed);
      await field.press('Tab');
      assert.equal(await field.inputValue(), taken, typed);
    }
    await field.fill('35 in');
    await visit.page.getByText('Diameter must be a number').waitFor();
  },
);

test('after a pause in typing the figures are there, though the focus stays in the field', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.section('Shape');
  const field = visit.page.getByRole('spinbutton', { name: 'Diameter' });
  await field.fill('');
  await field.pressSequentially('21');
  await visit.until(({ plate, live }) => plate.width === 21 && !live);
  await visit.idle();
  assert.equal(await field.evaluate((one) => one.matches(':focus')), true);
  assert.equal(await field.inputValue(), '21');
});

test('figures and values are whole in a narrow page in French, and so is a comma', { skip }, async () => {
  const visit = await bench.open({ small: true, viewport: { width: 768, height: 700 }, language: 'fr' });
  await visit.idle();
  const figures = visit.page.locator('sillon-status .figures');
  assert.ok(await figures.evaluate((one) => one.scrollWidth <= one.clientWidth), await figures.innerText());
  await visit.section('Impression');
  await visit.page.getByText('Réglages avancés').click();
  await visit.page.locator('details summary', { hasText: 'Trajet' }).click();
  const narrowest = visit.page.getByLabel('Cordon le plus étroit', { exact: true });
  assert.equal(await narrowest.inputValue(), '0,5');
  assert.ok(await narrowest.evaluate((one) => one.scrollWidth <= one.clientWidth && one.clientWidth > 50));

  const spacing = visit.page.locator('#toolpath-spacing');
  await spacing.fill('');
  await spacing.pressSequentially('0,5');
  assert.equal(await spacing.inputValue(), '0,5');
  await visit.until('({ plate }) => plate.toolpath.spacing === 0.5');
  await spacing.fill(' 0.75 '); // as it is written elsewhere
  await visit.until('({ plate }) => plate.toolpath.spacing === 0.75');
  await spacing.press('ArrowUp');
  await visit.until('({ plate }) => plate.toolpath.spacing > 0.75');
  // The name of a number is dragged to change it.
  const name = visit.page.locator('label.scrubs[for=toolpath-spacing]');
  await name.scrollIntoViewIfNeeded();
  const { x, y } = await name.boundingBox();
  await visit.page.mouse.move(x + 5, y + 5);
  await visit.page.mouse.down();
  await until(async () => (await visit.page.locator('label.drags').count()) > 0, 'the drag');
  await visit.page.mouse.move(x + 85, y + 5, { steps: 4 });
  await visit.page.mouse.up();
  await visit.until('({ plate, live }) => plate.toolpath.spacing > 0.77 && !live');
});

for (const width of [1440, 1280])
  test(`on a wide bench words move nothing, ${width} pixels`, { skip }, async () => {
    const visit = await bench.open({ small: true, viewport: { width, height: 900 } });
    await visit.idle();
    await visit.page.evaluate(() => {
      document.querySelector('sillon-app').studio.store.set({ notices: [] });
    });
    const bars = async () => [
      await visit.page.locator('.views').boundingBox(),
      await visit.button('View and light').boundingBox(),
    ];
    const before = await bars();
    await visit.page.evaluate(() => document.querySelector('sillon-app').studio.notify('A word of what has happened'));
    await visit.page.getByText('A word of what has happened').waitFor();
    assert.deepEqual(await bars(), before);
  });
