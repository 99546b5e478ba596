// Whatever is handed over, the answer is a SillonError that names it, and the engine goes on.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { SillonError, createEngine } from 'sillon';

import { copyEngine } from './support/engine-copy.js';
import { small, turning } from './support/jobs.js';
import { threadsHaveScript } from './support/pages.js';
import { png } from './support/png.js';

let engine;
let plate;

before(async () => {
  engine = await createEngine({ threads: 'off' });
  plate = await engine.generateToolpath(...small);
});
after(() => engine.dispose());

const detached = (bytes) => {
  structuredClone(bytes.buffer, { transfer: [bytes.buffer] });
  return bytes;
};
const disc = { builtin: 'disc', size: [10, 10] };
const square = {
  page: [9, 9],
  paths: [{ fillRule: 'nonzero', rings: [Float64Array.from([0, 0, 9, 0, 9, 9, 0, 9])] }],
};
const picture = turning(8, 8);
const goodPng = png(8, 8, 1, picture.samples);
const noise = Uint8Array.from({ length: 300 }, (_, k) => (k * k * 31 + 7) & 255);
const cyclic = { layers: 2 };
cyclic.self = cyclic;
let deep = {};
for (let k = 0; k < 1e5; ++k) deep = { deep };

const generate = (input, params, options) => () => engine.generateToolpath(input, params, options);
const withShape = (file, more) => generate({ shape: { file, ...more } });
const withDirections = (file, more) => generate({ shape: disc, layers: [{ kind: 'map', file, ...more }] });
const withPath = (changes) => () => engine.writeSvg({ ...plate.toolpath, ...changes });
const withCycle = (changes) => () => withPath({ cycles: [{ ...plate.toolpath.cycles[0], ...changes }] })();
const withRing = (ring) => withPath({ shape: { page: [10, 10], paths: [{ fillRule: 'evenodd', rings: [ring] }] } });
const gcode = (printer, print, options) => () => engine.writeGcode(plate.toolpath, printer, print, options);

// What is done, the code, and what the message must say.
const cases = {
  'wrong types': [
    [generate(undefined), 'InvalidArgument', /^input is undefined; it must be an object$/],
    [generate(null), 'InvalidArgument', /^input is null/],
    [generate('disc'), 'InvalidArgument', /^input is "disc"/],
    [generate([]), 'InvalidArgument', /^input is a list/],
    [generate({ shape: 'leaf.svg' }), 'InvalidArgument', /^shape is "leaf.svg"; it must be an object/],
    [generate({ shape: disc, layers: 7 }), 'InvalidArgument', /^layers is 7; it must be a list/],
    [generate({ shape: disc, layers: [7] }), 'InvalidArgument', /^layers\[0\] is 7; it must be an object/],
    [generate({ shape: disc, pictures: 7 }), 'InvalidArgument', /^pictures is 7; it must be an object/],
    [
      generate({ shape: disc, layers: [{ kind: 'picture', pictures: 7 }] }),
      'InvalidArgument',
      /^layers\[0\]\.pictures is 7; it must be a list/,
    ],
    [generate({ shape: disc }, 0.4), 'InvalidArgument', /^params is 0.4/],
    [
      generate({ shape: disc }, { spacing: '0.4' }),
      'InvalidArgument',
      /^toolpath\.spacing is of the JSON type string; it must be a number$/,
    ],
    [generate({ shape: disc }, { spacing: 4n }), 'InvalidArgument', /^toolpath\.spacing is a bigint/],
    [generate({ shape: disc }, { spacing: () => 1 }), 'InvalidArgument', /^toolpath\.spacing is a function/],
    [generate({ shape: disc }, { spacing: Symbol('s') }), 'InvalidArgument', /^toolpath\.spacing is a symbol/],
    [generate({ shape: disc }, { bridge: new Map() }), 'InvalidArgument', /^toolpath\.bridge is of type Map/],
    [generate({ shape: { builtin: 'disc', size: 10 } }), 'InvalidArgument', /shape\.size/],
    [generate({ shape: { builtin: 'disc', size: [10] } }), 'InvalidArgument', /shape\.size/],
    [
      generate({ shape: { builtin: 'disc', size: [10, undefined] } }),
      'InvalidArgument',
      /^shape\.size\[1\] is undefined/,
    ],
    [
      generate({ shape: { builtin: 'disc', size: Float64Array.of(1, 2) } }),
      'InvalidArgument',
      /^shape\.size is of type Float64Array/,
    ],
    [() => engine.generateToolpath(small[0], small[1], { across: 1 }), 'InvalidArgument', /^across is .*true or false/],
    [gcode({}, {}, { below: 1 }), 'InvalidArgument', /^below is /],
    [gcode({}, {}, { below: {} }), 'InvalidArgument', /^below\./],
    [gcode({ setPressureAdvance: 1 }), 'InvalidArgument', /printer\.setPressureAdvance.*true or false/],
    [gcode({ name: 7 }), 'InvalidArgument', /printer\.name.*text/],
    [gcode({ name: 'half \ud800' }), 'InvalidArgument', /^printer\.name holds half a character/],
    [gcode({}, { date: '2026-11-21' }), 'InvalidArgument', /^print\.date is "2026-11-21"; it must be a Date/],
    [gcode({}, { date: new Date(NaN) }), 'InvalidArgument', /^print\.date/],
    [() => engine.readProject({ sillon: 1 }), 'InvalidArgument', /^json is an object; it must be text/],
    [() => engine.writeProject('{}'), 'InvalidArgument', /^project is "{}"/],
    [() => engine.renderPreview(plate.toolpath, 300), 'InvalidArgument', /^params is 300/],
    [() => engine.renderPreview(plate.toolpath, { width: '300' }), 'InvalidArgument', /^width is "300"/],
  ],
  'numbers that are none': [
    [
      generate({ shape: disc }, { spacing: NaN }),
      'InvalidArgument',
      /^toolpath\.spacing is NaN; it must be a finite number$/,
    ],
    [generate({ shape: { builtin: 'disc', size: [Infinity, 1] } }), 'InvalidArgument', /^shape\.size\[0\] is Infinity/],
    [
      generate({ shape: disc, layers: [{ kind: 'direction', angle: -Infinity }] }),
      'InvalidArgument',
      /^layers\[0\]\.angle is -Infinity/,
    ],
    [
      generate({ shape: disc }, { seed: 2 ** 53 }),
      'InvalidArgument',
      /^toolpath\.seed is 9007199254740992.*9007199254740991/,
    ],
    [gcode({ speed: NaN }), 'InvalidArgument', /^printer\.speed is NaN/],
    [gcode({}, { place: [NaN, 0] }), 'InvalidArgument', /^print\.place\[0\] is NaN/],
    [() => engine.writeProject({ print: { flow: NaN } }), 'InvalidArgument', /^print\.flow is NaN/],
    [() => engine.renderPreview(plate.toolpath, { lightAzimuth: NaN }), 'InvalidArgument', /^lightAzimuth is NaN/],
    [() => engine.renderPreview(plate.toolpath, { width: 2 ** 32 + 100 }), 'InvalidArgument', /^width is 4294967396/],
    [() => engine.renderPreview(plate.toolpath, { width: 99.5 }), 'InvalidArgument', /^width is 99.5/],
  ],
  'unknown keys': [
    [
      generate({ shap: disc }),
      'InvalidArgument',
      /^unknown key "shap"; known are shape, layers, pictures, printer, print$/,
    ],
    [generate({ shape: disc, toolpath: {} }), 'InvalidArgument', /^unknown key "toolpath"/],
    [generate({ shape: disc, svg_path: 'a.svg' }), 'InvalidArgument', /^unknown key "svg_path"/],
    [generate({ shape: { builtin: 'disc', sise: [1, 1] } }), 'InvalidArgument', /unknown key "shape\.sise".*"size"/],
    // Sections that plates once had: the lowest layer says what they said.
    [generate({ shape: disc, directions: { angle: 3 } }), 'InvalidArgument', /^unknown key "directions"; .*layers/],
    [generate({ shape: disc, modes: { mode: 'parallel' } }), 'InvalidArgument', /^unknown key "modes"; .*layers/],
    [generate({ shape: disc, pictures: { files: [] } }), 'InvalidArgument', /unknown key "pictures\.files"/],
    [
      generate({ shape: disc, layers: [{ kind: 'direction', angel: 3 }] }),
      'InvalidArgument',
      /unknown key "layers\[0\]\.angel".*"angle"/,
    ],
    [
      generate({ shape: disc, layers: [{ kind: 'direction', mod: 'parallel' }] }),
      'InvalidArgument',
      /unknown key "layers\[0\]\.mod".*"mode"/,
    ],
    [generate({ shape: disc }, { spacin: 1 }), 'InvalidArgument', /unknown key "toolpath\.spacin".*"spacing"/],
    [
      generate({ shape: disc }, { __proto__: null, ['__proto__']: 1 }),
      'InvalidArgument',
      /unknown key "toolpath\.__proto__"/,
    ],
    [generate({ shape: disc }, {}, { mesure: false }), 'InvalidArgument', /^unknown key "options\.mesure".*measure/],
    [withDirections({ ...picture, depth: 8 }), 'InvalidArgument', /^unknown key "layers\[0\]\.file\.depth"/],
    [
      generate({ shape: disc, layers: [{ kind: 'picture', pictures: [{ file: picture, lamps: [1, 2] }] }] }),
      'InvalidArgument',
      /unknown key "layers\[0\]\.pictures\[0\]\.lamps"/,
    ],
    [gcode({ nozle: 1 }), 'InvalidArgument', /unknown key "printer\.nozle".*"nozzle"/],
    [gcode({}, { layer: 1 }), 'InvalidArgument', /unknown key "print\.layer".*"layers"/],
    [gcode({}, {}, { onchunk() {} }), 'InvalidArgument', /^unknown key "options\.onchunk"/],
    [() => engine.writeSvg(plate.toolpath, { measure: false }), 'InvalidArgument', /^unknown key "options\.measure"/],
    [() => engine.renderPreview(plate.toolpath, { size: 3 }), 'InvalidArgument', /^unknown key "size"/],
    [() => engine.writeProject({ printers: {} }), 'InvalidArgument', /unknown key "printers".*"printer"/],
  ],
  'out of range': [
    [generate({ shape: disc }, { spacing: 0 }), 'InvalidArgument', /spacing.*0\.05.*20/],
    [generate({ shape: disc }, { perimeters: 1.5 }), 'InvalidArgument', /toolpath\.perimeters/],
    [
      generate({ shape: disc }, { perimeterMode: 'hard' }),
      'InvalidArgument',
      /toolpath\.perimeterMode is "hard".*"soft"/,
    ],
    [generate({ shape: { builtin: 'disc', size: [-1, 1] } }), 'InvalidArgument', /shape\.size.*-1.*10000/],
    [generate({ shape: { builtin: 'cloud', size: [1, 1] } }), 'InvalidArgument', /shape\.builtin is "cloud".*"disc"/],
    [gcode({ nozzleTemperature: 20 }), 'InvalidArgument', /nozzleTemperature.*20.*170.*300/],
    [gcode({}, { layers: 0 }), 'InvalidArgument', /layers.*0.*1.*1000/],
    [gcode({}, { place: [215, 100] }), 'DoesNotFit', /bed/],
    [() => engine.renderPreview(plate.toolpath, { width: 5 }), 'InvalidArgument', /width.*5.*16.*16384/],
    [() => engine.renderPreview(plate.toolpath, { lightElevation: 0 }), 'InvalidArgument', /[eE]levation.*1.*90/],
    [generate({ shape: { builtin: 'disc', size: [9000, 9000] } }, { spacing: 0.05 }), 'TooLarge', /9000.*0\.05/],
    [() => engine.writeProject({ toolpath: { maxWidth: 9 } }), 'InvalidArgument', /maxWidth.*9/],
    [
      () => engine.readProject('{ "sillon": 1, "toolpath": { "seed": 18446744073709551615 } }'),
      'InvalidArgument',
      /seed.*9007199254740991/,
    ],
  ],
  'what cannot be read': [
    [withShape(''), 'InvalidFile', /shape\.file.*empty/],
    [withShape('leaf.svg'), 'InvalidArgument', /^shape\.file is "leaf\.svg".*SVG text/],
    [withShape('<svg'), 'InvalidFile', /shape\.file/],
    [withShape('<html><body>404</body></html>'), 'InvalidFile', /shape\.file/],
    [withShape('<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"></svg>'), 'EmptyShape', /./],
    [withShape(new ArrayBuffer(0)), 'InvalidFile', /shape\.file.*empty/],
    [withShape(new Blob([])), 'InvalidFile', /shape\.file.*empty/],
    [withShape(noise), 'InvalidFile', /shape\.file/],
    [withDirections('veins.png'), 'InvalidArgument', /^layers\[0\]\.file is "veins\.png"/],
    [withDirections(goodPng.subarray(0, 50)), 'InvalidFile', /layers\[0\]\.file/],
    [withDirections(goodPng.subarray(0, goodPng.length - 20)), 'InvalidFile', /layers\[0\]\.file/],
    [withDirections(noise), 'InvalidFile', /layers\[0\]\.file/],
    [withDirections(goodPng, { modeFile: noise }), 'InvalidFile', /layers\[0\]\.modeFile/],
    [() => engine.importPrinter(noise), 'InvalidFile', /neither G-code nor settings of a slicer/],
    [() => engine.importPrinter(new TextEncoder().encode('[printer:A]\na = b\n'), 'B'), 'InvalidArgument', /"B"/],
    [() => engine.importPrinter('a.ini'), 'InvalidArgument', /^file is "a\.ini"/],
    [() => engine.checkGcode(7), 'InvalidArgument', /^file is 7/],
    [() => engine.examineBlock(7), 'InvalidArgument', /^block is 7/],
    [() => engine.examineBlock('G28', 'x'), 'InvalidArgument', /flavor/],
    [() => engine.packGcode(7), 'InvalidArgument', /^file is 7/],
    [() => engine.packGcode(new Uint8Array(0)), 'InvalidFile', /^file is empty/],
    [() => engine.packGcode(new Blob([])), 'InvalidFile', /^file is empty/],
    [() => engine.packGcode(new Blob(['G28\n'])), 'InvalidArgument', /^the G-code is not for a Bambu Lab printer/],
    [
      () => engine.writeBaseBody(square, {}, { base: 0 }),
      'InvalidArgument',
      /^print\.base is 0; it must be at least 1/,
    ],
    [() => engine.writeBaseBody(square, {}, { layerHeight: 9 }), 'InvalidArgument', /^print\.layerHeight is 9 mm/],
    [() => engine.writeBaseBody(square, {}, {}, { format: 'obj' }), 'InvalidArgument', /^format is "obj"; .*"stl"/],
    [() => engine.writeBaseBody({ page: [1, 1] }), 'InvalidArgument', /^shape\.paths is undefined/],
    [() => engine.writeBaseBody({ page: [1, 1], paths: [] }), 'EmptyShape', /no area/],
    [() => engine.checkGcode(Buffer.from('PK\x03\x04')), 'InvalidFile', /^the \.gcode\.3mf is cut off/],
    [
      () => engine.checkGcode(noise, { profile: 'prusa-mk4x' }),
      'InvalidArgument',
      /^"prusa-mk4x" is unknown for printer\.profile/,
    ],
    [() => engine.decodePicture(noise), 'InvalidFile', /file/],
    [() => engine.decodePicture(new Uint8Array(0)), 'InvalidFile', /./],
    [() => engine.decodePicture(goodPng.subarray(0, 60)), 'InvalidFile', /./],
    [() => engine.decodePicture('a.png'), 'InvalidArgument', /^file is "a\.png"/],
    [() => engine.decodePicture(picture), 'InvalidArgument', /^file is an object/],
    [() => engine.readShape({ file: noise }), 'InvalidFile', /shape\.file/],
    [() => engine.readProject(''), 'InvalidFile', /./],
    [() => engine.readProject('not JSON'), 'InvalidFile', /JSON/],
    [() => engine.readProject('[1, 2]'), 'InvalidFile', /./],
    [() => engine.readProject('{}'), 'InvalidFile', /./],
    [() => engine.readProject('{ "sillon": 2 }'), 'InvalidFile', /./],
    [() => engine.readProject('{ "sillon": 1, "toolpath": { "spacing": "a" } }'), 'InvalidFile', /toolpath\.spacing/],
    [() => engine.readProject('{ "sillon": 1, "toolpath": { "spacing": 90 } }'), 'InvalidArgument', /spacing/],
    [() => engine.readProject(`${'['.repeat(1e5)}`), 'InvalidFile', /./],
    [() => engine.readProject('\ud800'), 'InvalidArgument', /^json holds half a character/],
    [() => engine.writeProject(cyclic), 'InvalidArgument', /deeper than 64 levels, or holds itself/],
    [() => engine.writeProject(deep), 'InvalidArgument', /deeper than 64 levels/],
  ],
  'holders of bytes': [
    [withShape(42), 'InvalidArgument', /^shape\.file is 42; it must be SVG text, bytes/],
    [withShape(null), 'InvalidArgument', /^shape\.file is null/],
    [withShape([1, 2, 3]), 'InvalidArgument', /^shape\.file is a list/],
    [withShape(Promise.resolve('<svg/>')), 'InvalidArgument', /^shape\.file is of type Promise/],
    [
      withShape(detached(Uint8Array.from(goodPng))),
      'InvalidArgument',
      /^shape\.file lies in a buffer that was transferred/,
    ],
    [withShape(detached(Uint8Array.from(goodPng)).buffer), 'InvalidArgument', /^shape\.file lies in a buffer/],
    [() => engine.decodePicture(detached(Uint8Array.from(goodPng))), 'InvalidArgument', /^file lies in a buffer/],
    [
      withDirections({ ...picture, samples: detached(Uint8Array.of(1)) }),
      'InvalidArgument',
      /^layers\[0\]\.file.*transferred/,
    ],
    [
      withDirections({ ...picture, samples: [1, 2] }),
      'InvalidArgument',
      /^layers\[0\]\.file\.samples is a list; it must be a Uint8Array/,
    ],
    [
      withDirections({ width: 8, height: 8, data: picture.samples }),
      'InvalidArgument',
      /^unknown key "layers\[0\]\.file\.data"/,
    ],
    [
      withDirections({ ...picture, samples: new Float32Array(64) }),
      'InvalidArgument',
      /samples is of type Float32Array/,
    ],
    [withDirections({ ...picture, width: 9 }), 'InvalidArgument', /layers\[0\]\.file" is a picture.*samples/],
    [withDirections({ ...picture, width: '8' }), 'InvalidArgument', /^layers\[0\]\.file\.width is "8"/],
    [withDirections({ ...picture, width: -8, height: -8 }), 'InvalidArgument', /layers\[0\]\.file" is a picture/],
    [withDirections({ ...picture, width: 1e9, height: 1e9 }), 'InvalidArgument', /layers\[0\]\.file" is a picture/],
    [withDirections({ ...picture, channels: 5 }), 'InvalidArgument', /layers\[0\]\.file" is a picture/],
    [withDirections({ ...picture, width: 7.5 }), 'InvalidArgument', /layers\[0\]\.file" is a picture/],
  ],
  toolpaths: [
    [() => engine.writeGcode(undefined), 'InvalidArgument', /^toolpath is undefined/],
    [() => engine.writeGcode(plate), 'InvalidArgument', /^toolpath\.shape is undefined/],
    [withPath({ cycles: {} }), 'InvalidArgument', /^toolpath\.cycles is an object; it must be a list/],
    [withPath({ cycles: [7] }), 'InvalidArgument', /^toolpath\.cycles\[0\] is 7/],
    [withPath({ cycles: new Array(3) }), 'InvalidArgument', /^toolpath\.cycles\[0\] is undefined/],
    [withPath({ notes: 'a' }), 'InvalidArgument', /^toolpath\.notes is "a"; it must be a list/],
    [withPath({ notes: [1] }), 'InvalidArgument', /^toolpath\.notes\[0\] is 1; it must be text/],
    [withPath({ spacing: NaN }), 'InvalidArgument', /^toolpath\.spacing is NaN/],
    [withPath({ shape: { page: [NaN, 1], paths: [] } }), 'InvalidArgument', /^toolpath\.shape\.page\[0\] is NaN/],
    [withPath({ shape: { page: [-1, 1], paths: [] } }), 'InvalidArgument', /page/],
    [
      withPath({ shape: { page: [1, 1], paths: [{ fillRule: 'odd', rings: [] }] } }),
      'InvalidArgument',
      /fillRule is "odd"/,
    ],
    [
      withRing([1, 2]),
      'InvalidArgument',
      /^toolpath\.shape\.paths\[0\]\.rings\[0\] is a list; it must be a Float64Array/,
    ],
    [withRing(Float64Array.of(1, 2, 3)), 'InvalidArgument', /rings\[0\] has 3 coordinates/],
    [
      withCycle({ points: [1, 2] }),
      'InvalidArgument',
      /^toolpath\.cycles\[0\]\.points is a list; it must be a Float32Array/,
    ],
    [withCycle({ points: Float32Array.of(1, 2) }), 'InvalidArgument', /^toolpath\.cycles\[0\] has 2 coordinates/],
    [
      withCycle({ points: detached(Float32Array.of(1, 2)) }),
      'InvalidArgument',
      /points lies in a buffer that was transferred/,
    ],
    [
      withCycle({ points: new Float32Array(8).fill(NaN), widths: new Float32Array(4).fill(1) }),
      'InvalidArgument',
      /point/,
    ],
    [withCycle({ points: new Float32Array(8), widths: new Float32Array(4).fill(-1) }), 'InvalidArgument', /width/],
    [() => engine.writeGcode({ ...plate.toolpath, cycles: [] }), 'EmptyShape', /./],
    [
      () =>
        engine.writeGcode({
          ...plate.toolpath,
          cycles: [{ points: new Float32Array(8).fill(NaN), widths: new Float32Array(4) }],
        }),
      'InvalidArgument',
      /./,
    ],
  ],
  options: [
    [generate({ shape: disc }, {}, 7), 'InvalidArgument', /^options is 7/],
    [
      generate({ shape: disc }, {}, { signal: {} }),
      'InvalidArgument',
      /^signal is an object; it must be an AbortSignal/,
    ],
    [
      generate({ shape: disc }, {}, { onProgress: 'log' }),
      'InvalidArgument',
      /^onProgress is "log"; it must be a function/,
    ],
    [generate({ shape: disc }, {}, { measure: 'no' }), 'InvalidArgument', /^measure is "no"; it must be true or false/],
    [gcode({}, {}, { onChunk: [] }), 'InvalidArgument', /^onChunk is a list; it must be a function/],
  ],
};

function isSillonError(error, code, message) {
  assert.ok(error instanceof SillonError && error instanceof Error, String(error));
  assert.equal(error.name, 'SillonError');
  assert.match(error.message, message);
  assert.equal(error.code, code, error.message);
  assert.ok(!/undefined|\[object/.test(error.message.replace(/is undefined/, '')), error.message);
  assert.ok(error.message.length < 400, error.message);
  assert.equal(typeof error.hint, 'string');
  if (code === 'InvalidFile') assert.match(error.hint, /^$|^Shapes are/);
  else if (code !== 'InvalidArgument') assert.match(error.hint, /^[A-Z].*\.$/);
  assert.ok(error.stack.startsWith(`SillonError: ${error.message}`));
}

async function rejects(promise, code, message) {
  const error = await promise.then(
    () => assert.fail(`not refused; ${code} ${message} was expected`),
    (error) => error,
  );
  isSillonError(error, code, message);
  return error;
}

for (const [kind, list] of Object.entries(cases)) {
  describe(kind, () => {
    for (const [call, code, message] of list) {
      test(`${code} ${message}`, async () => {
        let promise;
        assert.doesNotThrow(() => (promise = call()));
        await rejects(promise, code, message);
      });
    }
  });
}

test('after all of them the engine gives the same plate', async () => {
  assert.equal((await engine.generateToolpath(...small)).report.digest, plate.report.digest);
});

test('errors that users often meet say what to do', async () => {
  const hint = async (call) => (await call().catch((error) => error)).hint;
  assert.match(await hint(withShape('leaf.svg')), /content/);
  assert.match(await hint(withDirections({ ...picture, samples: [] })), /ImageData/);
  assert.match(await hint(withShape(detached(Uint8Array.of(1)))), /buffer/);
  for (const call of [
    withShape(noise),
    withDirections(noise),
    () => engine.readShape({ file: noise }),
    () => engine.decodePicture(noise),
  ])
    assert.match(await hint(call), /SVG, PNG/);
  // Of pictures nothing where none are read.
  for (const call of [
    () => engine.readProject('not JSON'),
    () => engine.importPrinter(noise),
    () => engine.checkGcode(Buffer.from('PK\x03\x04')),
    () => engine.listSurfaces(Buffer.from('G28\n')),
  ])
    assert.equal(await hint(call), '');
});

test('what a page would say in another language has a reason with values', async () => {
  const told = async (call) => {
    const { reason, values } = await call().catch((error) => error);
    return { reason, values };
  };
  assert.deepEqual(await told(generate({ shape: disc }, { spacing: 90 })), {
    reason: 'SettingOutOfRange',
    values: { setting: 'toolpath.spacing', value: 90, low: 0.05, high: 20 },
  });
  assert.deepEqual(await told(generate({ shape: { builtin: 'disc', size: [1, 1] } }, { spacing: 9 })), {
    reason: 'NoBeadFits',
    values: { spacing: 9 },
  });
  const holed = { builtin: 'disc', size: [20, 20], holes: [{ x: 30, y: 10, diameter: 4 }] };
  assert.deepEqual(await told(generate({ shape: holed }, {})), {
    reason: 'HoleOutside',
    values: { n: 1, x: 30, y: 10, diameter: 4, left: 0, bottom: 0, right: 20, top: 20 },
  });
  assert.equal((await told(gcode({}, { rim: 2, showSide: 'bed' }))).reason, 'RimBelow');
  const { reason, values } = await told(gcode({}, { place: [-2, 20] }));
  assert.equal(reason, 'OverBedEdge');
  assert.deepEqual(Object.keys(values), ['left']);
  assert.equal((await told(gcode({ startGcode: 'G28\nG1 X10 E5 F600' }))).reason, 'StartLine');
  assert.equal((await told(withShape(noise))).reason, 'UnknownPicture');
});

describe('createEngine', () => {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
  after(() => rmSync(folder, { recursive: true }));

  for (const [options, message] of [
    [7, /^options is 7/],
    [{ thread: 2 }, /^unknown key "options\.thread"; known are threads, assetBase, idleTimeout/],
    [{ threads: 0 }, /^threads is 0; it must be "auto", "off" or a whole number from 1 to 64/],
    [{ threads: 65 }, /^threads is 65/],
    [{ threads: 1.5 }, /^threads is 1.5/],
    [{ threads: NaN }, /^threads is NaN/],
    [{ threads: 'on' }, /^threads is "on"/],
    [{ threads: null }, /^threads is null/],
    [{ idleTimeout: -1 }, /^idleTimeout is -1/],
    [{ idleTimeout: NaN }, /^idleTimeout is NaN/],
    [{ idleTimeout: '5' }, /^idleTimeout is "5"/],
    [{ assetBase: 5 }, /^assetBase is 5/],
    [{ assetBase: 'https://example.org/engine' }, /^assetBase is "https:\/\/example\.org\/engine"; in Node/],
  ]) {
    test(`InvalidArgument ${message}`, () => rejects(createEngine(options), 'InvalidArgument', message));
  }

  test('a folder without the engine is named', async () => {
    const url = pathToFileURL(join(folder, 'sillon-st.wasm')).href;
    for (const assetBase of [folder, `${folder}/`, pathToFileURL(folder), `${pathToFileURL(folder)}/`]) {
      const { message } = await rejects(createEngine({ assetBase, threads: 'off' }), 'LoadFailed', /ENOENT/);
      assert.ok(message.includes(url), message);
    }
  });

  for (const [name, content] of [
    ['worker.js', null],
    ['worker.js', 'syntax error'],
    ['node-worker.js', null],
    ['sillon-st.js', null],
    ['sillon-st.js', '<!doctype html>'],
    ['sillon-st.wasm', '<!doctype html>'],
    ['sillon-st.wasm', ''],
  ]) {
    test(`${name} that ${content === null ? 'is missing' : `holds "${content}"`} is named`, async () => {
      const copy = copyEngine({ [name]: content });
      const { message } = await rejects(createEngine({ assetBase: copy.folder, threads: 'off' }), 'LoadFailed', /./);
      copy.remove();
      assert.ok(message.includes(name), message);
    });
  }

  for (const name of ['sillon-mt.wasm', 'sillon-mt.js', ...(threadsHaveScript ? ['sillon-mt.worker.js'] : [])]) {
    test(`without ${name} one thread works, and the reason names it`, async () => {
      const copy = copyEngine({ [name]: null });
      const alone = await createEngine({ assetBase: copy.folder, threads: 2 });
      const { report } = await alone.generateToolpath(...small);
      const { info } = alone;
      alone.dispose();
      copy.remove();
      assert.deepEqual([info.variant, info.threads, report.digest], ['st', 1, plate.report.digest]);
      assert.ok(info.reason.includes(name), info.reason);
    });
  }
});
