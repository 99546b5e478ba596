import assert from 'node:assert/strict';
import { test } from 'node:test';
import { plainName } from '../../src/files/file-name.js';

test('a plate’s name stays readable as a file’s, in every script', () => {
  for (const name of ['Sun and moon', 'हिन्दी', 'ภาษาไทย', 'Ørsted-2 v1.5', '日本語', 'עִבְרִית'])
    assert.equal(plainName(name), name.normalize('NFC'));
  assert.equal(plainName('e\u0301te\u0301'), '\u00e9t\u00e9'); // as macOS writes accents
});

test('what is no name for a file, or would hide it, is left out', () => {
  assert.equal(plainName('a/b\\c:d*?"<>|'), 'abcd');
  assert.equal(plainName('..'), '');
  assert.equal(plainName(' .hidden. '), 'hidden');
  assert.equal(plainName('★'), '');
});
