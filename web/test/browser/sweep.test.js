// No control is covered or cut, from the narrowest phones to walls, in any view and any language; test/release/windows.test.js goes
// through the widths between.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { inAllViews, inDialogs } from './support/windows.js';

const bench = sharedBench(skip, start);

test('no control is covered or cut, in any view and language', { skip }, async () => {
  const widths = [320, 400, 560, 720, 740, 860, 1000, 1280, 2560];
  assert.deepEqual(await inAllViews(bench, () => widths), []);
});

test('nothing of the sheets on the way to a print is cut, in any language', { skip }, async () => {
  assert.deepEqual(await inDialogs(bench, [320, 480, 768, 1024]), []);
});
