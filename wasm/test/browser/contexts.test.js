// The package in all kinds of pages: threads where they are possible, a reason where they are not, and in every page the
// plate and the bytes that Node gets.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';

import { createEngine } from 'sillon';

import { lacking, launch } from '../support/browsers.js';
import { attempt, serveSite } from '../support/pages.js';
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

async function sandboxedFrame(page) {
  await page.evaluate(
    () =>
      new Promise((resolve) => {
        const frame = document.createElement('iframe');
        frame.sandbox = 'allow-scripts';
        frame.src = location.href;
        frame.onload = () => resolve();
        document.body.append(frame);
      }),
  );
  const frame = page.frames().find((frame) => frame.parentFrame() !== null);
  assert.equal(await frame.evaluate(() => self.origin), 'null');
  return frame;
}

// `threaded`: the browsers in which memory can be shared there. Sandboxed frames need Document-Isolation-Policy.
const both = ['Chromium', 'Firefox'];
const contexts = [
  { name: 'isolated page', site: 'isolated', threaded: both },
  { name: 'plain page', site: 'plain', threaded: [] },
  { name: 'strict policy without unsafe-eval', site: 'strict', threaded: both },
  {
    name: 'isolated page, engine files from another origin',
    site: 'isolated',
    assetBase: () => elsewhere('isolatedShared', '/sillon/dist/engine'),
    threaded: both,
  },
  {
    name: 'plain page, engine files from another origin',
    site: 'plain',
    assetBase: () => elsewhere('plainShared', '/sillon/dist/engine/'),
    threaded: [],
  },
  {
    name: 'isolated page, whole package from another origin',
    site: 'isolated',
    library: () => elsewhere('isolatedShared', '/sillon/dist/index.js'),
    threaded: both,
  },
  {
    name: 'sandboxed frame of opaque origin in an isolated page',
    site: 'isolatedShared',
    place: sandboxedFrame,
    threaded: ['Chromium'],
  },
  {
    name: 'sandboxed frame of opaque origin in a plain page',
    site: 'plainShared',
    place: sandboxedFrame,
    threaded: [],
  },
  { name: 'worker of an isolated page', site: 'isolated', task: 'plateInWorker', threaded: both },
  { name: 'worker of a plain page', site: 'plain', task: 'plateInWorker', threaded: [] },
];

for (const name of both) {
  describe(name, { skip: lacking(name) }, () => {
    let browser;
    before(async () => {
      browser = await launch(name);
    });
    after(() => browser?.close());

    for (const { site, task = 'plate', place, assetBase, library, threaded, ...context } of contexts) {
      test(context.name, async () => {
        const page = await browser.newPage();
        try {
          await page.goto(`${sites[site].origin}/pages/index.html`);
          const { value, error } = await attempt((await place?.(page)) ?? page, task, {
            library: library?.(),
            options: { threads, assetBase: assetBase?.() },
            project: `/${project}`,
          });
          assert.equal(error, undefined);
          const { version: _version, reason, ...rest } = value;
          if (threaded.includes(name)) {
            assert.deepEqual(rest, { variant: 'mt', threads, ...expected });
            assert.equal(reason, '');
          } else {
            assert.deepEqual(rest, { variant: 'st', threads: 1, ...expected });
            assert.match(reason, /isolated/);
          }
        } finally {
          await page.close();
        }
      });
    }

    test('as many threads as the machine has, unless told otherwise', async () => {
      const page = await browser.newPage();
      try {
        await page.goto(`${sites.isolated.origin}/pages/index.html`);
        const { value } = await attempt(page, 'plate', { options: {}, project: `/${project}` });
        assert.equal(value.threads, Math.min(8, availableParallelism()));
        assert.equal(value.reason, '');
      } finally {
        await page.close();
      }
    });
  });
}
