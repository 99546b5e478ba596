// Whether a phone would read a plate's code is said where the code is made, and before the file is downloaded.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { lacking } from '../../../wasm/test/support/browsers.js';
import { sharedBench } from './support/shared.js';
import { linkOf } from './support/small.js';
import { start } from './support/studio.js';

const skip = lacking('Chromium');
const bench = sharedBench(skip, start);

/** A square plate with a code across it. @param changes  of the code's layer */
const withCode = (side, changes = {}) =>
  `/${linkOf({
    shape: { builtin: 'rectangle', size: [side, side] },
    layers: [
      { kind: 'direction', angle: 150 },
      { kind: 'code', text: 'SILLON', angle: 60, size: [0.9 * side, 0], ...changes },
    ],
  })}`;
const row = (visit, name) => visit.page.locator('sillon-layers-panel').getByRole('button', { name, exact: true });

/** @returns what is said of it, wherever one looks */
async function said(visit) {
  const note = visit.page.locator('sillon-scan-note p:visible').first();
  await note.waitFor();
  return note.innerText();
}

test(
  'a code that can be read says under which light; one that is too fine says that none will do',
  { skip },
  async () => {
    const visit = await bench.open({ path: withCode(60) });
    await row(visit, 'SILLON').click();
    assert.match(await said(visit), /reads this code with the light at \d+/);
    const read = await visit.state((state) => state.scan.azimuths);
    assert.ok(read.includes(60) || read.includes(150), `where one direction shines and the other does not: ${read}`);
    await visit.page.evaluate(() => {
      const { studio } = document.querySelector('sillon-app');
      const small = (layer) => (layer.kind === 'code' ? { ...layer, size: [12, 0] } : layer);
      studio.change((plate) => ({ ...plate, width: 13, height: 13, layers: plate.layers.map(small) }));
    });
    await visit.page.getByText('no phone reads this code').first().waitFor();
    assert.deepEqual(await visit.state((state) => state.scan.azimuths), []);
  },
);

test('a code that is put on top lies whole in a shape with round corners', { skip }, async () => {
  const shape = { builtin: 'rounded', size: [60, 60], radius: 27 };
  const visit = await bench.open({ path: `/${linkOf({ shape, layers: [{ kind: 'direction', angle: 150 }] })}` });
  await row(visit, 'QR code').click();
  await visit.until(({ plate }) => plate.layers.length === 2);
  await visit.page.keyboard.type('SILLON');
  await visit.until(({ plate }) => plate.layers[1].text === 'SILLON');
  assert.match(await said(visit), /reads this code with the light at/);
});

test('two directions that look the same show no code', { skip }, async () => {
  const visit = await bench.open({ path: withCode(60, { ground: 64 }) });
  await row(visit, 'SILLON').click();
  assert.match(await said(visit), /no phone reads this code/);
  await visit.section('Print');
  assert.match(await said(visit), /no phone reads this code/, 'Print');
  await visit.view('Check');
  assert.match(await said(visit), /no phone reads this code/, 'Check');
});

test(
  'a code of nothing is not called good, and a text that is too long is told and leaves the code',
  { skip },
  async () => {
    const visit = await bench.open({ path: withCode(60) });
    await row(visit, 'SILLON').click();
    const field = visit.page.getByRole('textbox', { name: 'Text or address' });
    await field.fill('a'.repeat(4097));
    await visit.page.getByText('Text or address has 4,097 characters and is not used; at most 4,096 fit.').waitFor();
    assert.equal(await visit.state(({ plate }) => plate.layers[1].text), 'SILLON');
    await field.press('Tab');
    assert.equal(await field.inputValue(), 'SILLON');
    await field.fill('');
    await visit.page.getByText('Nothing is drawn without letters.').waitFor();
    await visit.idle();
    assert.equal(await visit.page.getByText('reads this code').count(), 0);
  },
);

test('how a code is read is also said where the file is taken from', { skip }, async () => {
  const visit = await bench.open({ path: withCode(60) });
  await visit.page.locator('[popovertarget=export]').click();
  await visit.page.locator('#export').getByText('reads this code with the light at').waitFor();
});
