// Layers of plates: what the package hands to the engine, and what it says where that cannot be.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { createEngine } from 'sillon';

import { copyEngine } from './support/engine-copy.js';
import { turning } from './support/jobs.js';
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
    { kind: 'code', text: 'SILLON', at: [10, 10] },
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
    { kind: 'code', text: 'SILLON', size: [26, 0], at: [40, 15] },
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
    pictures: [{ file: { width: side, height: side, channels: 1, samples }, lamp: [60, 45] }],
    size: [24, 24],
  };
  const layers = [{ kind: 'direction', angle: 10 }, layer];
  const { report } = await engine.generateToolpath({ shape, layers, pictures: { corrections: 0 } });
  assert.equal(report.pictures.length, 1);
  const [{ layer: number, lamp, r }] = report.pictures;
  assert.equal(number, 2);
  assert.deepEqual(lamp, [60, 45]);
  assert.ok(r > 0.5, `r is ${r}`);
});

const angleOf = (degrees) => Math.round(((degrees + 90) / 180) * 65535);
const constrained = 3;

test('one direction for all is drawn as one texel, and no layer as 0 degrees', async () => {
  const one = (...layers) => engine.drawLayers({ shape, layers });
  for (const [layers, degrees, mode] of [
    [[], 0, constrained],
    [[{ kind: 'direction', angle: 30 }], 30, constrained],
    [[{ kind: 'direction', angle: -45, mode: 'smoothest' }], -45, 2],
  ]) {
    const { angle, mode: modes, ...size } = await one(...layers);
    assert.deepEqual(size, { width: 1, height: 1 });
    assert.ok(angle instanceof Uint16Array && modes instanceof Uint8Array);
    assert.ok(angle.length === 1 && Math.abs(angle[0] - angleOf(degrees)) <= 1, `${angle} for ${degrees}`);
    assert.deepEqual([...modes], [mode]);
  }
  assert.deepEqual(await engine.drawLayers({ shape }), await one());
});

test('layers are drawn in quarters of the spacing, each where it lies', async () => {
  const layers = [
    { kind: 'direction', angle: 20 },
    { kind: 'direction', angle: 70, mode: 'parallel', size: [30, 30], at: [15, 15] },
    { kind: 'text', text: 'I', textSize: 12, at: [45, 15], fill: 'angle', angle: -40 },
  ];
  const { width, height, angle, mode } = await engine.drawLayers({ shape, layers }, { spacing: 0.8 });
  assert.deepEqual([width, height, angle.length, mode.length], [300, 150, 45000, 45000]);
  const at = (x, y) => 300 * Math.floor(149.99 - 5 * y) + Math.floor(5 * x); // [mm] from the lower left corner
  const near = (k, degrees) => Math.abs(angle[k] - angleOf(degrees)) <= 1;
  assert.ok(near(at(5, 5), 70) && near(at(29.5, 29.5), 70) && near(at(30.5, 15), 20) && near(at(45, 15), -40));
  assert.deepEqual([mode[at(5, 5)], mode[at(45, 2)], mode[at(45, 15)]], [0, constrained, constrained]);
  const count = (degrees) => angle.reduce((sum, _, k) => sum + (near(k, degrees) ? 1 : 0), 0);
  assert.equal(count(70), 22500);
  assert.ok(count(-40) > 25 * 12 && count(-40) < 25 * 12 * 4, count(-40)); // a stem of 12 mm, 1 to 4 mm wide
  assert.equal(count(20) + count(-40), 22500);
  assert.equal((await engine.drawLayers({ shape, layers }, { spacing: 0.4 })).width, 600);
});

test('pictures of directions and of modes may have other sizes, and both are drawn', async () => {
  const lines = { width: 4, height: 2, channels: 1, samples: Uint16Array.of(0, 9, 99, 999, 9999, 2, 3, 65535) };
  const modes = { width: 2, height: 4, channels: 1, samples: Uint8Array.of(0, 85, 170, 255, 255, 170, 85, 0) };
  const both = await engine.drawLayers({ shape, layers: [{ kind: 'map', file: lines, modeFile: modes }] });
  assert.deepEqual(both, {
    width: 4,
    height: 4,
    angle: Uint16Array.of(0, 9, 99, 999, 0, 9, 99, 999, 9999, 2, 3, 65535, 9999, 2, 3, 65535),
    mode: Uint8Array.of(0, 0, 1, 1, 2, 2, 3, 3, 3, 3, 2, 2, 1, 1, 0, 0),
  });
  const alone = await engine.drawLayers({ shape, layers: [{ kind: 'direction', modeFile: modes }] });
  assert.deepEqual([alone.width, alone.height, [...alone.mode]], [2, 4, [0, 1, 2, 3, 3, 2, 1, 0]]);
  assert.equal(new Set(alone.angle).size, 1);
});

test('what is drawn is what the plate is made from', async () => {
  const layers = [
    { kind: 'pattern', pattern: 'waves', amplitude: 35 },
    { kind: 'border', width: 4, fill: 'along' },
    { kind: 'text', text: 'HI', textSize: 12, fill: 'across', soft: 1 },
    { kind: 'direction', mode: 'smoothest', size: [10, 10], at: [50, 15] },
    { kind: 'strokes', strokes: [{ radius: 4, points: [5, 5, 20, 25] }] },
  ];
  const { width, height, angle, mode } = await engine.drawLayers({ shape, layers }, { spacing: 0.8 });
  const picture = (samples) => ({ width, height, channels: 1, samples });
  const modeFile = picture(Uint8Array.from(mode, (number) => 85 * number));
  assert.equal(await digest({ kind: 'map', file: picture(angle), modeFile }), await digest(...layers));
  const turned = angle.with(Math.floor(angle.length / 2), 0);
  assert.notEqual(await digest({ kind: 'map', file: picture(turned.fill(9)), modeFile }), await digest(...layers));
});

test('a drawing is painted in its colours, letters and all', async () => {
  const drawing = (inside) => new Blob([`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10">${inside}</svg>`]);
  const blue = '<rect width="10" height="10" fill="#0000ff"/>';
  const { width, height, channels, samples } = await engine.paintDrawing(drawing(blue));
  assert.deepEqual([width, height, channels], [1024, 512, 4]);
  const pixel = (x, y) => [...samples.subarray(4 * (1024 * y + x), 4 * (1024 * y + x) + 4)];
  assert.deepEqual(
    [pixel(100, 256), pixel(900, 256)],
    [
      [0, 0, 65535, 65535],
      [0, 0, 0, 0],
    ],
  );
  const lettered = await engine.paintDrawing(drawing(`${blue}<text x="11" y="9" font-size="9" fill="#f00">I</text>`));
  const red = lettered.samples.filter((sample, k) => k % 4 === 0 && sample === 65535).length;
  assert.ok(red > 2000 && red < 60_000, `${red} red pixels`);
  await assert.rejects(engine.paintDrawing(drawing('')), { code: 'EmptyShape' });
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
    [[{ kind: 'code', text: 'x'.repeat(3000) }], /the text has 3000 bytes; no QR code/],
    [[{ kind: 'drawing' }], /^layers\[0\]\.file is empty/],
    [[{ kind: 'cloud' }], /^layers\[0\]\.kind is "cloud"/],
    [[{ kind: 'qr', text: 'x' }], /^layers\[0\]\.kind is "qr"; .*"code"/],
    [[{ ...text, size: [-1, 0] }], /^layers\[0\]\.size\.x is -1 mm/],
    [[{ ...text, colour: 'red' }], /unknown key "layers\[0\]\.colour"/],
    // A key that another kind has.
    [
      [text, { ...text, waveLength: 3 }],
      /^layers\[1\]\.waveLength is not for the kind "text"; it has kind, visible, at,/,
    ],
    [[{ kind: 'direction', pictures: [] }], /^layers\[0\]\.pictures is not for the kind "direction"/],
    [[{ kind: 'picture', file: turning(8, 8) }], /^layers\[0\]\.file is not for the kind "picture"/],
    [[{ kind: 'border', font: 'Nunito' }], /^layers\[0\]\.font is not for the kind "border"/],
    [[{ kind: 'picture', pictures: [] }], /layers\[0\]\.pictures/],
    [[{ kind: 'map' }], /layers\[0\]\.file is empty/],
    ['letters', /^layers is "letters"; it must be a list/],
    [Array.from({ length: 33 }, () => text), /layers has 33 entries; it may have up to 32/],
  ];
  for (const [layers, message] of cases) {
    await assert.rejects(engine.generateToolpath({ shape, layers }), { name: 'SillonError', message });
  }
});
