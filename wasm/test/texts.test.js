// Letters that JavaScript sets, without the engine.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { root } from './support/projects.js';

const { forget, shapeLine, start, textRuns } = await import(join(root, 'wasm/dist/engine/text.js'));
const { Texts } = await import(join(root, 'wasm/dist/texts.js'));

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

const nunito = { name: 'Nunito', bytes: readFileSync(join(root, 'core/data/fonts/nunito.ttf')) };
const startTools = () => start(() => Promise.resolve(readFileSync(join(root, 'wasm/dist/engine/harfbuzz.wasm'))));

test('as many lines are set as anybody asks for, in a memory of one font', async () => {
  await startTools();
  for (let k = 0; k < 20_000; ++k) assert.equal(shapeLine(`Label ${k}`, nunito).lacks, false);
});

test('a memory that is left behind is followed by another', async () => {
  await startTools();
  const before = shapeLine('Anna', nunito);
  forget();
  await startTools();
  assert.deepEqual(shapeLine('Anna', nunito), before);
});

test('an error of the library is told with the font, and the next call starts it anew', async () => {
  const script = `data:text/javascript,${encodeURIComponent(`
    export let started = 0, forgotten = 0;
    export const start = () => void (started = Math.max(started, forgotten + 1));
    export const forget = () => void ++forgotten;
    export const plainFont = (file) => file.arrayBuffer().then((bytes) => new Uint8Array(bytes));
    export const shapeLine = (line) => {
      if (line === 'B') throw new RangeError('memory access out of bounds');
      return { started };
    };`)}`;
  const font = new Blob(['font']);
  const texts = new Texts({}, { fonts: {}, text: { script, wasm: '' } }, () => []);
  const made = async (text) => {
    const files = { 'own.ttf': { number: 0, value: font } };
    await texts.addTo(files, { layers: [{ kind: 'text', text, font: 'own.ttf' }] });
    return JSON.parse(new TextDecoder().decode(files[`line:own.ttf\n${text}`].value));
  };
  assert.deepEqual(await made('A'), { started: 1 });
  await assert.rejects(made('B'), {
    name: 'SillonError',
    code: 'TooLarge',
    message:
      'the letters of "own.ttf" cannot be set (memory access out of bounds); take another font, or fewer letters',
  });
  assert.deepEqual(await made('A'), { started: 2 });
});
