// The service worker, on hosts that send no headers and on our own: threads, no network, new versions, broken ones.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { cpSync, existsSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { availableParallelism, tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, beforeEach, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { lacking, startChromium } from '../../../wasm/test/support/browsers.js';
import { serve as servePlain } from '../../../wasm/test/support/server.js';
import { serve } from '../../serve.js';
import { patience, until } from '../browser/support/waits.js';

const dist = fileURLToPath(new URL('../../dist', import.meta.url));
const skip = lacking('Chromium');

let browser, context, folder, site;

before(async () => {
  if (skip) return;
  assert.ok(existsSync(join(dist, 'sw.js')), 'there is no web/dist; ./dev build makes it');
  browser = await startChromium();
});
after(() => browser?.close());

beforeEach(async () => {
  if (skip) return;
  context = await browser.newContext();
  folder = mkdtempSync(join(tmpdir(), 'sillon-offline-'));
  cpSync(dist, folder, { recursive: true });
});
afterEach(async () => {
  await context?.close();
  site?.close();
  if (folder) rmSync(folder, { recursive: true });
  site = undefined;
});

/** As GitHub Pages: in a folder of a site, without headers. */
async function plainHost() {
  site = await servePlain({ '/studio/': folder, '/': folder });
  return `${site.origin}/studio/`;
}

/** @param atStart  runs in the page before its own scripts */
async function open(address, atStart = () => {}) {
  const page = await context.newPage();
  await page.addInitScript(atStart);
  const visits = [];
  const problems = [];
  page.on('framenavigated', (frame) => visits.push(frame.url()));
  page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
  page.on('pageerror', (error) => problems.push(String(error)));
  await page.goto(address);
  return { page, visits, problems };
}

/** Waits until the service worker is there, as `active` or `waiting`. */
const workerIs = (page, state) =>
  page.evaluate(async (state) => {
    const registration = await navigator.serviceWorker.ready;
    while (registration[state] === null) await new Promise((resolve) => setTimeout(resolve, 50));
  }, state);
const isolatedPage = (page) => page.waitForFunction(() => crossOriginIsolated);
const rest = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** As a whole: who reads the file meanwhile gets all of the old one. */
function replaceFile(path, content) {
  writeFileSync(`${path}.new`, content);
  renameSync(`${path}.new`, path);
}

/** Another version: one file changed, in the list of the service worker too unless it is to be broken. */
function deploy({ broken = false } = {}) {
  const file = 'manifest.webmanifest';
  const hash = (bytes) => createHash('sha256').update(bytes).digest('base64');
  const manifest = JSON.parse(readFileSync(join(folder, file), 'utf8'));
  const bytes = JSON.stringify({ ...manifest, name: 'Another version' });
  const worker = readFileSync(join(folder, 'sw.js'), 'utf8');
  const old = hash(readFileSync(join(folder, file)));
  assert.ok(worker.includes(old), `sw.js does not list ${file}`);
  replaceFile(join(folder, file), bytes);
  const next = worker
    .replace(/"version":"[^"]*"/, '"version":"next"')
    .replace(old, broken ? hash('something else') : hash(bytes));
  replaceFile(join(folder, 'sw.js'), next);
}

/** The engine's folder. */
const engine = () => /name="sillon-engine" content="([^"]*)"/.exec(readFileSync(join(folder, 'index.html'), 'utf8'))[1];
/** A context in another language. */
const german = async (context) => {
  await context.close();
  return browser.newContext({ locale: 'de-DE' });
};

const caches = (page) => page.evaluate(() => globalThis.caches.keys());
/** Paths of what the studio's caches hold. */
const kept = (page) =>
  page.evaluate(async () => {
    const found = [];
    for (const name of (await globalThis.caches.keys()).filter((name) => name.startsWith('sillon ')))
      for (const { url } of await (await globalThis.caches.open(name)).keys()) found.push(new URL(url).pathname);
    return found.sort();
  });
/** Waits until they hold a path. */
const keeps = (page, path) => until(async () => (await kept(page)).some((one) => path.test(one)), path);
/** All that a whole copy holds. */
const whole = () => {
  const { files } = JSON.parse(/^const build = (.*);$/m.exec(readFileSync(join(folder, 'sw.js'), 'utf8'))[1]);
  return Object.keys(files);
};
/** Waits until there is a plate with its file. */
const plate = (page) =>
  page.waitForFunction(
    () => globalThis.document.querySelector('sillon-app')?.studio.store.state.summary !== undefined,
    undefined,
    { timeout: patience },
  );
const missing = (page) => page.getByText('A part of the page could not be loaded.').first();
const nameInCache = (page) => page.evaluate(async () => (await (await fetch('manifest.webmanifest')).json()).name);

test('a host without headers gets threads after one reload', { skip }, async () => {
  const { page, visits, problems } = await open(await plainHost());
  await isolatedPage(page);
  assert.equal(visits.length, 2);
  await page.reload();
  await isolatedPage(page);
  await rest(1500);
  assert.equal(visits.length, 3, 'it reloads again and again');
  assert.deepEqual(problems, []);
});

const oneCore = availableParallelism() < 2 && 'one core: threads are not asked for';

test('threads really run there', { skip: skip || oneCore }, async () => {
  const address = await plainHost();
  const { page } = await open(address);
  await isolatedPage(page);
  // Only the engine with threads is fetched, and it starts its threads: else the one without would be fetched next.
  const threads = page.waitForEvent('worker', { predicate: (worker) => worker.url().includes('sillon-mt') });
  const fetched = [];
  page.on('request', (request) => /sillon-(mt|st)\.wasm$/.test(request.url()) && fetched.push(request.url()));
  await page.reload();
  await threads.catch(() => assert.fail('no thread was started'));
  await rest(1000);
  assert.deepEqual([...new Set(fetched)], [`${address}${engine()}sillon-mt.wasm`]);
});

test('our own server needs no reload', { skip }, async () => {
  site = await serve(folder, 0);
  const { page, visits, problems } = await open(`${site.origin}/`);
  assert.equal(await page.evaluate(() => crossOriginIsolated), true);
  await workerIs(page, 'active');
  await rest(1000);
  assert.equal(visits.length, 1);
  assert.deepEqual(problems, []);
});

test('after the first visit it works without the server, with the parts that were used', { skip }, async () => {
  site = await serve(folder, 0);
  const address = `${site.origin}/`;
  context = await german(context);
  const { page, problems } = await open(address);
  await plate(page);
  await keeps(page, /sillon-mt\.wasm$/);
  await keeps(page, /\/de-[^/]*\.js$/); // as the browser speaks
  const files = await kept(page);
  for (const never of [/gallery\//, /\.ttf$/, /harfbuzz/, /sillon-st/, /coupon/, /\/fr-/, /licences/])
    assert.deepEqual(
      files.filter((name) => never.test(name)),
      [],
      String(never),
    );
  assert.equal(await page.locator('sillon-notices').innerText(), '');
  assert.deepEqual(problems, []);
  site.close();
  for (const way of [address, `${address}index.html`]) {
    await page.goto(way);
    assert.equal(await page.evaluate(() => crossOriginIsolated), true, way);
    await plate(page);
  }
  await page.getByRole('button', { name: 'Beispiele', exact: true }).click();
  await page.getByText('Ein Teil der Seite konnte nicht geladen werden.').first().waitFor();
});

test('what is used on a host without headers is kept, too', { skip }, async () => {
  const address = await plainHost();
  const { page } = await open(address);
  await isolatedPage(page);
  await plate(page);
  await keeps(page, /sillon-mt\.wasm$/);
  site.close();
  await page.goto(`${address}?lang=en`);
  await plate(page);
});

test('all parts are kept when somebody asks for that', { skip }, async () => {
  site = await serve(folder, 0);
  const address = `${site.origin}/`;
  const { page } = await open(address);
  await plate(page);
  await workerIs(page, 'active');
  await page.locator('[popovertarget=menu]').click();
  await page.getByRole('button', { name: 'Keep for offline use' }).click();
  await page.getByText('All of Sillon is kept on this device and works offline.').waitFor({ timeout: patience });
  assert.equal((await kept(page)).length, whole().length);
  site.close();
  await page.goto(`${address}?threads=off&lang=fr`);
  await plate(page);
  await page.getByRole('button', { name: 'Exemples', exact: true }).click();
  const picture = page.locator('sillon-gallery img').first();
  await until(() => picture.evaluate((image) => image.complete && image.naturalWidth === 320), 'its picture');
  const licences = await page.goto(`${address}licences.txt`);
  assert.equal(licences.status(), 200);
});

test('without the network it is told that not all can be kept', { skip }, async () => {
  site = await serve(folder, 0);
  const { page } = await open(`${site.origin}/`);
  await plate(page);
  await workerIs(page, 'active');
  await page.locator('[popovertarget=menu]').click();
  await page.getByRole('button', { name: 'Keep for offline use' }).waitFor();
  site.close();
  await page.getByRole('button', { name: 'Keep for offline use' }).click();
  await missing(page).waitFor({ timeout: patience });
});

/** Tells the page that its line costs. */
const savesData = () =>
  Object.defineProperty(navigator, 'connection', { configurable: true, value: { saveData: true } });

test('who comes a second time has all parts kept, unless the line costs', { skip }, async () => {
  site = await serve(folder, 0);
  const address = `${site.origin}/`;
  const { page: first } = await open(address);
  await plate(first);
  await keeps(first, /sillon-mt\.wasm$/);
  await first.reload(); // of the same visit
  await plate(first);
  await first.close();
  const { page: saving } = await open(address, savesData);
  await plate(saving);
  await workerIs(saving, 'active');
  await rest(1000);
  assert.ok(!(await kept(saving)).some((name) => /gallery\//.test(name)));
  await saving.close();
  const { page: again } = await open(address);
  await until(async () => (await kept(again)).length === whole().length, 'a whole copy');
  assert.equal(await again.locator('sillon-notices').innerText(), '');
});

test('other pages and sites are left alone', { skip }, async () => {
  writeFileSync(join(folder, 'other.html'), '<!doctype html><title>other</title>');
  const { page } = await open(await plainHost());
  await isolatedPage(page);
  await page.goto(`${site.origin}/studio/other.html`);
  assert.equal(await page.evaluate(() => crossOriginIsolated), false);
  assert.equal(await page.evaluate(async () => (await fetch('missing.js')).status), 404);
});

test('a new version waits for open pages, then takes over and leaves nothing of the old', { skip }, async () => {
  const { page } = await open(await plainHost());
  await isolatedPage(page);
  const before = await caches(page);
  assert.equal(before.length, 1);
  await page.evaluate(() => globalThis.caches.open('of somebody else'));
  const name = await nameInCache(page);
  await plate(page);
  await keeps(page, /sillon-mt\.wasm$/);
  const had = await kept(page);
  deploy();
  await page.reload();
  await workerIs(page, 'waiting');
  assert.equal(await nameInCache(page), name, 'an open page got a file of another version');

  await page.evaluate(async () => {
    const changed = new Promise((resolve) =>
      navigator.serviceWorker.addEventListener('controllerchange', resolve, { once: true }),
    );
    (await navigator.serviceWorker.ready).waiting.postMessage('activate');
    await changed;
  });
  await page.goto(`${site.origin}/studio/`);
  assert.equal(await nameInCache(page), 'Another version');
  const has = await kept(page);
  assert.deepEqual(
    had.filter((path) => !has.includes(path)),
    [],
  );
  const left = await caches(page);
  assert.equal(left.length, 2);
  assert.ok(left.includes('of somebody else') && left.some((cache) => cache.endsWith(' next')), left.join());
});

const takesNew = async (page) => {
  await page.evaluate(() => (globalThis.before = true));
  await page.getByRole('button', { name: 'Reload' }).click({ timeout: 60_000 });
  await page.waitForFunction(() => globalThis.before === undefined, undefined, { timeout: 60_000 });
  await page.waitForLoadState();
};
const findsNew = (page) => page.evaluate(async () => void (await (await navigator.serviceWorker.ready).update()));

/** Opens a page that learns of its registration only once the function that this returns is called. */
async function openSlow(address) {
  const { page } = await open(address, () => {
    const { register } = ServiceWorkerContainer.prototype;
    ServiceWorkerContainer.prototype.register = async function (...asked) {
      const registration = await register.apply(this, asked);
      globalThis.registered = true;
      await new Promise((resolve) => (globalThis.learn = resolve));
      return registration;
    };
  });
  await page.waitForFunction(() => globalThis.registered, undefined, { timeout: 60_000 });
  return { page, learn: () => page.evaluate(() => globalThis.learn()) };
}

test('each of two open pages is loaded anew when its visitor says so, however late', { skip }, async () => {
  await context.clock.install();
  const address = await plainHost();
  const { page: first } = await open(address);
  await isolatedPage(first);
  const { page: second, learn } = await openSlow(address);
  await learn();
  deploy();
  await findsNew(second);
  for (const page of [first, second]) await page.getByRole('button', { name: 'Reload' }).waitFor({ timeout: 60_000 });
  await context.clock.fastForward(600_000);
  await takesNew(first);
  await takesNew(second);
});

/** A page that is settled, and one that learns of its registration late; there is another version by then. */
async function pagesBeforeAnotherVersion() {
  const address = await plainHost();
  const { page: first } = await open(address);
  await isolatedPage(first);
  await nameInCache(first); // so that another version takes that file, too
  await keeps(first, /manifest/);
  const { page: second, learn } = await openSlow(address);
  deploy();
  return { first, second, learn };
}

test('a page that registers while a new version comes offers it too', { skip }, async () => {
  const { first, second, learn } = await pagesBeforeAnotherVersion();
  const release = site.hold('/studio/manifest.webmanifest');
  await findsNew(first);
  await workerIs(first, 'installing');
  await learn();
  release();
  await takesNew(second);
});

test('a page that registers after another took a new version offers it too', { skip }, async () => {
  const { first, second, learn } = await pagesBeforeAnotherVersion();
  await findsNew(first);
  await takesNew(first);
  await learn();
  await takesNew(second);
});

test('a version that came incompletely is not taken', { skip }, async () => {
  const { page } = await open(await plainHost());
  await isolatedPage(page);
  const before = await caches(page);
  const name = await nameInCache(page);
  deploy({ broken: true });
  await page.evaluate(async () => {
    const registration = await navigator.serviceWorker.ready;
    const found = new Promise((resolve) => registration.addEventListener('updatefound', resolve, { once: true }));
    await registration.update();
    if (registration.installing === null) await found;
    const { installing } = registration;
    await new Promise((resolve) => {
      if (installing === null || installing.state === 'redundant') resolve();
      installing?.addEventListener('statechange', () => installing.state === 'redundant' && resolve());
    });
  });
  await page.reload();
  assert.equal(await nameInCache(page), name);
  // The visit tries again, and what that keeps goes with it.
  await page.waitForFunction(async (before) => (await globalThis.caches.keys()).join() === before, before.join());
  assert.equal(await nameInCache(page), name);
});

test('changed headers reach those who come back, and the page for frames is not kept', { skip }, async () => {
  const sent = {};
  site = await servePlain({ '/studio/': folder }, sent);
  const address = `${site.origin}/studio/`;
  const { page } = await open(address);
  await isolatedPage(page);
  sent['Content-Security-Policy'] = "frame-ancestors 'none'";
  for (const name of ['', 'index.html', 'embed.html']) {
    const response = await page.goto(address + name);
    assert.ok(response.fromServiceWorker(), name);
    assert.equal(response.headers()['content-security-policy'], "frame-ancestors 'none'", name);
  }
  const kept = await page.evaluate(async () => {
    const cache = await globalThis.caches.open((await globalThis.caches.keys())[0]);
    return (await cache.keys()).map(({ url }) => new URL(url).pathname);
  });
  assert.ok(kept.includes('/studio/') && !kept.includes('/studio/embed.html'));
});
