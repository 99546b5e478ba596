// The ways from the studio to the project's other places, and from an old version of it to the newest.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { linksOf, readAddresses } from '../../../tools/addresses.mjs';
import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);

test(
  'the menu leads to source, reports and licences where these are known, and names the version',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.page.locator('[popovertarget=menu]').click();
    const about = visit.page.locator('sillon-menu .about');
    await about.getByText(/^Version \d+\.\d+\.\d+$/).waitFor();
    const { source, report } = linksOf(readAddresses());
    for (const [name, address] of [
      ['Source', source],
      ['Report a problem', report],
    ]) {
      const links = about.getByRole('link', { name });
      assert.equal(await links.count(), address === '' ? 0 : 1, name);
      if (address !== '') assert.equal(await links.getAttribute('href'), address);
    }
    const licences = await visit.page.request.get(
      await about.getByRole('link', { name: 'Licences' }).evaluate((link) => link.href),
    );
    assert.equal(licences.status(), 200);
    const text = await licences.text();
    for (const name of ['Sillon', 'eigen3', 'stb', 'lit ', 'musl']) assert.ok(text.includes(name), name);
  },
);

test(
  'a part that a newer version has replaced is told as such, with a button that reloads the page',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    await visit.page.route(/assets\/plates-/, (route) => route.fulfill({ status: 404 }));
    await visit.menu('Share');
    const alert = visit.page.locator('sillon-notices .problem').first();
    await alert.getByText('A part of the page could not be loaded.').waitFor();
    await visit.page.evaluate(() => (globalThis.old = true));
    await alert.getByRole('button', { name: 'Reload' }).click();
    await until(() => visit.page.evaluate(() => globalThis.old === undefined).catch(() => false), 'the page anew');
    await visit.page.unroute(/assets\/plates-/);
  },
);

test('a section that cannot be fetched is asked for ever more rarely, and fills once it can be', { skip }, async () => {
  // Its waits end when the test says so.
  const prepare = () => {
    const { setTimeout } = globalThis;
    globalThis.rests = [];
    globalThis.setTimeout = (run, wait, ...more) =>
      globalThis.holds && [1000, 2000, 4000].includes(wait)
        ? globalThis.rests.push({ run, wait })
        : setTimeout(run, wait, ...more);
  };
  const visit = await bench.open({ small: true, fresh: true, prepare });
  const { page } = visit;
  await visit.idle();
  const asked = [];
  await page.route(/assets\//, (route) => {
    asked.push(new URL(route.request().url()).pathname);
    return route.fulfill({ status: 404 });
  });
  await page.evaluate(() => (globalThis.holds = true));
  await visit.section('Shape');
  const alert = page.locator('sillon-notices .problem');
  await alert.getByText('A part of the page could not be loaded.').waitFor();
  const frames = () =>
    page.evaluate(async () => {
      for (let k = 0; k < 30; ++k) await new Promise((resolve) => requestAnimationFrame(resolve));
    });
  const waits = () => page.evaluate(() => globalThis.rests.map(({ wait }) => wait));
  const again = () => page.evaluate(() => globalThis.rests.at(-1).run());
  const tries = () => asked.filter((name) => name.includes('/shape-')).length;
  await frames();
  const [first] = asked;
  assert.match(first, /\/shape-/);
  assert.ok(asked.length < 5, `${asked.length} requests`); // with what the section itself imports
  for (const [k, list] of [[1000], [1000, 2000], [1000, 2000, 4000]].entries()) {
    await until(async () => (await waits()).length === list.length, `rest ${k}`);
    await frames();
    assert.deepEqual(await waits(), list);
    assert.equal(tries(), k + 1);
    if (list.length < 3) await again();
  }
  assert.equal(await alert.count(), 1);
  await page.unroute(/assets\//);
  await again();
  await page.locator('sillon-shape-panel').getByText('Heart', { exact: true }).first().waitFor();
  await until(async () => (await alert.count()) === 0, 'the notice gone');
});

test('why the engine refuses a plate is told without the words that cannot be fetched', { skip }, async () => {
  const visit = await bench.open({ fresh: true, visited: true, path: '/404' });
  const { page } = visit;
  let asked = 0;
  await page.route(/assets\/problem-/, (route) => {
    ++asked;
    return route.fulfill({ status: 404 });
  });
  await page.goto(bench.origin);
  await visit.idle();
  const before = asked; // of parts that share the file
  await page.evaluate(() => {
    const values = { reason: 'SettingOutOfRange', setting: 'toolpath.spacing', value: 90, low: 0.05, high: 20 };
    document.querySelector('sillon-app').studio.fail({ code: 'InvalidArgument', values, detail: 'spacing is 90' });
  });
  const alert = page.locator('sillon-notices .problem');
  await alert.getByText('spacing is 90').waitFor();
  for (let k = 0; k < 2; ++k) await page.evaluate((k) => document.querySelector('sillon-app').studio.notify(`${k}`), k);
  await settled(page);
  assert.equal(await alert.getByText('spacing is 90').isVisible(), true);
  assert.ok(asked >= 1 && asked - before <= 3, `${before} and ${asked} requests`);
});

test(
  'the first G-code tells once that nothing was tried on a printer yet, and offers the first print',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    const told = visit.page.locator('sillon-notices').getByText('not tried any file of Sillon on a printer');
    await visit.download('G-code');
    await told.waitFor();
    await visit.page.locator('sillon-notices').getByRole('button', { name: 'First print…' }).click();
    await visit.page.locator('sillon-first dialog').waitFor();
    await visit.page.keyboard.press('Escape');
    await visit.download('G-code');
    assert.equal(await told.count(), 0);
  },
);
