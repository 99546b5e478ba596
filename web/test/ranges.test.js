// The ends of each setting's range, and one step past them: the command line, project files, the npm package and the
// studio all say the same.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { createEngine } from 'sillon';

import { accepts, settings as studioSettings } from '../build/unit/web/src/model/settings.js';

const program = fileURLToPath(new URL('../../build/release/sillon', import.meta.url));
assert.ok(existsSync(program), `${program} is missing: ./dev build release sillon`);

const folder = mkdtempSync(join(tmpdir(), 'sillon-ranges-'));
let engine;
before(async () => (engine = await createEngine({ threads: 'off' })));
after(async () => {
  await engine.dispose();
  rmSync(folder, { recursive: true });
});

const said = (...words) => {
  const { status, stderr } = spawnSync(program, words, { cwd: folder, encoding: 'utf8' });
  assert.equal(status, 2, `${words.join(' ')}: ${stderr}`);
  return stderr;
};

const { settings } = JSON.parse(spawnSync(program, ['settings', '--json'], { encoding: 'utf8' }).stdout);
const rows = settings.filter(({ low }) => low !== undefined);

/** The name in messages, which number layers. */
const nameOf = ({ section, key }) => `${section === 'layers' ? 'layers[0]' : section}.${key}`;

const wholeOf = ({ type }) => type.startsWith('integer');
const pairOf = ({ type }) => type.endsWith('pair');

/** The next number that a double can be. */
function next(value, up) {
  if (value === 0) return up ? Number.MIN_VALUE : -Number.MIN_VALUE;
  const bits = new BigInt64Array(1);
  const number = new Float64Array(bits.buffer);
  number[0] = value;
  bits[0] += value > 0 === up ? 1n : -1n;
  return number[0];
}

/** [value, allowed] of all four. A seed of more than 2^53 - 1 is no number of JavaScript; errors.test.js tells of it. */
function* trials(row) {
  const past = (value, up) => (wholeOf(row) ? value + (up ? 1 : -1) : next(value, up));
  yield [past(row.low, false), false];
  if (!['bedMax', 'cropMax'].includes(row.key)) yield [row.low, true]; // no other corner could be left of it
  if (row.key === 'seed') return;
  if (!['bedMin', 'cropMin'].includes(row.key)) yield [row.high, true];
  yield [past(row.high, true), false];
}

/** What the rules between settings ask for besides. */
function besides(row, value) {
  if (row.key.toLowerCase().endsWith('temperature')) return { generalHeatLimits: true };
  if (row.key === 'bedMin') return { bedMax: [1, 1].map(() => Math.min(value + 10, 5000)) };
  if (row.key === 'bedMax') return { bedMin: [1, 1].map(() => Math.max(value - 5000, -5000)) };
  return {};
}

/** A layer of the first kind that has the setting, and with what such a layer needs. */
const layerWith = ({ kinds: [kind] = ['direction'] }, fields) => ({
  ...{ kind, ...(kind === 'picture' ? { pictures: [{ file: 'missing.png' }] } : {}) },
  ...(['map', 'tones', 'drawing'].includes(kind) ? { file: 'missing.png' } : {}),
  ...(['text', 'code'].includes(kind) ? { text: 'A' } : {}),
  ...fields,
});

const projectOf = (row, value) => {
  const fields = { ...besides(row, value), [row.key]: pairOf(row) ? [value, value] : value };
  return { [row.section]: row.section === 'layers' ? [layerWith(row, fields)] : fields };
};

/** Whether text tells of the setting, or of what comes after all settings were read. */
function verdict(row, text, afterwards) {
  const refused = text.includes(nameOf(row)) || text.includes(`${row.option} is `);
  assert.notEqual(refused, text.includes(afterwards), text);
  if (refused) assert.match(text, /must be/, text);
  return !refused;
}

const doors = {
  'project file': (row, value) => {
    const project = { sillon: 1, ...projectOf(row, value) };
    // A file that is missing is looked for only after all settings are known to be right.
    if (row.section === 'shape') {
      project.layers = [{ kind: 'map', file: 'missing.png' }];
      project.shape.builtin = 'rectangle';
    } else {
      project.shape = { file: 'missing.svg' };
    }
    writeFileSync(join(folder, 'project.json'), JSON.stringify(project));
    return verdict(row, said('generate', 'project.json', '--gcode', 'x.gcode'), '"missing.');
  },
  'command line': (row, value) => {
    // --bed takes a size, and the field is a corner; --size takes no 0, which leaves the size open in files.
    if (row.option === undefined || ['--bed', '--size'].includes(row.option)) return undefined;
    const separator = row.option === '--place' ? ',' : 'x';
    const word = pairOf(row) ? `${value}${separator}${value}` : String(value);
    const shape =
      row.section === 'shape' ? ['--shape', 'rounded', '--directions', 'missing.png'] : ['--shape', 'missing.svg'];
    return verdict(row, said('generate', ...shape, `${row.option}=${word}`, '--gcode', 'x.gcode'), '"missing.');
  },
};

const packageDoors = {
  'readProject of the package': (row, value) =>
    engine.readProject(JSON.stringify({ sillon: 1, ...projectOf(row, value) })),
  'writeProject of the package': (row, value) => engine.writeProject(projectOf(row, value)),
};

for (const [name, door] of Object.entries(doors)) {
  test(`ranges of the ${name}`, () => {
    let compared = 0;
    for (const row of rows) {
      for (const [value, allowed] of trials(row)) {
        const got = door(row, value);
        if (got === undefined) continue;
        assert.equal(got, allowed, `${row.section}.${row.key} ${value}`);
        ++compared;
      }
    }
    assert.ok(compared > 100, `${compared} compared`);
  });
}

for (const [name, door] of Object.entries(packageDoors)) {
  test(`ranges of ${name}`, async () => {
    let compared = 0;
    for (const row of rows) {
      for (const [value, allowed] of trials(row)) {
        const error = await Promise.resolve(door(row, value)).then(
          () => undefined,
          (reason) => reason,
        );
        const what = `${row.section}.${row.key} ${value}: ${error?.message}`;
        assert.equal(error === undefined, allowed, what);
        if (error !== undefined) {
          assert.ok(error.message.includes(nameOf(row)), what);
        }
        ++compared;
      }
    }
    assert.ok(compared > 200, `${compared} compared`);
  });
}

test("ranges of the studio's fields", () => {
  let compared = 0;
  for (const setting of studioSettings) {
    const row = rows.find(({ section, key }) => setting.section === section && setting.key === key);
    assert.equal(row !== undefined, 'min' in setting, setting.id);
    if (row === undefined) continue;
    for (const [value, allowed] of trials(row)) {
      assert.equal(accepts(setting, pairOf(row) ? [value, value] : value), allowed, `${setting.id} ${value}`);
      ++compared;
    }
  }
  assert.ok(compared > 200, `${compared} compared`);
});
