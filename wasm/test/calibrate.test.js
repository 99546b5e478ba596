// Calibration prints are those of the native program, byte for byte, and photographs of coupons are read as it reads them.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { createEngine } from 'sillon';

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

for (const kind of [
  ...['first-layer', 'flow', 'advance', 'speed', 'temperature'],
  ...['fan', 'width', 'directions', 'swatch', 'coupon'],
]) {
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

test('a photograph is read as the native program reads it, and gives a spool', async () => {
  const { status, stdout, stderr } = native(
    ...['read', photographFile, '--json', '--lamp-elevation', '44', '-o', 'mine.spools.json'],
  );
  assert.equal(status, 0, stderr);
  const told = JSON.parse(stdout);
  const read = await engine.readCoupon(photograph, { lampElevation: 44 });
  const rounded = ({ value, error }, digits) => ({
    value: Number(value.toFixed(digits)),
    error: Number(error.toFixed(digits)),
  });
  assert.deepEqual(rounded(read.along, 2), told.along);
  assert.deepEqual(rounded(read.across, 2), told.across);
  assert.deepEqual(rounded(read.flow, 3), told.flow);
  assert.deepEqual({ ...rounded(read.width, 3), asked: Number(read.widthAsked.toFixed(3)) }, told.width);
  assert.deepEqual(rounded(read.azimuth, 2), told.lamp.azimuth);
  assert.equal(read.allDiscsClosed, told.allDiscsClosed);
  const { spools } = JSON.parse(readFileSync(join(folder, 'mine.spools.json'), 'utf8'));
  assert.deepEqual(read.spool, spools.mySpool);
});

test('what cannot be calibrated or read is refused in a sentence', async () => {
  const empty = { width: 300, height: 300, channels: 4, samples: new Uint8ClampedArray(4 * 300 * 300) };
  const refused = [
    [() => engine.calibrate('gloss'), 'InvalidArgument', /kind is "gloss"; it must be one of first-layer, flow/],
    [() => engine.calibrate('flow', { from: 2, to: 3 }), 'InvalidArgument', /flow would try 2; values must be 0\.5 to/],
    [() => engine.calibrate('flow', { from: '1' }), 'InvalidArgument', /request\.from is "1"/],
    [() => engine.calibrate('flow', { pictureSide: 5000 }), 'InvalidArgument', /pictureSide is 5000/],
    [() => engine.calibrate('flow', { spool: 'goldPla' }), 'InvalidArgument', /unknown key "request\.spool"/],
    [() => engine.calibrate('flow', { printer: { bedMax: [30, 30] } }), 'DoesNotFit', /over the edge of the bed/],
    [() => engine.calibrate('flow', { printer: { nozzle: -1 } }), 'InvalidArgument', /nozzle is -1/],
    [() => engine.readCoupon(empty), 'InvalidFile', /no coupon/],
    [() => engine.readCoupon(empty, { lampSize: 3 }), 'InvalidArgument', /lamp size is 3/],
    [() => engine.readCoupon(readFileSync(photographFile)), 'InvalidArgument', /photograph is .*a Picture/],
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
