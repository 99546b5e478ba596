// Frames, handles, snapping and crops, in closed form.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { newPlate } from '../../src/model/new-plate.js';
import { croppedTo, refilled, scaledLayer, slid, wholePicture } from '../../src/model/layer-changes.js';
import {
  boundsOf,
  contains,
  corners,
  cornersOf,
  frameOf,
  inFrame,
  onPage,
  placeIn,
  resized,
  rotated,
  type Frame,
  type Point,
} from '../../src/model/layer-frame.js';
import { newLayer } from '../../src/model/layer-list.js';
import type { Plate, PlateLayer } from '../../src/model/plate.js';
import { cornerSnapped, snapped } from '../../src/model/snap.js';
import { chances } from './support/pictures.js';

const page: Plate = { ...newPlate(), width: 100, height: 60 };
const layer = (kind: PlateLayer['kind'], given: Partial<PlateLayer> = {}): PlateLayer => ({
  ...newLayer(page, kind),
  id: 1,
  ...given,
});
const frame = (given: Partial<Frame> = {}): Frame => ({
  middle: [50, 30],
  size: [20, 10],
  turn: 0,
  ...given,
});
const near = (found: Point, wanted: Point, what = ''): void => {
  found.forEach((value, k) => {
    assert.ok(Math.abs(value - (wanted[k] as number)) < 1e-9, `${what}: ${found.join()} is not ${wanted.join()}`);
  });
};

test('a box turns about its middle, and places go to the page and back', () => {
  const upright = cornersOf(frame());
  near(upright[0] as Point, [40, 25]);
  near(upright[2] as Point, [60, 35]);
  const quarter = frame({ turn: 90 });
  near(cornersOf(quarter)[1] as Point, [55, 40]); // the lower right corner is right, and above
  assert.deepEqual(
    boundsOf(quarter).low.map((length) => Math.round(length * 1e6) / 1e6),
    [45, 20],
  );
  const chance = chances(3);
  for (let k = 0; k < 200; ++k) {
    const any = frame({ turn: 720 * chance() - 360, middle: [9 * chance(), -5 * chance()] });
    const place: Point = [100 * chance(), 60 * chance()];
    near(onPage(any, inFrame(any, place)), place, 'there and back');
    assert.ok(contains(any, onPage(any, placeIn(any, [0.99, -0.99]))));
    assert.ok(!contains(any, onPage(any, placeIn(any, [1.02, 0]))));
    assert.ok(contains(any, onPage(any, placeIn(any, [1.02, 0])), 1));
  }
});

test('the corner across stays when a corner is dragged, whatever the turn', () => {
  const chance = chances(11);
  for (let k = 0; k < 400; ++k) {
    const before = frame({ turn: 360 * chance(), size: [5 + 20 * chance(), 5 + 9 * chance()] });
    const corner = corners[k % 4] as Point;
    const across: Point = [-corner[0], -corner[1]];
    const free = k % 8 < 4;
    const to = onPage(before, [40 * chance() - 20, 20 * chance() - 10]);
    const { scale, middle } = resized(before, corner, to, free);
    const after: Frame = {
      ...before,
      middle,
      size: [before.size[0] * scale[0], before.size[1] * scale[1]],
    };
    near(onPage(after, placeIn(after, across)), onPage(before, placeIn(before, across)), 'the corner across');
    if (!free) assert.equal(scale[0], scale[1]);
    assert.ok(after.size[0] >= 1 - 1e-9 && after.size[1] >= 1 - 1e-9);
  }
});

test('a corner comes to lie where the hand is: freely anywhere, else on its diagonal', () => {
  const { scale, middle } = resized(frame(), [1, 1], [80, 30], true);
  near(scale, [2, 0.5]);
  near(middle, [60, 27.5]);
  near(resized(frame(), [1, 1], [80, 45], false).scale, [2, 2]);
  near(resized(frame(), [-1, -1], [20, 15], false).scale, [2, 2]);
});

test('the knob turns by the angle between where the hand was and where it is, and with Shift in steps of 15 degrees', () => {
  assert.equal(rotated(frame(), [50, 40], [40, 30], false), 90);
  assert.equal(rotated(frame({ turn: 170 }), [50, 40], [40, 30], false), -100);
  assert.equal(rotated(frame(), [50, 40], [50, 20], false), 180);
  const at = (degrees: number): Point => [
    50 + 10 * Math.cos((degrees * Math.PI) / 180),
    30 + 10 * Math.sin((degrees * Math.PI) / 180),
  ];
  for (let turn = -179; turn < 180; turn += 7) {
    assert.equal(rotated(frame(), at(0), at(turn), false), turn);
    assert.equal(Math.abs(rotated(frame(), at(0), at(turn), true) % 15), 0);
    const away = Math.abs(rotated(frame(), at(0), at(turn), true) - turn);
    assert.ok(Math.min(away, 360 - away) <= 7.5);
  }
});

test('boxes are as large as the engine has told, and grow with their letters until it has answered', () => {
  const text = layer('text', { at: [20, 10], textSize: 8 });
  const known = { layer: text, size: [40, 12] as const };
  assert.deepEqual(frameOf(page, text, known), { middle: [20, 10], size: [40, 12], turn: 0 });
  const larger = frameOf(page, { ...text, textSize: 16, at: null, rotation: 5 }, known);
  assert.deepEqual(larger, { middle: [50, 30], size: [80, 24], turn: 5 });
  const within = { layer: { ...text, size: [50, 12] } as PlateLayer, size: [40, 12] as const }; // never stretched
  assert.deepEqual(frameOf(page, { ...text, size: [100, 24] }, within).size, [80, 24]);
  assert.deepEqual(frameOf(page, { ...text, size: [100, 18] }, within).size, [60, 18]);
  const picture = layer('picture', { size: [0, 0] });
  const shown = { layer: picture, size: [30, 20] as const };
  assert.deepEqual(frameOf(page, picture, shown).size, [30, 20]);
  assert.deepEqual(frameOf(page, { ...picture, size: [60, 0] }, shown).size, [60, 40]);
  assert.deepEqual(frameOf(page, { ...picture, size: [0, 10] }, shown).size, [15, 10]);
  assert.deepEqual(frameOf(page, { ...picture, size: [7, 9] }, shown).size, [7, 9]);
  assert.deepEqual(frameOf(page, layer('direction', { size: [0, 0] }), undefined).size, [100, 60]);
  assert.deepEqual(frameOf(page, layer('code', { size: [30, 0] }), undefined).size, [30, 30]);
  const border = frameOf(page, layer('border', { at: [3, 3], size: [5, 5], rotation: 9 }), undefined);
  assert.deepEqual(border, { middle: [50, 30], size: [100, 60], turn: 0 });
});

test('a text that is scaled has other letters; what has a size has another, whose open side stays open', () => {
  const text = layer('text', { textSize: 10, circle: -20 });
  assert.deepEqual(scaledLayer(text, frame(), [1.5, 1.5]), { textSize: 15, circle: -30 });
  assert.deepEqual(scaledLayer(text, frame(), [0.01, 0.01]), { textSize: 1, circle: -0.2 }); // the least that is allowed
  const sized = { ...text, size: [40, 0], circle: 0 } as PlateLayer;
  assert.deepEqual(scaledLayer(sized, frame(), [1.5, 1.5]), { size: [60, 0] });
  assert.deepEqual(scaledLayer(layer('direction', { size: [0, 0] }), frame(), [2, 1]), { size: [40, 10] });
  assert.deepEqual(scaledLayer(layer('picture', { size: [0, 30] }), frame(), [2, 2]), { size: [0, 60] });
  assert.deepEqual(scaledLayer(layer('drawing', { size: [0, 0] }), frame(), [2, 2]), { size: [40, 20] });
});

// --- Snapping --------------------------------------------------------------------------------------------------------------

const box = (x: number, y: number, width = 20, height = 10): { low: Point; high: Point } => ({
  low: [x - width / 2, y - height / 2],
  high: [x + width / 2, y + height / 2],
});

test('what is moved snaps to the middle and the edges of the page', () => {
  const middle = snapped(box(50.4, 29.8), [100, 60], [], 1);
  near(middle.by, [-0.4, 0.2]);
  assert.deepEqual(middle.guides, [
    { axis: 0, at: 50 },
    { axis: 1, at: 30 },
  ]);
  const corner = snapped(box(10.7, 5.5), [100, 60], [], 1);
  near(corner.by, [-0.7, -0.5]);
  assert.deepEqual(corner.guides, [
    { axis: 0, at: 0 },
    { axis: 1, at: 0 },
  ]);
  const right = snapped(box(89.5, 20), [100, 60], [], 1);
  near(right.by, [0.5, 0]);
  assert.deepEqual(right.guides, [{ axis: 0, at: 100 }]);
});

test('edges snap to the page’s middle lines, but a middle to no edge', () => {
  near(snapped(box(39.8, 20), [100, 60], [], 1).by, [0.2, 0]);
  near(snapped(box(0.2, 20), [100, 60], [], 1).by, [0, 0]);
});

test('middles snap to those of others, the nearest line counts, and nothing happens far away', () => {
  near(snapped(box(70.3, 20.2), [100, 60], [[70, 44]], 1).by, [-0.3, 0]);
  near(snapped(box(49.6, 20), [100, 60], [[49.7, 44]], 1).by, [0.1, 0]);
  const far = snapped(box(70, 20), [100, 60], [[72, 22]], 1);
  assert.deepEqual(far, { by: [0, 0], guides: [] });
  // It lies on several lines at once: all of them are shown, each once.
  const all = snapped(box(50, 30, 100, 60), [100, 60], [[50, 30]], 1);
  assert.deepEqual(
    new Set(all.guides.map(({ axis, at }) => `${axis} ${at}`)),
    new Set(['0 0', '0 50', '0 100', '1 0', '1 30', '1 60']),
  );
});

test('a corner that is resized snaps to the page’s edges and middle lines, straight away from the corner across', () => {
  const free = cornerSnapped([49.3, 59.4], [100, 60], undefined, 1);
  assert.deepEqual(free.corner, [50, 60]);
  assert.deepEqual(free.guides, [
    { axis: 0, at: 50 },
    { axis: 1, at: 60 },
  ]);
  const kept = cornerSnapped([49.6, 24.8], [100, 60], [10, 5], 1); // two to one
  near(kept.corner, [50, 25]);
  assert.deepEqual(kept.guides, [{ axis: 0, at: 50 }]);
  // The nearer of two lines, and a side that is level never meets a line that is.
  near(cornerSnapped([50.6, 30.2], [100, 60], [20.6, 0.2], 1).corner, [50.4, 30]);
  near(cornerSnapped([99.5, 20], [100, 60], [10, 20], 1).corner, [100, 20]);
  assert.deepEqual(cornerSnapped([70, 20], [100, 60], [10, 5], 1), { corner: [70, 20], guides: [] });
});

// --- Files ----------------------------------------------------------------------------------------------------------------

test('a file in the place of another leaves the layer as large as it was, and nothing is stretched', () => {
  const wide = refilled(layer('picture', { size: [20, 0] }), frame({ size: [20, 20] }), 1.5);
  assert.deepEqual(wide.size, [20, 20]);
  near(
    [...(wide.cropMin ?? []), ...(wide.cropMax ?? [])] as unknown as Point,
    [1 / 6, 0, 5 / 6, 1] as unknown as Point,
  );
  const tall = refilled(layer('picture', { size: [20, 0] }), frame({ size: [20, 20] }), 0.5);
  assert.deepEqual(
    [tall.cropMin, tall.cropMax],
    [
      [0, 0.25],
      [1, 0.75],
    ],
  );
  // A drawing stays within the same circle.
  assert.deepEqual(refilled(layer('drawing', { size: [40, 0] }), frame({ size: [40, 30] }), 0.75), { size: [30, 0] });
  // A layer that covers the page goes on doing so.
  assert.deepEqual(refilled(layer('map', { cropMin: [0.1, 0] }), frame(), 3), { cropMin: [0, 0], cropMax: [1, 1] });
});

// --- Crops -----------------------------------------------------------------------------------------------------------------

const picture = layer('picture', { cropMin: [0.25, 0], cropMax: [0.75, 0.5], size: [20, 10] });

test('the whole of a cropped picture lies around its box', () => {
  assert.deepEqual(wholePicture(frame(), picture), { low: [-20, -5], high: [20, 15] });
  const left = { ...picture, cropMin: [0, 0], cropMax: [0.5, 1] } as PlateLayer;
  assert.deepEqual(wholePicture(frame(), left), { low: [-10, -5], high: [30, 5] });
  assert.deepEqual(wholePicture(frame(), { ...left, mirror: true }), { low: [-30, -5], high: [10, 5] });
});

test('a cropped edge follows the hand while the picture stays where it is, turned and mirrored as well', () => {
  assert.deepEqual(croppedTo(frame(), picture, [1, 0], [65, 0]), {
    cropMin: [0.25, 0],
    cropMax: [0.875, 0.5],
    size: [25, 10],
    at: [52.5, 30],
  });
  const chance = chances(5);
  for (let k = 0; k < 200; ++k) {
    const mirror = k % 2 === 1;
    const before = { ...picture, mirror };
    const at = frame({ turn: 360 * chance() });
    const sides: Point = [Math.floor(3 * chance()) - 1, Math.floor(3 * chance()) - 1];
    const changed = croppedTo(at, before, sides, [100 * chance(), 60 * chance()]);
    const after = { ...before, ...changed };
    const whole = wholePicture({ ...at, middle: after.at as Point, size: after.size }, after);
    const was = wholePicture(at, before);
    // Rounded to 0.01 mm and 0.0001 of the picture.
    const now = { ...at, middle: after.at as Point };
    for (const end of ['low', 'high'] as const) {
      const [a, b] = [onPage(now, whole[end]), onPage(at, was[end])];
      assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1]) < 0.15, `${sides.join()} ${a.join()} ${b.join()}`);
    }
    assert.ok(after.cropMin[0] >= 0 && after.cropMax[0] <= 1 && after.cropMin[0] < after.cropMax[0]);
    assert.ok(after.cropMin[1] >= 0 && after.cropMax[1] <= 1 && after.cropMin[1] < after.cropMax[1]);
  }
});

test('a picture that is dragged under its crop goes with the hand, to its edges and no farther', () => {
  assert.deepEqual(slid(frame(), picture, [50, 30], [54, 28]), { cropMin: [0.15, 0.1], cropMax: [0.65, 0.6] });
  assert.deepEqual(slid(frame(), { ...picture, mirror: true }, [50, 30], [54, 28]), {
    cropMin: [0.35, 0.1],
    cropMax: [0.85, 0.6],
  });
  assert.deepEqual(slid(frame(), picture, [50, 30], [90, 90]), { cropMin: [0, 0], cropMax: [0.5, 0.5] });
});
