// Drawings that are little to read and endless to draw: the page answers, and nothing that stops it comes back by itself.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { linkOf, named } from './support/small.js';
import { fileOf, skip, start } from './support/studio.js';
import { keptPlate, patience, settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);

const svg = (inner) =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">${inner}</svg>`;
const levels = [...'bcdefghijkl'];
const tenfold = (one) => one.repeat(10);
/** The engine refuses it, for its points. */
const uses = svg(
  `<defs><g id="a"><path d="M0 0${'h1v1h-1v-1'.repeat(500)}"/></g>${levels
    .map((id, k) => `<g id="${id}">${tenfold(`<use href="#${'abcdefghijk'[k]}"/>`)}</g>`)
    .join('')}</defs><use href="#l"/>`,
);
/** The engine reads a square: it does not look into patterns. */
const patterns = svg(
  `<defs><pattern id="a" width=".1" height=".1"><rect width="9" height="9"/></pattern>${levels
    .map(
      (id, k) =>
        `<pattern id="${id}" width=".1" height=".1">${tenfold(`<rect width="9" height="9" fill="url(#${'abcdefghijk'[k]})"/>`)}</pattern>`,
    )
    .join('')}</defs><rect width="20" height="20" fill="url(#l)"/>`,
);
const inLink = { files: { 'x.svg': Buffer.from(uses).toString('base64url') } };

/** A page that stands still answers nothing, for ever. */
const inTime = (answer) =>
  Promise.race([
    answer,
    new Promise((_, reject) => {
      setTimeout(reject, patience, new Error('the page does not answer')).unref();
    }),
  ]);
const answers = (visit) => inTime(visit.page.evaluate(() => true));
const shows = (visit, name) => inTime(visit.until(`({ plate }) => plate.name === '${name}'`));
const rename = (visit, name) =>
  visit.page.evaluate((name) => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, name }));
  }, name);
async function keepMine(visit) {
  await visit.idle();
  await rename(visit, 'Mine');
  await until(async () => (await keptPlate(visit.page))?.name === 'Mine', 'the work in the storage');
}
const plates = (visit) =>
  visit.page.evaluate(async () => {
    const list = await document.querySelector('sillon-app').studio.services.plates().list();
    return list.map(({ name }) => name);
  });
const pictures = process.env.SILLON_PICTURES;
const draw = async (visit, name) => {
  if (pictures === undefined) return;
  await settled(visit.page);
  await visit.page.screenshot({ path: `${pictures}/${name}.png` });
};

test('a dropped drawing that the engine refuses is not drawn either', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.drop([fileOf('uses.svg', uses, 'image/svg+xml')]);
  await visit.page.locator('sillon-notices .problem').first().waitFor();
  await answers(visit);
  assert.equal(await visit.state(({ plate }) => plate.shape.kind), 'disc');
});

test('what the engine does not look into is not drawn', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.drop([fileOf('patterns.svg', patterns, 'image/svg+xml')]);
  await inTime(visit.until(({ plate }) => plate.shape.kind === 'file'));
  await visit.idle();
  await visit.section('Shape');
  await answers(visit);
});

/** With its page, which else the file would be asked for while the link is read. */
const studio = { ...named('gift').studio, page: [24, 24] };
for (const [what, change] of [
  ['shape', { shape: { file: 'x.svg', pageWidth: 24, unitless: 'px' } }],
  ['layer', { layers: [{ kind: 'tones', by: 'colours', colours: [{ colour: '#ff0000', angle: 10 }], file: 'x.svg' }] }],
]) {
  test(
    `a link whose ${what} cannot be made is told of, and is not what the next visit begins with`,
    { skip },
    async () => {
      const mine = await bench.open({ small: true, fresh: true });
      await keepMine(mine);
      await mine.page.close();
      const visit = await bench.open({ keep: mine.context, path: `/${linkOf({ studio, ...change }, inLink)}` });
      await shows(visit, 'gift');
      await visit.page.locator('sillon-notices .problem').first().waitFor();
      await rename(visit, 'gift, changed');
      await answers(visit);
      assert.deepEqual(await plates(visit), ['Mine']);
      await visit.page.close();
      const next = await bench.open({ keep: mine.context, path: '/' });
      await shows(next, 'Mine');
    },
  );
}

test('a link is kept once its plate has been made', { skip }, async () => {
  const visit = await bench.open({ path: `/${linkOf(named('gift'))}`, fresh: true });
  await until(async () => (await keptPlate(visit.page))?.name === 'gift', 'the plate in the storage');
  assert.ok(await visit.state(({ result }) => result !== undefined));
});

/** A plate of somebody's own, and the page that was opening it when the browser was killed. */
async function killed() {
  const mine = await bench.open({ small: true, fresh: true });
  await keepMine(mine);
  await mine.page.close();
  const { context } = mine;
  const stuck = await context.newPage();
  // Its path is asked for and never comes, so that nothing is shown.
  await stuck.addInitScript(() => {
    const { postMessage } = Worker.prototype;
    Worker.prototype.postMessage = function (...given) {
      const { studio } = document.querySelector('sillon-app') ?? {};
      if (studio?.store.state.plate.name !== 'Mine') postMessage.apply(this, given);
    };
  });
  await stuck.goto(bench.origin);
  await stuck.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.plate.name === 'Mine');
  const crash = new Promise((resolve) => stuck.once('crash', resolve));
  const session = await context.newCDPSession(stuck);
  session.send('Page.crash').catch(() => undefined); // nobody is left to answer
  await crash;
  await stuck.close();
  return context;
}

test('what was never shown is offered, not restored', { skip }, async () => {
  const context = await killed();
  const visit = await bench.open({ keep: context, path: '/' });
  await visit.button('Open it anyway').waitFor();
  assert.notEqual(await visit.state(({ plate }) => plate.name), 'Mine');
  await draw(visit, 'unshown');
  await visit.page.locator('sillon-notices').getByRole('button', { name: 'Your plates…', exact: true }).click();
  await visit.page.locator('sillon-plates input.name').first().waitFor();
  assert.deepEqual(await plates(visit), ['Mine']);
  await visit.page.keyboard.press('Escape');
  // Offered once more until it has been shown.
  await visit.page.reload();
  await visit.button('Open it anyway').click();
  await shows(visit, 'Mine');
  await visit.idle();
  await until(
    () => visit.page.evaluate(() => Object.keys(localStorage).every((key) => !key.includes('opening'))),
    'the mark to go',
  );
  await visit.page.reload();
  await shows(visit, 'Mine');
});

test('opened files are shown as pictures of their own, never as drawings', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.drop([fileOf('leaf.svg', svg('<rect width="20" height="9" fill="navy"/>'), 'image/svg+xml')]);
  await visit.page.locator('sillon-notices').getByRole('button', { name: 'Change' }).click();
  const image = visit.page.locator('sillon-files li img');
  await image.waitFor();
  const shown = await image.evaluate(async (one) => {
    await one.decode();
    return { type: (await (await fetch(one.src)).blob()).type, width: one.naturalWidth };
  });
  assert.deepEqual(shown, { type: 'image/png', width: 192 });
});
