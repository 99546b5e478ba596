// The printer, filament and thickness that a visitor has named: kept as a text, used for plates that begin, and never guessed.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { printerDefaults } from '../../src/model/defaults.js';
import { withFilament, withSpool } from '../../src/model/filaments.js';
import { newPlate } from '../../src/model/new-plate.js';
import { OwnPrint, ownPrintText } from '../../src/model/own-print.js';
import type { Plate } from '../../src/model/plate.js';
import { isNobodys, printers, profileOf, withPrinter } from '../../src/model/printers.js';
import { thicknessOf } from '../../src/model/thickness.js';

const ender = withFilament(withPrinter(newPlate(), 'creality-ender-3'), 'bluePla');
const said = (plate: Plate, thickness?: number) => {
  const own = OwnPrint.of(ownPrintText(plate, thickness));
  assert.ok(own !== undefined);
  return own;
};

test('each printer of the list, and one of a file, come back as they were said', () => {
  const imported = {
    ...ender,
    printer: { ...ender.printer, name: 'P1S', flavor: 'bambu' as const, startGcode: 'G28\nG29' },
  };
  for (const plate of [...printers.map(({ key }) => withPrinter(ender, key)), imported]) {
    const { printer, spool, thickness } = said(plate, 2).said;
    assert.deepEqual(printer, plate.printer, plate.printer.name);
    assert.deepEqual([spool, thickness], ['bluePla', 2]);
  }
});

test('what nobody has said is left open, and what is not understood is asked again', () => {
  const spool = { key: 'mySilk', colour: [1, 2, 3], fine: { nozzleSide: [3, 14], bedSide: [2, 9] } } as const;
  assert.deepEqual(Object.keys(said(withSpool(ender, spool as unknown as Plate['spool'])).said), ['printer']);
  for (const text of [
    '',
    '{}',
    'no',
    '{"profile":"creality-ender-9"}',
    '{"profile":"creality-ender-3","printer":{"nozzle":"0.4"}}',
    '{"profile":"creality-ender-3","printer":{"nozzleTemperature":900}}',
    JSON.stringify({ printer: { ...printerDefaults, startGcode: undefined } }),
  ]) {
    assert.equal(OwnPrint.of(text), undefined, text);
  }
});

test('a machine that has a name stays; one that is for none in particular is the one that was said', () => {
  assert.ok(isNobodys(newPlate().printer));
  assert.ok(!isNobodys(ender.printer));
  assert.ok(!isNobodys({ ...newPlate().printer, bedMax: [300, 300] })); // of a file
  const generic = said(newPlate());
  assert.ok(generic.means(newPlate().printer));
  assert.ok(!generic.means(withPrinter(newPlate(), 'generic-centre').printer));
  assert.ok(!said(ender).means(newPlate().printer));
  assert.equal(said(ender).on(newPlate()).printer.name, 'Ender-3');
  const mini = withPrinter(newPlate(), 'prusa-mini');
  assert.equal(said(ender).on(mini), mini);
});

test('a new plate has the printer, the filament and the thickness that were said', () => {
  assert.deepEqual(OwnPrint.of('{"profile":"generic"}')?.begin(printerDefaults), newPlate());
  const plate = said(ender, 3).begin(printerDefaults);
  assert.equal(profileOf(plate.printer)?.key, 'creality-ender-3');
  assert.equal(plate.pictures.spool, 'bluePla');
  assert.equal(plate.printer.nozzleTemperature, ender.printer.nozzleTemperature);
  assert.ok(Math.abs(thicknessOf(plate) - 3) < 1e-9);
  // The machine on the screen goes before the one that was said, and its filament does not.
  const mini = withFilament(withPrinter(newPlate(), 'prusa-mini'), 'redPetg').printer;
  const next = said(ender).begin(mini);
  assert.deepEqual([next.printer.name, next.printer.filamentType, next.pictures.spool], ['MINI', 'PLA', 'bluePla']);
});
