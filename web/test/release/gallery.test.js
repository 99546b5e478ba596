// The examples of the studio's gallery, each made in the page; one of them is opened by test/browser/first.test.js.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from '../browser/support/shared.js';
import { skip, start } from '../browser/support/studio.js';

const bench = sharedBench(skip, start);

test('every example of the gallery makes one whole plate', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  await visit.directions(); // no beads to draw in software
  await visit.button('Examples').click();
  await visit.page.locator('sillon-gallery li').first().waitFor();
  const count = await visit.page.locator('sillon-gallery li button').count();
  assert.ok(count >= 10, `${count} examples`);
  await visit.page.keyboard.press('Escape');
  for (let k = 0; k < count; ++k) {
    await visit.button('Examples').click();
    const entry = visit.page.locator('sillon-gallery li button').nth(k);
    const name = await entry.innerText();
    await entry.click();
    await visit.page.waitForFunction(
      (name) => document.querySelector('sillon-app').studio.store.state.plate.name === name,
      name,
    );
    await visit.idle();
    const { toolpaths, parts, crossings } = await visit.state((state) => state.result.report);
    assert.equal(toolpaths, parts, name);
    assert.equal(crossings, 0, name);
  }
  assert.deepEqual(visit.problems, []);
});
