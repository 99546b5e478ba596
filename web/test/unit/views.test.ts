// What the views compute before anything is drawn: places to look at, the zigzag beside the plate, colours.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import type { Toolpath } from 'sillon';
import { widthHistogram } from '../../src/controls/histogram.js';
import { panned, zoomed } from '../../src/views/camera.js';
import { conflictPixels } from '../../src/views/conflict.js';
import { freeOf, seenIn } from '../../src/views/fit.js';
import { findGaps } from '../../src/views/gaps.js';
import { findMarks } from '../../src/views/marks.js';
import { directionPalette, markColours, rampColour } from '../../src/views/palette.js';
import { zigzag } from '../../src/views/zigzag.js';

const spacing = 0.4;
const square = Float64Array.of(0, 0, 20, 0, 20, 10, 0, 10);
const shape = { page: [20, 10] as [number, number], paths: [{ fillRule: 'evenodd' as const, rings: [square] }] };

const toolpath = (points: readonly number[], widths: readonly number[]): Toolpath => ({
  spacing,
  cycles: [{ points: Float32Array.from(points), widths: Float32Array.from(widths) }],
  shape,
  notes: [],
});

/** A long loop of two lines one spacing apart: hairpins at both ends, and nowhere else. */
function loop(width: (k: number) => number): Toolpath {
  const points: number[] = [];
  for (let x = 0; x <= 20; x += 0.1) points.push(x, 0);
  for (let x = 20; x >= 0; x -= 0.1) points.push(x, spacing);
  return toolpath(
    points,
    Array.from({ length: points.length / 2 }, (_, k) => width(k)),
  );
}

/** A narrow shape of its own, so that nothing stays empty. */
const onPage = (page: [number, number], made: Toolpath): Toolpath => ({
  ...made,
  shape: {
    page,
    paths: [{ fillRule: 'evenodd', rings: [Float64Array.of(0, 0, page[0], 0, page[0], page[1], 0, page[1])] }],
  },
});

test('an empty square is one place, where it is; a filled one is none', () => {
  const rows: number[] = [];
  const lines = Math.round(10 / spacing);
  for (let row = 0; row < lines; ++row) {
    const y = (row + 0.5) * spacing;
    rows.push(...(row % 2 === 0 ? [0.2, y, 19.8, y] : [19.8, y, 0.2, y]));
  }
  const widths = new Array<number>(rows.length / 2).fill(spacing);
  // Back to the beginning along the border, which is filled already.
  assert.deepEqual(findGaps(toolpath(rows, widths), 100), []);
  const short = rows.map((value, k) =>
    k % 2 === 0 && (rows[k + 1] ?? 0) > 4 && (rows[k + 1] ?? 0) < 6 ? Math.min(value, 14) : value,
  );
  const places = findGaps(toolpath(short, widths), 100);
  assert.equal(places[0]?.kind, 'lost');
  assert.ok(Math.abs(places[0].x - 17) < 0.3 && Math.abs(places[0].y - 5) < 0.3, `${places[0].x}, ${places[0].y}`);
});

test('what was widened to a bead is marked first', () => {
  const all = toolpath([], []);
  const [first, second] = findMarks({ ...all, shape: { ...all.shape, kept: [[3, 4, 1.5, 0.3]] } });
  assert.deepEqual(first, { x: 3, y: 4, kind: 'kept' });
  assert.equal(second?.kind, 'lost'); // the shape, all empty
});

test('what is outside of the shape, and in its holes, does not count as empty', () => {
  const ring = Float64Array.of(5, 2, 15, 2, 15, 8, 5, 8);
  const all = {
    ...toolpath([], []),
    shape: { page: [20, 10] as [number, number], paths: [{ fillRule: 'nonzero' as const, rings: [ring] }] },
  };
  const [place, ...others] = findGaps(all, 100);
  assert.ok(place !== undefined && others.length === 0);
  assert.ok(Math.abs(place.x - 10) < 0.2 && Math.abs(place.y - 5) < 0.2);
  const holed = { ...all, shape: { ...all.shape, paths: [{ fillRule: 'evenodd' as const, rings: [ring, ring] }] } };
  assert.deepEqual(findGaps(holed, 100), []);
});

test('a loop of two lines has a hairpin at each end', () => {
  const marks = findMarks(
    onPage(
      [20, spacing],
      loop(() => spacing),
    ),
  );
  assert.deepEqual(
    marks.map(({ kind }) => kind),
    ['turn', 'turn'],
  );
  const ends = marks.map(({ x }) => Math.round(x)).sort((a, b) => a - b);
  assert.deepEqual(ends, [0, 20]);
});

test('a wide circle has no marks', () => {
  const count = 400;
  const points = Array.from({ length: count }, (_, k) => (2 * Math.PI * k) / count).flatMap((angle) => [
    10 + 8 * Math.cos(angle),
    10 + 8 * Math.sin(angle),
  ]);
  const kinds = findMarks(toolpath(points, new Array<number>(count).fill(spacing))).map(({ kind }) => kind);
  assert.ok(
    kinds.every((kind) => kind === 'lost'),
    kinds.join(),
  );
});

test('narrow and wide beads are marked where they are, once each', () => {
  const marks = findMarks(
    onPage(
      [20, spacing],
      loop((k) => (k > 95 && k < 105 ? 0.1 : k > 300 && k < 304 ? 0.9 : spacing)),
    ),
  );
  const of = (kind: string): [number, number][] => marks.filter((mark) => mark.kind === kind).map(({ x, y }) => [x, y]);
  assert.equal(of('narrow').length, 1);
  assert.ok(Math.abs((of('narrow')[0]?.[0] ?? NaN) - 10) < 0.6);
  assert.equal(of('wide').length, 1);
  assert.ok(Math.abs((of('wide')[0]?.[1] ?? NaN) - spacing) < 1e-6);
});

test('there are at most 200 marks, and empty or tiny paths leave their shape empty', () => {
  const zigzags: number[] = [];
  for (let row = 0; row < 500; ++row) {
    const xs = Array.from({ length: 21 }, (_, k) => (row % 2 === 0 ? k : 20 - k));
    for (const x of xs) zigzags.push(x, row * spacing);
  }
  const widths = new Array<number>(zigzags.length / 2).fill(spacing);
  assert.equal(findMarks(onPage([20, 200], toolpath(zigzags, widths))).length, 200);
  for (const path of [toolpath([], []), toolpath([1, 1, 1, 1, 1, 1], [spacing, spacing, spacing])]) {
    assert.deepEqual(
      findMarks(path).map(({ kind }) => kind),
      ['lost'],
    );
  }
});

test('the zigzag fills the shape at 45°, and keeps half a bead from its border', () => {
  const { cycles } = zigzag(shape, spacing);
  let length = 0;
  for (const { points } of cycles) {
    const [ax = NaN, ay = NaN, bx = NaN, by = NaN] = points;
    assert.ok(Math.abs(bx - ax - (by - ay)) < 1e-4, 'not at 45°');
    for (const [x, y] of [
      [ax, ay],
      [bx, by],
    ] as const) {
      assert.ok(x >= 0.1 && x <= 19.9 && y >= 0.1 && y <= 9.9, `(${x}, ${y}) is too near to the border`);
    }
    length += Math.hypot(bx - ax, by - ay) + spacing;
  }
  assert.ok(Math.abs(length * spacing - 200) < 4, `${length * spacing} mm² of 200 are filled`);
});

test('a hole stays empty under the zigzag', () => {
  const hole = Float64Array.of(8, 3, 12, 3, 12, 7, 8, 7);
  const { cycles } = zigzag({ page: [20, 10], paths: [{ fillRule: 'evenodd', rings: [square, hole] }] }, spacing);
  for (const { points } of cycles) {
    const [ax = 0, ay = 0, bx = 0, by = 0] = points;
    for (let t = 0; t <= 1; t += 0.02) {
      const [x, y] = [ax + (bx - ax) * t, ay + (by - ay) * t];
      assert.ok(!(x > 8.01 && x < 11.99 && y > 3.01 && y < 6.99), `(${x}, ${y}) is in the hole`);
    }
  }
});

test('colours of directions go round: the last is next to the first, and each differs from its opposite', () => {
  const palette = directionPalette();
  const distance = (a: number, b: number): number =>
    Math.hypot(...[0, 1, 2].map((c) => (palette[3 * a + c] ?? 0) - (palette[3 * b + c] ?? 0)));
  for (let k = 0; k < 256; ++k) {
    assert.ok(distance(k, (k + 1) % 256) < 8, `a step at ${k}`);
    assert.ok(distance(k, (k + 128) % 256) > 60, `${k} looks like its opposite`);
  }
});

test('the ramp is bounded, and lighter the larger the value', () => {
  assert.deepEqual(rampColour(-1), rampColour(0));
  assert.deepEqual(rampColour(2), rampColour(1));
  const lightness = (value: number): number => {
    const [r, g, b] = rampColour(value);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  for (let value = 0; value < 1; value += 0.05) assert.ok(lightness(value + 0.05) > lightness(value));
});

test('the histogram counts length, not points', () => {
  const { bars, low, high } = widthHistogram(loop((k) => (k < 201 ? 0.3 : 0.5)));
  const total = bars.reduce((sum, bar) => sum + bar, 0);
  const at = (width: number): number => bars[Math.floor(((width - low) / (high - low)) * bars.length)] ?? 0;
  assert.ok(Math.abs(at(0.3) / total - 0.5) < 0.03, `${at(0.3) / total}`);
  assert.ok(Math.abs(at(0.5) / total - 0.5) < 0.03);
});

test('a zoom keeps the place under the pointer, within its bounds', () => {
  const camera = { x: 10, y: 20, scale: 4 };
  const at = { x: 13, y: 15 };
  const pixelOf = (one: typeof camera): number[] => [(at.x - one.x) * one.scale, (at.y - one.y) * one.scale];
  for (const [factor, scale] of [
    [2, 8],
    [0.5, 2],
    [100, 40],
    [0.001, 1],
  ] as const) {
    const next = zoomed(camera, at, factor, 1, 40);
    assert.equal(next.scale, scale);
    for (const [k, pixel] of pixelOf(next).entries()) assert.ok(Math.abs(pixel - (pixelOf(camera)[k] ?? NaN)) < 1e-9);
  }
});

test('a drag moves the page with the hand, and not out of sight', () => {
  const camera = { x: 10, y: 20, scale: 4 };
  assert.deepEqual(panned(camera, 8, 4, [30, 40], 0.5), { x: 8, y: 21, scale: 4 });
  assert.deepEqual(panned(camera, 1e6, 1e6, [30, 40], 0.5), { x: -15, y: 60, scale: 4 });
  assert.deepEqual(panned(camera, -1e6, -1e6, [30, 40], 0.5), { x: 45, y: -20, scale: 4 });
});

test('where light is missing is amber, where there is too much teal, and what nobody sees is clear', () => {
  const pixels = conflictPixels(Int8Array.of(0, 3, 60, -60, 22));
  const alpha = (cell: number): number => pixels[4 * cell + 3] as number;
  assert.deepEqual([alpha(0), alpha(1), alpha(2), alpha(3)], [0, 0, 230, 230]);
  assert.equal(alpha(4), 115);
  assert.ok((pixels[8] as number) > 200 && (pixels[10] as number) < 60, 'amber');
  assert.ok((pixels[12] as number) < 60 && (pixels[14] as number) > 190, 'teal');
});

test('buttons take the side of a canvas on which they cost least; what covers nothing takes nothing', () => {
  const area = { left: 10, top: 10, right: 410, bottom: 310 };
  const views = { left: 100, top: 10, right: 300, bottom: 50 };
  const tools = { left: 10, top: 60, right: 50, bottom: 250 };
  const light = { left: 250, top: 240, right: 410, bottom: 310 };
  assert.deepEqual(freeOf(area, [views, tools, light]), { left: 50, top: 50, right: 410, bottom: 240 });
  // Beside it, hidden, or behind another.
  const beside = { left: 420, top: 0, right: 500, bottom: 300 };
  const hidden = { left: 200, top: 100, right: 200, bottom: 100 };
  const behind = { left: 110, top: 15, right: 200, bottom: 45 };
  assert.deepEqual(freeOf(area, [views, beside, hidden, behind]), { ...area, top: 50 });
});

test('a plate is seen in the middle of a box, whole or at a scale', () => {
  const free = { left: 100, top: 80, right: 460, bottom: 380 };
  const [wide, tall] = [60, 30];
  const element: [number, number] = [500, 480];
  /** Where a place [mm] of the plate lies on the element. */
  const at = ({ x, y, scale }: { x: number; y: number; scale: number }, px: number, py: number): [number, number] => [
    element[0] / 2 + (px - x) * scale,
    element[1] / 2 - (py - y) * scale,
  ];
  const whole = seenIn(free, [wide, tall], element);
  assert.equal(whole.scale, 6); // 360 pixels for 60 mm; 30 mm would have room for 10 per mm
  assert.deepEqual(at(whole, 0, tall), [100, 140]);
  assert.deepEqual(at(whole, wide, 0), [460, 320]);
  const small = seenIn(free, [wide, tall], element, 2);
  assert.equal(small.scale, 2);
  assert.deepEqual(at(small, wide / 2, tall / 2), [280, 230]);
});

test('places to look at have colours of their own', () => {
  const colours = Object.values(markColours);
  assert.equal(new Set(colours).size, colours.length);
});
