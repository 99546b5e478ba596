// The light of a whole bead, for which pictures are exposed.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { appearance } from '../../src/model/appearance.js';
import { highlightOf } from '../../src/views/look.js';

const places = 20_000;

/** The mean over a bead's round top, place by place. */
function meanOf(along: number, across: number, [alongVariance, acrossVariance]: readonly [number, number]): number {
  let sum = 0;
  for (let k = 0; k < places; ++k) {
    const slope = across - appearance.profileSlope * ((2 * (k + 0.5)) / places - 1);
    sum += Math.exp(-(along ** 2) / (2 * alongVariance)) * Math.exp(-(slope ** 2) / (2 * acrossVariance));
  }
  return sum / places;
}

test('the light of a bead is the mean of its top', () => {
  for (const variances of [[0.0017, 0.095] as const, [0.06, 0.0108] as const]) {
    for (const along of [-0.2, 0, 0.05]) {
      for (const across of [-0.3, 0, 0.41]) {
        const [found, expected] = [highlightOf(along, across, variances), meanOf(along, across, variances)];
        assert.ok(Math.abs(found - expected) < 4e-3, `${along}, ${across}: ${found}, not ${expected}`);
      }
    }
  }
  assert.ok(highlightOf(0, 0.41, [0.0017, 0.095]) > 2 * highlightOf(0.1, 0.41, [0.0017, 0.095]));
});
