// A body that nobody has sliced: dropped, its top faces are listed; the chosen one is the plate; and the slicer's file has the
// whole body, with zones on that face.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

import * as fflate from 'fflate';

import { violations } from './support/axe.js';
import { sharedBench } from './support/shared.js';
import { fileOf, skip, start } from './support/studio.js';
import { until } from './support/waits.js';

const bench = sharedBench(skip, start);
const program = fileURLToPath(new URL('../../../build/release/sillon', import.meta.url));

/** The walls of a box, as triangles. */
function box(low, high) {
  const at = (k) => [0, 1, 2].map((axis) => ((k >> axis) & 1 ? high : low)[axis]);
  const quads = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
  ];
  return quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d].map(at));
}

function stlOf(points) {
  const bytes = Buffer.alloc(84 + (50 * points.length) / 3);
  bytes.writeUInt32LE(points.length / 3, 80);
  for (const [k, point] of points.entries()) {
    for (const [axis, value] of point.entries())
      bytes.writeFloatLE(value, 84 + 50 * Math.floor(k / 3) + 12 + 12 * (k % 3) + 4 * axis);
  }
  return bytes;
}

const stl = stlOf([...box([10, 20, 0], [34, 36, 5]), ...box([70, 20, 0], [90, 30, 12])]);
const faces = ({ page }) => page.locator('sillon-zones .faces button');
const modelIn = (bytes) => fflate.strFromU8(fflate.unzipSync(bytes)['3D/3dmodel.model']);
/** Boxes of the triangles of the body, and of the zones [mm]. */
function boxesIn(bytes) {
  const model = modelIn(bytes);
  const config = fflate.strFromU8(fflate.unzipSync(bytes)['Metadata/Slic3r_PE_model.config']);
  const numbers = (text, names) => names.map((name) => Number(new RegExp(`${name}="([^"]*)"`).exec(text)[1]));
  const points = model.match(/<vertex [^>]*>/g).map((tag) => numbers(tag, ['x', 'y', 'z']));
  const triangles = model.match(/<triangle [^>]*>/g).map((tag) => numbers(tag, ['v1', 'v2', 'v3']));
  return config.match(/<volume [^>]*>/g).map((tag) => {
    const [first, last] = numbers(tag, ['firstid', 'lastid']);
    const own = triangles.slice(first, last + 1).flatMap((corners) => corners.map((corner) => points[corner]));
    const of = (pick) => [0, 1, 2].map((axis) => pick(...own.map((point) => point[axis])));
    return [of(Math.min), of(Math.max)];
  });
}

test('a face of a body becomes the plate, and the body leaves with zones on that face alone', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  const { page } = visit;
  await visit.drop([fileOf('part.stl', stl)]);
  await until(async () => (await faces(visit).count()) === 2, 'two faces are listed');
  assert.match(await faces(visit).first().innerText(), /24 × 16 mm, 5 mm high[^]*384 mm²/);
  assert.match(await faces(visit).nth(1).innerText(), /20 × 10 mm, 12 mm high/);
  assert.equal(
    await faces(visit)
      .first()
      .evaluate((one) => one.matches(':focus')),
    true,
  );
  assert.deepEqual(await violations(page), []);
  await faces(visit).first().click();
  await visit.until(({ plate }) => plate.body !== undefined);
  await visit.idle();
  assert.deepEqual(await visit.state(({ plate }) => [plate.name, plate.width, plate.height]), ['part', 24, 16]);

  const save = async (button) => {
    const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  const made = await save(visit.button('Download the body'));
  assert.equal(made.name, 'part.zones.3mf');
  const [body, ...zones] = boxesIn(made.bytes);
  assert.deepEqual(body, [
    [10, 20, 0],
    [90, 36, 12],
  ]);
  assert.ok(zones.length > 1);
  for (const [low, high] of zones) {
    assert.ok(low[0] >= 8.9 && high[0] <= 35.1 && low[1] >= 18.9 && high[1] <= 37.1, `${low} ${high}`);
    assert.ok(low[2] > 2 && high[2] >= 5 && high[2] < 6, 'under the face, and nowhere else');
  }

  // The same bytes as the native program makes of the project and the body.
  const folder = mkdtempSync(join(tmpdir(), 'sillon-zones-'));
  try {
    const project = fflate.unzipSync(
      Buffer.from(
        await page.evaluate(async () => {
          const { blob } = await document.querySelector('sillon-app').studio.make('project');
          return [...new Uint8Array(await blob.arrayBuffer())];
        }),
      ),
    );
    assert.ok('inputs/part.stl' in project);
    for (const name of ['project.json', 'inputs/part.svg', 'inputs/part.stl'])
      writeFileSync(join(folder, name.replace('inputs/', '')), project[name]);
    const text = fflate.strFromU8(project['project.json']).replaceAll('inputs/', '');
    writeFileSync(join(folder, 'project.json'), text);
    const out = join(folder, 'out.3mf');
    const options = ['--body', join(folder, 'part.stl'), '--face', '10,20,5', '--layer-height'];
    const height = await visit.state(({ plate }) => String(plate.print.layerHeight));
    execFileSync(program, ['zones', join(folder, 'project.json'), ...options, height, '-o', out]);
    assert.equal(readFileSync(out).compare(made.bytes), 0);
  } finally {
    rmSync(folder, { recursive: true });
  }

  // The body is kept with the plate.
  await page.reload();
  await page.getByText('has been restored').waitFor();
  assert.deepEqual(await visit.state(({ plate }) => plate.body.face), [10, 20, 5]);
  // Another size is no face of it any more.
  await page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.change((plate) => ({ ...plate, width: 30, height: 20 }));
    void studio.save('zones');
  });
  await page.getByText('part.stl carries another shape than the plate has now').waitFor();
  assert.deepEqual(visit.problems, []);
});

test('a package without G-code is a body; one without a level top says so', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  const points = box([0, 0, 0], [20, 20, 4]);
  const model =
    '<model unit="millimeter"><resources><object id="1"><mesh><vertices>' +
    points.map(([x, y, z]) => `<vertex x="${x}" y="${y}" z="${z}"/>`).join('') +
    '</vertices><triangles>' +
    Array.from({ length: points.length / 3 }, (_, k) => [3 * k, 3 * k + 1, 3 * k + 2])
      .map(([a, b, c]) => `<triangle v1="${a}" v2="${b}" v3="${c}"/>`)
      .join('') +
    '</triangles></mesh></object></resources><build><item objectid="1"/></build></model>';
  const packed = fflate.zipSync({ '3D/3dmodel.model': fflate.strToU8(model) });
  await visit.drop([fileOf('cube.3mf', Buffer.from(packed))]);
  await until(async () => (await faces(visit).count()) === 1, 'its top is listed');
  await page.keyboard.press('Escape');
  const tent = stlOf([
    [0, 0, 0],
    [30, 0, 0],
    [15, 10, 20],
  ]);
  await visit.drop([fileOf('tent.stl', tent)]);
  await page.getByText('tent.stl has no flat face that looks up').waitFor();
  await page.keyboard.press('Escape');
  await visit.drop([fileOf('cut.stl', 'solid')]);
  await page.getByText('cut.stl could not be read').waitFor();
  assert.deepEqual(visit.problems, []);
});
