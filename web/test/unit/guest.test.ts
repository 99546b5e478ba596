import assert from 'node:assert/strict';
import { test } from 'node:test';
import { spoken } from '../../src/i18n/languages.js';
import { guestSettings } from '../../src/model/guest.js';
import { printers } from '../../src/model/printers.js';
import { newShown, offers, ownControls } from '../../src/studio/shown.js';

const read = (attributes: Record<string, unknown>): ReturnType<typeof guestSettings> =>
  guestSettings((name) => attributes[name], spoken);

test('what a host asks for is read from its attributes; what it leaves out is not there', () => {
  assert.deepEqual(read({}), { given: {}, wrong: [] });
  const { given, wrong } = read({
    mode: 'customize',
    controls: 'name, size toolpath.spacing',
    lang: 'FR-ca',
    theme: 'dark',
    units: 'in',
    printer: 'prusa-mk4s',
    threads: '8',
    autosave: 'shop-1',
  });
  assert.deepEqual(wrong, []);
  assert.deepEqual(given, {
    mode: 'customize',
    controls: ['name', 'size', 'toolpath.spacing'],
    language: 'fr',
    theme: 'dark',
    units: 'in',
    printer: 'prusa-mk4s',
    threads: 8,
    autosave: 'shop-1',
  });
  assert.equal(read({ threads: 'off' }).given.threads, 'off');
});

test('what cannot be is told with its name and value, and nothing else is lost by it', () => {
  const bad: [string, unknown][] = [
    ['mode', 'admin'],
    ['controls', 'name, everything'],
    ['lang', 'constructor'],
    ['theme', ''],
    ['units', 'ft'],
    ['printer', 'nothing'],
    ['threads', '0'],
    ['threads', '65'],
    ['threads', '1.5'],
    ['threads', '1e1'],
    ['autosave', '../x'],
    ['autosave', 'x'.repeat(65)],
    ['mode', 3],
    ['controls', 'name '.repeat(300)],
  ];
  for (const [name, value] of bad) {
    const { given, wrong } = read({ units: 'in', [name]: value, theme: name === 'theme' ? value : 'dark' });
    assert.deepEqual(
      wrong.map(({ where }) => where),
      [name],
    );
    assert.equal(Object.keys(given).length, name === 'units' || name === 'theme' ? 1 : 2, name);
  }
});

test('all parts are there for editing, the named ones for customizing, none for a view', () => {
  const shown = newShown();
  const controls = ['shape', 'download', 'toolpath.spacing'] as const;
  assert.ok(offers(shown, 'print'));
  assert.ok(offers({ ...shown, mode: 'customize', controls }, 'shape'));
  assert.ok(!offers({ ...shown, mode: 'customize', controls }, 'print'));
  assert.ok(!offers({ ...shown, mode: 'view', controls }, 'shape'));
  // Sections have panels of their own, and downloads their button.
  assert.deepEqual(ownControls({ ...shown, mode: 'customize', controls }), ['toolpath.spacing']);
  assert.deepEqual(ownControls({ ...shown, mode: 'edit', controls }), []);
});

test('printers are listed by name, generic ones first', () => {
  const isGeneric = printers.map(({ key }) => key.startsWith('generic'));
  assert.ok(isGeneric[0]);
  assert.equal(isGeneric.lastIndexOf(true), isGeneric.indexOf(false) - 1);
  const names = printers.filter((_, k) => isGeneric[k] === false).map(({ label }) => label);
  assert.deepEqual(
    names,
    [...names].sort((a, b) => a.localeCompare(b, 'en')),
  );
});
