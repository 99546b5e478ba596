// One plate in three programs: the studio, the npm package and the command line write the same G-code, byte for byte.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { unzipSync } from 'fflate';
import { createEngine } from 'sillon';

import { dateOf, natively } from './support/native.js';
import { sharedBench } from './support/shared.js';
import { linkOf } from './support/small.js';
import { fileAt, inputs, skip, start } from './support/studio.js';

const bench = sharedBench(skip, start);

let engine;
before(async () => (engine = await createEngine({ threads: 'off' })));
after(() => engine.dispose());

/** Makes the project with the npm package, as somebody's program would. */
async function packaged(zip, date) {
  const files = unzipSync(zip);
  const { shape, layers, pictures, toolpath, print, printer } = await engine.readProject(
    Buffer.from(files['project.json']).toString(),
  );
  const brought = (part) => {
    const named = ['file', 'maskFile', 'modeFile'].filter((key) => part[key] !== undefined);
    const own = named.map((key) => [key, part[key] === '' ? undefined : files[part[key]]]);
    return { ...part, ...Object.fromEntries(own), ...(part.pictures && { pictures: part.pictures.map(brought) }) };
  };
  const input = { shape: brought(shape), layers: layers.map(brought), pictures, printer, print };
  const made = await engine.generateToolpath(input, toolpath, { measure: true });
  const { blob } = await engine.writeGcode(made.toolpath, printer, { ...print, date });
  return blob.text();
}

/** Line of the first difference, with both. */
function firstDifference(a, b) {
  if (a === b) return undefined;
  const [left, right] = [a.split('\n'), b.split('\n')];
  const k = left.findIndex((line, at) => line !== right[at]);
  return [k, left[k]?.slice(0, 200), right[k]?.slice(0, 200)];
}

/** Opens pictures of examples/inputs, each for its use. */
async function show(visit, roles) {
  for (const [name, role] of Object.entries(roles)) {
    const { data } = fileAt(join(inputs, name));
    await visit.page.evaluate(
      ([name, role, data]) => {
        const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
        return document.querySelector('sillon-app').studio.open([new File([bytes], name)], role);
      },
      [name, role, data],
    );
  }
  const count = Object.keys(roles).length;
  await visit.until(`({ plate }) => plate.layers[0].pictures.length === ${count}`);
}

const ground = { kind: 'direction', angle: 20 };
const stroke = { tool: 'comb', points: [4.8, 9.6, 12, 14.4, 19.2, 9.6], radius: 3.6, soft: 0.5 };

/** Plates by name: changes of the small plate in a link, then what is done with it. */
const plates = {
  photograph: [{}, (visit) => show(visit, { 'photo.png': 'lamp' })],
  'two photographs': [{}, (visit) => show(visit, { 'photo.png': 'lamp', 'relief.png': 'more' })],
  text: [{ layers: [ground, { kind: 'text', text: 'Ab', textSize: 12, ground: 0 }] }],
  'QR code': [
    {
      shape: { builtin: 'rectangle', size: [24, 24] },
      layers: [ground, { kind: 'code', text: 'SILLON', size: [21, 0] }],
    },
  ],
  'comb stroke': [{ layers: [ground, { kind: 'strokes', strokes: [stroke] }] }],
};

for (const [what, [link, make]] of Object.entries(plates)) {
  test(`studio, npm package and command line write one G-code: ${what}`, { skip }, async () => {
    // Between the nozzles whose gloss was measured, so that slopes are computed everywhere.
    const settings = { printer: { nozzle: 0.5 }, toolpath: { spacing: 0.5 }, pictures: { spool: 'bluePla' } };
    const visit = await bench.open({ path: `/${linkOf({ ...link, ...settings })}` });
    await visit.until(({ plate }) => plate.width === 24);
    await make?.(visit);
    await visit.idle();
    const gcode = (await visit.download('G-code')).bytes.toString('utf8');
    const { bytes: zip } = await visit.download('Project with its files');
    assert.ok(gcode.length > 20_000);
    assert.equal(firstDifference(gcode, natively(zip, gcode)), undefined, 'the command line');
    assert.equal(firstDifference(gcode, await packaged(zip, dateOf(gcode))), undefined, 'the npm package');
    assert.deepEqual(visit.problems, []);
  });
}
