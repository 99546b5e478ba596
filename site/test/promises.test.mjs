// Each promise of docs/internals/promises.md names tests that are there, and can be broken so that one of them fails:
// tests/break_promises.mjs does that, which takes long; here its list is held together with the page and the source.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { breaks, testFile, unbroken } from '../../tests/promises.mjs';
import { root } from '../pages.mjs';

const read = (path) => readFileSync(join(root, path), 'utf8');
const rows = [...read('docs/internals/promises.md').matchAll(/^\| (.*) \| (.*) \|$/gm)]
  .slice(1)
  .map(([, promise, told]) => ({ promise, names: [...told.matchAll(/`([\w./-]+\w)`/g)].map(([, name]) => name) }));
const rowOf = (beginning) => rows.filter(({ promise }) => promise.startsWith(beginning));

test('every test that a promise names is there', () => {
  assert.ok(rows.length > 30);
  const places = (name) => [testFile(name), name, `tests/${name}`];
  const missing = rows.flatMap(({ names }) =>
    names.filter((name) => !places(name).some((at) => existsSync(join(root, at)))),
  );
  assert.deepEqual(missing, []);
});

test('every promise has a break, or a reason why it has none', () => {
  const beginnings = [...breaks.map(({ promise }) => promise), ...Object.keys(unbroken)];
  for (const beginning of beginnings) assert.equal(rowOf(beginning).length, 1, beginning);
  const left = rows.filter(({ promise }) => !beginnings.some((beginning) => promise.startsWith(beginning)));
  assert.deepEqual(left, []);
  for (const beginning of Object.keys(unbroken))
    assert.ok(!breaks.some(({ promise }) => promise === beginning), beginning);
});

for (const { promise, test: name, only, file, text, broken } of breaks) {
  test(`what breaks in ${file}, and the case in ${name} that notices it, are there`, () => {
    assert.equal(read(file).split(text).length, 2, text);
    assert.notEqual(text, broken);
    assert.ok(rowOf(promise)[0].names.includes(name), `"${promise}" does not name ${name}`);
    if (only !== undefined) assert.ok(read(testFile(name)).includes(only.replace(/\*$/, '')), only);
  });
}
