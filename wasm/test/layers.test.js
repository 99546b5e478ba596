// Layers of plates: what the package hands to the engine, and what it says where that cannot be.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { createEngine } from 'sillon';

import { copyEngine } from './support/engine-copy.js';
import { engineFolder } from './support/pages.js';
import { nativeProgram, root } from './support/projects.js';

const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
let engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
  rmSync(folder, { recursive: true });
});

const shape = { builtin: 'rectangle', size: [60, 30] };
const make = (...layers) => engine.generateToolpath({ shape, layers }, { spacing: 0.8 }, { measure: false });
const place = (...layers) => engine.placeLayers({ shape, layers });
const digest = async (...layers) => (await make(...layers)).report.digest;

/** What the native program reports of these layers. */
function native(...layers) {
  const [project, report] = ['project.json', 'report.json'].map((name) => join(folder, name));
  writeFileSync(project, JSON.stringify({ sillon: 1, shape, layers, toolpath: { spacing: 0.8 } }));
  const { status, stderr } = spawnSync(nativeProgram, ['generate', project, '--report', report], { encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  return JSON.parse(readFileSync(report, 'utf8'));
}

test('boxes of layers are told without a plate', async () => {
  const [letters, code, box] = await place(
    { kind: 'text', text: 'HH', textSize: 10 },
    { kind: 'qr', text: 'SILLON', at: [10, 10] },
    { kind: 'direction', angle: 20, size: [8, 4], visible: false },
  );
  assert.deepEqual(letters.at, [30, 15]);
  assert.ok(Math.abs(letters.size[1] - 10) < 0.01 && letters.size[0] > 12 && letters.size[0] < 20);
  assert.deepEqual(code, { at: [10, 10], size: [18, 18], thin: 0 });
  assert.deepEqual(box.size, [8, 4]);
  const [small] = await place({ kind: 'text', text: 'HH', textSize: 1.5 });
  assert.ok(small.thin > 0.5);
});

test('a layer that cannot be drawn keeps no other from its box, and the spacing tells what is thin', async () => {
  const text = { kind: 'text', text: 'HH', textSize: 4 };
  const [broken, whole] = await place({ ...text, text: '字', at: [9, 8], size: [7, 6] }, text);
  assert.match(broken.problem, /^layers\[0\]: no font has a letter for "字" \(U\+5B57\)/);
  assert.deepEqual(
    [broken.at, broken.size],
    [
      [9, 8],
      [7, 6],
    ],
  );
  assert.equal(whole.problem, undefined);
  const thin = async (spacing) => (await engine.placeLayers({ shape, layers: [text] }, { spacing }))[0].thin;
  assert.ok((await thin(0.8)) > (await thin(0.2)) + 0.3);
});

test('the report tells how much of each layer is seen, and whether codes can be read', async () => {
  const { report } = await make(
    { kind: 'text', text: 'HH', at: [0, 15] },
    { kind: 'qr', text: 'SILLON', size: [26, 0], at: [40, 15] },
    { kind: 'direction', visible: false },
    { kind: 'direction', size: [9, 9], at: [40, 15], angle: 45 },
  );
  const [letters, code, box] = report.layers;
  assert.ok(Math.abs(letters.beside - 0.5) < 0.02, letters.beside);
  assert.equal(letters.readable, undefined);
  assert.equal(code.readable, false);
  assert.ok(Math.abs(code.covered - (9 / 26) ** 2) < 0.01, code.covered);
  assert.deepEqual(box, { layer: 4, beside: 0, underRim: 0, covered: 0, alike: 0 });
  assert.deepEqual(
    report.warnings.map(({ code, values }) => [code, values.layer]),
    [
      ['LayerBeside', 1],
      ['LayerCovered', 2],
      ['LayerUnreadable', 2],
    ],
  );
});

test('text of drawings is set in built-in fonts, as the native program does', async () => {
  const drawing = (text) =>
    `<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="30mm" viewBox="0 0 60 30">${text}</svg>`;
  const inside = async (file) => engine.readShape({ file });
  const text = '<text x="5" y="20" font-size="12" font-family="Caveat">Ab <tspan>cd</tspan></text>';
  const shape = await inside(drawing(text));
  assert.equal(shape.paths.length, 4);
  assert.equal(shape.texts, 0);
  assert.deepEqual(await inside(new Blob([drawing(text)])), shape);
  assert.deepEqual(await inside(new TextEncoder().encode(drawing(text))), shape);
  assert.equal((await inside(drawing(text.replace('Caveat', 'Arial')))).otherFont, true);
  const layer = { kind: 'drawing', file: drawing(text), fill: 'along' };
  assert.notEqual(await digest(layer), await digest());
});

test('lines that run both ways are those of the native program', async () => {
  for (const text of ['רחוב הרצל 12', 'Anna (א-ב) 3:4', '\u202BA 1,5% ב\u202C!', 'ב\t[A] 7']) {
    const layer = { kind: 'text', font: 'Fredoka', text, textSize: 7, fill: 'across' };
    assert.equal(await digest(layer), native(layer).digest, text);
  }
});

test('a layer with a letter that no font has is left out alone, as in the native program', async () => {
  const plain = { kind: 'direction', angle: 30, size: [20, 20] };
  const told = async (layer) => {
    const { report } = await make(plain, layer);
    const expected = native(plain, layer);
    assert.equal(report.digest, expected.digest);
    const ofLetters = ({ warnings }) => warnings.filter(({ code }) => /^Layer(Le|Only)/.test(code));
    assert.deepEqual(ofLetters(report), ofLetters(expected));
    return ofLetters(report).map(({ message }) => message);
  };
  const text = { kind: 'text', text: 'Anna 漢', textSize: 7, fill: 'across' };
  assert.deepEqual(await told(text), ['layer 2 is left out: no font has a letter for "漢" (U+6F22)']);
  assert.equal(await digest(plain, text), await digest(plain));
  const lent = await told({ ...text, text: 'Anna אΕ 12' });
  assert.match(lent.join(), /the letters "א" \(U\+05D0\) of layer 2 come from Fredoka: .*"Ε" \(U\+0395\).*Roboto Slab/);
  assert.deepEqual(await told({ ...text, visible: false }), []);
  assert.equal(await digest(plain, { kind: 'drawing', visible: false }), await digest(plain));
});

test('the report tells how alike the pictures of layers are', async () => {
  const side = 32;
  const samples = Uint8Array.from({ length: side * side }, (_, k) => (k % side) * 8);
  const layer = {
    kind: 'picture',
    file: { width: side, height: side, channels: 1, samples },
    size: [24, 24],
    lamp: [60, 45],
  };
  const layers = [{ kind: 'direction', angle: 10 }, layer];
  const { report } = await engine.generateToolpath({ shape, layers, pictures: { files: [], corrections: 0 } });
  assert.equal(report.layerPictures.length, 1);
  const [{ layer: number, lamp, r }] = report.layerPictures;
  assert.equal(number, 2);
  assert.deepEqual(lamp, [60, 45]);
  assert.ok(r > 0.5, `r is ${r}`);
});

test('a font as bytes makes the letters of the built-in one', async () => {
  const font = readFileSync(join(root, 'core/data/fonts/fredoka.ttf'));
  const text = { kind: 'text', text: 'Sil\nlon', angle: 90 };
  const builtin = await digest({ ...text, font: 'Fredoka' });
  assert.equal(await digest({ ...text, font }), builtin);
  assert.equal(await digest({ ...text, font: new Blob([font]) }), builtin);
  assert.notEqual(await digest({ ...text, font: 'Caveat' }), builtin);
});

test('a font that could not be loaded is loaded by the next call', async () => {
  const copy = copyEngine({ 'nunito.ttf': null });
  const other = await createEngine({ threads: 'off', assetBase: copy.folder });
  try {
    const plate = { shape, layers: [{ kind: 'text', text: 'A' }] };
    const lacks = { code: 'LoadFailed', message: /nunito\.ttf could not be read/ };
    for (let k = 0; k < 2; ++k) await assert.rejects(other.generateToolpath(plate), lacks);
    copyFileSync(join(engineFolder, 'nunito.ttf'), join(copy.folder, 'nunito.ttf'));
    const { report } = await other.generateToolpath(plate, { spacing: 0.8 }, { measure: false });
    assert.equal(report.digest, await digest(...plate.layers));
  } finally {
    other.dispose();
    copy.remove();
  }
});

test('drawings come as text or as bytes', async () => {
  const svg =
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9" width="9mm"><circle cx="4" cy="4" r="4"/></svg>';
  const layer = { kind: 'drawing', fill: 'across' };
  assert.equal(await digest({ ...layer, file: svg }), await digest({ ...layer, file: new TextEncoder().encode(svg) }));
});

test('what cannot be drawn is refused with the number of its layer', async () => {
  const text = { kind: 'text', text: 'A' };
  const cases = [
    [[text, { ...text, text: '' }], /^layers\[1\]\.text is empty/],
    [[{ ...text, font: new Uint8Array([1, 2, 3]) }], /is no font; it must be a TrueType or OpenType file/],
    [
      [{ ...text, font: 'Comic' }],
      /the font is "Comic"; it must be a file that is handed over, or one of Nunito, Bebas Neue/,
    ],
    [[{ kind: 'qr', text: 'x'.repeat(3000) }], /the text has 3000 bytes; no QR code/],
    [[{ kind: 'drawing' }], /^layers\[0\]\.file is empty/],
    [[{ kind: 'cloud' }], /^layers\[0\]\.kind is "cloud"/],
    [[{ ...text, size: [-1, 0] }], /^layers\[0\]\.size\.x is -1 mm/],
    [[{ ...text, colour: 'red' }], /unknown key "layers\[0\]\.colour"/],
    ['letters', /^layers is "letters"; it must be a list/],
    [Array.from({ length: 33 }, () => text), /layers has 33 entries; it may have up to 32/],
  ];
  for (const [layers, message] of cases) {
    await assert.rejects(engine.generateToolpath({ shape, layers }), { name: 'SillonError', message });
  }
});
