// Calibration prints are those of the native program, byte for byte, and photographs of coupons are read as it reads them.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { createEngine } from 'sillon';

import { png } from './support/png.js';
import { nativeProgram, root } from './support/projects.js';

const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
const photographFile = join(root, 'docs/pictures/coupon-photograph.jpg');
const printer = { name: 'Own', flavor: 'klipper', pressureAdvance: 0.03, screenSizes: '48x48' };
const print = { flow: 0.93 };
const epoch = 86_400 * 365;
const date = new Date(1000 * epoch);
let engine;
let photograph;

before(async () => {
  engine = await createEngine({ threads: 'off' });
  photograph = await engine.decodePicture(readFileSync(photographFile));
  writeFileSync(join(folder, 'mine.json'), JSON.stringify({ sillon: 1, printer, print }));
});
after(() => {
  engine.dispose();
  rmSync(folder, { recursive: true });
});

function native(...args) {
  const { status, stdout, stderr } = spawnSync(nativeProgram, ['calibrate', ...args], {
    encoding: 'utf8',
    cwd: folder,
    env: { ...process.env, SOURCE_DATE_EPOCH: String(epoch) },
  });
  return { status, stdout, stderr };
}

for (const kind of ['flow', 'speed', 'fan', 'width', 'directions', 'swatch', 'coupon']) {
  test(`${kind} is the native file, with the same table`, async () => {
    const { status, stdout, stderr } = native(kind, 'mine.json', '--json', '-o', 'out.gcode');
    assert.equal(status, 0, stderr);
    const told = JSON.parse(stdout);
    const made = await engine.calibrate(kind, { printer, print: { ...print, date }, pictureSide: 64 });
    assert.equal(Buffer.from(await made.blob.arrayBuffer()).compare(readFileSync(join(folder, 'out.gcode'))), 0);
    assert.equal(made.setting.join(', '), told.setting);
    assert.equal(made.unit, told.unit);
    assert.equal(made.advice, told.advice);
    assert.deepEqual(
      made.values.map(({ label, value }) => ({ label, value })),
      told.values.map(({ label, value }) => ({ label, value })),
    );
    assert.equal(Math.round(made.summary.seconds), told.seconds);
    assert.equal(made.check.errors, 0);
    assert.deepEqual(
      made.page.map((side) => side.toFixed(3)),
      told.size.map((side) => side.toFixed(3)),
    );
    const picture = await engine.decodePicture(made.picture);
    const [longer] = [...made.page].sort((a, b) => b - a);
    const pixels = made.page.map((side) => Math.max(16, Math.round((64 * side) / longer)));
    assert.deepEqual([picture.width, picture.height], pixels);
  });
}

test('range and filament are those that were asked for', async () => {
  const { status, stderr } = native(
    ...['flow', 'mine.json', '--from', '0.9', '--to', '0.96', '--spool', 'goldPla', '-o', 'gold.gcode'],
  );
  assert.equal(status, 0, stderr);
  const request = { printer, print: { ...print, date }, from: 0.9, to: 0.96 };
  const gold = { colour: [201, 148, 46], slopes: [8.93, 15.6] };
  const made = await engine.calibrate('flow', { ...request, filament: gold });
  assert.equal(await made.blob.text(), readFileSync(join(folder, 'gold.gcode'), 'utf8'));
  assert.equal(made.picture, undefined);
  const blue = await engine.calibrate('flow', request);
  assert.notEqual(await blue.blob.text(), await made.blob.text()); // its pictures are of another colour
});

/** The native program prints so many digits of the same figures. */
function assertPrinted({ value, error }, told, digits) {
  const allowed = 0.5 * 10 ** -digits + 1e-12;
  assert.ok(Math.abs(value - told.value) <= allowed, `${value}, ${told.value} natively`);
  assert.ok(Math.abs(error - told.error) <= allowed, `±${error}, ±${told.error} natively`);
}

test('a photograph is read as the native program reads it, and gives a spool', async () => {
  const { status, stdout, stderr } = native(
    ...['read', photographFile, '--json', '--lamp-elevation', '44', '-o', 'mine.spools.json'],
  );
  assert.equal(status, 0, stderr);
  const told = JSON.parse(stdout);
  const read = await engine.readCoupon(photograph, { lampElevation: 44 });
  assertPrinted(read.along, told.along, 2);
  assertPrinted(read.across, told.across, 2);
  assertPrinted(read.flow, told.flow, 3);
  assertPrinted(read.width, told.width, 3);
  assert.equal(Number(read.widthAsked.toFixed(3)), told.width.asked);
  assertPrinted(read.azimuth, told.lamp.azimuth, 2);
  assert.equal(read.allDiscsClosed, told.allDiscsClosed);
  assert.equal(read.noDiscClosed, told.noDiscClosed);
  const { spools } = JSON.parse(readFileSync(join(folder, 'mine.spools.json'), 'utf8'));
  // Its slopes are the figures, rounded.
  const withoutSlopes = (spool) => JSON.stringify({ ...spool, fine: { ...spool.fine, nozzleSide: [], bedSide: [] } });
  assert.equal(withoutSlopes(read.spool), withoutSlopes(spools.mySpool));
  for (const side of ['nozzleSide', 'bedSide']) {
    [read.along, read.across].forEach(({ value, error }, k) => {
      assertPrinted({ value: read.spool.fine[side][k], error }, { value: spools.mySpool.fine[side][k], error }, 2);
      assert.ok(Math.abs(read.spool.fine[side][k] - value) < 0.00501);
    });
  }
});

/** The same photograph, held upside down. */
function turned({ width, height, channels, samples }) {
  const out = new Uint8Array(samples.length);
  for (let k = 0; k < width * height; ++k) {
    const from = (width * height - 1 - k) * channels;
    out.set(samples.subarray(from, from + channels), k * channels);
  }
  return { width, height, channels, samples: out };
}

test('several photographs are joined as the native program joins them', async () => {
  const other = turned(photograph);
  writeFileSync(join(folder, 'other.png'), png(other.width, other.height, other.channels, other.samples));
  const { status, stdout, stderr } = native(
    ...['read', photographFile, 'other.png', '--lamp-size', '0.01', '--json', '-o', 'both.json'],
  );
  assert.equal(status, 0, stderr);
  const told = JSON.parse(stdout);
  const request = { lampSize: 0.01 };
  const each = [await engine.readCoupon(photograph, request), await engine.readCoupon(other, request)];
  const joined = await engine.joinReadings(each, request);
  // Sines differ in their last digit, and a fit may stop a step earlier.
  const like = (figure, native, what) => {
    assert.ok(Math.abs(figure.value / native.value - 1) < 0.005, `${what}: ${figure.value} ${native.value}`);
    assert.ok(Math.abs(figure.error - native.error) < 0.1 * native.error + 0.0005, `${what}: ${figure.error}`);
  };
  for (const what of ['along', 'across', 'flow', 'width']) like(joined[what], told[what], what);
  assert.equal(Number(joined.widthAsked.toFixed(3)), told.width.asked);
  assert.deepEqual(joined.azimuth, each[0].azimuth);
  const { spools } = JSON.parse(readFileSync(join(folder, 'both.json'), 'utf8'));
  assert.deepEqual(joined.spool.colour, spools.mySpool.colour);
  // One photograph tells no more if it is given twice.
  assert.ok(joined.width.error > 0.999 * Math.min(...each.map(({ width }) => width.error)));
  assert.deepEqual(await engine.joinReadings(each.slice(0, 1), request), each[0]);
  const strange = { ...each[1], along: { value: 3 * each[1].along.value, error: 0.1 } };
  await assert.rejects(engine.joinReadings([...each, strange], request), {
    code: 'InvalidFile',
    message: /^photograph 3 has slopes of .* they are not of one coupon/,
  });
  await assert.rejects(engine.joinReadings([{ ...each[0], width: 0.4 }]), {
    code: 'InvalidArgument',
    message: /^readings\[0\]\.width is 0\.4; it must be an object/,
  });
});

test('the kinds are those of the native program', () => {
  const [, kinds] = /it must be (.*) or read/.exec(native('gloss').stderr);
  const refusal = /it must be one of (.*)/;
  return assert.rejects(engine.calibrate('gloss'), (error) => refusal.exec(error.message)[1] === kinds);
});

test('what cannot be calibrated or read is refused in a sentence', async () => {
  const empty = { width: 300, height: 300, channels: 4, samples: new Uint8ClampedArray(4 * 300 * 300) };
  const refused = [
    [() => engine.calibrate('gloss'), 'InvalidArgument', /kind is "gloss"; it must be one of flow, speed/],
    [() => engine.calibrate('flow', { from: 2, to: 3 }), 'InvalidArgument', /flow is 2; it must be 0\.5 to/],
    [() => engine.calibrate('flow', { from: '1' }), 'InvalidArgument', /request\.from is "1"/],
    [() => engine.calibrate('flow', { pictureSide: 5000 }), 'InvalidArgument', /pictureSide is 5000/],
    [() => engine.calibrate('flow', { spool: 'goldPla' }), 'InvalidArgument', /unknown key "request\.spool"/],
    [() => engine.calibrate('flow', { printer: { bedMax: [30, 30] } }), 'DoesNotFit', /over the edge of the bed/],
    [() => engine.calibrate('flow', { printer: { nozzle: -1 } }), 'InvalidArgument', /nozzle is -1/],
    [() => engine.readCoupon(empty), 'InvalidFile', /no coupon/],
    [() => engine.readCoupon(empty, { lampSize: 3 }), 'InvalidArgument', /lampSize is 3/],
    [() => engine.readCoupon(readFileSync(photographFile)), 'InvalidArgument', /photograph is .*a Picture/],
    [() => engine.joinReadings([]), 'InvalidArgument', /readings is a list; it must be a list of at least one/],
    [() => engine.joinReadings({}), 'InvalidArgument', /readings is an object; it must be a list/],
    [() => engine.readCoupon({ ...empty, width: 7 }), 'InvalidArgument', /photograph is a picture whose sides/],
  ];
  for (const [call, code, message] of refused) {
    await assert.rejects(call, (error) => {
      assert.match(error.message, message);
      assert.equal(error.code, code);
      return true;
    });
  }
});
