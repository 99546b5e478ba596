import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { unzipSync, zipSync, type Zippable } from 'fflate';
import { createEngine, type Engine, type Project } from 'sillon';
import { layersFor } from '../../src/app/example-layers.js';
import { createAutosave } from '../../src/files/autosave.js';
import { filesOf } from '../../src/files/plate-project.js';
import { packStored, projectFileData, readProject, writeProject } from '../../src/files/project.js';
import { sourceFile } from '../../src/files/source-file.js';
import { newFileShape, newShape } from '../../src/model/defaults.js';
import { changeGround, filledWith, patternFills, pictureFills } from '../../src/model/fills.js';
import { engineInput, sectionsOf } from '../../src/model/input.js';
import { layerKinds, newLayer, projectLayer, withLayer } from '../../src/model/layer-list.js';
import { lackOf } from '../../src/model/layers.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate, SourceFile } from '../../src/model/plate.js';
import { printers, withPrinter } from '../../src/model/printers.js';
import { StudioError, type ProblemCode } from '../../src/model/problem.js';
import { builtinShapes, withHole } from '../../src/model/shapes.js';
import { templates } from '../../src/plates/templates.js';
import { chances } from './support/pictures.js';
import { layered, strokes, unfinished, type Files } from './support/plates.js';
import { Box, Browser } from './support/storage.js';

const nativeProgram = resolve('build/release/sillon');
const examples = resolve('examples');
const folder = mkdtempSync(join(tmpdir(), 'sillon-studio-'));

let engine: Engine;
let leaf: SourceFile;
let photo: SourceFile;
let modeMap: SourceFile;
let ownFont: SourceFile;
let files: Files;
before(async () => {
  engine = await createEngine({ threads: 'off' });
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="16mm" viewBox="0 0 20 16">
    <path d="M1 8 Q10 -6 19 8 Q10 22 1 8 Z"/></svg>`;
  leaf = await sourceFile('leaf.svg', new TextEncoder().encode(svg));
  photo = await sourceFile('photo.png', new Uint8Array(readFileSync(join(examples, 'inputs/photo.png'))));
  ownFont = await sourceFile('Own.ttf', Uint8Array.of(0, 1, 0, 0, 9, 9)); // that is all that the studio knows of fonts
  modeMap = await sourceFile('mode.png', new Uint8Array(readFileSync(join(examples, 'inputs/logo_mode.png'))));
  files = { drawing: leaf, photo, modes: modeMap, font: ownFont };
});
after(() => {
  engine.dispose();
  rmSync(folder, { recursive: true });
});

const bytesOf = async (blob: Blob): Promise<Uint8Array<ArrayBuffer>> => new Uint8Array(await blob.arrayBuffer());
const asFile = (name: string, bytes: Uint8Array<ArrayBuffer> | string): Promise<SourceFile> =>
  sourceFile(name, typeof bytes === 'string' ? new TextEncoder().encode(bytes) : bytes);

const zipOf = async (plate: Plate): Promise<Uint8Array<ArrayBuffer>> => bytesOf(await writeProject(plate));
const read = async (bytes: Uint8Array<ArrayBuffer> | string, others: SourceFile[] = []): Promise<Plate> =>
  readProject(await asFile(typeof bytes === 'string' ? 'plate.json' : 'plate.zip', bytes), others, engine);
const projectIn = (zip: Uint8Array): Record<string, unknown> =>
  JSON.parse(Buffer.from(unzipSync(zip)['project.json'] ?? []).toString()) as Record<string, unknown>;

async function contents(plate: Plate): Promise<string[]> {
  return Promise.all(filesOf(plate).map(async ({ bytes }) => Buffer.from(await bytesOf(bytes)).toString('hex')));
}

const small = (): Plate => ({
  ...newPlate(),
  width: 20,
  height: 20,
  toolpath: { ...newPlate().toolpath, spacing: 0.8 },
  printer: { ...newPlate().printer, nozzle: 0.8 },
});

const combed = (plate: Plate): Plate => withLayer(plate, newLayer(plate, 'strokes', { strokes: [...strokes] }));

// --- Round trip --------------------------------------------------------------------------------------------------------

test('every kind of plate comes back as it went, with the bytes of its files', async () => {
  const pictures = [
    { file: photo, lamp: [60, 45] },
    { file: modeMap, lamp: null },
  ] as const;
  const plates: Plate[] = [
    newPlate(),
    { ...newPlate(), layers: [] },
    ...patternFills.map((fill) => filledWith(newPlate(), fill)),
    ...pictureFills
      .filter((fill) => fill !== 'picture')
      .map((fill) => filledWith(newPlate(), fill, { file: photo, mode: 'parallel', modeFile: modeMap })),
    filledWith(newPlate(), 'picture', { pictures }),
    ...builtinShapes.map((kind) => ({ ...newPlate(), shape: newShape(kind) })),
    withHole({ ...newPlate(), shape: { ...newShape('tag'), corners: 'chamfer', inner: 4, offset: 2.5 } }, 'magnet'),
    ...printers.map(({ key }) => withPrinter(newPlate(), key)),
    combed(newPlate()),
    layered(files),
    {
      ...combed(filledWith(newPlate(), 'brightness', { file: photo, mode: 'smoothest', modeFile: modeMap })),
      name: 'Épicéa ✨ “quoted”',
      shape: { ...newFileShape(leaf, 'mm'), paint: 'shown', keepThin: true },
      height: 0,
      print: { ...newPlate().print, place: [12.5, 3], rotate: 30, mirror: true },
    },
  ];
  for (const plate of plates) {
    const back = await read(await zipOf(plate));
    assert.deepEqual(back, plate);
    assert.deepEqual(await contents(back), await contents(plate));
  }
});

test('layers come back in the order that they lay in, whichever that was', async () => {
  const plate = layered(files);
  const numbered = ({ layers }: Plate): Plate => ({
    ...plate,
    layers: layers.map((layer, k) => ({ ...layer, id: k + 1 })),
  });
  const turned = numbered({ ...plate, layers: [...plate.layers].reverse() });
  assert.deepEqual((await read(await zipOf(turned))).layers, turned.layers);
  const left = numbered({ ...plate, layers: plate.layers.slice(3) });
  assert.deepEqual((await read(await zipOf(left))).layers, left.layers);
});

test('layers that lack something are in no project, and neither are their files', async () => {
  const whole = newLayer(newPlate(), 'border');
  const all = [whole, ...unfinished(files), newLayer(newPlate(), 'text', { text: 'A' })];
  const plate = all.reduce(withLayer, newPlate());
  const zip = await zipOf(plate);
  assert.deepEqual(
    (projectIn(zip)['layers'] as { kind: string }[]).map(({ kind }) => kind),
    ['pattern', 'border', 'text'],
  );
  const back = await read(zip);
  assert.deepEqual(
    back.layers,
    plate.layers.filter((layer) => lackOf(layer) === undefined).map((layer, k) => ({ ...layer, id: k + 1 })),
  );
  assert.deepEqual(Object.keys(unzipSync(zip)), ['project.json']);
});

test('names that no file system would take stay the plate’s, and stand beside each other', async () => {
  const one = { ...photo, name: 'Leaf.png' };
  const other = { ...modeMap, name: 'leaf.png' };
  const filled = filledWith(newPlate(), 'levels', { file: one, mode: 'parallel', modeFile: other });
  const plate: Plate = { ...filled, shape: newFileShape({ ...leaf, name: 'b:…?*.svg' }) };
  const zip = await zipOf(plate);
  assert.deepEqual(Object.keys(unzipSync(zip)), [
    'project.json',
    ...['inputs/b_.svg', 'inputs/Leaf.png', 'inputs/leaf-2.png'],
  ]);
  assert.deepEqual(await read(zip), plate);
});

test('a file that is used in several places is packed once', async () => {
  const drawing = newLayer(newPlate(), 'drawing', { file: leaf, mask: 'outside', maskFile: leaf });
  const plate = [drawing, drawing].reduce(withLayer, { ...newPlate(), shape: newFileShape(leaf) });
  const zip = await zipOf(plate);
  assert.deepEqual(Object.keys(unzipSync(zip)), ['project.json', 'inputs/leaf.svg']);
  const back = await read(zip);
  assert.ok(back.shape.kind === 'file');
  for (const layer of back.layers.slice(1)) assert.ok(layer.file === back.shape.file && layer.maskFile === layer.file);
});

test('the same plate gives the same bytes', async () => {
  const plate: Plate = { ...layered(files), shape: newFileShape(leaf) };
  assert.deepEqual(await zipOf(plate), await zipOf(plate));
});

test('layers of every kind are the same after the studio has read and written a project', async () => {
  const ground = [
    { kind: 'direction', angle: 12, mode: 'orthogonal' },
    { kind: 'map', file: 'inputs/photo.png', encoding: 'rotation', mode: 'smoothest', modeFile: 'inputs/mode.png' },
    { kind: 'picture', pictures: [{ file: 'inputs/photo.png', lamp: [10, 40] }, { file: 'inputs/mode.png' }] },
    { kind: 'direction', angle: 12, at: [3, 4], size: [5, 6] }, // it does not fill the page
    { kind: 'pattern', pattern: 'noise' },
  ];
  const above = [
    { kind: 'direction', angle: 3, soft: 2, mask: 'disc' },
    { kind: 'map', file: 'inputs/photo.png', encoding: 'tangent', cropMax: [0.5, 0.75], modeFile: 'inputs/mode.png' },
    {
      ...{ kind: 'picture', size: [10, 0], mode: 'parallel', cropMin: [0.1, 0.2] },
      pictures: [
        { file: 'inputs/photo.png', lamp: [10, 40] },
        { file: 'inputs/mode.png', lamp: [-20, 30.5] },
        { file: 'inputs/photo.png', lamp: null },
      ],
    },
    { kind: 'picture', pictures: [{ file: 'inputs/photo.png', lamp: null }] },
    { kind: 'text', text: 'A\nB', font: 'inputs/Own.ttf', angle: 5, fill: 'angle', circle: -9, align: 'left' },
    { kind: 'code', text: 'x', correction: 'high', ground: 4 },
    { kind: 'pattern', pattern: 'spiral', waveLength: 12, mirror: true },
    { kind: 'pattern', pattern: 'waves', amplitude: 12.5, visible: false },
    { kind: 'pattern', pattern: 'noise', seed: 7, mode: 'smoothest' },
    { kind: 'pattern', pattern: 'echo', text: 'A', font: 'Caveat', textSize: 3 },
    { kind: 'pattern', pattern: 'echo', file: 'inputs/leaf.svg' },
    { kind: 'tones', file: 'inputs/photo.png', from: 5, to: -60, contrast: 2, smoothing: 1.5 },
    { kind: 'tones', file: 'inputs/photo.png', by: 'levels', threshold: 0.25 },
    { kind: 'tones', file: 'inputs/photo.png', by: 'edges', angle: 90 },
    {
      ...{ kind: 'tones', file: 'inputs/leaf.svg', by: 'colours' },
      colours: Array.from({ length: 32 }, (_, k) => ({ colour: `#0000${(k + 16).toString(16)}`, angle: k })),
    },
    { kind: 'drawing', file: 'inputs/leaf.svg', rotation: 30, mask: 'outside', maskFile: 'inputs/leaf.svg' },
    { kind: 'border', width: 2, fill: 'along' },
    {
      kind: 'strokes',
      strokes: [
        { tool: 'comb', radius: 4, soft: 0.5, points: [1, 2, 3, 4.5] },
        { tool: 'mode', radius: 2, soft: 0, mode: 'orthogonal', points: [1, 2] },
        { tool: 'erase', radius: 0.5, soft: 1, points: [] },
      ],
    },
  ];
  assert.deepEqual(new Set(above.map(({ kind }) => kind)), new Set(layerKinds));
  const others = [photo, modeMap, leaf, ownFont];
  for (const lowest of ground) {
    const project = { sillon: 1, shape: { builtin: 'rectangle', size: [40, 30] }, layers: [lowest, ...above] };
    const text = JSON.stringify(project);
    const { layers = [] } = await engine.readProject(text); // without what is as usual
    const zip = await zipOf(await read(text, others));
    const back = (await engine.readProject(JSON.stringify({ ...project, layers: projectIn(zip)['layers'] }))).layers;
    assert.deepEqual(back, layers);
    assert.deepEqual((await read(zip)).layers, (await read(text, others)).layers);
  }
});

// --- Projects of the version before ------------------------------------------------------------------------------------------

test('a project with directions and strokes of the studio’s own is read: its layers say the same', async () => {
  const plate = combed(filledWith({ ...newPlate(), name: 'before' }, 'map', { file: photo, modeFile: modeMap }));
  const now = projectFileData(plate) as { studio: { files: object } };
  const studio = {
    ...now.studio,
    version: 1,
    files: { 'inputs/own.png': 'own.png' },
    directions: {
      kind: 'tone',
      file: 'inputs/own.png',
      from: 60,
      to: 150,
      contrast: 1,
      smoothing: 0.004,
      invert: false,
    },
    modes: 'inputs/own.png',
    strokes: [{ tool: 'comb', points: [0.1, 0.5, 0.5, 0.6], radius: 0.1, softness: 0.5 }],
    layers: [{ kind: 'picture', id: 7, file: null }],
  };
  const zip = packed(
    { ...now, studio },
    { 'inputs/photo.png': await bytesOf(photo.bytes), 'inputs/mode.png': await bytesOf(modeMap.bytes) },
  );
  assert.deepEqual(await read(zip), plate);
});

// --- The native program --------------------------------------------------------------------------------------------------

const date = new Date(0);

async function studioGcode(plate: Plate): Promise<string> {
  const { input, params } = engineInput(plate);
  const { toolpath } = await engine.generateToolpath(input, params);
  const { blob } = await engine.writeGcode(toolpath, plate.printer, { ...plate.print, date });
  return blob.text();
}

function nativeGcode(zip: Uint8Array, name: string): string {
  const place = join(folder, name);
  for (const [path, bytes] of Object.entries(unzipSync(zip))) {
    mkdirSync(dirname(join(place, path)), { recursive: true });
    writeFileSync(join(place, path), bytes);
  }
  const gcode = join(place, 'plate.gcode');
  const { status, stderr } = spawnSync(
    nativeProgram,
    ['generate', join(place, 'project.json'), '--gcode', gcode, '--quiet'],
    { env: { ...process.env, SOURCE_DATE_EPOCH: '0' }, encoding: 'utf8' },
  );
  assert.equal(status, 0, stderr);
  return readFileSync(gcode, 'utf8');
}

const noProgram = existsSync(nativeProgram) ? false : 'no build/release/sillon; run ./dev build';

test('the native program makes the page’s G-code from the unpacked project', { skip: noProgram }, async () => {
  const plates: [string, Plate][] = [
    ['waves', small()],
    ['strokes', combed(small())],
    [
      'plain',
      filledWith({ ...small(), shape: newShape('rectangle') }, 'direction', { angle: 33.3, mode: 'orthogonal' }),
    ],
    ['nothing', { ...small(), layers: [] }],
    ['letters', [...unfinished(files), newLayer(small(), 'text', { text: 'Ab' })].reduce(withLayer, small())],
    ['picture', filledWith(small(), 'picture', { pictures: [{ file: photo, lamp: [60, 45] }] })],
    [
      'leaf',
      {
        ...filledWith(small(), 'brightness', { file: photo, smoothing: 0.5 }),
        shape: newFileShape(leaf),
        height: 16,
        print: { ...newPlate().print, layers: 2, rotate: 17, mirror: true, place: [50, 60.5] },
        printer: { ...small().printer, flavor: 'klipper', name: 'Ünï “x”', setPressureAdvance: true },
      },
    ],
    [
      'rounded',
      {
        ...filledWith(small(), 'map', { file: photo, encoding: 'rotation', modeFile: modeMap }),
        shape: { ...newShape('rounded'), radius: 5.3 },
        height: 0,
        toolpath: { ...small().toolpath, perimeterMode: 'soft', seed: Number.MAX_SAFE_INTEGER, bridge: 0 },
      },
    ],
  ];
  const made = new Set<string>();
  for (const [name, plate] of plates) {
    const expected = await studioGcode(plate);
    assert.ok(expected.length > 10_000);
    assert.ok(nativeGcode(await zipOf(plate), name) === expected, `G-code of ${name} differs`);
    made.add(expected);
  }
  assert.equal(made.size, plates.length);
});

// --- Projects of the command line ----------------------------------------------------------------------------------------

test('every example project of the command line opens, as large as the command line makes it', async () => {
  for (const name of ['islands', 'logo', 'mosaic', 'noise', 'photo', 'qr', 'relief', 'strokes', 'tiles']) {
    const json = readFileSync(join(examples, `${name}.json`), 'utf8');
    const project = await engine.readProject(json);
    const layers = project.layers ?? [];
    const named = [project.shape.file, ...layers.flatMap(({ file = '', modeFile = '' }) => [file, modeFile])];
    const others = await Promise.all(
      named
        .filter((file) => file !== '')
        .map((file) => asFile(file, new Uint8Array(readFileSync(join(examples, file))))),
    );
    const plate = await read(json, others);
    assert.equal(plate.name, 'plate');
    assert.deepEqual(plate.toolpath, project.toolpath);
    assert.deepEqual(plate.print, project.print);
    assert.deepEqual({ ...plate.printer, profile: '', filament: '' }, project.printer);
    assert.deepEqual(
      plate.layers.map(({ kind, file, modeFile }) => [kind, file?.name, modeFile?.name]),
      layers.map(({ kind, file = '', modeFile = '' }) => [
        kind,
        ...[file, modeFile].map((path) => others.find(({ name: own }) => path.endsWith(`/${own}`))?.name),
      ]),
    );
    const { page } = await engine.readShape(engineInput(plate).input.shape ?? {});
    assert.deepEqual(
      [plate.width, plate.height].map((mm) => mm.toFixed(6)),
      page.map((mm) => mm.toFixed(6)),
      name,
    );
  }
});

test('templates have the layers of the examples that they are made of', async () => {
  for (const { id, layers } of templates) {
    const name = id.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
    const { shape, layers: wanted = [] } = await engine.readProject(
      readFileSync(join(examples, `${name}.json`), 'utf8'),
    );
    const plate: Plate = { ...newPlate(), layers: await layersFor(layers, (file) => asFile(file, file)) };
    const { layers: told } = sectionsOf(plate, (file) => `inputs/${file.name}`, projectLayer);
    const { layers: found = [] } = await engine.readProject(JSON.stringify({ sillon: 1, shape, layers: told }));
    assert.deepEqual(found, wanted, id);
  }
  assert.ok(templates.some(({ layers }) => layers.some(({ kind, pictures }) => kind === 'picture' && pictures)));
});

test('a project of a picture alone is as large as the command line makes it', async () => {
  const json = JSON.stringify({ sillon: 1, layers: [{ kind: 'map', file: 'in/photo.png', encoding: 'rotation' }] });
  const plate = await read(json, [photo]);
  const { width, height } = await engine.decodePicture(photo.bytes);
  assert.deepEqual([plate.shape, plate.width], [{ ...newShape('rectangle'), radius: 3 }, 80]);
  assert.ok(Math.abs(plate.height - (80 * height) / width) < 1e-6);
  assert.deepEqual(
    plate.layers,
    filledWith({ ...plate, layers: [] }, 'map', { file: photo, encoding: 'rotation' }).layers,
  );
});

test('a zip that was packed by hand opens, also with a folder around it', async () => {
  const json = JSON.stringify({
    sillon: 1,
    shape: { file: 'in/leaf.svg' },
    layers: [{ kind: 'direction', angle: 20 }],
  });
  const svg = await bytesOf(leaf.bytes);
  for (const around of ['', 'my plate/']) {
    const zip = zipSync({ [`${around}project.json`]: Buffer.from(json), [`${around}in/leaf.svg`]: svg });
    const plate = await read(zip);
    assert.deepEqual([plate.width, plate.height], [20, 16]);
    assert.deepEqual(plate.shape, { ...newFileShape(leaf), radius: 3 });
  }
  const studio = unzipSync(await zipOf(small()));
  const again = zipSync(Object.fromEntries(Object.entries(studio).map(([path, bytes]) => [`folder/${path}`, bytes])));
  assert.deepEqual(await read(again), small());
});

test('a size that somebody has written into a project counts, not the page that the studio kept', async () => {
  const project = projectFileData({ ...small(), shape: newShape('rectangle') }) as { shape: object };
  const wider = { ...project, shape: { ...project.shape, size: [30, 25] } };
  const { width, height } = await read(JSON.stringify(wider));
  assert.deepEqual([width, height], [30, 25]);
});

// --- Bad files -------------------------------------------------------------------------------------------------------------

async function refused(
  bytes: Uint8Array<ArrayBuffer> | string,
  code: ProblemCode,
  detail: RegExp,
  others: SourceFile[] = [],
): Promise<void> {
  await assert.rejects(read(bytes, others), (error) => {
    assert.ok(error instanceof StudioError, String(error));
    assert.equal(error.code, code, error.message);
    assert.match(error.detail, detail);
    assert.ok('name' in error.values);
    return true;
  });
}

const packed = (project: unknown, more: Zippable = {}): Uint8Array<ArrayBuffer> =>
  zipSync({ 'project.json': Buffer.from(typeof project === 'string' ? project : JSON.stringify(project)), ...more });

test('what is wrong with a project is said', async () => {
  await refused('{ "sillon": 2 }', 'BrokenProject', /sillon/);
  await refused('{ "sillon": 1, "shape": { "file": "a/leaf.svg" } }', 'BrokenProject', /^a\/leaf\.svg is missing/);
  await refused('{ "sillon": 1, "toolpath": { "spacing": 99 } }', 'BrokenProject', /spacing/);
  await refused(`{ "sillon": 1, "layers": [], "x": ${'['.repeat(1e5)}`, 'BrokenProject', /./);
  await refused(' '.repeat(17 << 20), 'BrokenProject', /17\.8 MB; at most/);
  const project = { ...(projectFileData(newPlate()) as Project & { studio: object }) };
  const withStudio = (studio: object): Uint8Array<ArrayBuffer> =>
    packed({ ...project, studio: { ...project.studio, ...studio } });
  await refused(withStudio({ version: 3 }), 'BrokenProject', /^studio\.version is 3/);
  await refused(withStudio({ version: null }), 'BrokenProject', /^studio\.version is null/);
  await refused(withStudio({ name: 7 }), 'BrokenProject', /^studio\.name is 7/);
  await refused(withStudio({ name: 'x'.repeat(201) }), 'BrokenProject', /^studio\.name is "xxx/);
  await refused(withStudio({ spool: 7 }), 'BrokenProject', /^spool is 7/);
  await refused(packed({ ...project, studio: 7 }), 'BrokenProject', /studio is of the JSON type number/);
  const mapped = { ...project, layers: [{ kind: 'map', file: 'inputs/a.png' }] };
  await refused(packed(mapped), 'BrokenProject', /^inputs\/a\.png is missing/);
  const named = { ...mapped, studio: { ...project.studio, files: { 'inputs/a.png': 7 } } };
  await refused(packed(named, { 'inputs/a.png': Buffer.from('x') }), 'BrokenProject', /^studio\.files\.inputs/);
  const lowest = { kind: 'direction', mode: 'up' };
  await refused(packed({ ...project, layers: [lowest] }), 'BrokenProject', /layers(\[0\])?\.mode is "up"/);
  await refused(packed({ ...project, sparkle: {} }), 'BrokenProject', /unknown key "sparkle"/);
  await refused(packed({ ...project, layers: [{ kind: 'picture' }] }), 'BrokenProject', /layers\[0\]/);
  await refused(
    packed('{"sillon":1,"layers":[{"kind":"border","__proto__":{"width":3}}]}'),
    'BrokenProject',
    /__proto__/,
  );
  await refused(packed(`{"sillon":1,"studio":${'['.repeat(1e6)}`), 'BrokenProject', /nested deeper/);
  await refused(packed('{"sillon":1,'), 'BrokenProject', /JSON/);
  await refused(zipSync({ 'word/document.xml': Buffer.from('<w/>') }), 'UnknownFile', /^$/);
  await refused(packed({ sillon: 1, shape: { file: 'b.svg' } }), 'BrokenProject', /b\.svg/);
});

test('what the studio’s own section says beside that harms nobody', async () => {
  const project = projectFileData(newPlate()) as { studio: object };
  const odd: object[] = [
    { files: 7, textless: 7 },
    { files: null, textless: [0, -1, 'x', 1e9, null] },
    { files: [], page: 'all' },
    { page: [1, 2, 3] },
    { page: [null, null] },
    { page: [70, [70]] },
    { page: [{ toString: 7 }, 70] },
    JSON.parse('{ "__proto__": { "width": 3 }, "constructor": 7 }') as object,
  ];
  for (const studio of odd) {
    const told = JSON.stringify({ ...project, studio: { ...project.studio, ...studio } });
    assert.deepEqual(await read(packed(told)), newPlate(), JSON.stringify(studio));
  }
  assert.equal(({} as Record<string, unknown>)['width'], undefined);
});

test('names that lead out of the archive are refused', async () => {
  for (const path of ['../project.json', '/etc/passwd', 'a/../../b', 'C:\\a', 'a\\..\\b', 'a\u0000b']) {
    await refused(packed(projectFileData(newPlate()), { [path]: Buffer.from('x') }), 'BrokenProject', /not allowed/);
  }
});

/** The zip with a 32-bit number of its first directory entry changed. */
function patched(zip: Uint8Array<ArrayBuffer>, offset: number, value: number): Uint8Array<ArrayBuffer> {
  const copy = zip.slice();
  const at = Buffer.from(copy.buffer).indexOf(Buffer.of(0x50, 0x4b, 1, 2));
  new DataView(copy.buffer).setUint32(at + offset, value, true);
  return copy;
}

test('bombs are refused before they are unpacked', async () => {
  const bomb = packed(' '.repeat(100e6));
  assert.ok(bomb.length < 1e6);
  await refused(bomb, 'BrokenProject', /100 MB; at most 16\.8 MB/);
  await refused(patched(bomb, 24, 1000), 'BrokenProject', /larger than the archive says/);
  await refused(patched(bomb, 24, 15e6), 'BrokenProject', /larger than the archive says/);
  const good = packed(projectFileData(newPlate()));
  await refused(patched(good, 24, 1e6), 'BrokenProject', /is incomplete/);
  await refused(patched(good, 16, 1), 'BrokenProject', /is damaged/);
  await refused(patched(good, 42, 1e9), 'BrokenProject', /./);
  await refused(
    zipSync(Object.fromEntries(Array.from({ length: 1001 }, (_, k) => [`${k}`, new Uint8Array(0)]))),
    'BrokenProject',
    /1001 files/,
  );
});

test('random bytes and damage end in a plate or in an error of ours', async () => {
  const chance = chances(11);
  const pick = (n: number): number => Math.floor(n * chance());
  const plate: Plate = {
    ...combed(newPlate()),
    shape: newFileShape(leaf),
    toolpath: { ...newPlate().toolpath, seed: 7 },
  };
  const whole = await zipOf(plate);
  const project = Buffer.from(unzipSync(whole)['project.json'] ?? new Uint8Array(0)).toString();
  const cases: (() => Uint8Array<ArrayBuffer> | string)[] = [
    () => Uint8Array.from({ length: pick(2000) }, () => pick(256)),
    () => Uint8Array.from({ length: 100 + pick(2000) }, (_, k) => [0x50, 0x4b, 3, 4][k] ?? pick(256)),
    () => `{${String.fromCharCode(...Array.from({ length: pick(200) }, () => 32 + pick(95)))}`,
    () => whole.slice(0, pick(whole.length)),
    () => {
      const bytes = whole.slice();
      for (let n = 1 + pick(8); n > 0; --n) bytes[pick(bytes.length)] = pick(256);
      return bytes;
    },
    () => {
      // Where archives are told: the directory at the end.
      const bytes = whole.slice();
      for (let n = 1 + pick(4); n > 0; --n) bytes[bytes.length - 1 - pick(400)] = pick(256);
      return bytes;
    },
    () => {
      const letters = Array.from(project);
      for (let n = 1 + pick(3); n > 0; --n) letters[pick(letters.length)] = '0{}[]",:-e9'[pick(11)] ?? '';
      return packed(letters.join(''), { 'inputs/leaf.svg': Buffer.from('<svg/>') });
    },
  ];
  let opened = 0;
  for (let k = 0; k < 1400; ++k) {
    const make = cases[k % cases.length];
    const bytes = make?.() ?? '';
    try {
      await read(bytes);
      ++opened;
    } catch (error) {
      assert.ok(error instanceof StudioError, `case ${k}: ${String(error)}`);
    }
  }
  assert.ok(opened > 10, `only ${opened} were harmless`);
});

// --- What a browser has kept ---------------------------------------------------------------------------------------------

test('what is kept is handed out as it is, and the version that wrote it opens it', async () => {
  const shown = { pictures: [{ file: photo, lamp: [60, 45] as const }] };
  const lacking = newLayer(newPlate(), 'text', { text: '', mask: 'inside' });
  const plate = withLayer(filledWith({ ...small(), shape: newFileShape(leaf, 'mm') }, 'picture', shown), lacking);
  const autosave = createAutosave(
    { onProblem: ({ detail }) => assert.fail(detail), engine: () => Promise.resolve(engine) },
    ...(['test', new Box(), new Browser().tab(), { get: () => undefined, set: () => undefined }] as const),
  );
  autosave.save({ past: [changeGround(plate, { mode: 'parallel' })], plate, future: [] });
  const stored = await autosave.stored(autosave.current());
  const zip = await bytesOf(await packStored(stored));
  const back = await read(zip);
  assert.deepEqual(await contents(back), await contents(plate));
  assert.deepEqual(back, plate);

  const about = { name: 'theirs', picture: new Blob(['small']) };
  const theirs = { ...(stored.record as object), version: 9, sparkle: true };
  const packedTheirs = unzipSync(await bytesOf(await packStored({ record: theirs, about, files: stored.files })));
  const kept = JSON.parse(Buffer.from(packedTheirs['kept.json'] ?? []).toString()) as {
    record: unknown;
    about: { name: string; picture: { id: string } };
    files: Record<string, string>;
  };
  assert.deepEqual(kept.record, theirs);
  const bytes = (id: string): string => Buffer.from(packedTheirs[kept.files[id] ?? ''] ?? []).toString('hex');
  assert.equal(bytes(leaf.id), Buffer.from(await bytesOf(leaf.bytes)).toString('hex'));
  assert.equal(bytes(photo.id), Buffer.from(await bytesOf(photo.bytes)).toString('hex'));
  assert.equal(Buffer.from(bytes(kept.about.picture.id), 'hex').toString(), 'small');
  await refused(zipSync(packedTheirs), 'BrokenProject', /sparkle|version/);

  // A file that is gone is no layer that lacks one.
  for (const path of Object.keys(unzipSync(zip)).filter((name) => name.startsWith('inputs/'))) {
    const others = Object.fromEntries(Object.entries(unzipSync(zip)).filter(([name]) => name !== path));
    await refused(zipSync(others), 'BrokenProject', /./);
  }
});

/** As the first version kept it. */
const firstRecord = (): { record: object; files: ReadonlyMap<string, unknown> } => {
  const { id, name } = photo;
  const directions = { kind: 'lamp', pictures: [{ file: { id, name }, lamp: [60, 45] }] };
  const plate = { name: 'first', width: 20, height: 20, shape: { kind: 'disc' }, directions, modes: {}, strokes: [] };
  return { record: { version: 1, files: [id], plate, past: [], future: [] }, files: new Map([[id, photo.bytes]]) };
};

test('what the first version has kept is handed out, and told to be of another', async () => {
  const { record, files: own } = firstRecord();
  const zip = await bytesOf(await packStored({ record, about: { name: 'first' }, files: own }));
  const entries = unzipSync(zip);
  const kept = JSON.parse(Buffer.from(entries['kept.json'] ?? []).toString()) as { record: unknown };
  assert.deepEqual(kept.record, record);
  assert.deepEqual(Buffer.from(entries['inputs/photo.png'] ?? []), Buffer.from(await bytesOf(photo.bytes)));
  await refused(zip, 'BrokenProject', /^version is 1/);
});

for (const record of [null, 'text', 7, {}, { plate: null, files: 'all' }]) {
  test(`whatever is kept is handed out: ${JSON.stringify(record)}`, async () => {
    const zip = await bytesOf(await packStored({ record, about: undefined, files: new Map() }));
    const kept = JSON.parse(Buffer.from(unzipSync(zip)['kept.json'] ?? []).toString()) as { record: unknown };
    assert.deepEqual(kept.record, record);
    await refused(zip, 'BrokenProject', /./);
  });
}
