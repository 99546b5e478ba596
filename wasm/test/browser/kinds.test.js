// Every kind of layer in every place where the engine runs: the native program, Node and browsers, with and without threads,
// draw the same.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';

import { createEngine } from 'sillon';

import { lacking, launch } from '../support/browsers.js';
import { plates, writePlates } from '../support/kinds.js';
import { serveSite } from '../support/pages.js';
import { drawPlate, sumOf } from '../support/plate.js';
import { nativePlate, nativeProgram } from '../support/projects.js';
import { headerSets } from '../support/server.js';

const names = Object.keys(plates);
const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
const textOf = (name) => readFileSync(join(folder, `${name}.json`), 'utf8');
const read = (name) => new Blob([readFileSync(join(folder, name))]);

let engine;
let site;
/** Drawings of the native program for each plate, and the projects that it writes back. */
let expected;
/** Rasters of Node, to compare with: the native program writes the directions of layers into no file. */
let inNode;

before(async () => {
  writePlates(folder);
  expected = [];
  for (const name of names) expected.push(await drawNatively(name));
  engine = await createEngine({ threads: 'off' });
  inNode = await drawAll(engine);
  site = await serveSite(headerSets.isolated, { '/plates/': folder });
});
after(() => {
  engine?.dispose();
  site?.close();
  rmSync(folder, { recursive: true });
});

async function drawNatively(name) {
  const [svg, project] = ['plate.svg', 'written.json'].map((file) => join(folder, file));
  const options = ['--svg', svg, '--project', project];
  const { report, refusal } = nativePlate(folder, join(folder, `${name}.json`), ...options);
  assert.equal(refusal, undefined);
  return { digest: report.digest, svg: await sumOf(read('plate.svg')), project: textOf('written') };
}

async function drawAll(engine) {
  const drawn = [];
  for (const name of names) drawn.push(await drawPlate(engine, textOf(name), read));
  return drawn;
}

/** Fails with the names of the plates that differ, and with what differs. */
function assertSame(drawn) {
  const differing = names.flatMap((name, k) => {
    const { digest, svg } = expected[k];
    const wanted = { digest, svg, raster: inNode[k].raster };
    return Object.keys(wanted)
      .filter((key) => drawn[k]?.[key] !== wanted[key])
      .map((key) => `${key} of ${name}`);
  });
  assert.deepEqual(differing, []);
}

test('there is a plate for every word that a setting of layers may be, and no two plates are alike', () => {
  const { stdout } = spawnSync(nativeProgram, ['settings', '--json'], { encoding: 'utf8', maxBuffer: 1 << 26 });
  const layers = Object.values(plates).flatMap((project) => project.layers);
  const choices = JSON.parse(stdout).settings.filter(({ section, type }) => section === 'layers' && type === 'choice');
  assert.ok(choices.some(({ key }) => key === 'kind'));
  for (const { key, choices: words, default: usual } of choices) {
    const used = new Set(layers.map((layer) => layer[key] ?? usual));
    const unused = words.filter((word) => !used.has(word));
    assert.deepEqual(unused, [], key);
  }
  assert.equal(new Set(expected.map(({ digest }) => digest)).size, names.length);
});

test('the native program and the engine write projects back alike, with the same settings', async () => {
  for (const [k, name] of names.entries()) {
    const project = await engine.readProject(textOf(name));
    assert.deepEqual(project.layers, plates[name].layers, name);
    assert.equal(await engine.writeProject(project), expected[k].project, name);
    assert.deepEqual(await engine.readProject(expected[k].project), project, name);
  }
});

test('Node', () => assertSame(inNode));

test('Node, 2 threads', async () => {
  const threaded = await createEngine({ threads: 2 });
  try {
    assert.equal(threaded.info.threads, 2);
    assertSame(await drawAll(threaded));
  } finally {
    threaded.dispose();
  }
});

for (const name of ['Chromium', 'Firefox']) {
  describe(name, { skip: lacking(name) }, () => {
    let browser;
    before(async () => {
      browser = await launch(name);
    });
    after(() => browser?.close());

    for (const threads of [1, 2]) {
      test(`threads: ${threads}`, async () => {
        const { value, error } = await browser.attempt(site.page, 'plates', {
          options: { threads },
          projects: names.map((name) => `/plates/${encodeURIComponent(name)}.json`),
        });
        assert.equal(error, undefined, error?.message);
        assert.equal(value.threads, threads);
        assertSame(value.drawn);
      });
    }
  });
}
