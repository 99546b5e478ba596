import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { deflateRawSync, inflateRawSync } from 'node:zlib';
import { createEngine, type Engine, type Stroke } from 'sillon';
import { mostPictureBytes, readLink, writeLink, type Shrink } from '../../src/files/link.js';
import { plateOf } from '../../src/files/plate-project.js';
import { newFileShape, newShape } from '../../src/model/defaults.js';
import { filaments, withFilament } from '../../src/model/filaments.js';
import { changeGround, filledWith, groundPictures, patternFills, type Fill } from '../../src/model/fills.js';
import { mostLayers, newLayer, withLayer } from '../../src/model/layer-list.js';
import type { LayerValues } from '../../src/model/layers.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate, SourceFile } from '../../src/model/plate.js';
import { profileOf, printers, withPrinter } from '../../src/model/printers.js';
import { problemOf, StudioError, type ProblemCode } from '../../src/model/problem.js';
import { settings, withValue, type SettingValue } from '../../src/model/settings.js';
import { builtinShapes, withHole } from '../../src/model/shapes.js';
import type { Untold } from '../../src/model/untold.js';
import { chances, fileOf } from './support/pictures.js';
import { strokes, unfinished } from './support/plates.js';

let engine: Engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
});

const most = 16_000; // characters
const hashOf = (value: unknown, version = '2'): string =>
  `#plate=${version}.${deflateRawSync(JSON.stringify(value)).toString('base64url')}`;

const unpack = (name: string, bytes: Uint8Array<ArrayBuffer>): Promise<SourceFile> =>
  Promise.resolve({ id: `id of ${name}`, name, bytes: new Blob([bytes]) });
const read = (hash: string, tell?: (parts: Untold[]) => void): Promise<Plate | undefined> =>
  readLink(hash, unpack, () => Promise.resolve(engine), tell);
const small: Shrink = ({ name }) => Promise.resolve(new TextEncoder().encode(`small ${name}`));

/** Tells the plate as a link's data. */
async function told(plate: Plate): Promise<{ project: Record<string, unknown> }> {
  const { hash } = await writeLink(plate);
  const packed = hash.replace(/^#plate=2\./, '');
  return JSON.parse(inflateRawSync(Buffer.from(packed, 'base64url')).toString()) as ReturnType<typeof told>;
}

async function refused(hash: string, code?: ProblemCode): Promise<StudioError> {
  try {
    await read(hash);
  } catch (error) {
    assert.ok(error instanceof StudioError, String(error));
    if (code !== undefined) assert.equal(error.code, code, `${hash.slice(0, 80)}: ${JSON.stringify(error.values)}`);
    return error;
  }
  return assert.fail(`${hash.slice(0, 80)} was let through`);
}

/** A link whose plate the engine, or the studio, refuses with words for people. */
async function unfit(value: unknown): Promise<void> {
  const what = JSON.stringify(value).slice(-160);
  try {
    await read(hashOf(value));
  } catch (error) {
    const { code, values, detail } = problemOf(error);
    const known: ProblemCode[] = ['InvalidArgument', 'InvalidFile', 'TooLarge', 'LinkValue', 'LinkBroken'];
    assert.ok(known.includes(code), `${what}: ${String(error)}`);
    assert.ok(code === 'LinkBroken' || detail !== '' || typeof values['where'] === 'string', what);
    return;
  }
  assert.fail(`${what} was let through`);
}

const svgType = 'image/svg+xml';
const drawing = (text: string, name = 'd.svg'): SourceFile => ({
  ...{ id: `id of ${name}`, name },
  bytes: new Blob([text], { type: svgType }),
});
const svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 3"><path d="M0 0H4V3H0Z"/></svg>';

// --- There and back ----------------------------------------------------------------------------------------------------

test('every pattern, shape, printer and filament comes back as it went', async () => {
  const named = { ...newPlate(), name: 'Épicéa ✨ “quoted” \\ <b>', height: 0 };
  const plates: Plate[] = [
    newPlate(),
    { ...newPlate(), layers: [] },
    ...patternFills.map((fill) => filledWith(newPlate(), fill, { angle: 12, mode: 'smoothest' })),
    ...builtinShapes.map((kind) => ({ ...newPlate(), shape: newShape(kind) })),
    withHole({ ...newPlate(), shape: { ...newShape('tag'), corners: 'chamfer', inner: 4, offset: 2.5 } }, 'magnet'),
    ...printers.map(({ key }) => withPrinter(newPlate(), key)),
    ...filaments.map(({ key }) => withFilament(newPlate(), key)),
    named,
  ];
  for (const plate of plates) {
    const { hash, untold } = await writeLink(plate);
    assert.deepEqual(untold, []);
    assert.match(hash, /^#plate=2\.[\w-]+$/);
    assert.deepEqual(await read(hash), plate);
  }
  assert.ok((await writeLink(newPlate())).hash.length < 400);
});

test('letters, codes, patterns and strokes travel whole, in their order', async () => {
  const values: LayerValues[] = [
    newLayer(newPlate(), 'text', { text: 'two\nlines', font: 'Caveat', at: [3, 4] }),
    newLayer(newPlate(), 'code', { text: 'https://example.org', correction: 'high' }),
    newLayer(newPlate(), 'pattern', { pattern: 'waves', visible: false }),
    newLayer(newPlate(), 'pattern', { pattern: 'echo', text: 'A' }),
    newLayer(newPlate(), 'border', { width: 2 }),
    newLayer(newPlate(), 'direction', { mask: 'disc', soft: 2 }),
    newLayer(newPlate(), 'strokes', { strokes: [...strokes] }),
  ];
  for (const layers of [values, [...values].reverse()]) {
    for (const plate of [
      layers.reduce(withLayer, newPlate()),
      layers.reduce(withLayer, { ...newPlate(), layers: [] }),
    ]) {
      const { hash, untold } = await writeLink(plate);
      assert.deepEqual(untold, []);
      assert.deepEqual(await read(hash), plate);
    }
  }
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
      return setting.maxBytes > 1024 ? 'G28 ; home' : 'x'.repeat(64);
    case 'pair':
      return [setting.min, setting.max];
  }
}

/** As a link carries it: of a machine that is no profile, without blocks and without leave for any heat. */
const travelled = (plate: Plate): Plate =>
  profileOf(plate.printer) !== undefined
    ? plate
    : { ...plate, printer: { ...plate.printer, startGcode: '', endGcode: '', generalHeatLimits: false } };

test('every setting travels but what would move and heat another machine', async () => {
  let [tried, kept, blocks] = [0, 0, 0];
  for (const setting of settings) {
    const plate = withValue(newPlate(), setting, another(setting));
    const { hash, untold } = await writeLink(plate);
    const own = setting.key === 'startGcode' || setting.key === 'endGcode';
    assert.deepEqual(untold, own ? ['blocks'] : [], setting.id);
    blocks += Number(own);
    ++tried;
    // Some values ask for others beside them.
    const back = await read(hash).catch((error: unknown) => problemOf(error).code);
    if (back === 'InvalidArgument') continue;
    assert.deepEqual(back, travelled(plate), setting.id);
    ++kept;
  }
  assert.ok(kept > 0.8 * tried && blocks === 2, `${kept} of ${tried}`);
});

test('a printer that a project names brings its own values, also where they are as usual', async () => {
  const printer = { profile: 'prusa-mk4s', filament: 'petg', bedMax: [220, 220], nozzleTemperature: 215, speed: 50 };
  const project = JSON.stringify({ sillon: 1, shape: { builtin: 'disc', size: [70, 70] }, printer });
  const plate = await plateOf(project, '', () => Promise.resolve(undefined), engine);
  assert.deepEqual([plate.printer.bedMax, plate.printer.nozzleTemperature], [[220, 220], 215]);
  const back = await read((await writeLink(plate)).hash);
  const values = ({ profile: _, filament: __, ...rest }: Plate['printer']): object => rest;
  assert.deepEqual(values(back?.printer ?? assert.fail()), values(travelled(plate).printer));
});

// --- Files -------------------------------------------------------------------------------------------------------------

test('pictures under lamps travel small, wherever they lie, and are told to have been larger', async () => {
  const ground = [
    { file: fileOf('cat.jpg'), lamp: [60, 45] },
    { file: fileOf('dog.jpg'), lamp: null },
  ] as const;
  const plate = filledWith(newPlate(), 'picture', { pictures: ground });
  const shown = newLayer(plate, 'picture', {
    pictures: [{ file: fileOf('owl.jpg'), lamp: [1, 40] }],
    mode: 'smoothest',
  });
  const { hash, untold } = await writeLink(withLayer(plate, shown), small);
  assert.deepEqual(untold, ['detail']);
  let heard: Untold[] = [];
  const back = (await read(hash, (parts) => (heard = parts))) ?? assert.fail();
  assert.deepEqual(heard, ['detail']);
  const texts = async (pictures: LayerValues['pictures']): Promise<unknown[]> =>
    Promise.all(pictures.map(async ({ file, lamp }) => [file.name, lamp, await file.bytes.text()]));
  assert.deepEqual(await texts(groundPictures(back)), [
    ['cat.jpg', [60, 45], 'small cat.jpg'],
    ['dog.jpg', null, 'small dog.jpg'],
  ]);
  assert.deepEqual(await texts(back.layers[1]?.pictures ?? []), [['owl.jpg', [1, 40], 'small owl.jpg']]);
  assert.equal(back.layers[1]?.mode, 'smoothest');
  // Where they cannot, that is told, and nothing of them is left.
  const left = withLayer(plate, newLayer(plate, 'border'));
  for (const shrink of [undefined, () => Promise.resolve(undefined)]) {
    const plain = await writeLink(left, shrink);
    assert.deepEqual(plain.untold, ['directions']);
    assert.deepEqual(
      (await read(plain.hash))?.layers.map(({ kind }) => kind),
      ['border'],
    );
  }
});

test('all pictures of a link share one room', async () => {
  const asked: number[] = [];
  const filling: Shrink = (_, room) => {
    asked.push(room);
    return Promise.resolve(new Uint8Array(Math.floor(room)));
  };
  const four = [1, 2, 3, 4].map((k) => ({ file: fileOf(`${k}.png`), lamp: null }));
  const total = (): number => asked.reduce((sum, one) => sum + Math.floor(one), 0);
  await writeLink(filledWith(newPlate(), 'picture', { pictures: four.slice(0, 2) }), filling);
  assert.deepEqual(asked.splice(0), [mostPictureBytes / 2, mostPictureBytes / 2]);
  const plate = filledWith(newPlate(), 'picture', { pictures: four });
  const [tone, shown] = [
    newLayer(plate, 'tones', { file: fileOf('5.png') }),
    newLayer(plate, 'picture', { pictures: [{ file: fileOf('6.png'), lamp: null }] }),
  ];
  await writeLink([tone, shown].reduce(withLayer, plate), filling);
  assert.equal(asked.length, 6);
  assert.ok(total() <= mostPictureBytes, String(asked));
});

test('drawings and flat colours travel as they are', async () => {
  const flat = { ...fileOf('flat.png', 'coloured'), id: 'flat' };
  const colours = [
    { colour: '#ff0000', angle: 30 },
    { colour: '#00ff7f', angle: -90 },
  ];
  const plate = [
    newLayer(newPlate(), 'drawing', { file: drawing(svg), mask: 'outside', maskFile: drawing(svg) }),
    newLayer(newPlate(), 'tones', { by: 'colours', file: flat, colours }),
  ].reduce(withLayer, { ...newPlate(), shape: newFileShape(drawing(svg), 'mm') });
  const { hash, untold } = await writeLink(plate, () => assert.fail('nothing is made smaller'));
  assert.deepEqual(untold, []);
  const back = (await read(hash)) ?? assert.fail();
  assert.ok(back.shape.kind === 'file');
  for (const file of [back.shape.file, back.layers[1]?.file, back.layers[1]?.maskFile]) {
    assert.deepEqual([file?.name, await file?.bytes.text()], ['d.svg', svg]);
  }
  assert.deepEqual([await back.layers[2]?.file?.bytes.text(), back.layers[2]?.colours], ['coloured', colours]);
  assert.deepEqual([back.shape.unitless, back.width, back.height], ['mm', plate.width, plate.height]);
});

test('what cannot travel is named, and the rest goes without it', async () => {
  const file = fileOf('a.png');
  const kept = newLayer(newPlate(), 'text', { text: 'kept' });
  const long: Stroke[] = [{ points: Array.from({ length: 9000 }, (_, k) => k / 8) }];
  const left: [LayerValues, Untold][] = [
    [newLayer(newPlate(), 'map', { file }), 'layers'],
    [newLayer(newPlate(), 'direction', { modeFile: file }), 'layers'],
    [newLayer(newPlate(), 'text', { text: 'A', font: fileOf('own.ttf') }), 'layers'],
    [newLayer(newPlate(), 'drawing', { file: drawing('x'.repeat(4001)) }), 'layers'],
    [newLayer(newPlate(), 'strokes', { strokes: long }), 'strokes'],
    ...unfinished({ drawing: drawing(svg) }).map((layer): [LayerValues, Untold] => [layer, 'layers']),
  ];
  for (const [layer, part] of left) {
    const plate = [layer, kept].reduce(withLayer, newPlate());
    const { hash, untold } = await writeLink(plate, small);
    assert.deepEqual(untold, [part], layer.kind);
    let heard: Untold[] = [];
    const back = await read(hash, (parts) => (heard = parts));
    assert.deepEqual(heard, untold);
    assert.deepEqual(
      back?.layers.map(({ kind, text }) => [kind, text]),
      [
        ['pattern', ''],
        ['text', 'kept'],
      ],
    );
  }
  // Of the ground, it is the directions.
  const grounds: [Fill, Partial<LayerValues>][] = [
    ['map', { file }],
    ['waves', { modeFile: file }],
    ['colours', { file: fileOf('large.png', 'x'.repeat(5000)) }],
  ];
  for (const [fill, given] of grounds) {
    const { hash, untold } = await writeLink(filledWith(newPlate(), fill, given), small);
    assert.deepEqual(untold, ['directions'], fill);
    assert.deepEqual((await read(hash))?.layers, []);
  }
  // A shape of a file too large, or of a picture, is its page.
  for (const one of [drawing('x'.repeat(4001)), file]) {
    const plate: Plate = { ...newPlate(), width: 33, shape: newFileShape(one) };
    const { hash, untold } = await writeLink(plate, small);
    assert.deepEqual(untold, ['shape']);
    assert.deepEqual(await read(hash), { ...plate, shape: newShape('rectangle') });
  }
});

test('several parts that cannot travel are told in their order', async () => {
  const file = fileOf('a.png');
  const long: Stroke[] = [{ points: Array.from({ length: 9000 }, (_, k) => k / 8) }];
  const plate = [
    newLayer(newPlate(), 'strokes', { strokes: long }),
    newLayer(newPlate(), 'map', { file }),
    newLayer(newPlate(), 'picture', { pictures: [{ file, lamp: null }] }),
  ].reduce(withLayer, changeGround({ ...newPlate(), shape: newFileShape(file) }, { modeFile: file }));
  const own = { ...plate, printer: { ...plate.printer, startGcode: 'M112' } };
  const all: Untold[] = ['shape', 'directions', 'detail', 'layers', 'strokes', 'blocks'];
  const { hash, untold } = await writeLink(own, small);
  assert.deepEqual(untold, all);
  let heard: Untold[] = [];
  assert.equal((await read(hash, (parts) => (heard = parts)))?.printer.startGcode, '');
  assert.deepEqual(heard, all);
});

test('whatever a link carries, it can be opened again', async () => {
  const chance = chances(3);
  const words = (length: number): string =>
    Array.from({ length }, () => String.fromCharCode(97 + Math.floor(26 * chance()))).join('');
  const bytes: Shrink = (_, room) =>
    Promise.resolve(Uint8Array.from({ length: Math.floor(room) }, () => Math.floor(256 * chance())));
  const points = Array.from({ length: 3000 }, () => Math.round(7000 * chance()) / 100);
  const pictures = [1, 2, 3, 4].map((k) => ({ file: fileOf(`${k}.png`), lamp: null }));
  const pictured = filledWith(newPlate(), 'picture', { pictures });
  const brushed = withLayer(pictured, newLayer(pictured, 'strokes', { strokes: [{ points }] }));
  const texts = Array.from({ length: mostLayers - 2 }, () => newLayer(newPlate(), 'text', { text: words(4000) }));
  for (const plate of [pictured, brushed, texts.reduce(withLayer, brushed), texts.reduce(withLayer, newPlate())]) {
    const { hash, untold } = await writeLink(plate, bytes);
    assert.ok(hash.length <= most, `${hash.length} characters`);
    const back = (await read(hash)) ?? assert.fail();
    assert.ok(back.layers.length > 0);
    assert.equal(
      back.layers.length < plate.layers.length,
      untold.some((part) => part !== 'detail'),
    );
  }
});

test('a link of version 2 opens as it was made', async () => {
  // Never made anew: somebody keeps it.
  const kept =
    '#plate=2.TZBNTsMwEIXv8tYjmqY_Et6yhAUS7KouTDNNTF3bsidtIfIBOBcXQ3FaYOV5M9Y3896AEP077wRqQDLWegc1J6ROBx57vTNiOSUohAsIQRsnUEidPzsQDszhtTMOaq9tYsJbb6yMGtH3ruEGhGQ-GWpzX9G62maC1R8cE9RmwMG4ZmRrEY6uLJgqhbM-cQKV94ldKx1UvbxbEfQxWCN9w1DLKtMvRfgiIGiB2iwqqqstIXrRYoqtFU0_FL6_gsGkXspt85qw98XZgz6xFvzD7nzDN-y6ouWIvVparGhUV2wnEpKazfgyXsh3PrbIW0IwO-kjpxJy8N5CofW2ebYamSDe26BHe0MmhFgSHhDNEaq-dThO4yR9Y_w4P3FMxVhNcPrIUHjkICXD9i9vwt7YsjvnnH8A';
  const plate = (await read(kept)) ?? assert.fail('it is no link');
  assert.deepEqual([plate.name, plate.width, plate.height, plate.shape.kind], ['Kept', 90, 60, 'rounded']);
  const [, text, code] = plate.layers;
  assert.deepEqual(
    [text?.kind, text?.text, text?.font, text?.at, text?.rotation],
    ['text', 'Épi', 'Caveat', [30, 20], 15],
  );
  assert.deepEqual([code?.kind, code?.text, code?.at], ['code', 'https://example.org', [60, 40]]);
  assert.equal(plate.print.rim, 2);
});

// --- Strangers' links --------------------------------------------------------------------------------------------------

test('other hashes are no links', async () => {
  const never = (): Promise<Engine> => assert.fail('no engine is asked for');
  for (const hash of ['', '#', '#help', '#plat', '#PLATE=2.x', '#x&plate=2.x']) {
    assert.equal(await readLink(hash, unpack, never), undefined);
  }
});

test('cut, changed and foreign links are refused with what is wrong', async () => {
  const { hash } = await writeLink(newPlate());
  for (const broken of [
    '#plate=',
    '#plate=2',
    '#plate=2.',
    '#plate=x.abc',
    '#plate=2.%20',
    '#plate=2.AAAA',
    '#plate=2.a',
  ])
    await refused(broken, 'LinkBroken');
  for (const keep of [0.2, 0.5, 0.9])
    await refused(hash.slice(0, 9 + Math.floor(keep * (hash.length - 9))), 'LinkBroken');
  await refused(`#plate=2.${deflateRawSync(Buffer.from([0xff, 0xfe, 0x80])).toString('base64url')}`, 'LinkBroken');
  await refused(`#plate=2.${deflateRawSync('{"project":').toString('base64url')}`, 'LinkBroken');
  assert.deepEqual((await refused(hash.replace('=2.', '=3.'), 'LinkTooNew')).values, { version: 3 });
  await refused(hash.replace('=2.', '=0.'), 'LinkTooNew');
});

test('a link of the first version is told to be of another', async () => {
  const link =
    '#plate=1.TY4xCsMwEAT_srUwJnEavSJfENIhHZFPwneOC6O_BydNuoVhhj0hYSV4wEFL6AR_4sWS4JFYI4bDwckK_G1xKMS52G8n3igaN9E_5whvUjgEyZXgZ4ew9sq2J4JfZodKkq_aPN0fw2FtF0BsorYFFkrXETJjyd9u52j7Rjppb63CI7eanjVgjA8';
  assert.deepEqual((await refused(link, 'LinkTooNew')).values, { version: 1 });
});

test('bombs are refused before they are unpacked', async () => {
  await refused(`#plate=2.${'A'.repeat(1_000_000)}`, 'LinkTooLong');
  const bomb = deflateRawSync(Buffer.alloc(8_000_000, ' ')).toString('base64url');
  assert.ok(bomb.length < most, 'the bomb must be small enough to get that far');
  await refused(`#plate=2.${bomb}`, 'LinkTooLong');
  await refused(hashOf({ name: 'x'.repeat(190_000) }), 'LinkValue');
});

test('what is no link’s data is refused', async () => {
  const { project } = await told(newPlate());
  const wrong: unknown[] = [
    ...[null, 1, 'x', [], true, {}],
    ...[null, 1, 'x', [], {}].map((other) => ({ project: other })),
    { project, more: 1 },
    ...[null, 'x', 7, [1]].map((files) => ({ project, files })),
    { project: { ...project, shape: { file: '0/a.svg' } } },
    { project: { ...project, shape: { file: '0/a.svg' } }, files: { '0/b.svg': 'AAAA' } },
    { project: { ...project, shape: { file: 'toString' } } },
    { project: { ...project, shape: { file: '__proto__' } } },
    ...['A', '!', 7, null, {}].map((data) => ({
      project: { ...project, shape: { file: 'a.svg' } },
      files: { 'a.svg': data },
    })),
    JSON.parse('{"__proto__": {}}') as unknown,
    { project: { ...project, studio: { version: 3 } } },
    { project: { ...project, studio: { version: 2, name: 7 } } },
    { project: { ...project, studio: 7 } },
  ];
  assert.ok((await read(hashOf({ project }))) !== undefined);
  assert.ok((await read(hashOf({ project, untold: 7 }))) !== undefined); // it is but told
  for (const value of wrong) await unfit(value);
  const { values } = await refused(hashOf({ project, more: 'x'.repeat(1000) }), 'LinkValue');
  assert.ok(values['where'] === 'more' && String(values['value']).length <= 41, JSON.stringify(values));
  const page = { version: 2, page: [{ toString: 7 }, 70] };
  assert.ok((await read(hashOf({ project: { ...project, studio: page } }))) !== undefined);
  const deep = `{"project":${'['.repeat(90_000)}${']'.repeat(90_000)}}`;
  await refused(`#plate=2.${deflateRawSync(deep).toString('base64url')}`);
  assert.equal(({} as Record<string, unknown>)['a'], undefined);
});

test('every value of a link’s project is checked: kind, range, unknown names', async () => {
  const { project } = await told({ ...newPlate(), shape: newShape('rounded') });
  const shape = { builtin: 'star', size: [70, 70] };
  const wrong: [string, unknown][] = [
    ...['disc', null, { builtin: 'blob' }, { builtin: 'rounded', radius: -1 }, { ...shape, extra: 1 }].map(
      (one): [string, unknown] => ['shape', one],
    ),
    ['shape', { ...shape, size: ['70', 70] }],
    ['shape', { ...shape, size: [-1, 70] }],
    ['shape', { ...shape, size: [1e9, 1e9] }],
    ['shape', { ...shape, points: 2 }],
    ['shape', { ...shape, points: 5.5 }],
    ['shape', { ...shape, corners: 'sharp' }],
    ['shape', { ...shape, offset: 51 }],
    ['shape', { ...shape, holes: {} }],
    ['shape', { ...shape, holes: [{ x: 1, y: 2 }] }],
    ['shape', { ...shape, holes: [{ x: 1, y: 2, diameter: 0 }] }],
    ['shape', { ...shape, holes: Array(17).fill({ x: 1, y: 2, diameter: 3 }) }],
    ['pictures', { spool: 'constructor' }],
    ['pictures', { slopes: [0, 1] }],
    ['toolpath', []],
    ['toolpath', { spacing: '0.4' }],
    ['toolpath', { spacing: 0 }],
    ['toolpath', { seed: 1.5 }],
    ['toolpath', { unknown: 1 }],
    ['toolpath', JSON.parse('{"__proto__": {"a": 1}}')],
    ['print', { layers: 0 }],
    ['printer', { name: 'two\nlines' }],
    ['printer', { bedMax: [1] }],
    ['printer', { profile: '../../etc/passwd' }],
    ['strokes', []],
    ['sillon', 2],
  ];
  for (const [section, value] of wrong) await unfit({ project: { ...project, [section]: value } });
});

test('layers of a link are let through as far as a control could have set them', async () => {
  const { project } = await told(newPlate());
  const linked = (layers: unknown): { project: object } => ({ project: { ...project, layers } });
  const of = async (layers: unknown): Promise<LayerValues | undefined> =>
    (await read(hashOf(linked(layers))))?.layers[0];
  assert.equal((await of([{ kind: 'border', width: 2 }]))?.width, 2);
  const stroke = { tool: 'comb', radius: 4, soft: 0.5, points: [0, 0, 1, 1] };
  const colour = { colour: '#ff0000', angle: 3 };
  const brushed = (...all: unknown[]): unknown => [{ kind: 'strokes', strokes: all }];
  assert.deepEqual((await of(brushed(stroke)))?.strokes, [stroke]);
  const [file, toned] = [
    'AAAA',
    (...all: unknown[]) => [{ kind: 'tones', by: 'colours', file: 'a.png', colours: all }],
  ];
  const withFile = (layers: unknown): object => ({ ...linked(layers), files: { 'a.png': file } });
  assert.deepEqual((await read(hashOf(withFile(toned(colour)))))?.layers[0]?.colours, [colour]);

  const bad: unknown[] = [
    ...[7, {}, [7], [{ kind: 'up' }], Array(mostLayers + 1).fill({ kind: 'border' })],
    [{ kind: 'border', width: 0 }],
    [{ kind: 'border', sparkle: 1 }],
    [{ kind: 'border', angle: null }],
    [{ kind: 'border', visible: 1 }],
    [{ kind: 'border', at: [1] }],
    [{ kind: 'border', size: [-1, 0] }],
    [{ kind: 'border', amplitude: 3 }], // of another kind
    [{ kind: 'text', text: 'x'.repeat(4097) }],
    [{ kind: 'text', text: 'A', font: 'a.ttf' }],
    [{ kind: 'text', text: 'A', font: '../secret.ttf' }],
    [{ kind: 'text', text: 'A', textSize: 0 }],
    [{ kind: 'picture' }],
    [{ kind: 'picture', pictures: {} }],
    [{ kind: 'picture', pictures: [{ file: 'gone.png' }] }],
    [{ kind: 'pattern', pattern: 'noise', seed: -1 }],
    [{ kind: 'map', file: { name: 'a.png' } }],
    [JSON.parse('{"kind":"border","__proto__":{"width":3}}')],
    ...[7, null, {}, { ...stroke, points: 'all' }, { ...stroke, points: [1] }, { ...stroke, points: [null, 1] }].map(
      (one) => brushed(stroke, one),
    ),
    brushed({ ...stroke, points: [1e5, 1] }),
    brushed({ ...stroke, radius: -1 }),
    brushed({ ...stroke, radius: 1e9 }),
    brushed({ ...stroke, soft: 'x' }),
    brushed({ ...stroke, tool: 'axe' }),
    brushed({ ...stroke, mode: 'up' }),
    brushed({ ...stroke, more: 1 }),
    brushed(...Array<unknown>(10_001).fill({ points: [] })),
  ];
  for (const layers of bad) await unfit(linked(layers));
  const painted: unknown[] = [
    ...[7, null, {}, { ...colour, colour: 'red' }, { ...colour, colour: '#ff000' }, { ...colour, colour: 7 }],
    { ...colour, colour: '#ff0000"' },
    { ...colour, angle: 'x' },
    { ...colour, angle: 1e3 },
    { ...colour, more: 1 },
  ];
  for (const one of painted) await unfit(withFile(toned(colour, one)));
  await unfit(withFile(toned(...Array<unknown>(33).fill(colour))));
  const lit = (lamp: unknown): object => withFile([{ kind: 'picture', pictures: [{ file: 'a.png', lamp }] }]);
  for (const lamp of [[0, 0], [0, 91], [0, 45, 1], ['x', 45], 7]) await unfit(lit(lamp));
});

test('random damage ends in a plate that controls could have set, or in an error of ours', async () => {
  const plate = withLayer(newPlate(), newLayer(newPlate(), 'text', { text: 'A' }));
  const { hash } = await writeLink(withPrinter(plate, 'voron-2-4-300'));
  const letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_';
  const chance = chances(7);
  const random = (below: number): number => Math.floor(chance() * below);
  for (let k = 0; k < 300; ++k) {
    const at = 9 + random(hash.length - 9);
    const damaged = hash.slice(0, at) + (letters[random(64)] ?? 'A') + hash.slice(at + 1);
    try {
      const plate = await read(damaged);
      assert.ok(plate !== undefined);
      assert.deepEqual(await read((await writeLink(plate)).hash), travelled(plate));
    } catch (error) {
      assert.ok(problemOf(error).code !== 'Internal', String(error));
    }
  }
});
