// Letters that JavaScript sets, without the engine.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { root } from './support/projects.js';

const { textRuns } = await import(join(root, 'wasm/dist/engine/text.js'));

const bidiTest = '/usr/share/unicode/BidiCharacterTest.txt';
const lacksTest = existsSync(bidiTest) ? false : `no ${bidiTest}; Debian's package unicode-data has it`;

test("letters stand in the order of Unicode's own test of the bidirectional algorithm", { skip: lacksTest }, () => {
  const lines = readFileSync(bidiTest, 'utf8')
    .split('\n')
    .filter((line) => /^[^#]/.test(line));
  for (const line of lines) {
    const [codes, , level, levels, order] = line.split(';');
    // A mark in front makes the direction that the line is given the one that its first strong letter tells.
    const letters = codes.split(' ').map((code) => String.fromCodePoint(parseInt(code, 16)));
    const text = (level === '0' ? '\u200E' : '\u200F') + letters.join('');
    const seen = textRuns(text)
      .flatMap(({ begin, end, toLeft }) =>
        Array.from({ length: end - begin }, (_, k) => ({ at: (toLeft ? end - 1 - k : begin + k) - 1, toLeft })),
      )
      .filter(({ at }) => at >= 0 && levels.split(' ')[at] !== 'x');
    assert.equal(seen.map(({ at }) => at).join(' '), order, line);
    for (const { at, toLeft } of seen) assert.equal(toLeft, levels.split(' ')[at] % 2 === 1, line);
  }
  assert.ok(lines.length > 90000);
});

test('a line is split where its sense or its script changes', () => {
  const runs = (line) => textRuns(line).map(({ begin, end, toLeft }) => [begin, end, toLeft]);
  assert.deepEqual(runs(''), []);
  assert.deepEqual(runs('Anna (12)'), [[0, 9, false]]);
  assert.deepEqual(runs('א 12'), [
    [2, 4, false],
    [0, 2, true],
  ]);
  assert.deepEqual(runs('A, Δ.'), [
    [0, 3, false],
    [3, 5, false],
  ]);
  assert.deepEqual(runs('א ا'), [
    [2, 3, true],
    [0, 2, true],
  ]);
  assert.deepEqual(runs('\u{10900} \u{1F600} A'), [
    [6, 7, false],
    [0, 6, true],
  ]);
  assert.deepEqual(runs(`${'א'.repeat(4096)}ב`), [
    [0, 4096, true],
    [4096, 4097, true],
  ]);
});
