// The ways from the studio to the project's other places, and from an old version of it to the newest.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { linksOf, readAddresses } from '../../../tools/addresses.mjs';
import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { until } from './support/waits.js';

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
    for (const name of ['Sillon', 'eigen3', 'stb', 'lit ', 'musl', 'qrcode-generator'])
      assert.ok(text.includes(name), name);
  },
);

test(
  'a part that a newer version has replaced is told as such, with a button that reloads the page',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    await visit.page.route(/assets\/share-dialog-/, (route) => route.fulfill({ status: 404 }));
    await visit.button('Share').click();
    const alert = visit.page.locator('sillon-notices .problem').first();
    await alert.getByText('A part of the page could not be loaded.').waitFor();
    await visit.page.unroute(/assets\/share-dialog-/);
    await visit.page.evaluate(() => (globalThis.old = true));
    await alert.getByRole('button', { name: 'Reload' }).click();
    await until(() => visit.page.evaluate(() => globalThis.old === undefined).catch(() => false), 'the page anew');
  },
);

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
