// Files as other people have them, each of which stands for a kind, and what is right for it: tests/data/field/*.cases.json.
//
//   node --test tests/cli/field_cases.test.mjs   (SILLON: the program, else the one of ./dev build)
//
// A case: `kind`, the words of its call `run`, and any of
//   exit      the exit code [0]
//   says      texts that are in what it prints
//   silent    texts that are not
//   areaMm2   of the outline, for `shape` [within 0.2 %]
//   ink       least x, greatest x, least y, greatest y of the outline from the page's upper left corner [mm, within 0.25]
//   writes    names of files it writes, each with texts that are in it; a text that begins with ! is not
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const program = process.env.SILLON ?? fileURLToPath(new URL('../../build/release/sillon', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sillon-field-'));
cpSync(fileURLToPath(new URL('../data/field', import.meta.url)), folder, { recursive: true });
after(() => rmSync(folder, { recursive: true }));

const call = (words) => spawnSync(program, words.split(' '), { cwd: folder, encoding: 'latin1' });

function inkOf(outline) {
  const numbers = outline.match(/-?[\d.]+/g).map(Number);
  return [0, 1].flatMap((axis) => {
    const along = numbers.filter((_, k) => k % 2 === axis);
    return [Math.min(...along), Math.max(...along)];
  });
}

const cases = readdirSync(folder)
  .filter((name) => name.endsWith('.cases.json'))
  .flatMap((name) => JSON.parse(readFileSync(join(folder, name), 'utf8')));
for (const { kind, run, exit = 0, says = [], silent = [], areaMm2, ink, writes = {} } of cases) {
  test(`${kind}: ${run}`, () => {
    const { status, stdout, stderr } = call(run);
    const told = Buffer.from(stdout + stderr, 'latin1').toString();
    assert.equal(status, exit, told);
    for (const text of says) assert.ok(told.includes(text), `not said: ${text}\n${told}`);
    for (const text of silent) assert.ok(!told.includes(text), `said: ${text}\n${told}`);
    for (const [name, texts] of Object.entries(writes)) {
      const written = readFileSync(join(folder, name), 'utf8');
      for (const text of texts) {
        const absent = text.startsWith('!');
        assert.equal(written.includes(absent ? text.slice(1) : text), !absent, `${name}: ${text}`);
      }
    }
    if (areaMm2 === undefined && ink === undefined) return;
    const shape = JSON.parse(call(`${run} --json --outline`).stdout);
    if (areaMm2 !== undefined) assert.ok(Math.abs(shape.areaMm2 - areaMm2) <= 0.002 * areaMm2, `${shape.areaMm2} mm²`);
    const found = ink === undefined ? [] : inkOf(shape.outline);
    ink?.forEach((place, k) => assert.ok(Math.abs(place - found[k]) <= 0.25, found.map((one) => one.toFixed(2)).join(' ')));
  });
}
