// Fonts that people bring: the package makes the plates of the native program, which has the same version of HarfBuzz, and
// refuses what that refuses.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { after, before, test } from 'node:test';

import { createEngine } from 'sillon';

import { nativeProgram, openProject, root } from './support/projects.js';

const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
let engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
  rmSync(folder, { recursive: true });
});

/** A plate with the text, as both make it: its digest, or what is wrong with it, without the name of the font. */
async function both(file, text) {
  const path = join(folder, 'plate.json');
  const layers = [{ kind: 'text', text, size: [44, 12], font: basename(file) }];
  const plate = { shape: { builtin: 'rectangle', size: [50, 16] }, toolpath: { spacing: 0.8 }, layers };
  writeFileSync(path, JSON.stringify({ sillon: 1, ...plate }));
  const report = join(folder, 'report.json');
  const { status, stderr } = spawnSync(nativeProgram, ['generate', path, '--report', report, '--quiet'], {
    encoding: 'utf8',
  });
  const refusal = (sentence) =>
    sentence
      .trim()
      .replace('sillon: ', '')
      .replaceAll(/"[^"]*"/g, '""');
  const native = status === 0 ? JSON.parse(readFileSync(report, 'utf8')).digest : refusal(stderr);
  let here;
  try {
    const { input, project } = await openProject(engine, path);
    here = (await engine.generateToolpath(input, project.toolpath, { measure: false })).report.digest;
  } catch (error) {
    here = refusal(error.message);
  }
  return { native, here };
}

const installed = '/usr/share/fonts';
const brought = {
  'truetype/dejavu/DejaVuSans.ttf': 'VATo Щит',
  'opentype/linux-libertine/LinBiolinum_R.otf': 'Affix Typ',
  'opentype/cantarell/Cantarell-Bold.otf': 'Kärntner AV',
  'opentype/fonts-hosny-amiri/Amiri-Regular.ttf': 'مُحَمَّد لله',
  'truetype/ezra/SILEOT.ttf': 'בְּרֵאשִׁית',
  'truetype/lohit-devanagari/Lohit-Devanagari.ttf': 'क्षत्रिय हिन्दी',
  'truetype/lohit-bengali/Lohit-Bengali.ttf': 'স্ত্রী বাংলা',
  'truetype/lohit-tamil/Lohit-Tamil.ttf': 'தமிழ் கௌ',
  'opentype/tlwg/Loma.otf': 'ที่นี่ น้ำ',
  'truetype/padauk/Padauk-Regular.ttf': 'မြန်မာ က္က',
};
for (const [name, text] of Object.entries(brought)) {
  const file = join(installed, name);
  test(`${basename(name)} makes one plate everywhere`, { skip: !existsSync(file) && `no ${file}` }, async () => {
    copyFileSync(file, join(folder, basename(name)));
    const { native, here } = await both(name, text);
    assert.match(native, /^[0-9a-f]+$/);
    assert.equal(here, native);
  });
}

test('web fonts make the plate of the fonts inside them everywhere, and damaged ones none', async () => {
  const seeds = join(root, 'tests/fuzz/seeds/font');
  for (const name of ['kerned.ttf', 'kerned.woff', 'kerned.woff2']) copyFileSync(join(seeds, name), join(folder, name));
  const plain = await both('kerned.ttf', 'fiAV HÉ');
  for (const name of ['kerned.woff', 'kerned.woff2']) {
    assert.deepEqual(await both(name, 'fiAV HÉ'), { native: plain.native, here: plain.native }, name);
    writeFileSync(join(folder, `cut-${name}`), readFileSync(join(seeds, name)).subarray(0, 900));
    const { native, here } = await both(`cut-${name}`, 'A');
    assert.match(native, /is no font/);
    assert.equal(here, native, name);
  }
});

test('letters of fonts in colour are the same everywhere', async () => {
  for (const name of ['layers.ttf', 'painted.ttf']) {
    copyFileSync(join(root, 'tests/fuzz/seeds/font', name), join(folder, name));
    const { native, here } = await both(name, 'HT');
    assert.match(native, /^[0-9a-f]+$/);
    assert.equal(here, native, name);
  }
});

test('a font that makes of each letter as many as it can is one thing everywhere', async () => {
  copyFileSync(join(root, 'tests/fuzz/seeds/font/growing.ttf'), join(folder, 'growing.ttf'));
  for (const text of ['A', 'HAB', 'A'.repeat(40)]) {
    const { native, here } = await both('growing.ttf', text);
    assert.equal(here, native, text);
  }
});

test('damaged fonts make the same plate everywhere, or none', async () => {
  const whole = ['roboto-slab', 'caveat'].map((name) => readFileSync(join(root, `core/data/fonts/${name}.ttf`)));
  let seed = 1;
  const below = (bound) => (seed = (48271 * seed) % 2147483647) % bound;
  let made = 0;
  for (let k = 0; k < 16; k++) {
    const font = Buffer.from(whole[k % 2]);
    // In the tables of shaping, outlines and letters, where most fonts are as they should be.
    const tables = Array.from({ length: font.readUInt16BE(4) }, (_, row) => 12 + 16 * row)
      .filter((at) => /GSUB|GPOS|GDEF|cmap|glyf|loca|hmtx/.test(font.toString('latin1', at, at + 4)))
      .map((at) => [font.readUInt32BE(at + 8), font.readUInt32BE(at + 12)]);
    const [offset, length] = tables[below(tables.length)];
    for (let n = 0; n < 1 + 8 * (k % 4); n++) font[offset + below(length)] = below(256);
    writeFileSync(join(folder, 'damaged.ttf'), font);
    const { native, here } = await both('damaged.ttf', 'AVATo fi');
    assert.equal(here, native, `the font of try ${k}`);
    if (/^[0-9a-f]+$/.test(native)) made++;
  }
  assert.ok(made > 4, `only ${made} of 16 make a plate`);
});
