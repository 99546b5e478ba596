import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { unzipSync, zipSync, type Zippable } from 'fflate';
import { createEngine, type Engine } from 'sillon';
import { rasterise } from '../../src/generators/rasterise.js';
import type { DirectionRaster } from '../../src/model/raster.js';
import { layersFor } from '../../src/app/example-layers.js';
import { groundOf } from '../../src/model/ground.js';
import { engineInput, sectionsOf } from '../../src/model/input.js';
import { packStored, projectData, readProject, writeProject } from '../../src/files/project.js';
import { filesOf, plateData } from '../../src/files/plate-data.js';
import { sourceFile } from '../../src/files/source-file.js';
import {
  fileKinds,
  generatorKinds,
  newFileDirections,
  newFileShape,
  newGenerator,
  newLampDirections,
  newPlate,
  newShape,
} from '../../src/model/defaults.js';
import { layerKinds, newLayer, projectLayer, withLayer } from '../../src/model/layer-list.js';
import type { LayerKind, LayerValues } from '../../src/model/layers.js';
import type { DirectionSource, Plate, SourceFile } from '../../src/model/plate.js';
import { templates } from '../../src/plates/templates.js';
import { builtinShapes, withHole } from '../../src/model/shapes.js';
import { printers, withPrinter } from '../../src/model/printers.js';
import { StudioError, type ProblemCode } from '../../src/model/problem.js';
import { chances } from './support/pictures.js';

const nativeProgram = resolve('build/release/sillon');
const examples = resolve('examples');
const folder = mkdtempSync(join(tmpdir(), 'sillon-studio-'));

let engine: Engine;
let leaf: SourceFile;
let photo: SourceFile;
let modeMap: SourceFile;
let ownFont: SourceFile;
before(async () => {
  engine = await createEngine({ threads: 'off' });
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="16mm" viewBox="0 0 20 16">
    <path d="M1 8 Q10 -6 19 8 Q10 22 1 8 Z"/></svg>`;
  leaf = await sourceFile('leaf.svg', new TextEncoder().encode(svg));
  photo = await sourceFile('photo.png', new Uint8Array(readFileSync(join(examples, 'inputs/photo.png'))));
  ownFont = await sourceFile('Own.ttf', Uint8Array.of(0, 1, 0, 0, 9, 9)); // that is all that the studio knows of fonts
  modeMap = await sourceFile('mode.png', new Uint8Array(readFileSync(join(examples, 'inputs/logo_mode.png'))));
});
after(() => {
  engine.dispose();
  rmSync(folder, { recursive: true });
});

const bytesOf = async (blob: Blob): Promise<Uint8Array<ArrayBuffer>> => new Uint8Array(await blob.arrayBuffer());
const asFile = (name: string, bytes: Uint8Array<ArrayBuffer> | string): Promise<SourceFile> =>
  sourceFile(name, typeof bytes === 'string' ? new TextEncoder().encode(bytes) : bytes);

async function drawn(plate: Plate, resolution = 96): Promise<DirectionRaster> {
  const decoded = async (part: object & { file?: SourceFile }): ReturnType<Engine['decodePicture']> =>
    engine.decodePicture(part.file?.bytes ?? new Blob());
  return rasterise(
    plate.directions,
    plate.modes,
    plate.strokes,
    [plate.width, plate.height || plate.width],
    resolution,
    {
      ...('file' in plate.directions ? { source: await decoded(plate.directions) } : {}),
      ...(plate.modes.file === undefined ? {} : { modes: await decoded(plate.modes) }),
    },
  );
}

/** Stands for directions that no test looks at. */
const anyRaster: DirectionRaster = { width: 1, height: 1, angle: Uint16Array.of(7), mode: Uint8Array.of(3) };

const zipOf = async (plate: Plate, raster = anyRaster): Promise<Uint8Array<ArrayBuffer>> =>
  bytesOf(await writeProject(plate, raster));
const read = async (bytes: Uint8Array<ArrayBuffer> | string, others: SourceFile[] = []): Promise<Plate> =>
  readProject(await asFile(typeof bytes === 'string' ? 'plate.json' : 'plate.zip', bytes), others, engine);

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

/** One layer of each kind, with files of every sort. */
const layered = (): Plate => {
  const strokes = [{ tool: 'comb' as const, radius: 4, soft: 0.5, points: [1, 2, 3, 4.5] }];
  const own: Partial<Record<LayerKind, Partial<LayerValues>>> = {
    map: { file: photo, encoding: 'tangent', modeFile: modeMap, mode: 'parallel' },
    picture: { file: photo, cropMin: [0.1, 0.2] },
    tones: { file: photo, by: 'colours', colours: [{ colour: '#00ff7f', angle: -45 }] },
    drawing: { file: leaf, ground: 20 },
    strokes: { strokes },
  };
  const made = layerKinds.map((kind) => newLayer(newPlate(), kind, own[kind]));
  const more = [
    newLayer(newPlate(), 'text', { font: ownFont, maskFile: leaf, mask: 'inside', at: [3, 4.5] }),
    newLayer(newPlate(), 'picture', {
      ...{ file: photo, lamp: [10, 40] },
      others: [
        { file: modeMap, lamp: [-20, 30.5] },
        { file: photo, lamp: null },
      ],
    }),
    newLayer(newPlate(), 'pattern', { pattern: 'spiral', waveLength: 12 }),
    newLayer(newPlate(), 'pattern', { pattern: 'noise', seed: 7, mode: 'smoothest' }),
    newLayer(newPlate(), 'pattern', { pattern: 'echo', text: 'A', font: 'Caveat' }),
    newLayer(newPlate(), 'pattern', { pattern: 'echo', file: leaf }),
    ...(['brightness', 'levels', 'edges'] as const).map((by) =>
      newLayer(newPlate(), 'tones', { file: photo, by, threshold: 0.25, contrast: 2, smoothing: 1.5 }),
    ),
  ];
  return [...made, ...more].reduce(withLayer, { ...newPlate(), directions: { kind: 'angle', angle: 12 } });
};

const stroke = { tool: 'comb', points: [0.1, 0.5, 0.5, 0.6, 0.9, 0.5], radius: 0.1, softness: 0.5 } as const;

// --- Round trip --------------------------------------------------------------------------------------------------------

test('every kind of plate comes back as it went, with the bytes of its files', async () => {
  const plates: Plate[] = [
    newPlate(),
    ...generatorKinds.map((kind) => ({ ...newPlate(), directions: newGenerator(kind) })),
    ...fileKinds.map((kind) => ({ ...newPlate(), directions: newFileDirections(kind, photo) })),
    {
      ...newPlate(),
      directions: newLampDirections([
        { file: photo, lamp: [60, 45] },
        { file: modeMap, lamp: null },
      ]),
    },
    ...builtinShapes.map((kind) => ({ ...newPlate(), shape: newShape(kind) })),
    withHole({ ...newPlate(), shape: { ...newShape('tag'), corners: 'chamfer', inner: 4, offset: 2.5 } }, 'magnet'),
    ...printers.map(({ key }) => withPrinter(newPlate(), key)),
    layered(),
    {
      ...newPlate(),
      name: 'Épicéa ✨ “quoted”',
      shape: { ...newFileShape(leaf, 'mm'), paint: 'shown', keepThin: true },
      directions: newFileDirections('tone', photo),
      modes: { mode: 'smoothest', file: modeMap },
      strokes: [stroke, { ...stroke, tool: 'mode', mode: 'orthogonal' }, { ...stroke, tool: 'erase' }],
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

test('names that no file system would take stay the plate’s, and stand beside each other', async () => {
  const shape = { ...leaf, name: 'a:b?/leaf.svg' };
  const one = { ...photo, name: 'Leaf.png' };
  const other = { ...modeMap, name: 'leaf.png' };
  const plate: Plate = {
    ...newPlate(),
    shape: newFileShape({ ...shape, name: 'b:…?*.svg' }),
    directions: newFileDirections('levels', one),
    modes: { mode: 'parallel', file: other },
  };
  const zip = await zipOf(plate);
  const names = Object.keys(unzipSync(zip));
  assert.deepEqual(names, [
    ...['project.json', 'directions.png', 'modes.png'],
    ...['inputs/b_.svg', 'inputs/Leaf.png', 'inputs/leaf-2.png'],
  ]);
  assert.deepEqual(await read(zip), plate);
});

test('the same plate gives the same bytes', async () => {
  const plate: Plate = { ...small(), shape: newFileShape(leaf) };
  const raster = await drawn(plate);
  assert.deepEqual(await zipOf(plate, raster), await zipOf(plate, raster));
});

test('directions and modes stand in the zip exactly as the raster has them', async () => {
  const plate: Plate = { ...small(), strokes: [stroke, { ...stroke, tool: 'mode', mode: 'parallel' }] };
  const raster = await drawn(plate);
  const files = unzipSync(await zipOf(plate, raster));
  const angles = await engine.decodePicture(files['directions.png'] ?? new Uint8Array());
  assert.deepEqual([angles.width, angles.height], [raster.width, raster.height]);
  assert.deepEqual(Array.from(angles.samples), Array.from(raster.angle));
  const modes = await engine.decodePicture(files['modes.png'] ?? new Uint8Array());
  assert.ok(new Set(raster.mode).size > 1);
  assert.deepEqual(
    Array.from(modes.samples, (grey) => grey / 257),
    Array.from(raster.mode, (mode) => 85 * mode),
  );
});

const layersIn = (zip: Uint8Array): unknown =>
  (JSON.parse(Buffer.from(unzipSync(zip)['project.json'] ?? []).toString()) as { layers: unknown }).layers;

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
  const files = [photo, modeMap, leaf, ownFont];
  for (const lowest of ground) {
    const project = { sillon: 1, shape: { builtin: 'rectangle', size: [40, 30] }, layers: [lowest, ...above] };
    const text = JSON.stringify(project);
    const { layers = [] } = await engine.readProject(text); // without what is as usual
    const zip = await zipOf(await read(text, files));
    const fills = lowest.kind !== 'pattern' && !('at' in lowest);
    // Nothing lies below the lowest: directions of 0.
    const below = fills
      ? []
      : ((await engine.readProject('{"sillon":1,"layers":[{"kind":"direction"}]}')).layers ?? []);
    const back = (await engine.readProject(JSON.stringify({ ...project, layers: layersIn(zip) }))).layers;
    assert.deepEqual(back, [...below, ...layers]);
    assert.deepEqual((await read(zip)).layers, (await read(text, files)).layers);
  }
});

// --- The native program --------------------------------------------------------------------------------------------------

const date = new Date(0);

async function studioGcode(plate: Plate, raster: DirectionRaster): Promise<string> {
  const { input, params } = engineInput({ plate, raster });
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
  const drawnPlates: [string, Plate][] = [
    ['waves', small()],
    ['strokes', { ...small(), strokes: [stroke, { ...stroke, tool: 'mode', mode: 'smoothest' }] }],
    [
      'leaf',
      {
        ...small(),
        shape: newFileShape(leaf),
        height: 16,
        directions: newFileDirections('tone', photo),
        print: { ...newPlate().print, layers: 2, rotate: 17, mirror: true, place: [50, 60.5] },
        printer: { ...small().printer, flavor: 'klipper', name: 'Ünï “x”', setPressureAdvance: true },
      },
    ],
    [
      'rounded',
      {
        ...small(),
        shape: { ...newShape('rounded'), radius: 5.3 },
        height: 0,
        directions: { ...newFileDirections('map', photo), encoding: 'rotation' },
        modes: { mode: 'constrained', file: modeMap },
        toolpath: { ...small().toolpath, perimeterMode: 'soft', seed: Number.MAX_SAFE_INTEGER, bridge: 0 },
      },
    ],
  ];
  for (const [name, plate] of drawnPlates) {
    const raster = await drawn(plate);
    const expected = await studioGcode(plate, raster);
    assert.ok(expected.length > 10_000);
    assert.ok(nativeGcode(await zipOf(plate, raster), name) === expected, `G-code of ${name} differs`);
  }
});

test('and without a raster, from one direction and one mode', { skip: noProgram }, async () => {
  const plate: Plate = {
    ...small(),
    directions: { kind: 'angle', angle: 33.3 },
    modes: { mode: 'orthogonal' },
    shape: newShape('rectangle'),
  };
  const zip = await zipOf(plate);
  assert.ok(!('directions.png' in unzipSync(zip)));
  assert.ok(nativeGcode(zip, 'plain') === (await studioGcode(plate, anyRaster)));
});

// --- Projects of the command line ----------------------------------------------------------------------------------------

test('every example project of the command line opens, as large as the command line makes it', async () => {
  for (const name of ['islands', 'logo', 'mosaic', 'noise', 'photo', 'qr', 'relief', 'strokes', 'tiles']) {
    const json = readFileSync(join(examples, `${name}.json`), 'utf8');
    const project = await engine.readProject(json);
    const [lowest, ...above] = project.layers ?? [];
    assert.deepEqual(above, []);
    const { file: map = '', modeFile = '' } = lowest ?? {};
    const named = [project.shape.file, map, modeFile].filter((file) => file !== '');
    const others = await Promise.all(
      named.map((file) => asFile(file, new Uint8Array(readFileSync(join(examples, file))))),
    );
    const plate = await read(json, others);
    assert.equal(plate.name, 'plate');
    assert.deepEqual(plate.toolpath, project.toolpath);
    assert.deepEqual(plate.print, project.print);
    assert.deepEqual({ ...plate.printer, profile: '', filament: '' }, project.printer);
    assert.equal(plate.directions.kind, map === '' ? 'angle' : 'map');
    assert.equal(plate.modes.file?.name, others.find(({ name }) => modeFile.endsWith(`/${name}`))?.name);
    const { page } = await engine.readShape(engineInput({ plate, raster: undefined }).input.shape ?? {});
    assert.deepEqual(
      [plate.width, plate.height].map((mm) => mm.toFixed(6)),
      page.map((mm) => mm.toFixed(6)),
      name,
    );
  }
});

test('templates have the layers of the examples that they are made of', async () => {
  for (const { id, directions, layers = [] } of templates) {
    const name = id.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
    const { shape, layers: wanted = [] } = await engine.readProject(
      readFileSync(join(examples, `${name}.json`), 'utf8'),
    );
    const own = await layersFor(layers, (file) => asFile(file, file));
    const plate: Plate = { ...newPlate(), directions: directions as DirectionSource, layers: own };
    const { layers: told } = sectionsOf(plate, (file) => `inputs/${file.name}`, undefined, projectLayer);
    const { layers: found = [] } = await engine.readProject(JSON.stringify({ sillon: 1, shape, layers: told }));
    // Directions of 0° lie below layers that do not fill the page.
    assert.deepEqual(groundOf(wanted) === undefined ? found.slice(1) : found, wanted, id);
    assert.equal(found[0]?.angle ?? 0, groundOf(wanted)?.angle ?? 0, id);
  }
  assert.ok(templates.some(({ layers = [] }) => layers.some(({ kind, file }) => kind === 'picture' && file)));
});

test('a project of a picture alone is as large as the command line makes it', async () => {
  const json = JSON.stringify({ sillon: 1, layers: [{ kind: 'map', file: 'in/photo.png', encoding: 'rotation' }] });
  const plate = await read(json, [photo]);
  const { width, height } = await engine.decodePicture(photo.bytes);
  assert.deepEqual([plate.shape, plate.width], [{ ...newShape('rectangle'), radius: 3 }, 80]);
  assert.ok(Math.abs(plate.height - (80 * height) / width) < 1e-6);
  assert.deepEqual(plate.directions, { kind: 'map', file: photo, encoding: 'rotation' });
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
  const project = { ...(projectData(newPlate()) as { studio: object }) };
  const withStudio = (studio: object): Uint8Array<ArrayBuffer> =>
    packed({ ...project, studio: { ...project.studio, ...studio } });
  await refused(withStudio({ version: 2 }), 'BrokenProject', /^studio\.version is 2/);
  await refused(withStudio({ more: 1 }), 'BrokenProject', /^studio\.more is 1/);
  await refused(withStudio({ name: 7 }), 'BrokenProject', /^name is 7/);
  await refused(withStudio({ directions: { kind: 'up' } }), 'BrokenProject', /^directions\.kind is "up"/);
  await refused(withStudio({ strokes: [7] }), 'BrokenProject', /^strokes\[0\] is 7/);
  const tone = { ...newFileDirections('tone', photo), file: 'inputs/a.png' };
  await refused(withStudio({ directions: tone }), 'BrokenProject', /^inputs\/a\.png is missing/);
  const lowest = { kind: 'direction', mode: 'up' };
  await refused(packed({ ...project, layers: [lowest] }), 'BrokenProject', /layers(\[0\])?\.mode is "up"/);
  await refused(packed({ ...project, sparkle: {} }), 'BrokenProject', /unknown key "sparkle"/);
  await refused(packed('{"sillon":1,"studio":{"__proto__":{"width":3}}}'), 'BrokenProject', /__proto__/);
  await refused(packed(`{"sillon":1,"studio":${'['.repeat(1e6)}`), 'BrokenProject', /nested deeper/);
  await refused(packed('{"sillon":1,'), 'BrokenProject', /JSON/);
  await refused(zipSync({ 'word/document.xml': Buffer.from('<w/>') }), 'UnknownFile', /^$/);
  await refused(packed({ sillon: 1, shape: { file: 'b.svg' } }), 'BrokenProject', /b\.svg/);
});

test('names that lead out of the archive are refused', async () => {
  for (const path of ['../project.json', '/etc/passwd', 'a/../../b', 'C:\\a', 'a\\..\\b', 'a\u0000b']) {
    await refused(packed(projectData(newPlate()), { [path]: Buffer.from('x') }), 'BrokenProject', /not allowed/);
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
  const good = packed(projectData(newPlate()));
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
    ...newPlate(),
    shape: newFileShape(leaf),
    strokes: [stroke],
    toolpath: { ...newPlate().toolpath, seed: 7 },
  };
  const whole = await zipOf(plate, await drawn(plate, 16));
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
  for (let k = 0; k < 700; ++k) {
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

// --- What another version has kept --------------------------------------------------------------------------------------

test('what is kept is handed out as it is, and the version that wrote it opens it', async () => {
  const plate: Plate = {
    ...small(),
    shape: newFileShape(leaf, 'mm'),
    directions: newLampDirections([{ file: photo, lamp: [60, 45] }]),
  };
  const told = plateData(plate, ({ id, name }) => ({ id, name })) as object;
  const files = new Map(filesOf(plate).map(({ id, bytes }) => [id, bytes]));
  const record = { version: 1, files: [...files.keys()], plate: told, past: [], future: [] };
  const about = { name: 'theirs', picture: new Blob(['small']) };
  const zip = await bytesOf(await packStored({ record, about, files }));
  const back = await read(zip);
  assert.deepEqual(await contents(back), await contents(plate));
  assert.deepEqual(back, plate);

  const theirs = { ...record, version: 9, sparkle: true };
  const packed = unzipSync(await bytesOf(await packStored({ record: theirs, about, files })));
  const kept = JSON.parse(Buffer.from(packed['kept.json'] ?? []).toString()) as {
    record: unknown;
    about: { name: string; picture: { id: string } };
    files: Record<string, string>;
  };
  assert.deepEqual(kept.record, theirs);
  const bytes = (id: string): string => Buffer.from(packed[kept.files[id] ?? ''] ?? []).toString('hex');
  assert.equal(bytes(leaf.id), Buffer.from(await bytesOf(leaf.bytes)).toString('hex'));
  assert.equal(bytes(photo.id), Buffer.from(await bytesOf(photo.bytes)).toString('hex'));
  assert.equal(Buffer.from(bytes(kept.about.picture.id), 'hex').toString(), 'small');
});

for (const record of [null, 'text', 7, {}, { plate: null, files: 'all' }]) {
  test(`whatever is kept is handed out: ${JSON.stringify(record)}`, async () => {
    const packed = unzipSync(await bytesOf(await packStored({ record, about: undefined, files: new Map() })));
    assert.deepEqual(
      (JSON.parse(Buffer.from(packed['kept.json'] ?? []).toString()) as { record: unknown }).record,
      record,
    );
  });
}
