import assert from 'node:assert/strict';
import { test } from 'node:test';

import { stretches } from '../../src/quality/stretches.js';

void test('neighbours become one stretch, which may go on over 180 degrees', () => {
  assert.deepEqual(stretches([]), []);
  assert.deepEqual(stretches([60]), [[60, 60]]);
  assert.deepEqual(stretches([45, 60, 75, 150]), [
    [45, 75],
    [150, 150],
  ]);
  assert.deepEqual(stretches([0, 15, 60, 150, 165]), [
    [60, 60],
    [150, 195],
  ]);
  assert.deepEqual(stretches(Array.from({ length: 12 }, (_, k) => 15 * k)), [[0, 165]]);
});
