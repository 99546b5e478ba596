// Bodies: their level top faces, and the outlines that become plates.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { strToU8, zipSync } from 'fflate';
import { printOf } from '../../src/files/sliced.js';
import { bodyInput } from '../../src/model/body.js';
import { newFileShape } from '../../src/model/defaults.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import { readBody, stlOf } from '../../src/zones/mesh.js';
import { drawingOf, topFaces } from '../../src/zones/top-faces.js';
import { fileOf } from './support/pictures.js';

type Point = [number, number, number];

/** The walls of a box, or of a step of one, as triangles that face outwards. */
function box([x0, y0, z0]: Point, [x1, y1, z1]: Point): Point[] {
  const at = (k: number): Point => [k & 1 ? x1 : x0, k & 2 ? y1 : y0, k & 4 ? z1 : z0];
  const quads = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
  ];
  return quads.flatMap(([a = 0, b = 0, c = 0, d = 0]) => [a, b, c, a, c, d].map(at));
}
const mesh = (...points: Point[]): Float64Array => Float64Array.from(points.flat());
const file = (name: string, content: BlobPart): File => new File([content], name);
const step = (): Float64Array => mesh(...box([5, 5, 0], [25, 15, 3]), ...box([40, 5, 0], [52, 11, 8]));

test('level tops are found, the largest first, at their places; walls, bottoms and slopes are none', () => {
  const slope: Point[] = [
    [0, 0, 0],
    [30, 0, 0],
    [0, 30, 5],
  ];
  const faces = topFaces(mesh(...step().reduce<Point[]>(tripled, []), ...slope));
  assert.deepEqual(
    faces.map(({ z, areaMm2, corner, size }) => [z, areaMm2, corner, size]),
    [
      [3, 200, [5, 5], [20, 10]],
      [8, 72, [40, 5], [12, 6]],
    ],
  );
  assert.equal(faces[0]?.rings.length, 1);
});
const tripled = (all: Point[], value: number, k: number): Point[] => {
  if (k % 3 === 0) all.push([value, 0, 0]);
  else (all.at(-1) as Point)[k % 3] = value;
  return all;
};

test('a body whose triangles face inwards has the same tops', () => {
  const inside = mesh(...step().reduce<Point[]>(tripled, []).reverse());
  assert.deepEqual(
    topFaces(inside).map(({ z, areaMm2 }) => [z, areaMm2]),
    [
      [3, 200],
      [8, 72],
    ],
  );
});

/** A square top with a square hole, and nothing else. */
function frame(): Float64Array {
  const [outer, inner]: [number[][], number[][]] = [
    [
      [0, 0],
      [20, 0],
      [20, 20],
      [0, 20],
    ],
    [
      [5, 5],
      [15, 5],
      [15, 15],
      [5, 15],
    ],
  ];
  const points = [0, 1, 2, 3].flatMap((k): Point[] => {
    const next = (k + 1) % 4;
    const up = ([x = 0, y = 0]: number[]): Point => [x, y, 2];
    const [a, b, c, d] = [outer[k], outer[next], inner[next], inner[k]].map((point) => up(point ?? []));
    return [a, b, c, a, c, d] as Point[];
  });
  // Walls below, so that the body has an inside: which way is out follows from its volume.
  return mesh(...points, ...box([0, 0, 0], [20, 20, 1]));
}

test('holes are part of an outline, and the drawing is as large as the face', () => {
  const [face] = topFaces(frame());
  assert.ok(face !== undefined);
  assert.equal(face.areaMm2, 400);
  const [ring] = topFaces(frame()).filter(({ z }) => z === 2);
  assert.ok(ring !== undefined);
  assert.equal(ring.areaMm2, 300);
  assert.equal(ring.rings.length, 2);
  assert.match(drawingOf(ring), /width="20mm" height="20mm" viewBox="0 0 20 20"/);
  assert.match(drawingOf(ring), /fill-rule="evenodd"/);
  assert.equal(drawingOf(ring).match(/M/g)?.length, 2);
});

test('STL is read as bytes and as text, and written as the engine reads it', async () => {
  const given = step();
  const binary = await readBody(file('a.stl', await stlOf(given).arrayBuffer()));
  assert.deepEqual(binary, given);
  const corners = given.reduce<Point[]>(tripled, []).map((point) => `   vertex ${point.join(' ')}`);
  const text = await readBody(file('a.STL', `solid vertex\n${corners.join('\n')}\nendsolid\n`));
  assert.deepEqual(text, given);
  for (const wrong of ['', 'solid\nvertex 1 2 3\nendsolid', 'solid\nvertex 1 2 x\nvertex 1 2 3\nvertex 3 4 5\n'])
    await assert.rejects(readBody(file('a.stl', wrong)), { code: 'InvalidFile' });
});

const cube = (id: string, extra = ''): string => {
  const points = box([0, 0, 0], [10, 10, 10]);
  const vertices = points.map(([x, y, z]) => `<vertex x="${x}" y="${y}" z="${z}"/>`).join('');
  const triangles = Array.from({ length: points.length / 3 }, (_, k) => {
    const [a, b, c] = [3 * k, 3 * k + 1, 3 * k + 2];
    return `<triangle v1="${a}" v2="${b}" v3="${c}"/>`;
  }).join('');
  return `<object id="${id}" ${extra}><mesh><vertices>${vertices}</vertices><triangles>${triangles}</triangles></mesh></object>`;
};
const model = (content: string, unit = 'millimeter'): Uint8Array =>
  strToU8(`<?xml version="1.0"?><model unit="${unit}">${content}</model>`);
const packed = (entries: Record<string, Uint8Array>): BlobPart => zipSync(entries);

test('3MF is read as it is built: parts, places, units, other models of the package', async () => {
  const moved = '<build><item objectid="1" transform="1 0 0 0 1 0 0 0 1 100 50 5"/></build>';
  const plain = file('a.3mf', packed({ '3D/3dmodel.model': model(`<resources>${cube('1')}</resources>${moved}`) }));
  assert.equal(await printOf(plain), 'body');
  assert.deepEqual(
    topFaces(await readBody(plain)).map(({ z, corner, size }) => [z, corner, size]),
    [[15, [100, 50], [10, 10]]],
  );
  // Bambu Studio: components in models of their own, one of which is a modifier. A quarter turn, then a move.
  const parts =
    '<resources><object id="9"><components>' +
    '<component p:path="/3D/Objects/o.model" objectid="1" transform="0 1 0 -1 0 0 0 0 1 0 0 0"/>' +
    '<component p:path="/3D/Objects/o.model" objectid="2" transform="2 0 0 0 2 0 0 0 2 0 0 0"/>' +
    '</components></object></resources><build><item objectid="9" transform="1 0 0 0 1 0 0 0 1 30 0 0"/>' +
    '<item objectid="9" printable="0"/></build>';
  const bambu = packed({
    '3D/3dmodel.model': model(parts),
    '3D/Objects/o.model': model(`<resources>${cube('1')}${cube('2')}</resources>`),
    'Metadata/model_settings.config': strToU8(
      '<config><object id="9"><part id="1" subtype="normal_part"/><part id="2" subtype="modifier_part"/></object></config>',
    ),
  });
  assert.deepEqual(
    topFaces(await readBody(file('a.3mf', bambu))).map(({ z, corner }) => [z, corner]),
    [[10, [20, 0]]],
  );
  const inches = packed({
    'a.model': model(`<resources>${cube('1')}</resources><build><item objectid="1"/></build>`, 'inch'),
  });
  assert.equal(topFaces(await readBody(file('a.3mf', inches)))[0]?.z, 254);
});

test('modifiers of PrusaSlicer are no part of the body', async () => {
  const config =
    '<config><object id="1"><volume firstid="0" lastid="11"><metadata type="volume" key="volume_type" value="ParameterModifier"/></volume></object></config>';
  const both = packed({
    '3D/3dmodel.model': model(
      `<resources>${cube('1')}${cube('2')}</resources><build><item objectid="1"/><item objectid="2"/></build>`,
    ),
    'Metadata/Slic3r_PE_model.config': strToU8(config),
  });
  assert.equal((await readBody(file('a.3mf', both))).length, 12 * 9);
});

test('archives of something else, or that end early, are refused', async () => {
  for (const content of [packed({ 'a.txt': strToU8('a') }), packed({ 'a.model': model('') }), 'PK\x03\x04']) {
    await assert.rejects(readBody(file('a.3mf', content)), { code: 'InvalidFile' });
  }
  const nowhere = model('<resources></resources><build><item objectid="7"/></build>');
  await assert.rejects(readBody(file('a.3mf', packed({ 'a.model': nowhere }))), { code: 'InvalidFile' });
});

test('a body is told to the engine while the plate is its face, and refused when that has changed', () => {
  const [outline, solid] = [fileOf('part.svg', '<svg/>'), fileOf('part.stl', 'solid')];
  const body = { file: solid, face: [5, 6, 7], size: [20, 10], outline: outline.id } as const;
  const plate: Plate = { ...newPlate(), shape: newFileShape(outline, 'mm'), width: 20, height: 10, body };
  assert.deepEqual(bodyInput(plate), { body: solid.bytes, face: [5, 6, 7] });
  assert.equal(bodyInput(newPlate()), undefined);
  const grown = { ...plate, shape: { ...plate.shape, offset: 2 } };
  assert.deepEqual(bodyInput(grown)?.face, [3, 4, 7]);
  for (const other of [
    { ...plate, width: 40 },
    { ...plate, shape: newPlate().shape },
  ])
    assert.throws(() => bodyInput(other), {
      code: 'InvalidArgument',
      values: { reason: 'OffBody', name: 'part.stl' },
    });
});
