import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateRawSync } from 'node:zlib';
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
import { filaments, withFilament } from '../../src/model/filaments.js';
import { newLayer, withLayer } from '../../src/model/layer-list.js';
import type { LayerValues } from '../../src/model/layers.js';
import type { Plate, SourceFile } from '../../src/model/plate.js';
import { profileOf, printers, withPrinter } from '../../src/model/printers.js';
import { StudioError, type ProblemCode } from '../../src/model/problem.js';
import { settings, withValue, type SettingValue } from '../../src/model/settings.js';
import { builtinShapes, withHole } from '../../src/model/shapes.js';
import { readLink, writeLink } from '../../src/model/share.js';
import { fileOf } from './support/pictures.js';

const hashOf = (value: unknown, version = '1'): string =>
  `#plate=${version}.${deflateRawSync(JSON.stringify(value)).toString('base64url')}`;

/** The least that a link says. */
const plainLink = {
  ...{ name: '', shape: { kind: 'disc' }, width: 24, height: 24, mode: 'constrained', settings: {} },
  directions: { kind: 'angle', angle: 0 },
};

const file: SourceFile = { id: 'a', name: 'a.png', bytes: new Blob(['x']) };

async function told(plate: Plate): Promise<Record<string, unknown>> {
  const { hash } = await writeLink(plate);
  const { inflateRawSync } = await import('node:zlib');
  const packed = hash.replace(/^#plate=1\./, '');
  return JSON.parse(inflateRawSync(Buffer.from(packed, 'base64url')).toString()) as Record<string, unknown>;
}

async function refused(hash: string, code: ProblemCode): Promise<StudioError> {
  try {
    await readLink(hash);
  } catch (error) {
    assert.ok(error instanceof StudioError, String(error));
    assert.equal(error.code, code, `${hash.slice(0, 80)}: ${JSON.stringify(error.values)}`);
    return error;
  }
  return assert.fail(`${hash.slice(0, 80)} was let through`);
}

test('every generator, shape, printer and filament comes back as it went', async () => {
  const plates: Plate[] = [
    newPlate(),
    ...generatorKinds.map((kind) => ({ ...newPlate(), directions: newGenerator(kind) })),
    ...builtinShapes.map((kind) => ({ ...newPlate(), shape: newShape(kind) })),
    withHole({ ...newPlate(), shape: { ...newShape('tag'), corners: 'chamfer', inner: 4, offset: 2.5 } }, 'magnet'),
    ...printers.map(({ key }) => withPrinter(newPlate(), key)),
    ...filaments.map(({ key }) => withFilament(newPlate(), key)),
    { ...newPlate(), name: 'Épicéa ✨ “quoted” \\ <b>', modes: { mode: 'smoothest' as const }, height: 0 },
    { ...newPlate(), directions: { ...newGenerator('text'), text: 'two\nlines' } },
  ];
  for (const plate of plates) {
    const { hash, untold } = await writeLink(plate);
    assert.deepEqual(untold, []);
    assert.match(hash, /^#plate=1\.[\w-]+$/);
    assert.deepEqual(await readLink(hash), plate);
  }
});

test('layers travel as far as their files are small; what stays behind is told', async () => {
  const drawing = new Blob(['<svg xmlns="http://www.w3.org/2000/svg"/>'], { type: 'image/svg+xml' });
  const small: SourceFile = { id: 'd', name: 'd.svg', bytes: drawing };
  const values: LayerValues[] = [
    newLayer(newPlate(), 'text', { text: 'two\nlines', font: 'Caveat', at: [3, 4] }),
    newLayer(newPlate(), 'pattern', { pattern: 'waves', visible: false }),
    newLayer(newPlate(), 'drawing', { file: small, mask: 'outside', maskFile: small }),
  ];
  const plain = values.slice(0, 2).reduce(withLayer, newPlate());
  const link = await writeLink(plain);
  assert.deepEqual(link.untold, []);
  assert.deepEqual(await readLink(link.hash), plain);

  const shrink = (): Promise<Uint8Array> => Promise.resolve(Uint8Array.of(1, 2, 3));
  const unpack = (name: string, bytes: Uint8Array<ArrayBuffer>): Promise<SourceFile> =>
    Promise.resolve({ id: `id of ${name}`, name, bytes: new Blob([bytes]) });
  const pictured = [...values, newLayer(newPlate(), 'picture', { file })].reduce(withLayer, newPlate());
  const found = await writeLink(pictured, shrink);
  assert.deepEqual(found.untold, ['detail']);
  const back = await readLink(found.hash, unpack);
  assert.ok(back !== undefined);
  assert.deepEqual(
    back.layers.map(({ kind, file }) => [kind, file?.name]),
    [
      ['text', undefined],
      ['pattern', undefined],
      ['drawing', 'd.svg'],
      ['picture', 'a.png'],
    ],
  );
  assert.equal(await back.layers[2]?.maskFile?.bytes.text(), await drawing.text());
  assert.deepEqual([...new Uint8Array((await back.layers[3]?.file?.bytes.arrayBuffer()) ?? [])], [1, 2, 3]);

  const left = [
    newLayer(newPlate(), 'text', { font: { ...file, name: 'own.ttf' } }),
    newLayer(newPlate(), 'map', { file }),
    newLayer(newPlate(), 'direction', { modeFile: file }),
    newLayer(newPlate(), 'text', { text: 'x'.repeat(4000) }),
    newLayer(newPlate(), 'strokes', { strokes: [{ points: Array<number>(4000).fill(1) }] }),
    newLayer(newPlate(), 'picture'),
  ];
  for (const one of left) {
    const { hash, untold } = await writeLink([one, ...values.slice(0, 1)].reduce(withLayer, newPlate()), shrink);
    assert.deepEqual(untold, ['layers'], one.kind);
    assert.equal((await readLink(hash, unpack))?.layers.length, 1);
  }
  assert.deepEqual((await writeLink(pictured)).untold, ['layers']); // no file travels

  // Several pictures under their lamps, colours as they are, and strokes.
  const flat = { ...file, name: 'flat.png', bytes: new Blob(['coloured']) };
  const colours = [
    { colour: '#ff0000', angle: 30 },
    { colour: '#00FF7f', angle: -90 },
  ];
  const strokes = [{ tool: 'mode' as const, radius: 3, soft: 0, mode: 'parallel' as const, points: [1, 2, 3.5, 4] }];
  const rich = [
    newLayer(newPlate(), 'picture', { file, lamp: [10, 40], others: [{ file: flat, lamp: null }], mode: 'smoothest' }),
    newLayer(newPlate(), 'tones', { by: 'colours', file: flat, colours }),
    newLayer(newPlate(), 'strokes', { strokes }),
  ].reduce(withLayer, newPlate());
  const sent = await readLink((await writeLink(rich, shrink)).hash, unpack);
  assert.ok(sent !== undefined);
  const [shown, read, brushed] = sent.layers;
  assert.deepEqual([shown?.lamp, shown?.mode, shown?.file?.name], [[10, 40], 'smoothest', 'a.png']);
  assert.deepEqual(
    shown?.others.map((one) => [one.file.name, one.lamp]),
    [['flat.png', null]],
  );
  assert.deepEqual(read?.colours, colours);
  assert.equal(await read.file?.bytes.text(), 'coloured');
  assert.deepEqual(brushed?.strokes, strokes);
});

test('layers of a link are let through as far as a control could have set them', async () => {
  const linked = (layers: unknown): string => hashOf({ ...plainLink, layers });
  const plate = await readLink(linked([{ kind: 'border', width: 2 }]));
  assert.equal(plate?.layers[0]?.width, 2);
  for (const layers of [7, {}, [7], [{}], [{ kind: 'border', width: 0 }], [{ kind: 'text', font: 'a.ttf' }]]) {
    await refused(linked(layers), 'LinkValue');
  }
  const stroke = { tool: 'comb', radius: 4, soft: 0.5, points: [0, 0, 1, 1] };
  const colour = { colour: '#ff0000', angle: 3 };
  const brushed = (...strokes: unknown[]): unknown => [{ kind: 'strokes', strokes }];
  const toned = (...colours: unknown[]): unknown => [{ kind: 'tones', by: 'colours', colours }];
  assert.deepEqual((await readLink(linked(brushed(stroke))))?.layers[0]?.strokes, [stroke]);
  assert.deepEqual((await readLink(linked(toned(colour))))?.layers[0]?.colours, [colour]);
  const hostile = [
    ...[7, null, {}, { ...stroke, points: 'all' }, { ...stroke, points: [1] }, { ...stroke, points: [null, 1] }],
    ...[
      { ...stroke, points: [1e5, 1] },
      { ...stroke, radius: -1 },
      { ...stroke, radius: 1e9 },
    ],
    ...[
      { ...stroke, soft: 'x' },
      { ...stroke, tool: 'axe' },
      { ...stroke, mode: 'up' },
      { ...stroke, more: 1 },
    ],
  ];
  for (const one of hostile) await refused(linked(brushed(stroke, one)), 'LinkValue');
  await refused(linked(brushed(...Array<unknown>(10_001).fill({ points: [] }))), 'LinkValue');
  const painted = [
    ...[7, null, {}, { ...colour, colour: 'red' }, { ...colour, colour: '#ff000' }, { ...colour, colour: 7 }],
    ...[
      { ...colour, colour: '#ff0000"' },
      { ...colour, angle: 'x' },
      { ...colour, angle: 1e3 },
      { ...colour, more: 1 },
    ],
  ];
  for (const one of painted) await refused(linked(toned(colour, one)), 'LinkValue');
  await refused(linked(toned(...Array<unknown>(33).fill(colour))), 'LinkValue');
  await refused(linked([{ kind: 'picture', file: { name: 'a.png', data: 'AAAA' } }]), 'LinkValue');
});

test('a link that is out in the world opens', async () => {
  const link =
    '#plate=1.TY4xCsMwEAT_srUwJnEavSJfENIhHZFPwneOC6O_BydNuoVhhj0hYSV4wEFL6AR_4sWS4JFYI4bDwckK_G1xKMS52G8n3igaN9E_5whvUjgEyZXgZ4ew9sq2J4JfZodKkq_aPN0fw2FtF0BsorYFFkrXETJjyd9u52j7Rjppb63CI7eanjVgjA8';
  const plate = await readLink(link);
  assert.ok(plate !== undefined);
  const { name, width, directions, pictures } = plate;
  assert.deepEqual([name, width, directions.kind, pictures.spool], ['', 24, 'waves', 'goldPla']);
});

/** Another value than the default that its setting accepts. */
function another(setting: (typeof settings)[number]): SettingValue {
  switch (setting.kind) {
    case 'number':
    case 'integer':
      return setting.default === setting.max ? setting.min : setting.max;
    case 'choice':
      return setting.choices.find((choice) => choice !== setting.default) ?? '';
    case 'flag':
      return !setting.default;
    case 'text':
      return 'x'.repeat(Math.min(64, setting.maxBytes));
    case 'pair':
      return [setting.min, setting.max];
  }
}

/** As a link carries it: of a machine that is no profile, without blocks and without leave for any heat. */
const travelled = (plate: Plate): Plate =>
  profileOf(plate.printer) !== undefined
    ? plate
    : { ...plate, printer: { ...plate.printer, startGcode: '', endGcode: '', anyTemperature: false } };

test('every setting travels but what would move and heat another machine', async () => {
  let plate = newPlate();
  for (const setting of settings) plate = withValue(plate, setting, another(setting));
  const { hash, untold } = await writeLink(plate);
  assert.notEqual(plate.printer.startGcode, '');
  assert.deepEqual(await readLink(hash), travelled(plate));
  assert.deepEqual(untold, ['blocks']);
  assert.ok(hash.length < 2500, `${hash.length} characters`);
  assert.ok((await writeLink(newPlate())).hash.length < 400);
});

test('what cannot travel is named and replaced by something plain', async () => {
  for (const kind of fileKinds) {
    const plate: Plate = {
      ...newPlate(),
      width: 33,
      shape: newFileShape(file),
      directions: newFileDirections(kind, file),
      modes: { mode: 'parallel', file },
      strokes: [{ tool: 'comb', points: [0, 0, 1, 1], radius: 0.1, softness: 0 }],
    };
    const { hash, untold } = await writeLink(plate);
    assert.deepEqual(untold, ['shape', 'directions', 'modes', 'strokes']);
    const read = await readLink(hash);
    assert.deepEqual(read, {
      ...plate,
      shape: newShape('rectangle'),
      directions: newGenerator('angle'),
      modes: { mode: 'parallel' },
      strokes: [],
    });
  }
});

test('other hashes are no links', async () => {
  for (const hash of ['', '#', '#help', '#plat', '#PLATE=1.x', '#x&plate=1.x']) {
    assert.equal(await readLink(hash), undefined);
  }
});

test('cut, changed and foreign links are refused with what is wrong', async () => {
  const { hash } = await writeLink(newPlate());
  for (const broken of [
    '#plate=',
    '#plate=1',
    '#plate=1.',
    '#plate=x.abc',
    '#plate=1.%20',
    '#plate=1.AAAA',
    '#plate=1.a',
  ]) {
    await refused(broken, 'LinkBroken');
  }
  for (const keep of [0.2, 0.5, 0.9])
    await refused(hash.slice(0, 9 + Math.floor(keep * (hash.length - 9))), 'LinkBroken');
  await refused(`#plate=1.${deflateRawSync(Buffer.from([0xff, 0xfe, 0x80])).toString('base64url')}`, 'LinkBroken');
  await refused(`#plate=1.${deflateRawSync('{"name":').toString('base64url')}`, 'LinkBroken');
  assert.deepEqual((await refused(hash.replace('=1.', '=2.'), 'LinkTooNew')).values, { version: 2 });
  await refused(hash.replace('=1.', '=0.'), 'LinkTooNew');
});

test('bombs are refused before they are unpacked', async () => {
  await refused(`#plate=1.${'A'.repeat(1_000_000)}`, 'LinkTooLong');
  const bomb = deflateRawSync(Buffer.alloc(8_000_000, ' ')).toString('base64url');
  assert.ok(bomb.length < 16_000, 'the bomb must be small enough to get that far');
  await refused(`#plate=1.${bomb}`, 'LinkTooLong');
  await refused(hashOf({ name: 'x'.repeat(190_000) }), 'LinkValue');
});

test('every field is checked: kind, range, unknown names', async () => {
  const good = await told({ ...newPlate(), shape: newShape('rounded') });
  const directions = good['directions'] as Record<string, unknown>;
  const wrong: Record<string, unknown>[] = [
    ...['name', 'width', 'height', 'mode', 'settings'].map((name) => ({ ...good, [name]: undefined })),
    { ...good, name: 7 },
    { ...good, name: 'x'.repeat(201) },
    { ...good, name: '\u0000' },
    { ...good, width: 0 },
    { ...good, width: '70' },
    { ...good, width: 1e9 },
    { ...good, height: -1 },
    { ...good, mode: 'none' },
    { ...good, mode: 'toString' },
    { ...good, settings: { 'pictures.spool': 'gold' } },
    { ...good, settings: { 'pictures.spool': 'constructor' } },
    { ...good, shape: null },
    { ...good, shape: 'disc' },
    { ...good, shape: { kind: 'file' } },
    { ...good, shape: { kind: 'rounded', radius: -1 } },
    { ...good, shape: { kind: 'disc', radius: 1, extra: 1 } },
    { ...good, shape: { kind: 'star', points: 2 } },
    { ...good, shape: { kind: 'star', points: 5.5 } },
    { ...good, shape: { kind: 'star', corners: 'sharp' } },
    { ...good, shape: { kind: 'disc', offset: 51 } },
    { ...good, shape: { kind: 'disc', holes: {} } },
    { ...good, shape: { kind: 'disc', holes: [{ x: 1, y: 2 }] } },
    { ...good, shape: { kind: 'disc', holes: [{ x: 1, y: 2, diameter: 0 }] } },
    { ...good, shape: { kind: 'disc', holes: Array(17).fill({ x: 1, y: 2, diameter: 3 }) } },
    { ...good, directions: null },
    { ...good, directions: [] },
    { ...good, directions: { kind: 'tone', from: 0 } },
    { ...good, directions: { kind: '__proto__' } },
    { ...good, directions: { kind: 'angle', angle: 361 } },
    { ...good, directions: { ...directions, amplitude: null } },
    { ...good, directions: { ...directions, length: 0 } },
    { ...good, directions: { ...directions, more: 0 } },
    { ...good, directions: { ...newGenerator('radial'), centre: [0] } },
    { ...good, directions: { ...newGenerator('radial'), centre: [0, 1e9] } },
    { ...good, directions: { ...newGenerator('text'), bold: 'true' } },
    { ...good, directions: { ...newGenerator('text'), text: 'x'.repeat(2001) } },
    { ...good, settings: [] },
    { ...good, settings: { 'toolpath.spacing': '0.4' } },
    { ...good, settings: { 'toolpath.spacing': 0 } },
    { ...good, settings: { 'toolpath.seed': 1.5 } },
    { ...good, settings: { 'printer.name': 'two\nlines' } },
    { ...good, settings: { 'printer.bedMax': [1] } },
    { ...good, settings: { 'toolpath.unknown': 1 } },
    { ...good, settings: JSON.parse('{"__proto__": {"a": 1}}') },
    { ...good, strokes: [] },
    JSON.parse('{"__proto__": {}}') as Record<string, unknown>,
  ];
  assert.ok((await readLink(hashOf(good))) !== undefined);
  for (const value of wrong) {
    const { values } = await refused(hashOf(value), 'LinkValue');
    assert.ok(typeof values['where'] === 'string' && String(values['value']).length <= 41, JSON.stringify(values));
  }
  for (const value of [null, 1, 'x', [], true]) await refused(hashOf(value), 'LinkValue');
  assert.equal(({} as Record<string, unknown>)['a'], undefined);
});

test('random damage ends in a plate that controls could have set, or in an error of ours', async () => {
  const { hash } = await writeLink(withPrinter({ ...newPlate(), directions: newGenerator('text') }, 'voron-2-4-300'));
  const letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_';
  let seed = 7;
  const random = (below: number): number => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return Math.floor((seed / 2 ** 32) * below);
  };
  for (let k = 0; k < 300; ++k) {
    const at = 9 + random(hash.length - 9);
    const damaged = hash.slice(0, at) + (letters[random(64)] ?? 'A') + hash.slice(at + 1);
    try {
      const plate = await readLink(damaged);
      assert.ok(plate !== undefined);
      assert.deepEqual(await readLink((await writeLink(plate)).hash), travelled(plate));
    } catch (error) {
      assert.ok(error instanceof StudioError, String(error));
    }
  }
});

test('pictures under lamps travel small, and only as pictures', async () => {
  const plate: Plate = {
    ...newPlate(),
    directions: newLampDirections([
      { file: fileOf('cat.jpg'), lamp: [60, 45] },
      { file: fileOf('dog.jpg'), lamp: null },
    ]),
  };
  const asked: number[] = [];
  const shrink = ({ name }: SourceFile, most: number): Promise<Uint8Array> => {
    asked.push(most);
    return Promise.resolve(new TextEncoder().encode(`small ${name}`));
  };
  const unpack = (name: string, bytes: Uint8Array<ArrayBuffer>): Promise<SourceFile> =>
    Promise.resolve({ id: new TextDecoder().decode(bytes), name, bytes: new Blob([bytes]) });
  const { hash, untold } = await writeLink(plate, shrink);
  assert.deepEqual(untold, ['detail']);
  assert.deepEqual(asked, [4000, 4000]);
  const read = await readLink(hash, unpack);
  assert.ok(read?.directions.kind === 'lamp');
  assert.deepEqual(
    read.directions.pictures.map(({ file, lamp }) => [file.id, file.name, lamp]),
    [
      ['small cat.jpg', 'cat.jpg', [60, 45]],
      ['small dog.jpg', 'dog.jpg', null],
    ],
  );
  // Where they cannot, that is told; and no link makes a plate of files that it does not bring.
  assert.deepEqual((await writeLink(plate)).untold, ['directions']);
  assert.deepEqual((await writeLink(plate, () => Promise.resolve(undefined))).untold, ['directions']);
  await assert.rejects(readLink(hash), { code: 'LinkValue' });
});
