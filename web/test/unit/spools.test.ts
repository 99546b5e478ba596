// Own spools: the page reads the same files as the native program, and whatever is drawn or solved takes them.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { createEngine } from 'sillon';
import { kinds, answerOf, spacingBetween, withFound, withWidths } from '../../src/calibrate/model.js';
import { Unfit } from '../../src/model/check.js';
import { newPlate } from '../../src/model/new-plate.js';
import { lookOf, slopesOf, viewLook, withFilament, withSpool } from '../../src/model/filaments.js';
import { filledWith } from '../../src/model/fills.js';
import { engineInput } from '../../src/model/input.js';
import { samePictures } from '../../src/model/lamp.js';
import type { OwnSpool, Plate, SourceFile } from '../../src/model/plate.js';
import { howOf } from '../../src/model/rebrush.js';
import { readLink, writeLink } from '../../src/files/link.js';
import { plateOf, projectData } from '../../src/files/plate-project.js';
import { plateSpoolFrom } from '../../src/model/own-spool.js';
import { readSpools, spoolKey, spoolsText, withOne } from '../../src/print/spools.js';

const spool: OwnSpool = {
  key: 'mySilk',
  colour: [10, 20, 30],
  fine: { nozzleSide: [3, 14], bedSide: [2, 9] },
  source: 'a photograph',
};
const entry = { colour: [10, 20, 30], fine: { nozzleSide: [3, 14], bedSide: [2, 9] } };
const fileWith = (change: object, key = 'mySilk'): string =>
  JSON.stringify({ version: 1, spools: { [key]: { ...entry, ...change } } });
const picture: SourceFile = { id: 'a', name: 'a.png', bytes: new Blob(['x']) };
const refuse = (): Promise<SourceFile> => Promise.reject(new Error('no file'));

test('a file of spools comes back as it was written', () => {
  const wide: OwnSpool = { ...spool, key: 'other', wide: spool.fine };
  assert.deepEqual(readSpools(spoolsText([spool, wide])), [spool, wide]);
  assert.deepEqual(readSpools(spoolsText([])), []);
});

test('the page takes and refuses the files that the native program takes and refuses', () => {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
  const sides = { nozzleSide: [3, 14], bedSide: [2, 9] };
  const texts = [
    ...[fileWith({}), fileWith({ wide: sides }), fileWith({ source: 'x' }), fileWith({}, 'a-b_9'), spoolsText([spool])],
    ...[
      fileWith({}, ''),
      fileWith({}, 'a b'),
      fileWith({}, 'x'.repeat(41)),
      fileWith({}, 'bluePla'),
      fileWith({}, 'é'),
    ],
    ...[fileWith({ colour: [1, 2] }), fileWith({ colour: [1, 2, 256] }), fileWith({ colour: [1, 2, 0.5] })],
    ...[fileWith({ colour: undefined }), fileWith({ fine: undefined }), fileWith({ fine: { nozzleSide: [3, 14] } })],
    ...[fileWith({ fine: { ...sides, nozzleSide: [0.05, 14] } }), fileWith({ fine: { ...sides, bedSide: [3, 46] } })],
    ...[fileWith({ fine: { ...sides, bedSide: ['3', 4] } }), fileWith({ fine: { ...sides, top: [3, 4] } })],
    ...[fileWith({ wide: 3 }), fileWith({ source: 3 }), fileWith({ gloss: 3 }), '[]', '{', '', 'null'],
    ...['{"version": 2, "spools": {}}', '{"version": 1}', '{"version": 1, "spools": [], "a": 1}'],
  ];
  try {
    const verdicts = texts.map((text) => {
      writeFileSync(join(folder, 'mine.json'), text);
      const { status } = spawnSync('build/release/sillon', ['spools', '--spools', join(folder, 'mine.json')]);
      let taken = true;
      try {
        readSpools(text);
      } catch (error) {
        assert.ok(error instanceof Unfit, `${text}: ${String(error)}`);
        taken = false;
      }
      assert.equal(taken, status === 0, text);
      return taken;
    });
    assert.equal(verdicts.filter((taken) => taken).length, 5);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('names are made to fit, and taken once', () => {
  assert.equal(spoolKey('Seide é 9', []), 'Seide-e-9');
  assert.equal(spoolKey('  ', ['mySpool']), 'mySpool-2');
  assert.equal(spoolKey('bluePla', []), 'bluePla-2');
  assert.deepEqual(
    withOne([spool], { ...spool, key: 'a' }).map(({ key }) => key),
    ['a', 'mySilk'],
  );
  assert.equal(withOne([spool], { ...spool, colour: [1, 1, 1] }).length, 1);
});

test('whatever is drawn or solved takes the spool', () => {
  const plain = newPlate();
  const own = withSpool(plain, spool);
  assert.deepEqual(viewLook(own), { colour: [10, 20, 30], slopes: [3, 14] });
  assert.equal(lookOf(own).along, 3);
  assert.deepEqual(slopesOf({ ...own, print: { ...own.print, showSide: 'bed' } }), [2, 9]);
  const wide = { ...spool, wide: { nozzleSide: [5, 18] as [number, number], bedSide: [2, 9] as [number, number] } };
  assert.deepEqual(slopesOf({ ...withSpool(plain, wide), printer: { ...plain.printer, nozzle: 0.6 } }), [4, 16]);

  const pictured = (plate: Plate): Plate => filledWith(plate, 'picture', { pictures: [{ file: picture, lamp: null }] });
  assert.deepEqual(engineInput(pictured(own)).input.pictures?.slopes, [3, 14]);
  assert.ok(!samePictures(pictured(own), pictured(plain)));
  const wish = {
    ...{ side: 'bottom' as const, chosen: new Set([0]), way: 'picture' as const, angle: 0, picture },
    ...{ lamp: [60, 35] as const, spool: 'bluePla' as const, own: spool, fit: 'face' as const, strokes: [] },
  };
  assert.deepEqual(howOf(wish, [], plain, 0.4).pictures?.slopes, [2, 9]);
  assert.deepEqual(howOf({ ...wish, side: 'top', way: 'plate' }, [], pictured(own), 0.4).pictures?.slopes, [3, 14]);

  assert.deepEqual(howOf({ ...wish, own: wide, side: 'top' }, [], plain, 0.6).pictures?.slopes, [4, 16]);

  assert.equal(withFilament(own, 'greyPla').spool, undefined);
  assert.ok(!('spool' in withSpool(own, undefined)));
});

test('a plate carries its spool, into projects and links', async () => {
  const engine = await createEngine({ threads: 'off' });
  try {
    const own: Plate = withSpool(newPlate(), spool);
    const text = JSON.stringify(projectData(own, () => ''));
    assert.deepEqual(await plateOf(text, '', refuse, engine), own);
    assert.deepEqual(await readLink((await writeLink(own)).hash, refuse, () => Promise.resolve(engine)), own);
    // Slopes that somebody has changed since are not the spool's any more.
    const changed = JSON.parse(text) as { pictures: object };
    const other = JSON.stringify({ ...changed, pictures: { ...changed.pictures, slopes: [5, 20] } });
    const plate = await plateOf(other, '', refuse, engine);
    assert.deepEqual([plate.spool, plate.pictures.slopes], [undefined, [5, 20]]);
    for (const wrong of [
      { ...spool, key: 'bluePla' },
      { ...spool, fine: undefined },
      { ...spool, more: 1 },
      'mySilk',
      null,
    ]) {
      assert.throws(() => plateSpoolFrom(wrong), Unfit);
      const broken = JSON.stringify({ ...changed, studio: { version: 2, spool: wrong } });
      await assert.rejects(plateOf(broken, '', refuse, engine), Unfit);
    }
  } finally {
    engine.dispose();
  }
});

// --- Calibration ----------------------------------------------------------------------------------------------------------

test('what a print has found goes to its setting', () => {
  const plate = newPlate();
  const settings = kinds.flatMap((kind) => {
    const answer = answerOf(kind);
    return answer.kind === 'setting' ? [`${kind} ${answer.setting}`] : [];
  });
  assert.deepEqual(settings, [
    ...['coupon print.flow', 'flow print.flow', 'speed printer.showSpeed', 'fan printer.showFan'],
  ]);
  assert.equal(withFound(plate, 'coupon', 0.93, false).print.flow, 0.93);
  const fast = withFound(plate, 'speed', 30, true);
  assert.deepEqual([fast.printer.showSpeed, fast.print.constantFlow], [30, true]);
  assert.equal(withFound(plate, 'fan', 500, false), plate); // no control could have set it
});

test('two widths give a spacing between them and how far beads may depart from it', () => {
  assert.deepEqual(spacingBetween(0.32, 0.5), { spacing: 0.4, variation: 0.22 }); // as the guide says
  const { spacing, spacingVariation } = withWidths(newPlate(), 0.32, 0.5).toolpath;
  assert.deepEqual([spacing, spacingVariation], [0.4, 0.22]);
});
