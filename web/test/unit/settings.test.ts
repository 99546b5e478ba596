import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { test } from 'node:test';
import type { PrinterValues } from 'sillon';
import { printDefaults, printerDefaults, toolpathDefaults } from '../../src/model/defaults.js';
import { newPlate } from '../../src/model/new-plate.js';
import { filamentOf, filaments, lookOf, withFilament } from '../../src/model/filaments.js';
import type { Plate } from '../../src/model/plate.js';
import { ofFilament, printers, profileOf, withPrinter } from '../../src/model/printers.js';
import {
  accepts,
  adviceFor,
  expertSettings,
  nozzleAdvice,
  qualities,
  qualityOf,
  settingOf,
  settings,
  valueOf,
  withNozzle,
  withQuality,
  withValue,
  type Quality,
} from '../../src/model/settings.js';

const sections = { toolpath: toolpathDefaults, print: printDefaults, printer: printerDefaults };

interface Documented {
  id: string;
  default: string;
  unit: string;
  range: string;
}

/** Names of whole printers and filaments: the page puts their values in instead. */
const names = ['toolpath.preset', 'printer.profile', 'printer.filament'];

/** The rows of the tables of docs/reference/project.md. */
function documented(): Documented[] {
  const text = readFileSync('docs/reference/project.md', 'utf8');
  return Object.keys(sections)
    .flatMap((section) => {
      const [, table = ''] = text.split(new RegExp(`^## \`${section}\`$`, 'm'));
      const rows = (table.split(/^## /m)[0] ?? '').split('\n').filter((line) => line.startsWith('| `'));
      return rows.map((line) => {
        const [, key = '', value = '', unit = '', range = ''] = line.split('|').map((cell) => cell.trim());
        return { id: `${section}.${key.replaceAll('`', '')}`, default: value.replaceAll('`', ''), unit, range };
      });
    })
    .filter(({ id }) => !names.includes(id));
}

test('every setting of docs/reference/project.md has a row, and no other', () => {
  assert.deepEqual(
    settings.map(({ id }) => id).sort(),
    documented()
      .map(({ id }) => id)
      .sort(),
  );
  const ids: string[] = Object.entries(sections).flatMap(([section, values]) =>
    Object.keys(values).map((key) => `${section}.${key}`),
  );
  assert.deepEqual(settings.map(({ id }) => id as string).sort(), ids.sort());
});

test('defaults and units are those of docs/reference/project.md', () => {
  for (const { id, default: value, unit } of documented()) {
    const setting = settings.find((one) => one.id === id);
    assert.ok(setting !== undefined);
    const expected: unknown = setting.kind === 'text' ? value.replaceAll('"', '') : parsed(value);
    assert.deepEqual(setting.default, expected, id);
    if (!('unit' in setting)) continue;
    const units: Record<string, string> = { degrees: '°', τ: 'spacing' };
    assert.equal(setting.unit, units[unit] ?? unit, id);
  }
});

function parsed(value: string): unknown {
  try {
    return JSON.parse(value);
  } catch {
    return value;
  }
}

test('ranges are those of docs/reference/project.md, or what JavaScript and a control can hold of them', () => {
  let compared = 0;
  for (const { id, range } of documented()) {
    const setting = settings.find((one) => one.id === id);
    if (setting === undefined || !('min' in setting)) continue;
    const [, low, high] = /^([−\d.]+) to ([−\d.]+)/.exec(range) ?? [];
    if (low === undefined || high === undefined || range.includes('^')) continue;
    const number = (text: string): number => Number(text.replace('−', '-'));
    assert.deepEqual([setting.min, setting.max], [number(low), number(high)], id);
    ++compared;
  }
  assert.ok(compared > 35, `only ${compared} ranges were found in the docs`);
  assert.deepEqual(settingOf('toolpath.seed'), {
    ...settingOf('toolpath.seed'),
    min: 0,
    max: Number.MAX_SAFE_INTEGER,
  });
});

test('the studio leaves out what docs/reference/project.md calls expert', () => {
  const [, table = ''] = readFileSync('docs/reference/project.md', 'utf8').split(/^## `toolpath`$/m);
  const rows = (table.split(/^## /m)[0] ?? '').split('\n').filter((line) => line.includes('(expert)'));
  const ids = rows.map((line) => `toolpath.${/^\| `(\w+)`/.exec(line)?.[1] ?? ''}`);
  assert.deepEqual([...expertSettings].sort(), ids.sort());
});

test('choices are those of docs/reference/project.md', () => {
  for (const { id, range } of documented()) {
    const setting = settings.find((one) => one.id === id);
    if (setting?.kind !== 'choice') continue;
    assert.deepEqual(
      setting.choices,
      [...range.matchAll(/`(\w+)`/g)].map(([, name]) => name),
      id,
    );
  }
});

test('every default is accepted, and usual spans lie within the range', () => {
  for (const setting of settings) {
    assert.ok(accepts(setting, setting.default), setting.id);
    if (!('usual' in setting)) continue;
    const [low, high] = setting.usual;
    assert.ok(setting.min <= low && low < high && high <= setting.max, setting.id);
    assert.ok(setting.step > 0 && setting.step <= high - low, setting.id);
    if (typeof setting.default === 'number') assert.ok(low <= setting.default && setting.default <= high, setting.id);
  }
});

test('what no control could set is refused', () => {
  const wrong: Record<string, unknown[]> = {
    number: [undefined, 'x', '1', NaN, Infinity, -Infinity, {}, [], true, 1e9, -1e9],
    integer: [undefined, '1', NaN, 0.5, -1e9, 1e300, null],
    choice: [undefined, null, '', 'no such', 0, {}, '__proto__'],
    flag: [undefined, null, 0, 1, 'true', {}],
    text: [undefined, null, 1, 'x'.repeat(65537), '\u0000', {}],
    pair: [undefined, 1, [], [1], [1, 2, 3], ['1', 2], [NaN, 1], [1e9, 1], { 0: 1, 1: 2, length: 2 }],
  };
  assert.equal(accepts(settingOf('printer.name'), 'two\nlines'), false);
  assert.equal(accepts(settingOf('printer.name'), 'é'.repeat(512)), true);
  assert.equal(accepts(settingOf('printer.name'), 'é'.repeat(513)), false);
  assert.equal(accepts(settingOf('printer.startGcode'), 'G28\nM109 S210'), true);
  assert.equal(accepts(settingOf('print.copies'), [1.5, 1]), false);
  for (const setting of settings) {
    for (const value of wrong[setting.kind] ?? []) {
      assert.equal(accepts(setting, value), false, `${setting.id}: ${String(value)}`);
    }
    assert.equal(accepts(setting, null), 'nullable' in setting && setting.nullable, setting.id);
  }
});

test('a value goes into its section and leaves the others as they are', () => {
  const plate = newPlate();
  const setting = settingOf('print.layers');
  const changed = withValue(plate, setting, 3);
  assert.equal(valueOf(changed, setting), 3);
  assert.equal(plate.print.layers, 1);
  assert.equal(changed.toolpath, plate.toolpath);
  assert.equal(withValue(changed, setting, 3), changed);
});

test('a plate of a quality is recognised, another is not', () => {
  for (const quality of Object.keys(qualities) as Quality[]) {
    assert.equal(qualityOf(withQuality(newPlate(), quality).toolpath), quality);
    for (const [key, value] of Object.entries(qualities[quality])) {
      const setting = settings.find(({ id }) => id === `toolpath.${key}`);
      assert.ok(setting !== undefined && accepts(setting, value), key);
    }
  }
  assert.equal(qualityOf(toolpathDefaults), 'standard');
  assert.equal(qualityOf({ ...toolpathDefaults, sweepsPerLevel: 9 }), undefined);
});

test('advice for a nozzle can be laid by it', () => {
  for (const nozzle of [...nozzleAdvice.map((advice) => advice.nozzle), 0.05, 0.5, 2]) {
    const { spacing, layerHeight } = adviceFor(nozzle);
    for (const one of spacing) assert.ok(one >= 0.6 * nozzle && one <= 1.6 * nozzle, `${nozzle}: ${one}`);
    assert.ok(spacing[0] <= spacing[1] && spacing[1] <= spacing[2]);
    if (nozzle >= 0.1) assert.ok(layerHeight <= 0.8 * nozzle + 1e-9, `${nozzle}: ${layerHeight}`);
    const plate = withNozzle(newPlate(), nozzle);
    for (const id of ['toolpath.spacing', 'print.layerHeight', 'printer.nozzle'] as const) {
      assert.ok(accepts(settingOf(id), valueOf(plate, settingOf(id))), `${nozzle}: ${id}`);
    }
  }
  assert.equal(adviceFor(0.4).spacing[1], 0.4);
});

test('every printer has values that the engine takes, a bed, and a name of its own', () => {
  const names = new Set<string>();
  for (const { key, machine } of printers) {
    const plate = withPrinter(withFilament(newPlate(), 'redPetg'), key);
    for (const setting of settings) {
      assert.ok(accepts(setting, valueOf(plate, setting)), `${key}: ${setting.id}`);
    }
    assert.ok(machine.bedMin[0] < machine.bedMax[0] && machine.bedMin[1] < machine.bedMax[1], key);
    assert.equal(profileOf(plate.printer)?.key, key);
    // What belongs to the filament and the nozzle stays.
    assert.equal(plate.printer.nozzleTemperature, 235);
    assert.equal(withPrinter(withNozzle(newPlate(), 0.8), key).printer.nozzle, 0.8);
    names.add(machine.name);
  }
  assert.equal(names.size, printers.length);
  assert.equal(profileOf({ ...printerDefaults, name: 'Mine' }), undefined);
});

test('pressure advance follows the family of the filament, as in the core', () => {
  const advance = (filamentType: string): number | undefined => {
    const plate = newPlate();
    const { printer } = withPrinter({ ...plate, printer: { ...plate.printer, filamentType } }, 'prusa-mk4s');
    return printer.setPressureAdvance ? printer.pressureAdvance : undefined;
  };
  for (const type of ['PLA', 'PLA Silk', 'PLA+', 'pla-cf']) assert.equal(advance(type), 0.036, type);
  assert.equal(advance('PETG-CF'), 0.053);
  for (const type of ['TPU', 'PLASTIC', '']) assert.equal(advance(type), undefined, type);
});

test('pressure advance is the maker’s for printer, filament and nozzle, unless it is one’s own', () => {
  const of = (plate: Plate): number | undefined =>
    plate.printer.setPressureAdvance ? plate.printer.pressureAdvance : undefined;
  const mk4s = withPrinter(newPlate(), 'prusa-mk4s');
  assert.equal(of(newPlate()), undefined);
  assert.equal(of(mk4s), 0.036);
  assert.equal(of(withFilament(mk4s, 'redPetg')), 0.053);
  assert.equal(of(withNozzle(withFilament(mk4s, 'redPetg'), 0.6)), 0.032);
  assert.equal(of(withPrinter(withNozzle(newPlate(), 0.6), 'prusa-mini')), 0.17);
  assert.equal(of(withPrinter(mk4s, 'creality-ender-3-v2')), undefined);
  const own = { ...mk4s, printer: { ...mk4s.printer, pressureAdvance: 0.044 } };
  assert.equal(of(withNozzle(withFilament(own, 'redPetg'), 0.6)), 0.044);
});

test('printers share no lists that a change of one could spoil', () => {
  const a = withPrinter(newPlate(), 'prusa-mk4s');
  a.printer.bedMax[0] = 1;
  assert.equal(withPrinter(newPlate(), 'prusa-mk4s').printer.bedMax[0], 250);
});

test('a filament brings temperatures the engine takes, and a look that is duller across than along', () => {
  for (const { key } of filaments) {
    const plate = withFilament(newPlate(), key);
    for (const setting of settings) assert.ok(accepts(setting, valueOf(plate, setting)), `${key}: ${setting.id}`);
    for (const nozzle of [0.2, 0.4, 0.5, 0.8, 1.2]) {
      for (const showSide of ['up', 'bed'] as const) {
        const { colour, along, across } = lookOf({
          ...plate,
          print: { ...plate.print, showSide },
          printer: { ...plate.printer, nozzle },
        });
        assert.ok(along > 0 && across > along && across < 30, key);
        assert.ok(colour.every((one) => one >= 0 && one <= 1));
      }
    }
  }
});

test('a filament asks for what its profile in the core does', () => {
  const { stdout } = spawnSync(resolve('build/release/sillon'), ['filaments', '--json'], { encoding: 'utf8' });
  const { filaments: profiles } = JSON.parse(stdout) as { filaments: { id: string; printer: PrinterValues }[] };
  for (const { key } of filaments) {
    const id = key.endsWith('Petg') ? 'petg' : 'pla';
    const profile = profiles.find((one) => one.id === id)?.printer ?? assert.fail(id);
    const { printer } = withFilament(newPlate(), key);
    for (const value of ofFilament) {
      if (!value.endsWith('ressureAdvance')) assert.equal(printer[value], profile[value], `${key}: ${value}`);
    }
  }
});

test('the look is the one that was measured, from the side that is seen', () => {
  const plate = withFilament(newPlate(), 'bluePla');
  const { along, across } = lookOf(plate);
  assert.deepEqual([along, across], [2.36, 17.32]);
  const below = lookOf({ ...plate, print: { ...plate.print, showSide: 'bed' } });
  assert.deepEqual(lookOf({ ...plate, print: { ...plate.print, mirror: true } }), lookOf(plate));
  assert.deepEqual([below.along, below.across], [2.56, 13.54]);
  const wide = lookOf({ ...plate, printer: { ...plate.printer, nozzle: 0.8 } });
  assert.deepEqual([wide.along, wide.across], [2.31, 17.69]);
  const middle = lookOf({ ...plate, printer: { ...plate.printer, nozzle: 0.6 } });
  assert.ok(Math.abs(middle.across - (17.32 + 17.69) / 2) < 1e-9);
});

test('a filament that is not in the list is the first of it', () => {
  assert.equal(filamentOf('__proto__').key, filaments[0]?.key);
});
