// The package in all kinds of pages: threads where they are possible, a reason where they are not, and in every page the
// plate and the bytes that Node gets.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';

import { createEngine } from 'sillon';

import { lacking, launch } from '../support/browsers.js';
import { serveSite, threadsHaveScript } from '../support/pages.js';
import { makePlate } from '../support/plate.js';
import { root } from '../support/projects.js';
import { headerSets } from '../support/server.js';

const project = 'examples/logo.json';
const threads = 3;
const sites = {};
let expected;

before(async () => {
  for (const [name, headers] of Object.entries(headerSets)) sites[name] = await serveSite(headers);
  const engine = await createEngine({ threads: 'off' });
  const read = (name) => new Blob([readFileSync(join(root, 'examples', name))]);
  expected = await makePlate(engine, readFileSync(join(root, project), 'utf8'), read);
  engine.dispose();
});
after(() => {
  for (const site of Object.values(sites)) site.close();
});

/** Another origin than the page's: the same files from another port. */
const elsewhere = (site, path) => `${sites[site].origin}${path}`;

const browsers = ['Chromium', 'Firefox'];
const contexts = [
  { name: 'isolated page', site: 'isolated', threaded: true },
  { name: 'plain page', site: 'plain', threaded: false },
  { name: 'strict policy without unsafe-eval', site: 'strict', threaded: true },
  {
    name: 'strict policy, engine files from another origin',
    site: 'strictElsewhere',
    assetBase: () => elsewhere('isolatedShared', '/sillon/dist/engine'),
    threaded: true,
  },
  {
    name: 'isolated page, engine files from another origin',
    site: 'isolated',
    assetBase: () => elsewhere('isolatedShared', '/sillon/dist/engine'),
    threaded: true,
  },
  {
    name: 'plain page, engine files from another origin',
    site: 'plain',
    assetBase: () => elsewhere('plainShared', '/sillon/dist/engine/'),
    threaded: false,
  },
  {
    name: 'isolated page, whole package from another origin',
    site: 'isolated',
    library: () => elsewhere('isolatedShared', '/sillon/dist/index.js'),
    threaded: true,
  },
  {
    name: 'sandboxed frame of opaque origin in an isolated page',
    site: 'isolatedShared',
    task: 'plateInFrame',
    threaded: true,
  },
  {
    name: 'sandboxed frame of opaque origin in a plain page',
    site: 'plainShared',
    task: 'plateInFrame',
    threaded: false,
  },
  { name: 'worker of an isolated page', site: 'isolated', task: 'plateInWorker', threaded: true },
  { name: 'worker of a plain page', site: 'plain', task: 'plateInWorker', threaded: false },
];

for (const name of browsers) {
  describe(name, { skip: lacking(name) }, () => {
    let browser;
    before(async () => {
      browser = await launch(name);
    });
    after(() => browser?.close());

    for (const { name: context, site, task = 'plate', assetBase, library, threaded } of contexts) {
      test(context, async () => {
        const { value, error } = await browser.attempt(sites[site].page, task, {
          library: library?.(),
          options: { threads, assetBase: assetBase?.() },
          project: `/${project}`,
        });
        assert.equal(error, undefined);
        const { origin, reason, variant, threads: running, digest, gcode, bytes } = value;
        const opaque = task === 'plateInFrame';
        assert.equal(origin, opaque ? 'null' : sites[site].origin);
        const started = threaded && (threadsHaveScript || !opaque || name !== 'Chromium');
        assert.deepEqual(
          { variant, running },
          started ? { variant: 'mt', running: threads } : { variant: 'st', running: 1 },
        );
        assert.match(reason, started ? /^$/ : threaded ? /could not be started as a thread/ : /isolated/);
        assert.deepEqual({ digest, gcode, bytes }, expected);
      });
    }

    test('as many threads as the machine has, unless told otherwise', async () => {
      const { value } = await browser.attempt(sites.isolated.page, 'plate', { options: {}, project: `/${project}` });
      assert.equal(value.threads, Math.min(8, availableParallelism()));
      assert.equal(value.reason, '');
    });
  });
}
