// Whether a phone would read a plate's code is said where the code is made, and before the file is downloaded.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { lacking } from '../../../wasm/test/support/browsers.js';
import { sharedBench } from './support/shared.js';
import { linkOf } from './support/small.js';
import { start } from './support/studio.js';

const skip = lacking('Chromium');
const bench = sharedBench(skip, start);

const code = { kind: 'qr', text: 'SILLON', dark: 60, light: 150, margin: 2 };

/** @returns what is said of it */
async function said(visit) {
  await visit.page.locator('sillon-scan-note p').first().waitFor();
  return visit.page.locator('sillon-scan-note p').first().innerText();
}

test(
  'a code that can be read says under which light; one that is too fine says that none will do',
  { skip },
  async () => {
    const visit = await bench.open({
      path: `/${linkOf({ shape: { kind: 'rectangle' }, width: 46, height: 46, directions: code })}`,
    });
    assert.match(await said(visit), /reads this code with the light at \d+/);
    const read = await visit.state((state) => state.scan.azimuths);
    assert.ok(read.includes(60) || read.includes(150), `where one direction shines and the other does not: ${read}`);
    await visit.page.evaluate(() => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({ ...plate, width: 12, height: 12 }));
    });
    await visit.page.getByText('no phone reads this code').waitFor();
    assert.deepEqual(await visit.state((state) => state.scan.azimuths), []);
  },
);

test('in a shape with round corners the code is as large as it can be and whole', { skip }, async () => {
  const shape = { kind: 'rounded', radius: 27 };
  const visit = await bench.open({ path: `/${linkOf({ shape, width: 60, height: 60, directions: code })}` });
  assert.match(await said(visit), /reads this code with the light at/);
});

test('two directions that look the same show no code', { skip }, async () => {
  const directions = { ...code, light: 64 };
  const visit = await bench.open({
    path: `/${linkOf({ shape: { kind: 'rectangle' }, width: 46, height: 46, directions })}`,
  });
  assert.match(await said(visit), /no phone reads this code/);
  for (const section of ['Print', 'Quality']) {
    await visit.section(section);
    assert.match(await said(visit), /no phone reads this code/, section);
  }
});

test(
  'a code of nothing is not called good, and a text that is too long is told and leaves the code',
  { skip },
  async () => {
    const visit = await bench.open({
      path: `/${linkOf({ shape: { kind: 'rectangle' }, width: 46, height: 46, directions: code })}`,
    });
    const field = visit.page.getByRole('textbox', { name: 'Text or address' });
    await field.fill('a'.repeat(501));
    await visit.page.getByText('Text or address has 501 characters and is not used; at most 500 fit.').waitFor();
    assert.equal(await visit.state(({ plate }) => plate.directions.text), 'SILLON');
    await field.press('Tab');
    assert.equal(await field.inputValue(), 'SILLON');
    await field.fill('');
    await visit.page.getByText('The code is empty').waitFor();
    assert.equal(await visit.page.getByText('reads this code').count(), 0);
  },
);

test('how a code is read is also said where the file is taken from', { skip }, async () => {
  const visit = await bench.open({
    path: `/${linkOf({ shape: { kind: 'rectangle' }, width: 46, height: 46, directions: code })}`,
  });
  await said(visit);
  await visit.page.locator('[popovertarget=export]').click();
  await visit.page.locator('#export').getByText('reads this code with the light at').waitFor();
});
