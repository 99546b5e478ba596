// What strangers' designs may do to a machine: nothing, before the visitor has said so.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
  newPlateOn,
  onOwnPrinter,
  toReview,
  unusualHeat,
  useBrought,
  withoutBlocks,
  withoutBrought,
} from '../../src/model/brought.js';
import { printerDefaults } from '../../src/model/defaults.js';
import { newPlate } from '../../src/model/new-plate.js';
import { withFilament } from '../../src/model/filaments.js';
import type { Plate } from '../../src/model/plate.js';
import { isGeneric, printers, profileOf, withPrinter } from '../../src/model/printers.js';
import { accepts, settings, valueOf, withNozzle } from '../../src/model/settings.js';

const own = withPrinter(newPlate(), 'prusa-mini').printer;
const foreign = (printer: Partial<Plate['printer']>): Plate => ({
  ...newPlate(),
  printer: { ...printerDefaults, ...printer },
});

test('a profile of ours may be used, with any filament of ours', () => {
  for (const one of printers.filter((printer) => !isGeneric(printer))) {
    for (const filament of ['goldPla', 'redPetg'] as const) {
      const plate = withFilament(withPrinter(newPlate(), one.key), filament);
      assert.deepEqual(onOwnPrinter(plate, own), plate, one.key);
    }
  }
});

test('a design for no printer in particular is printed on the visitor’s own', () => {
  const generic = printers.filter(isGeneric);
  assert.ok(generic.length > 0);
  for (const { key } of generic) {
    const plate = withNozzle(withFilament(withPrinter(newPlate(), key), 'redPetg'), 0.6);
    const opened = onOwnPrinter(plate, own);
    assert.equal(profileOf(opened.printer)?.key, 'prusa-mini');
    assert.equal(opened.printer.nozzle, 0.6);
    assert.equal(opened.printer.nozzleTemperature, plate.printer.nozzleTemperature);
    assert.ok(!('brought' in opened));
    assert.deepEqual(onOwnPrinter(plate, newPlate().printer), plate, key); // who has chosen none gets what it says
    for (const one of generic) {
      const chosen = withPrinter(newPlate(), one.key).printer;
      const there = profileOf(onOwnPrinter(plate, chosen).printer)?.key;
      assert.equal(there, profileOf(chosen)?.key === 'generic' ? key : one.key);
    }
  }
});

test('the name of a profile opens no door', () => {
  const mk4s = withPrinter(newPlate(), 'prusa-mk4s').printer;
  for (const change of [
    { startGcode: 'G28\nM997' },
    { endGcode: 'M112' },
    { generalHeatLimits: true },
    { flavor: 'bambu' as const },
    { machineAcceleration: 100000 },
    { bedMin: [-5000, -5000] as [number, number] },
  ]) {
    const plate = { ...newPlate(), printer: { ...mk4s, ...change } };
    assert.equal(profileOf(plate.printer), undefined);
    const opened = onOwnPrinter(plate, own);
    assert.equal(profileOf(opened.printer)?.key, 'prusa-mini', JSON.stringify(change));
    assert.deepEqual(opened.brought, plate.printer);
  }
});

test('of all settings of a printer, those that are used unasked are few, and known', () => {
  // Each as far as a control lets it go, one at a time, over the defaults.
  const used = settings
    .filter(({ section }) => section === 'printer')
    .filter((setting) => {
      const extremes: unknown[] =
        setting.kind === 'number' || setting.kind === 'integer'
          ? [setting.min, setting.max]
          : setting.kind === 'pair'
            ? [
                [setting.min, setting.min],
                [setting.max, setting.max],
              ]
            : setting.kind === 'choice'
              ? [...setting.choices]
              : setting.kind === 'flag'
                ? [true, false]
                : ['G28'];
      return extremes.some((value) => {
        assert.ok(accepts(setting, value), setting.id);
        const opened = onOwnPrinter(foreign({ ...own, [setting.key]: value }), own);
        const now = JSON.stringify(valueOf(opened, setting));
        return (
          now === JSON.stringify(value) &&
          now !== JSON.stringify((own as unknown as Record<string, unknown>)[setting.key])
        );
      });
    });
  assert.deepEqual(used.map(({ key }) => key).sort(), [
    'bedTemperature', // down to 0
    'filamentDensity',
    'filamentType',
    'firstLayerNozzleTemperature',
    'firstLayerSpeed',
    'nozzle',
    'nozzleTemperature',
    'pressureAdvance',
    'setPressureAdvance',
    'speed',
  ]);
});

test('heat beyond any filament is never taken over', () => {
  for (const heat of [{ nozzleTemperature: 300 }, { firstLayerNozzleTemperature: 480 }, { bedTemperature: 120 }]) {
    const opened = onOwnPrinter(foreign(heat), own);
    assert.deepEqual(unusualHeat(opened.printer), { nozzle: 0, bed: 0 });
    assert.notEqual(opened.brought, undefined);
  }
});

test("the visitor's own printer, as it is, is no stranger's", () => {
  const mine = { ...own, startGcode: 'G28', nozzleTemperature: 290, generalHeatLimits: true };
  const plate = { ...newPlate(), printer: structuredClone(mine) };
  assert.deepEqual(onOwnPrinter(plate, mine), plate);
  // The same machine with more heat is.
  const hotter = { ...newPlate(), printer: { ...mine, nozzleTemperature: 300 } };
  assert.equal(onOwnPrinter(hotter, mine).printer.nozzleTemperature, 290);
});

test('used or not, nothing waits any more', () => {
  const opened = onOwnPrinter(foreign({ startGcode: 'G28' }), own);
  assert.equal(useBrought(opened).printer.startGcode, 'G28');
  assert.ok(!('brought' in useBrought(opened)));
  assert.ok(!('brought' in withoutBrought(opened)));
  assert.equal(withoutBrought(opened).printer.startGcode, own.startGcode);
});

test('what is to be seen before a download changes with every line and every degree', () => {
  assert.equal(toReview(own), '');
  for (const { machine } of printers) assert.equal(toReview({ ...own, ...machine }), '');
  const seen = new Set(
    [
      { startGcode: 'G28' },
      { startGcode: 'G28\nM997' },
      { endGcode: 'G28' },
      { generalHeatLimits: true },
      { generalHeatLimits: true, nozzleTemperature: 480 },
      { generalHeatLimits: true, bedTemperature: 200 },
      { startGcode: 'G28', generalHeatLimits: true },
    ].map((change) => toReview({ ...own, ...change })),
  );
  assert.equal(seen.size, 7);
  assert.ok(!seen.has(''));
  const plate = foreign({ startGcode: 'G28', endGcode: 'M112', generalHeatLimits: true, nozzleTemperature: 480 });
  assert.equal(toReview(withoutBlocks(plate).printer), '');
  assert.deepEqual(unusualHeat(withoutBlocks(plate).printer), { nozzle: 0, bed: 0 });
});

test('a new plate is as before on the usual printer, and elsewhere on the visitor’s own with beads for its nozzle', () => {
  assert.deepEqual(newPlateOn(printerDefaults), newPlate());
  const wide = withFilament(withNozzle({ ...newPlate(), printer: own }, 0.8), 'redPetg').printer;
  const plate = newPlateOn(wide);
  assert.equal(profileOf(plate.printer)?.key, 'prusa-mini');
  assert.deepEqual([plate.printer.nozzle, plate.toolpath.spacing, plate.print.layerHeight], [0.8, 0.8, 0.4]);
  assert.deepEqual([plate.pictures.spool, plate.printer.filamentType], ['goldPla', 'PLA']);
  const imported = { ...own, name: 'Mine', startGcode: 'G28' };
  assert.equal(newPlateOn(imported).printer.startGcode, 'G28');
});
