// Every printer of the table can be found: to be chosen, or with what it needs first.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import table from 'sillon/printers.json' with { type: 'json' };
import { newPlate } from '../../src/model/new-plate.js';
import { isGeneric, printers, printersByFile, withPrinter } from '../../src/model/printers.js';

test('each printer is in one of two lists, generic ones first', () => {
  const keys = [...printers, ...printersByFile].map(({ key }) => key);
  assert.deepEqual([...keys].sort(), Object.keys(table.printers).sort());
  const firstOwn = printers.findIndex((one) => !isGeneric(one));
  assert.ok(firstOwn > 0 && printers.slice(firstOwn).every((one) => !isGeneric(one)));
});

test('printers whose start block is their owner’s alone cannot be chosen without a file', () => {
  assert.ok(printersByFile.some(({ label }) => label === 'Bambu Lab P1S'));
  for (const { key, machine } of printersByFile) {
    assert.equal(machine.flavor, 'bambu');
    assert.throws(() => withPrinter(newPlate(), key), /there is no printer/);
  }
});
