// The checks of test/browser/sweep and layout, which look at a few windows, in all of them from a phone's to a wall's.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from '../browser/support/shared.js';
import { skip, start } from '../browser/support/studio.js';
import { inAllViews, inDialogs, inWindows, pages } from '../browser/support/windows.js';

const bench = sharedBench(skip, start);
const between = (from, to, step) =>
  Array.from({ length: Math.floor((to - from) / step) + 1 }, (_, k) => from + k * step);

test('no control is covered or cut, whatever the width', { skip }, async () => {
  // The view with the most controls in small steps, the others in large ones.
  const widthsOf = (view) =>
    (view === 'appearance' ? between(320, 1480, 20) : between(320, 1440, 80)).concat([1720, 2120, 2560]);
  assert.deepEqual(await inAllViews(bench, widthsOf), []);
});

test('nothing of calibration and first print is cut, whatever the width', { skip }, async () => {
  const widths = [320, 360, 400, 480, 560, 640, 720, 768, 860, 1024, 1440];
  assert.deepEqual(await inDialogs(bench, widths), []);
});

for (const page of pages) {
  test(`nothing lies over a button: ${page.path}`, { skip }, async () => {
    const sizes = [
      [320, 480],
      [360, 740],
      [400, 500],
      [480, 360],
      [600, 400],
      [721, 560],
      [900, 600],
      [1180, 700],
      [1400, 900],
    ];
    assert.deepEqual(await inWindows(bench, page, sizes), []);
  });
}
