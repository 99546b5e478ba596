import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { createEngine, type Engine, type PrinterValues, type Toolpath } from 'sillon';
import { printerDefaults } from '../../src/model/defaults.js';
import { evenSpeed } from '../../src/model/facts.js';
import { delaysOf, leans, shownSpeed } from '../../src/views/delays.js';

let engine: Engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
});

const [spacing, length, strands, speed] = [0.4, 20, 6, 10];

/** Strands along x, laid in the given order of their rows, each the other way round than the one before. */
function laid(rows: number[], width = spacing): Toolpath {
  const places = rows.flatMap((row, k) => {
    const ends = k % 2 === 0 ? [0, length] : [length, 0];
    return ends.flatMap((x) => [x, row * spacing]);
  });
  const points = Float32Array.from(places);
  const widths = new Float32Array(points.length / 2).fill(width);
  return { spacing, cycles: [{ points, widths }], shape: { page: [length, strands * spacing], paths: [] }, notes: [] };
}

/** The delay of the piece that begins in the middle of a row, or next to it, and how it leans. */
function middleOf(rows: number[], row: number, width = spacing): [number, number] {
  const { toolpath, delays } = delaysOf(laid(rows, width), speed);
  const { points, widths } = toolpath.cycles[0] ?? assert.fail();
  const at = [...widths.keys()].find(
    (k) =>
      Math.abs((points[2 * k] ?? 0) - length / 2) <= width / 2 + 0.01 &&
      Math.abs((points[2 * k + 1] ?? 0) - row * spacing) < 1e-3,
  );
  const [wait, lean] = delays[0]?.subarray(2 * (at ?? -1)) ?? [];
  return wait === undefined || lean === undefined ? assert.fail('no point in the middle') : [wait, lean];
}

const inTheMiddle = (...of: Parameters<typeof middleOf>): number => middleOf(...of)[0];

test('beads of a zigzag wait for one strand', () => {
  const strand = (length + spacing) / speed;
  assert.ok(Math.abs(inTheMiddle([0, 1, 2, 3, 4, 5], 2) - strand) < 0.05);
});

test('a bead between others that were laid long before waits for the longer side', () => {
  // Rows 0, 2 and 4 first, and 1, 3 and 5 on the way back: row 1 comes five strands after row 0.
  const waits = inTheMiddle([0, 2, 4, 5, 3, 1], 1);
  assert.ok(Math.abs(waits - (5 * length + 8 * spacing) / speed) < 0.1, `${waits}`);
});

test('a bead leans to the side where a neighbour was before it, seen along its own sense', () => {
  const lean = (rows: number[], row: number): number => middleOf(rows, row)[1];
  assert.equal(lean([0, 1, 2, 3], 0), leans.onNone);
  assert.equal(lean([0, 1, 2, 3], 1), leans.toTheLeft); // laid towards -x, so that row 0 lies at its left
  assert.equal(lean([0, 1, 2, 3], 2), leans.toTheRight);
  assert.equal(lean([0, 2, 1, 3], 1), leans.squeezed);
});

test('neighbours lie 0.6 to 1.4 of their own width beside a bead, as in the core, whatever the spacing', () => {
  const waits = (apart: number, width = spacing): boolean => inTheMiddle([0, apart], 0, width) > 0;
  assert.deepEqual(
    [0.59, 0.61, 1, 1.39, 1.41].map((apart) => waits(apart)),
    [false, true, true, true, false],
  );
  assert.deepEqual(
    [1.15, 1.25, 2.75, 2.85].map((apart) => waits(apart, 2 * spacing)),
    [false, true, true, false],
  );
});

test('beads of no width or no length are passed over', () => {
  const { delays } = delaysOf(
    { ...laid([0]), cycles: [{ points: Float32Array.of(0, 0, 0, 0, 1, 0), widths: Float32Array.of(0, 0, 0) }] },
    speed,
  );
  assert.deepEqual([...(delays[0] ?? [])], [0, 0, 0, 0, 0, 0]);
});

/** Shares of the length of beads with a neighbour that waits longer, and the longest wait of 90 % of it. */
function measured({ toolpath, delays }: ReturnType<typeof delaysOf>): {
  over30: number;
  over120: number;
  most: number;
  squeezed: number;
} {
  const waits = toolpath.cycles.flatMap(({ points, widths }, cycle) =>
    Array.from(widths, (_, k) => {
      const next = (k + 1) % widths.length;
      const [dx, dy] = [0, 1].map((side) => (points[2 * next + side] ?? 0) - (points[2 * k + side] ?? 0));
      const [wait = 0, lean = 0] = delays[cycle]?.subarray(2 * k) ?? [];
      return { wait, lean, length: Math.hypot(dx ?? 0, dy ?? 0) };
    }),
  );
  const known = waits.filter(({ wait }) => wait > 0).sort((a, b) => a.wait - b.wait);
  const all = known.reduce((sum, one) => sum + one.length, 0);
  const over = (limit: number): number =>
    known.reduce((sum, { wait, length }) => sum + (wait > limit ? length : 0), 0) / all;
  let sum = 0;
  const most = known.find((one) => (sum += one.length) >= 0.9 * all)?.wait ?? 0;
  const squeezed = known.reduce((sum, { lean, length }) => sum + (lean === leans.squeezed ? length : 0), 0) / all;
  return { over30: over(30), over120: over(120), most, squeezed };
}

test('the colours show the delays that the core measures in the G-code', async () => {
  for (const angle of [20, 75]) {
    const plate = { shape: { builtin: 'disc', size: [40, 40] }, layers: [{ kind: 'direction', angle }] } as const;
    const { toolpath } = await engine.generateToolpath(plate, { order: 'plain' }, { measure: false });
    const gcode = await engine.writeGcode(toolpath, {}, {});
    const { neighbourDelay } = await engine.checkGcode(gcode.blob);
    assert.ok(neighbourDelay !== null && neighbourDelay.over30 > 0.1);
    const shown = measured(delaysOf(toolpath, shownSpeed(printerDefaults)));
    for (const key of ['over30', 'over120', 'squeezed'] as const) {
      assert.ok(
        Math.abs(shown[key] - neighbourDelay[key]) < 0.007,
        `${angle} ${key}: ${shown[key]}, ${neighbourDelay[key]}`,
      );
    }
    const ratio = shown.most / neighbourDelay.most;
    assert.ok(Math.abs(ratio - 1) < 0.02, `${angle}: ${shown.most} s, ${neighbourDelay.most} s`);
  }
});

test('beads are as fast as the G-code has them, whatever sets pressure advance', async () => {
  const { toolpath } = await engine.generateToolpath(
    { shape: { builtin: 'rectangle', size: [10, 10] }, layers: [{ kind: 'direction' }] },
    {},
    { measure: false },
  );
  const heated = 'G28\nM190 S60\nM109 S220\n';
  const ways: Partial<PrinterValues>[] = [
    {},
    { speed: 15 },
    { flavor: 'klipper' },
    { flavor: 'reprap' },
    { flavor: 'prusa' },
    { setPressureAdvance: true },
    ...[
      'M900 K0.05',
      '  M900 T0 K.3 ; of PLA',
      'M900 K0.05\nM900 K0',
      'M900 K0\nM900 K0.05',
      'M900 K0 L12',
      'M572 D0 S0.04',
      'M572 D0 S0.0',
      'SET_PRESSURE_ADVANCE EXTRUDER=extruder ADVANCE=0.04',
      '; M900 K0.05',
      'M900 ; K0.05',
      'M9000\r\nM900 K0.1\r',
      'G1 X5 ; M900 K0.05',
    ].map((line) => ({ startGcode: heated + line })),
  ];
  for (const way of ways) {
    const printer = { ...printerDefaults, ...way };
    const { summary } = await engine.writeGcode(toolpath, printer);
    const slowed = summary.warnings.some(({ code }) => code === 'NoPressureAdvance');
    assert.equal(shownSpeed(printer), slowed ? evenSpeed : printer.speed, JSON.stringify(way));
    assert.equal(shownSpeed({ ...printer, showSpeed: 33 }), 33);
  }
});
