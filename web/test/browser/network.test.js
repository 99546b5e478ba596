// What a first visit fetches until the network rests, its service worker's part included.
import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { lacking, startChromium } from '../../../wasm/test/support/browsers.js';
import { filesOf } from '../../serve.js';
import { patience, until } from './support/waits.js';

const skip = lacking('Chromium');
const dist = fileURLToPath(new URL('../../dist', import.meta.url));
const most = { requests: 40, bytes: 1_000_000 };

let browser, server, address;
/** Every answer: its path, and how many bytes its body had on the way. */
let sent = [];

before(async () => {
  if (skip) return;
  browser = await startChromium();
  const files = filesOf(dist, (request, response) => response.writeHead(404).end());
  server = createServer((request, response) => {
    const one = { path: request.url, bytes: 0, status: 0 };
    sent.push(one);
    const { write, end } = response;
    const count = (part) => (one.bytes += typeof part === 'string' || part instanceof Uint8Array ? part.length : 0);
    response.write = (part, ...more) => (count(part), write.call(response, part, ...more));
    response.end = (part, ...more) => (count(part), end.call(response, part, ...more));
    response.on('finish', () => (one.status = response.statusCode));
    void files(request, response);
  });
  await new Promise((listens) => server.listen(0, 'localhost', listens));
  address = `http://localhost:${server.address().port}/`;
});
after(async () => {
  await browser?.close();
  server?.closeAllConnections();
  server?.close();
});

/** Until the page has its plate and the service worker has what the page fetched. */
async function comesToRest(page) {
  await page.waitForFunction(
    () => globalThis.document.querySelector('sillon-app')?.studio.store.state.summary !== undefined,
    undefined,
    { timeout: patience },
  );
  const keeps = () =>
    page.evaluate(async () => {
      const requests = await Promise.all((await caches.keys()).map(async (name) => (await caches.open(name)).keys()));
      return navigator.serviceWorker.controller !== null && requests.flat().some(({ url }) => url.endsWith('moon.png'));
    });
  await until(keeps, 'a service worker that keeps the last file of the first visit');
  await until(() => sent.every(({ status }) => status > 0), 'an end of all answers');
  await page.waitForLoadState('networkidle');
}

for (const threads of ['auto', 'off']) {
  test(`a first visit is the page and one engine: threads ${threads}`, { skip }, async () => {
    sent = [];
    const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, locale: 'en-US' });
    const page = await context.newPage();
    await page.goto(threads === 'auto' ? address : `${address}?threads=${threads}`);
    await comesToRest(page);
    const bytes = sent.reduce((sum, one) => sum + one.bytes, 0);
    const told = sent.map((one) => `${one.status} ${String(one.bytes).padStart(7)} ${one.path}`).join('\n');
    assert.ok(sent.length <= most.requests, `${sent.length} requests\n${told}`);
    assert.ok(bytes <= most.bytes, `${bytes} bytes\n${told}`);
    const paths = sent.map(({ path }) => path);
    assert.equal(paths.filter((path) => /sillon-\w+\.wasm/.test(path)).length, 1, told);
    for (const later of [/gallery\//, /\.ttf/, /harfbuzz/, /coupon/, /presets\//, /text\.js/, /\/(de|fr)-/])
      assert.ok(!paths.some((path) => later.test(path)), told);
    const parts = paths.flatMap((path) => /^\/assets\/(.*)-[\w-]{8}\.\w+$/.exec(path)?.[1] ?? []);
    const rare = parts.filter(
      (part) => !/^(ahead|engine|first|marks\.worker|rolldown-runtime|shimmer|studio|tokens)$/.test(part),
    );
    assert.deepEqual(rare, [], `what every visit asks for stands in "first" of web/chunks.js\n${told}`);
    const whole = sent.filter(({ status, bytes }) => status === 200 && bytes > 0).map(({ path }) => path);
    assert.deepEqual(
      whole.filter((path, k) => whole.indexOf(path) < k),
      [],
      `fetched twice\n${told}`,
    );
    assert.equal(await page.locator('sillon-notices').innerText(), '', 'nothing is said that nobody asked for');
    await context.close();
  });
}
