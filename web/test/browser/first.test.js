// What somebody sees who has never been here: what this is, what to do, and where - on phones, too.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';

const bench = sharedBench(skip, start);
const welcome = (visit) => visit.page.getByRole('region', { name: 'Welcome' });

/** In the window, and nothing lies over its middle. */
const reached = (locator) =>
  locator.evaluate((one) => {
    const { left, top, width, height } = one.getBoundingClientRect();
    let found = document.elementFromPoint(left + width / 2, top + height / 2);
    while (found?.shadowRoot) {
      const inner = found.shadowRoot.elementFromPoint(left + width / 2, top + height / 2);
      if (inner === null || inner === found) break;
      found = inner;
    }
    return width > 0 && (found === one || one.contains(found));
  });

for (const [width, height] of [
  [320, 600],
  [1440, 900],
]) {
  test(`a first visit says what this is and what to do, ${width} pixels wide`, { skip }, async () => {
    const visit = await bench.open({ viewport: { width, height } });
    await welcome(visit).waitFor();
    assert.match(await welcome(visit).innerText(), /turns a picture into a plate.*\s+Drop a photo or a logo/);
    for (const name of ['Open…', 'Examples', 'Choose a file…', 'See examples', 'Download']) {
      assert.ok(await reached(visit.button(name)), name);
    }
    const [chooser] = await Promise.all([
      visit.page.waitForEvent('filechooser'),
      visit.button(width < 720 ? 'Open…' : 'Choose a file…').click(),
    ]);
    assert.ok(chooser.isMultiple());
  });
}

test('the welcome goes with the first change, and for good once it is dismissed', { skip }, async () => {
  const visit = await bench.open();
  await welcome(visit).waitFor();
  await visit.page.evaluate(() => {
    document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, width: 20, height: 20 }));
  });
  await welcome(visit).waitFor({ state: 'detached' });

  const other = await bench.open();
  await welcome(other).getByRole('button', { name: 'Dismiss' }).click();
  await welcome(other).waitFor({ state: 'detached' });
  await other.page.reload();
  await other.page.waitForFunction(() => {
    const state = document.querySelector('sillon-app')?.studio.store.state;
    return state?.progress !== undefined || state?.made !== undefined; // it has begun: nothing more is restored
  });
  assert.equal(await other.state((state) => state.welcome), false);
});
