// The examples of embedding, opened as they are but for the addresses that stand in for the reader's own.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { build } from 'vite';

import { lacking, startChromium } from '../../../wasm/test/support/browsers.js';
import { headerSets, serve as servePlain } from '../../../wasm/test/support/server.js';
import { serve } from '../../serve.js';

const skip = lacking('Chromium');
const path = (name) => fileURLToPath(new URL(name, import.meta.url));
let browser, studio, cdn, site, folder, page;

before(async () => {
  if (skip) return;
  browser = await startChromium();
  studio = await serve(path('../../dist'), 0);
  cdn = await servePlain({ '/sillon@0.1.0/': path('../../../wasm/') }, headerSets.isolatedShared);
  folder = mkdtempSync(join(tmpdir(), 'sillon-examples-'));
  site = await serveReader();
});
after(async () => {
  await browser?.close();
  for (const one of [studio, cdn, site]) one?.close();
  if (folder !== undefined) rmSync(folder, { recursive: true });
});
afterEach(async () => {
  await page?.context().close();
  page = undefined;
});

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json' };

/** The site of the examples' reader, with the addresses that the reader would have put in. */
function serveReader() {
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    const file = pathname.startsWith('/built/')
      ? join(folder, pathname.slice(7))
      : path(`../../../examples${pathname}`);
    if (!existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    const type = types[extname(file)];
    let body = readFileSync(file);
    if (type !== undefined) {
      body = body
        .toString()
        .replaceAll('https://sillon.example', studio.origin)
        .replaceAll('https://cdn.example', cdn.origin);
      if (pathname.endsWith('block.html')) body = theme(body);
    }
    response.writeHead(200, { 'Content-Type': type ?? 'image/png' }).end(body);
  });
  return new Promise((resolve) => {
    server.listen(0, '127.0.0.1', () => {
      resolve({
        origin: `http://127.0.0.1:${server.address().port}`,
        close() {
          server.close();
          server.closeAllConnections();
        },
      });
    });
  });
}

/** A page around a block. */
const theme = (block) => `<!doctype html><html lang="en"><title>A blog</title><link rel="icon" href="data:," />
  <style>iframe, img { max-width: 100% } figure { margin: 0 }</style><article>${block}</article></html>`;

/** @param prepare  is given the page before it goes there */
async function open(address, prepare) {
  const context = await browser.newContext({ reducedMotion: 'reduce', locale: 'en-US' });
  page = await context.newPage();
  const problems = [];
  page.on('pageerror', (error) => problems.push(String(error)));
  await prepare?.(page);
  await page.goto(`${site.origin}/${address}`);
  return problems;
}

test('embed-page: a shop takes the order’s G-code', { skip }, async () => {
  const problems = await open('embed-page/index.html');
  await page.locator('#order:not([disabled])').click();
  await page.getByText(/^plate_0\.4mm_PLA_\d+m\.gcode: \d+ bytes for the printer$/).waitFor();
  await page.locator('sillon-view').scrollIntoViewIfNeeded();
  await page.locator('sillon-view canvas:not([hidden])').waitFor();
  assert.deepEqual(problems, []);
});

test('embed-page: nothing is ordered in the place of a plate that is not there', { skip }, async () => {
  const gone = (route) => route.fulfill({ status: 404 });
  const problems = await open('embed-page/index.html', (page) => page.route('**/plate.json', gone));
  const wrong = page.getByRole('alert').getByText(/plate\.json came with status 404/);
  await wrong.waitFor();
  const order = page.locator('#order');
  const outcome = await page
    .locator('sillon-studio')
    .evaluate((studio) => Promise.allSettled([studio.generate(), studio.exportProject()]));
  assert.deepEqual(
    outcome.map(({ status }) => status),
    ['rejected', 'rejected'],
  );
  assert.deepEqual([await order.isDisabled(), await wrong.isVisible()], [true, true]);
  await page.unroute('**/plate.json', gone);
  await page.locator('sillon-studio').evaluate((studio) => (studio.project = './plate.json'));
  await page.locator('#order:not([disabled])').waitFor();
  assert.equal(await page.locator('#wrong').innerText(), '');
  assert.deepEqual(problems, []);
});

test('embed-vite: an app that bundles nothing of the studio', { skip }, async () => {
  process.env.VITE_STUDIO = `${studio.origin}/`;
  await build({
    root: path('../../../examples/embed-vite'),
    base: './',
    logLevel: 'warn',
    build: { outDir: folder, emptyOutDir: true, target: 'es2022' },
  });
  const problems = await open('built/index.html');
  await page.waitForFunction(() => /^1 toolpath, \d+ points$/.test(document.title));
  assert.match(await page.locator('sillon-studio iframe').getAttribute('src'), /[?&]waits/); // no other plate is made first
  assert.deepEqual(problems, []);
});

test('embed-wordpress: a block in a page of somebody’s theme', { skip }, async () => {
  const problems = await open('embed-wordpress/block.html');
  const frame = await (await page.locator('sillon-studio iframe').elementHandle()).contentFrame();
  await frame.locator('sillon-canvas').waitFor();
  assert.equal(await frame.locator('nav').count(), 0);
  await page.locator('sillon-studio').evaluate((studio) => studio.generate());
  const named = await frame.evaluate(() => document.querySelector('sillon-app').studio.store.state.plate.name);
  assert.equal(named, 'logo');
  assert.deepEqual(problems, []);
});

test('embed-engine: an interface of one’s own over the engine of a CDN', { skip }, async () => {
  const problems = await open('embed-engine/index.html');
  await page.getByText(/^\d+ points, coverage [\d.]+ %, 1 threads$/).waitFor();
  const first = await page.locator('img').getAttribute('src');
  await page.locator('input').fill('90');
  await page.waitForFunction((first) => document.querySelector('img').src !== first, first);
  assert.deepEqual(problems, []);
});
