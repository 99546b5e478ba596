import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { createEngine, type Engine, type Picture } from 'sillon';
import { isAnimated } from '../../src/files/animated.js';
import { allowedRoles, factsOf, guessRoles } from '../../src/files/guess.js';
import { kindOf } from '../../src/files/kind.js';
import { identify, readFile, withFile, withFiles, withoutFiles } from '../../src/files/open.js';
import { cleanName, digest, plainDigest, stemOf } from '../../src/files/source-file.js';
import { newFileShape, newShape } from '../../src/model/defaults.js';
import { filledWith, groundFill, groundOf, groundPictures, patternFills, pictureFills } from '../../src/model/fills.js';
import { changeLayer, newLayer, withLayer } from '../../src/model/layer-list.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import { StudioError, type ProblemCode } from '../../src/model/problem.js';
import type { Opened, Role } from '../../src/model/file-role.js';
import { chances, colourPicture, fileOf, greyPicture } from './support/pictures.js';
import { encodeGreyPng } from './support/png16.js';

let engine: Engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
});

const inputs = resolve('examples/inputs');
const example = (name: string, as = name): File => new File([readFileSync(join(inputs, name))], as);
const text = (name: string, content: string): File => new File([content], name);
const svg = '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm"><rect width="90" height="50"/></svg>';
const plateWith = (change: Partial<Plate>): Plate => ({ ...newPlate(), ...change });

// --- What a file is ------------------------------------------------------------------------------------------------------

test('the bytes tell what a file is, not its name', () => {
  const told = (content: string | number[], name = 'a.txt'): string => {
    const { kind, mime } = kindOf(typeof content === 'string' ? Buffer.from(content) : Uint8Array.from(content), name);
    return `${kind} ${mime}`.trim();
  };
  assert.equal(told([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0], 'a.jpg'), 'picture image/png');
  assert.equal(told([0xff, 0xd8, 0xff, 0xe0]), 'picture image/jpeg');
  assert.equal(told([0x42, 0x4d, ...new Array<number>(24).fill(0)]), 'picture image/bmp');
  assert.equal(told([0x50, 0x4b, 3, 4]), 'zip application/zip');
  assert.equal(told([0x50, 0x4b, 5, 6]), 'zip application/zip');
  const tga = [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 4, 0, 24, 0];
  assert.equal(told(tga, 'A.TGA'), 'picture image/x-tga');
  assert.equal(told(tga, 'a.bin'), 'unknown');
  assert.equal(told(tga.slice(0, 12), 'a.tga'), 'unknown');
  for (const drawing of [
    '<svg>',
    '<svg/>',
    '\ufeff \n<?xml version="1.0"?><svg xmlns="x">',
    '<?xml version="1.0"?>\n<!-- made by <svg> tools > -->\n<!DOCTYPE svg PUBLIC "-//W3C" "svg11.dtd"><svg >',
    '<!DOCTYPE svg [ <!ENTITY ns "http://x"> <!ENTITY b "c"> ] ><svg\n>',
    '<svg:svg xmlns:svg="x">',
  ]) {
    assert.equal(told(drawing, 'a.png'), 'svg image/svg+xml', drawing);
  }
  for (const other of ['<html><svg></svg></html>', '<svgx>', '<!-- <svg>', '<?xml <svg>', '<!DOCTYPE svg', 'svg', ''])
    assert.equal(told(other, 'a.svg'), 'unknown', other);
  for (const font of ['\0\x01\0\0', 'OTTO', 'true', 'ttcf', 'wOFF', 'wOF2'])
    assert.equal(told(`${font}\0\0`, 'a.png'), 'font font/sfnt', font);
  const utf16 = [...Buffer.from('\ufeff<?xml version="1.0"?><svg>', 'utf16le')];
  assert.equal(told(utf16), 'svg image/svg+xml');
  assert.equal(told(' \n{ "sillon": 1 }', 'a.svg'), 'json application/json');
  assert.equal(told('[1]'), 'unknown');
  assert.equal(told('G28\nG1 X1'), 'unknown');
});

test('a packed drawing is opened as the drawing inside it, and nothing else that is packed', async () => {
  for (const [name, plain] of [
    ['leaf.svgz', 'leaf.svg'],
    ['leaf.SVG.gz', 'leaf.svg'],
    ['leaf', 'leaf.svg'],
  ] as const) {
    const { source, kind } = await readFile(new File([gzipSync(svg)], name));
    assert.deepEqual([source.name, kind, await source.bytes.text()], [plain, 'svg', svg]);
  }
  const broken = gzipSync(svg);
  for (const bytes of [gzipSync('G28'), broken.subarray(0, 60), gzipSync(Buffer.alloc(65e6))])
    await assert.rejects(readFile(new File([bytes], 'leaf.svgz')), { code: 'UnknownFile' });
});

test('hostile beginnings are no drawing', () => {
  for (const piece of ['<!--', '<!-- -->', '<?', '<?a?>', '<!doctype', '<!DOCTYPE [>', ' ', '<', '<a:'])
    assert.equal(kindOf(Buffer.from(piece.repeat(20_000)), 'a.svg').kind, 'unknown', piece);
});

test('equal bytes have one id, with and without the browser’s digest', async () => {
  const bytes = new TextEncoder().encode('abc');
  assert.equal(await digest(bytes), 'ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad');
  assert.equal(plainDigest(bytes), plainDigest(new TextEncoder().encode('abc')));
  const chance = chances(3);
  const ids = new Set(
    Array.from({ length: 2000 }, (_, k) => plainDigest(Uint8Array.from({ length: k % 9 }, () => 256 * chance()))),
  );
  assert.ok(ids.size > 1700, `${ids.size}`); // the shortest are few
  assert.notEqual(plainDigest(Uint8Array.of(1, 0)), plainDigest(Uint8Array.of(1)));
});

test('names lose folders and control characters', () => {
  assert.equal(cleanName('../a\\b/Leaf ✨.svg'), 'Leaf ✨.svg');
  assert.equal(cleanName('a\u0000b\nc\ud800'), 'abc');
  assert.equal(cleanName('a/'), 'file');
  assert.equal(Array.from(cleanName('✨'.repeat(500))).length, 120);
  assert.equal(stemOf('leaf.final.svg'), 'leaf.final');
  assert.equal(stemOf('.svg'), '.svg');
});

// --- What it may be for ----------------------------------------------------------------------------------------------------

const deepPicture = (width: number, height: number, at: (x: number, y: number) => number): Picture => ({
  width,
  height,
  channels: 1,
  samples: Uint16Array.from({ length: width * height }, (_, k) => 65535 * at(k % width, Math.floor(k / width))),
});
const chance = chances(5);
const pictures = {
  ramp: greyPicture(64, 48, (x, y) => (x + y) / 110),
  noise: greyPicture(64, 64, () => chance()),
  deepRamp: deepPicture(64, 64, (x) => x / 63),
  flat: greyPicture(32, 32, () => 0.5),
  logo: greyPicture(64, 64, (x, y) => (Math.hypot(x - 32, y - 32) < 20 ? 1 : 0)),
  // Two greys, with noise as JPEG leaves it and softened edges.
  scan: greyPicture(64, 64, (x) => 0.3 + 0.4 * Math.min(1, Math.max(0, (x - 30) / 3)) + 0.02 * chance()),
  modes: greyPicture(64, 64, (x, y) => ((Math.floor(x / 16) + (y > 31 ? 1 : 0)) % 4) / 3),
  tangents: colourPicture(64, 64, (x, y) => {
    const angle = Math.atan2(y - 31.5, x - 31.5);
    return [0.5 + Math.cos(angle) / 2, 0.5 + Math.sin(angle) / 2, 0.5];
  }),
  // Colours of all kinds, and a picture of one colour.
  photo: colourPicture(64, 64, (x, y) => [x / 63, y / 63, chance()]),
  sky: colourPicture(64, 64, (x, y) => [0.2 + x / 400, 0.4 + y / 300, 0.9]),
};

test('a picture’s figures tell what it is probably for', () => {
  const guess = (picture: Picture, name = 'x.png'): Role | undefined =>
    guessRoles([{ name, facts: factsOf(picture) }], newPlate())[0];
  const expected: Record<keyof typeof pictures, Role> = {
    ramp: 'lamp',
    noise: 'lamp',
    deepRamp: 'angle',
    flat: 'lamp',
    logo: 'levels',
    scan: 'levels',
    modes: 'modes',
    tangents: 'tangent',
    photo: 'lamp',
    sky: 'lamp',
  };
  for (const [name, role] of Object.entries(expected)) {
    assert.equal(guess(pictures[name as keyof typeof pictures]), role, name);
  }
  // As the engine decodes them, bytes come as multiples of 257.
  const { width, height, samples } = pictures.ramp;
  const wide = { width, height, channels: 1 as const, samples: Uint16Array.from(samples, (byte) => 257 * byte) };
  assert.equal(guess(wide), 'lamp');
  // Black ink on nothing, as logos come.
  const ink = Uint8Array.from(Array.from(pictures.logo.samples).flatMap((tone) => [0, tone]));
  const transparent = { ...pictures.logo, channels: 2 as const, samples: ink };
  assert.equal(guess(transparent), 'levels');
});

test('names help where the pixels allow it', () => {
  const guess = (name: string, picture: Picture): Role | undefined =>
    guessRoles([{ name, facts: factsOf(picture) }], newPlate())[0];
  assert.equal(guess('leaf_angle.png', pictures.ramp), 'angle');
  assert.equal(guess('leafAngle.png', pictures.ramp), 'angle');
  assert.equal(guess('line-field.png', pictures.ramp), 'angle');
  assert.equal(guess('veins ROTATION 2.png', pictures.ramp), 'rotation');
  assert.equal(guess('veins_tangent.png', pictures.photo), 'tangent');
  assert.equal(guess('veins_tangent.png', pictures.ramp), 'lamp'); // grey tells no tangents
  assert.equal(guess('angle.jpg', pictures.photo), 'lamp');
  assert.equal(guess('line_mode.png', pictures.logo), 'modes');
  assert.equal(guess('mask.png', pictures.logo), 'mask');
  assert.equal(guess('modern house.png', pictures.ramp), 'lamp');
  assert.equal(guess('untitled.png', pictures.ramp), 'lamp');
});

test('files that come together share the work', () => {
  const facts = (name: keyof typeof pictures): ReturnType<typeof factsOf> => factsOf(pictures[name]);
  const roles = (...files: (keyof typeof pictures | 'svg')[]): Role[] =>
    guessRoles(
      files.map((name) => ({ name: 'x', facts: name === 'svg' ? undefined : facts(name) })),
      newPlate(),
    );
  assert.deepEqual(roles('svg'), ['shape']);
  assert.deepEqual(roles('svg', 'deepRamp', 'modes'), ['shape', 'angle', 'modes']);
  assert.deepEqual(roles('logo', 'deepRamp'), ['mask', 'angle']);
  assert.deepEqual(roles('photo', 'logo'), ['lamp', 'mask']);
  assert.deepEqual(roles('svg', 'logo'), ['shape', 'levels']);
  assert.deepEqual(roles('svg', 'logo', 'photo'), ['shape', 'lamp', 'more']);
  assert.deepEqual(roles('photo', 'svg', 'logo'), ['lamp', 'shape', 'more']);
  assert.deepEqual(roles('ramp', 'modes'), ['angle', 'modes']);
  assert.deepEqual(roles('photo', 'modes'), ['lamp', 'modes']);
  assert.deepEqual(roles('photo', 'ramp'), ['lamp', 'more']);
  assert.deepEqual(roles('svg', 'svg'), ['shape', 'none']);
  // One after the other: a map of directions waits for an outline.
  const mapped = filledWith(newPlate(), 'map', { file: fileOf('a.png') });
  const logo = [{ name: 'x', facts: facts('logo') }];
  assert.deepEqual(guessRoles(logo, mapped), ['mask']);
  assert.deepEqual(guessRoles(logo, { ...mapped, shape: newFileShape(fileOf('a.svg')) }), ['levels']);
});

test('a drawing of several colours tells directions, where nobody has chosen others', () => {
  const drawing = { name: 'flag.svg', facts: undefined, colours: 3 };
  const plain = newPlate();
  for (const fill of patternFills) assert.deepEqual(guessRoles([drawing], filledWith(plain, fill)), ['colours'], fill);
  assert.deepEqual(guessRoles([drawing], { ...plain, layers: [] }), ['colours']);
  assert.deepEqual(guessRoles([drawing], filledWith(plain, 'colours', { file: fileOf('a.svg') })), ['colours']);
  assert.deepEqual(guessRoles([{ ...drawing, colours: 1 }], plain), ['shape']);
  for (const fill of pictureFills.filter((one) => one !== 'colours')) {
    assert.deepEqual(guessRoles([drawing], filledWith(plain, fill)), ['shape'], fill);
  }
  const combed = withLayer(plain, newLayer(plain, 'strokes', { strokes: [{ points: [0, 0, 1, 1] }] }));
  assert.deepEqual(guessRoles([drawing], combed), ['shape']);
  const photo = { name: 'cat.png', facts: factsOf(pictures.ramp) };
  assert.deepEqual(guessRoles([drawing, photo], plain), ['shape', 'lamp']);
});

test('every guess is allowed', () => {
  for (const picture of Object.values(pictures)) {
    for (const name of ['x', 'a_angle', 'a_rotation', 'a_tangent', 'a_mode', 'a_mask']) {
      const [role = 'project'] = guessRoles([{ name, facts: factsOf(picture) }], newPlate());
      assert.ok(allowedRoles(true).includes(role));
    }
  }
  assert.deepEqual(allowedRoles(false), ['shape', 'colours', 'none']);
});

test('white artwork on a transparent ground is told from pictures of one tone', () => {
  const told = (tone: number, coverAt: (x: number) => number): boolean => {
    const samples = Uint8Array.from({ length: 2 * 64 * 64 }, (_, k) => (k % 2 === 0 ? tone : coverAt((k >> 1) % 64)));
    return factsOf({ width: 64, height: 64, channels: 2, samples }).whiteOnClear;
  };
  const half = (x: number): number => (x < 30 ? 0 : 255);
  assert.ok(told(255, half));
  assert.ok(told(250, (x) => 4 * x));
  assert.ok(!told(0, half)); // on paper it is seen
  assert.ok(!told(255, () => 255));
  assert.ok(!told(255, () => 0));
  assert.ok(!factsOf(pictures.flat).whiteOnClear);
});

test('what nothing can be seen of is not laid beside other pictures', () => {
  const facts = factsOf(pictures.ramp);
  const flat = factsOf(pictures.flat);
  const files = [facts, flat, facts, flat].map((one) => ({ name: 'x', facts: one }));
  assert.deepEqual(guessRoles(files, newPlate()), ['lamp', 'none', 'more', 'none']);
  assert.deepEqual(guessRoles([{ name: 'x', facts: flat }], newPlate()), ['lamp']);
});

test('an animation is known by its bytes', () => {
  const bytes = (...parts: (string | number[])[]): Uint8Array =>
    Uint8Array.from(parts.flatMap((part) => (typeof part === 'string' ? [...Buffer.from(part, 'latin1')] : part)));
  const control = [0x21, 0xf9, 4, 0, 0, 0, 0, 0];
  const image = [0x2c, 0, 0, 0, 0, 1, 0, 1, 0, 0];
  const gif: [string, number[]] = ['GIF89a', [1, 0, 1, 0, 0, 0, 0]];
  assert.ok(isAnimated(bytes(...gif, control, image, control, image)));
  assert.ok(!isAnimated(bytes(...gif, control, image)));
  const png = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
  const chunk = (name: string): number[] => [0, 0, 0, 1, ...Buffer.from(name), 7, 0, 0, 0, 0];
  assert.ok(isAnimated(bytes(png, chunk('IHDR'), chunk('acTL'), chunk('IDAT'))));
  assert.ok(!isAnimated(bytes(png, chunk('IHDR'), chunk('IDAT'), chunk('acTL'))));
  assert.ok(!isAnimated(bytes(png, [0xff, 0xff, 0xff, 0xff], 'junk')));
  assert.ok(isAnimated(bytes('RIFF....WEBPVP8X....', [2])));
  assert.ok(!isAnimated(bytes('RIFF....WEBPVP8X....', [0x10])));
  assert.ok(isAnimated(bytes([0, 0, 0, 0x20], 'ftypavis....mif1')));
  assert.ok(!isAnimated(bytes([0, 0, 0, 0x20], 'ftypavif....mif1')));
  assert.ok(!isAnimated(bytes()));
});

test('a drawing that takes minutes to read is refused before', async () => {
  const drawing = (content: string): File => text('map.svg', `<svg viewBox="0 0 40 30">${content}</svg>`);
  const values = (file: File): Promise<unknown> =>
    readFile(file).then(
      () => undefined,
      (error: unknown) => (error as StudioError).values,
    );
  const name = 'map.svg';
  assert.deepEqual(await values(drawing('<path/>'.repeat(60_000))), { name, elements: 60_001, most: 50_000 });
  assert.equal(await values(drawing('<path/>'.repeat(40_000))), undefined);
  const long = drawing(`<path d="M${'1 2 '.repeat(3_000_000)}"/>`);
  assert.deepEqual(await values(long), { name, megabytes: 13, most: 10 });
  const photo = `<image href="data:image/png;base64,${'AAAA'.repeat(3_000_000)}"/>`;
  assert.equal(await values(drawing(photo)), undefined); // pictures are left out, and cost nothing
});

// --- Into a plate ------------------------------------------------------------------------------------------------------------

test('a strip is as large as another page by its area, and no longer than the bed', () => {
  const file = fileOf('a.png');
  const sized = (plate: Plate, size: [number, number]): [number, number] => {
    const { width, height, shape } = withFile(plate, file, 'lamp', size);
    assert.equal(shape.kind, 'rectangle');
    return [width, Math.round(10 * height) / 10];
  };
  const fresh = newPlate();
  assert.deepEqual(sized(fresh, [3000, 1000]), [70, 23.3]); // not yet
  assert.deepEqual(sized(fresh, [8000, 500]), [161.7, 10.1]);
  assert.deepEqual(sized(fresh, [500, 8000]), [10.1, 161.6]);
  assert.deepEqual(sized(fresh, [100, 9000]), [2.2, 198]); // of a bed of 220 mm
  // The next picture is as large as it would have been at once.
  const strip = withFile(fresh, file, 'lamp', [8000, 500]);
  assert.deepEqual(sized(strip, [600, 300]), [70, 35]);
  assert.deepEqual(sized(strip, [500, 8000]), [10.1, 161.6]);
});

test('a drawing is as large as it was drawn, where that can be printed', () => {
  const file = fileOf('a.svg');
  const sized = (size: [number, number]): [number, number] => {
    const { width, height } = withFile(newPlate(), file, 'shape', size);
    return [width, height];
  };
  assert.deepEqual(sized([120, 80]), [120, 80]);
  assert.deepEqual(sized([6, 3]), [70, 35]);
  assert.deepEqual(sized([2000, 1000]), [70, 35]);
  assert.deepEqual(sized([200, 500]), [28, 70]);
  const again = withFile(plateWith({ shape: newFileShape(fileOf('b.svg'), 'mm') }), file, 'shape', [20, 10]);
  assert.deepEqual(again.shape, newFileShape(file, 'mm'));
});

test('built-in shapes take a picture’s proportions; drawn ones keep theirs', () => {
  const file = fileOf('a.png');
  const framed = (shape: Plate['shape'], size: [number, number]): unknown => {
    const made = withFile(plateWith({ shape, width: 60, height: 80 }), file, 'tone', size);
    return [made.shape.kind, made.width, made.height];
  };
  assert.deepEqual(framed(newShape('rectangle'), [640, 480]), ['rectangle', 80, 60]);
  assert.deepEqual(framed(newShape('rounded'), [480, 640]), ['rounded', 60, 80]);
  assert.deepEqual(framed(newShape('disc'), [500, 500]), ['disc', 60, 80]);
  assert.deepEqual(framed(newShape('disc'), [800, 400]), ['rectangle', 80, 40]);
  assert.deepEqual(framed(newFileShape(file), [640, 480]), ['file', 60, 80]);
  const masked = withFile(newPlate(), file, 'mask', [200, 100]);
  assert.deepEqual([masked.shape.kind, masked.width, masked.height], ['file', 70, 35]);
  const thin = withFile(newPlate(), file, 'mask', [1, 10_000]);
  assert.ok(thin.width >= 0.1 && thin.height <= 10_000);
});

test('another picture of the same use keeps what was set for it', () => {
  const [a, b] = [fileOf('a.png'), fileOf('b.png')];
  const plate = filledWith(newPlate(), 'brightness', { file: a, from: 12, contrast: 2 });
  const square: [number, number] = [1, 1];
  assert.deepEqual(withFile(plate, b, 'tone', square).layers, changeLayer(plate, 1, () => ({ file: b })).layers);
  assert.deepEqual(withFile(plate, b, 'edges', square).layers, filledWith(plate, 'edges', { file: b }).layers);
  const map = groundOf(withFile(plate, b, 'tangent', square));
  assert.deepEqual([map?.kind, map?.encoding, map?.file], ['map', 'tangent', b]);
  // Another encoding of the same map is the same fill.
  const turned = filledWith(newPlate(), 'map', { file: a, encoding: 'angle', mode: 'parallel' });
  const rotated = groundOf(withFile(turned, b, 'rotation', square));
  assert.deepEqual([rotated?.encoding, rotated?.file, rotated?.mode], ['rotation', b, 'parallel']);
  assert.equal(withFile(plate, b, 'none', square), plate);
});

test('modes lie over whatever fills the plate', () => {
  const b = fileOf('b.png');
  const plate = filledWith(newPlate(), 'noise', { mode: 'smoothest' });
  const ground = groundOf(withFile(plate, b, 'modes', [1, 1]));
  assert.deepEqual([ground?.pattern, ground?.mode, ground?.modeFile], ['noise', 'smoothest', b]);
  const bare = { ...plate, layers: [] };
  const laid = groundOf(withFile(bare, b, 'modes', [1, 1]));
  assert.deepEqual([laid?.kind, laid?.modeFile], ['direction', b]);
});

test('a picture that fills the plate leaves the layers above it alone', () => {
  const plate = withLayer(newPlate(), newLayer(newPlate(), 'text', { text: 'A' }));
  for (const role of ['lamp', 'tone', 'edges', 'levels', 'angle', 'modes'] as const) {
    const made = withFile(plate, fileOf('b.png'), role, [1, 1]);
    assert.equal(made.layers.length, 2, role);
    assert.equal(made.layers[1], plate.layers[1], role);
  }
  // Where letters lie lowest, it goes below them.
  const letters = { ...plate, layers: plate.layers.slice(1) };
  const made = withFile(letters, fileOf('b.png'), 'tone', [1, 1]);
  assert.deepEqual(
    made.layers.map(({ kind, id }) => [kind, id]),
    [
      ['tones', 3],
      ['text', 2],
    ],
  );
});

// --- With the engine -----------------------------------------------------------------------------------------------------------

const rolesOf = ({ opened }: { opened: Opened[] }): Role[] => opened.map(({ role }) => role);

test('the examples’ own files are recognised, and make the plate', async () => {
  const found = await identify(
    [example('logo_mode.png', '1.png'), example('logo_angle.png', '2.png'), example('logo.svg', '3')],
    newPlate(),
    engine,
  );
  assert.deepEqual(rolesOf(found), ['modes', 'angle', 'shape']);
  assert.equal(found.project, undefined);
  assert.deepEqual(
    found.opened.map(({ source }) => source.bytes.type),
    ['image/png', 'image/png', 'image/svg+xml'],
  );
  const plate = await withFiles(newPlate(), found.opened, engine);
  assert.equal(plate.name, '1');
  assert.equal(plate.shape.kind, 'file');
  assert.equal(groundFill(plate), 'map');
  assert.equal(groundOf(plate)?.modeFile?.name, '1.png');
  const shape = await engine.readShape({ file: example('logo.svg'), pageWidth: plate.width });
  assert.ok(Math.abs(plate.height - shape.page[1]) < 1e-5);
  // Roles can be changed.
  const others = found.opened.map((one) =>
    one.role === 'angle' ? { ...one, role: 'tone' as const } : { ...one, role: 'none' as const },
  );
  const toned = await withFiles(newPlate(), others, engine);
  assert.equal(groundFill(toned), 'brightness');
  assert.deepEqual([groundOf(toned)?.modeFile, toned.name], [null, '2']);
  assert.equal((await withFiles(plateWith({ name: 'kept' }), others, engine)).name, 'kept');
});

test('another role keeps every edit since the files were opened', async () => {
  const wide = await encodeGreyPng(
    40,
    10,
    new Uint8Array(400).map((_, k) => k % 251),
  );
  const before = newPlate();
  const { opened: files } = await identify([new File([wide], 'photo.png')], before, engine);
  const made = await withFiles(before, files, engine);
  const opened = { before, made, files };
  assert.deepEqual(withoutFiles(made, opened), before);
  const edited = { ...made, name: 'Gift', print: { ...made.print, base: 5 } };
  assert.deepEqual(withoutFiles(edited, opened), { ...before, name: 'Gift', print: { ...before.print, base: 5 } });
  // A size is of no use to another shape.
  const larger = { ...made, width: 100, height: 25 };
  const { shape, width, height, layers } = withoutFiles(larger, opened);
  assert.deepEqual([shape, width, height, layers], [made.shape, 100, 25, before.layers]);
  // Of the drawn shape it stays, whatever else the drawing is used for.
  const drawing = (await identify([text('logo.svg', svg)], before, engine)).opened;
  const plain = await withFiles(before, drawing, engine);
  const sized = { ...plain, width: 77, height: 57.75 };
  for (const role of ['colours', 'shape'] as const) {
    const other = drawing.map((one) => ({ ...one, role }));
    const kept = await withFiles(withoutFiles(sized, { before, made: plain, files: drawing }), other, engine);
    assert.deepEqual([kept.width, kept.height], [77, 57.75], role);
  }
  // A picture whose lamp was moved is there once, whatever it is used as.
  const moved: Plate = { ...made, pictures: { ...made.pictures, lampSize: 0.01 } };
  const again = files.map((one) => ({ ...one, role: 'more' as const }));
  const lit = await withFiles(withoutFiles(moved, opened), again, engine);
  assert.deepEqual([groundPictures(lit).length, lit.pictures.lampSize], [1, 0.01]);
  // And so it is where a hand has moved its lamp.
  const turned = changeLayer(made, 1, ({ pictures }) => ({
    pictures: pictures.map((one) => ({ ...one, lamp: [1, 2] })),
  }));
  const back = await withFiles(withoutFiles(turned, opened), again, engine);
  assert.equal(groundPictures(back).length, 1);
});

test('a name that is a file’s goes on to the next picture, and not to what it does not show', async () => {
  const named = async (plate: Plate, role: Role, name: string): Promise<Plate> => {
    const grey = await encodeGreyPng(
      9,
      9,
      new Uint8Array(81).map((_, k) => 3 * k),
    );
    const { opened } = await identify([new File([grey], name)], plate, engine);
    return withFiles(
      plate,
      opened.map((one) => ({ ...one, role })),
      engine,
    );
  };
  const first = await named(newPlate(), 'lamp', 'cat.png');
  assert.equal(first.name, 'cat');
  assert.equal((await named(first, 'more', 'coins.png')).name, 'coins');
  assert.equal((await named(first, 'modes', 'modes.png')).name, 'cat');
  assert.equal((await named({ ...first, name: 'Gift' }, 'more', 'coins.png')).name, 'Gift');
});

test('shapes come first, in whatever order files are dropped', async () => {
  const wide = await encodeGreyPng(
    40,
    10,
    new Uint8Array(400).map((_, k) => k % 251),
  );
  const found = await identify([new File([wide], 'photo.png'), text('shape.svg', svg)], newPlate(), engine);
  assert.deepEqual(rolesOf(found), ['lamp', 'shape']);
  const plate = await withFiles(newPlate(), found.opened, engine);
  assert.deepEqual([plate.width, plate.height, plate.shape.kind], [40, 30, 'file']);
});

test('what of a drawing is not in its shape is told, and where a printer’s file belongs', async () => {
  const told: string[] = [];
  const tell = ({ code, values }: StudioError): void => {
    told.push(`${code} ${String(values['name'])}`);
  };
  const drawing = (content: string): File =>
    text('a.svg', `<svg viewBox="0 0 40 30"><rect width="40" height="30"/>${content}</svg>`);
  const flowing = '<flowRoot>a</flowRoot>';
  const inArial = '<text y="20" font-family="Arial">a</text>';
  for (const content of ['', flowing, `<defs>${flowing}</defs>`, '<image/>', '<text y="20">a</text>', inArial]) {
    const { opened } = await identify([drawing(content)], newPlate(), engine);
    await withFiles(newPlate(), opened, engine, tell);
  }
  assert.deepEqual(told, ['LeftOut a.svg', 'LeftOut a.svg', 'OtherFont a.svg']);
  await assert.rejects(identify([text('donor.gcode', 'G28')], newPlate(), engine), { code: 'PrinterFileHere' });
});

test('a project counts alone, and takes the files that it names', async () => {
  const json = text(
    'plate.json',
    '{ "sillon": 1, "shape": { "file": "leaf.svg" }, "layers": [{ "kind": "direction", "angle": 12 }] }',
  );
  const found = await identify([text('leaf.svg', svg), json], newPlate(), engine);
  assert.deepEqual(found.opened, []);
  assert.ok(found.project !== undefined);
  assert.deepEqual(found.project.layers, filledWith({ ...newPlate(), layers: [] }, 'direction', { angle: 12 }).layers);
  assert.deepEqual([found.project.width, found.project.height], [40, 30]);
});

test('what cannot be opened is named', async () => {
  const refused = async (files: File[], code: ProblemCode, said: RegExp): Promise<void> => {
    await assert.rejects(identify(files, newPlate(), engine), (error) => {
      assert.ok(error instanceof StudioError, String(error));
      assert.equal(error.code, code);
      assert.match(`${String(error.values['name'])} ${error.detail}`, said);
      return true;
    });
  };
  const json = '{ "sillon": 1, "layers": [{ "kind": "direction" }] }';
  await refused([text('notes.txt', 'hello')], 'UnknownFile', /^notes\.txt/);
  await refused([text('notes.txt', 'hello'), text('empty.png', '')], 'UnknownFile', /^notes\.txt/);
  await refused([text('a.json', json), text('b.json', json)], 'TooManyFiles', /./);
  await refused([text('a.json', '{ "some": "thing" }')], 'BrokenProject', /^a\.json .*some/);
  const png = readFileSync(join(inputs, 'photo.png'));
  await refused([new File([png.subarray(0, 500)], 'cut.png')], 'InvalidFile', /^cut\.png cut\.png: /);
  await refused([new File([new Uint8Array(65e6)], 'large.png')], 'InvalidFile', /large\.png has 65 MB; at most 64 MB/);
  const part = new File([new Uint8Array(60e6)], 'a.png');
  await refused([part, part, part, part, part], 'InvalidFile', /300 MB together; at most 256 MB/);
  const gone = new File(['x'], 'gone.png');
  gone.arrayBuffer = () => Promise.reject(new DOMException('it has gone', 'NotFoundError'));
  await refused([gone], 'InvalidFile', /^gone\.png .*it has gone/);
});

test('what can be opened is, and why the rest cannot is said of each', async () => {
  const png = readFileSync(join(inputs, 'photo.png'));
  const files = [
    text('empty.png', ''),
    text('leaf.svg', svg),
    text('page.png', '%PDF-1.7'),
    text('plan.DXF', '  0\nSECTION'),
    text('logo.ai', '%PDF-1.7'),
    text('part.step', 'ISO-10303-21;'),
    new File([png.subarray(0, 500)], 'cut.png'),
    text('cut.svg', svg.slice(0, -20)),
  ];
  const { opened, refused } = await identify(files, newPlate(), engine);
  assert.deepEqual(
    opened.map(({ source }) => source.name),
    ['leaf.svg'],
  );
  assert.deepEqual(
    refused.map(({ code, values }) => [code, values]),
    [
      ['UnknownFile', { name: 'empty.png', format: 'empty' }],
      ['UnknownFile', { name: 'page.png', format: 'PDF' }],
      ['UnknownFile', { name: 'plan.DXF', format: 'DXF' }],
      ['UnknownFile', { name: 'logo.ai', format: 'Illustrator' }],
      ['BodyHere', { name: 'part.step' }],
      ['InvalidFile', { name: 'cut.png', reason: 'PictureCutOff', file: 'file', format: 'PNG' }],
      ['InvalidFile', { name: 'cut.svg', reason: 'SvgNotXml', line: 1, text: '""' }],
    ],
  );
});
