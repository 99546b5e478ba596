// What hands do without thinking, such as going back.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';

const bench = sharedBench(skip, start);
const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const desk = { viewport: { width: 1000, height: 600 } };

/** A visit behind which another page lies in the history. */
async function arrived(options) {
  const visit = await bench.open({ small: true, fresh: true, visited: true, ...options });
  await visit.until(({ plate }) => plate.width === 24);
  return visit;
}

const back = ({ page }) => page.evaluate(() => history.back());
/** Until the browser is there, from where the page goes on. */
const forward = ({ page }) =>
  page.evaluate(
    () =>
      new Promise((resolve) => {
        addEventListener('popstate', () => resolve(), { once: true });
        history.forward();
      }),
  );
/** How many entries stand for open things, once the browser has gone there. */
const entriesAre = ({ page }, count) => page.waitForFunction((n) => (history.state?.open ?? 0) === n, count);
const noDialog = (visit) => visit.page.getByRole('dialog').waitFor({ state: 'detached' });

for (const [name, options] of Object.entries({ desk, phone })) {
  test(`Back closes a sheet and stays on the page: ${name}`, { skip }, async () => {
    const visit = await arrived(options);
    const { page } = visit;
    const entries = await page.evaluate(() => history.length);
    const open = (dialog) => page.evaluate((d) => document.querySelector('sillon-app').studio.show(d), dialog);
    for (const dialog of ['help', 'gallery']) {
      await open(dialog);
      await page.getByRole('dialog').waitFor();
      await entriesAre(visit, 1);
      await page.goBack();
      await noDialog(visit);
      await visit.until((state) => state.dialog === undefined);
      await entriesAre(visit, 0);
    }
    // Closed otherwise its entry goes, too: the next Back leaves the page, as it should.
    await open('help');
    await page.getByRole('dialog').waitFor();
    await entriesAre(visit, 1);
    await page.keyboard.press('Escape');
    await noDialog(visit);
    await entriesAre(visit, 0);
    // One that takes another's place has its entry, and Forward opens nothing.
    await open('help');
    await page.getByRole('dialog').waitFor();
    await open('share');
    await page.getByRole('dialog', { name: 'Share' }).waitFor();
    await entriesAre(visit, 1);
    await back(visit);
    await noDialog(visit);
    await entriesAre(visit, 0);
    await forward(visit);
    await entriesAre(visit, 0);
    assert.equal(await page.evaluate(() => history.length), entries + 1);
    assert.equal(await page.locator('sillon-app').count(), 1);
    await page.goBack();
    assert.equal(page.url(), 'about:blank');
  });
}

test('on a phone Back closes the sheet over a section first, then the section', { skip }, async () => {
  const visit = await arrived(phone);
  const { page } = visit;
  await visit.section('Print');
  await visit.until(({ panel }) => panel === 'print');
  await entriesAre(visit, 1);
  await page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await page.getByRole('dialog').waitFor();
  await entriesAre(visit, 2);
  await page.goBack();
  await noDialog(visit);
  assert.equal(await visit.state(({ panel }) => panel), 'print');
  await page.goBack();
  await visit.until(({ panel }) => panel === '');
  await entriesAre(visit, 0);
  // From one section to the next there is one entry; the grip takes it away.
  await visit.section('Shape');
  await visit.section('Print');
  await visit.until(({ panel }) => panel === 'print');
  await entriesAre(visit, 1);
  await visit.section('Print');
  await visit.until(({ panel }) => panel === '');
  await entriesAre(visit, 0);
});

test('a link that is followed while a sheet is open closes it, and opens its plate', { skip }, async () => {
  const visit = await arrived(desk);
  const { page } = visit;
  const { hash } = new URL(
    await page.evaluate(async () => {
      const { studio } = document.querySelector('sillon-app');
      const { url } = await studio.services.link({ ...studio.store.state.plate, name: 'linked' });
      return url;
    }),
  );
  for (const follow of [(to) => (location.hash = to), (to) => location.replace(to)]) {
    await page.evaluate(() => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({ ...plate, name: 'own' }));
      studio.show('help');
    });
    await page.getByRole('dialog').waitFor();
    await entriesAre(visit, 1);
    await page.evaluate(`(${follow})(${JSON.stringify(hash)})`);
    await visit.until(({ plate, dialog }) => plate.name === 'linked' && dialog === undefined);
    await noDialog(visit);
    assert.equal(await page.evaluate(() => location.hash), '');
  }
  // And Back works on.
  await page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await page.getByRole('dialog').waitFor();
  await entriesAre(visit, 1);
  await page.goBack();
  await noDialog(visit);
  assert.equal(await visit.state(({ plate }) => plate.name), 'linked');
});

test('in a frame the history is another page’s', { skip }, async () => {
  const { page } = await bench.open({ path: '/404' });
  await page.evaluate(() => document.body.append(Object.assign(document.createElement('iframe'), { src: '/' })));
  await page.frameLocator('iframe').locator('sillon-app').waitFor({ state: 'attached' });
  const entries = await page.evaluate(() => history.length);
  const frame = page.frames()[1];
  await frame.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await frame.locator('dialog[open]').waitFor();
  await frame.evaluate(() => new Promise((resolve) => setTimeout(resolve))); // entries are made a turn later
  assert.deepEqual(await page.evaluate(() => [history.length, history.state]), [entries, null]);
});

test('a page that is loaded again under an open sheet has its Back', { skip }, async () => {
  const visit = await arrived(desk);
  const { page } = visit;
  await page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await page.getByRole('dialog').waitFor();
  await entriesAre(visit, 1);
  await page.reload();
  await visit.until(({ result }) => result !== undefined);
  await page.evaluate(() => document.querySelector('sillon-app').studio.show('help'));
  await page.getByRole('dialog').waitFor();
  await page.goBack();
  await noDialog(visit);
  assert.equal(await page.locator('sillon-app').count(), 1);
});
