import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Toolpath } from 'sillon';
import { delaysOf } from '../../src/views/delays.js';

const [spacing, length, strands, speed] = [0.4, 20, 6, 10];

/** Strands along x, laid in the given order of their rows, each the other way round than the one before. */
function laid(rows: number[]): Toolpath {
  const places = rows.flatMap((row, k) => {
    const ends = k % 2 === 0 ? [0, length] : [length, 0];
    return ends.flatMap((x) => [x, row * spacing]);
  });
  const points = Float32Array.from(places);
  const widths = new Float32Array(points.length / 2).fill(spacing);
  return { spacing, cycles: [{ points, widths }], shape: { page: [length, strands * spacing], paths: [] }, notes: [] };
}

/** The delay in the middle of a row. */
function inTheMiddle(rows: number[], row: number): number {
  const { toolpath, delays } = delaysOf(laid(rows), speed);
  const { points, widths } = toolpath.cycles[0] ?? assert.fail();
  const at = [...widths.keys()].find(
    (k) =>
      Math.abs((points[2 * k] ?? 0) - length / 2) < 1e-3 && Math.abs((points[2 * k + 1] ?? 0) - row * spacing) < 1e-3,
  );
  return delays[0]?.[at ?? -1] ?? assert.fail('no point in the middle');
}

test('beads of a zigzag wait for one strand', () => {
  const strand = (length + spacing) / speed;
  assert.ok(Math.abs(inTheMiddle([0, 1, 2, 3, 4, 5], 2) - strand) < 0.05);
});

test('a bead between others that were laid long before waits for the longer side', () => {
  // Rows 0, 2 and 4 first, and 1, 3 and 5 on the way back: row 1 comes five strands after row 0.
  const waits = inTheMiddle([0, 2, 4, 5, 3, 1], 1);
  assert.ok(Math.abs(waits - (5 * length + 8 * spacing) / speed) < 0.1, `${waits}`);
});
