// What a first visit and a later one wait for: the first shimmer, the first plate, the bytes until then, and how much slower
// the engine's first plate is than its next ones. Prints; asserts nothing.   ./dev bench page
//
// The link is the server's, not the browser's own emulation of one: that one slows each page, worker and service worker by
// itself, while here all of them share 10 Mbit/s. Files are sent as brotli, as a host with compression does.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync } from 'node:zlib';

import { startChromium } from '../wasm/test/support/browsers.js';
import { headers } from './headers.js';

const rounds = Number(process.argv[2] ?? 5);
const megabits = 10;
const latency = 40; // [ms]
const packet = 8192; // [bytes]
const patience = 180_000; // [ms]
const dist = fileURLToPath(new URL('dist', import.meta.url));
const types = {
  '.css': 'text/css',
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.json': 'application/json',
  '.png': 'image/png',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
  '.webp': 'image/webp',
};

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

const files = new Map(
  readdirSync(dist, { recursive: true })
    .filter((name) => statSync(join(dist, name)).isFile())
    .map((name) => {
      const plain = readFileSync(join(dist, name));
      const packed = brotliCompressSync(plain);
      const small = packed.length < plain.length;
      const encoding = small ? { 'Content-Encoding': 'br' } : {};
      const tag = `"${createHash('sha256').update(plain).digest('base64url')}"`;
      return [`/${name.replaceAll('\\', '/')}`, { bytes: small ? packed : plain, encoding, tag }];
    }),
);

/** The studio at the end of one link. `fetched` tells what has been sent: name, bytes, and when the last of them left. */
async function serveSlowly() {
  const fetched = [];
  let free = 0; // when the link is [ms]
  const server = createServer(async (request, response) => {
    const path = new URL(request.url, 'http://localhost').pathname;
    const name = path.endsWith('/') ? `${path}index.html` : path;
    const file = files.get(name);
    await sleep(latency);
    if (file === undefined) {
      response.writeHead(404, headers).end();
      return;
    }
    const { bytes, encoding, tag } = file;
    if (request.headers['if-none-match'] === tag) {
      response.writeHead(304, { ...headers, ETag: tag }).end();
      return;
    }
    response.writeHead(200, {
      ...headers,
      ...encoding,
      ETag: tag,
      'Content-Type': types[extname(name)] ?? 'application/octet-stream',
      'Content-Length': bytes.length,
      'Cache-Control': name.startsWith('/assets/') ? 'max-age=31536000, immutable' : 'no-cache',
    });
    const entry = { name, bytes: 0, worker: request.headers['sec-fetch-dest'] };
    fetched.push(entry);
    for (let at = 0; at < bytes.length; at += packet) {
      const piece = bytes.subarray(at, at + packet);
      free = Math.max(free, performance.now()) + (8 * piece.length) / (1000 * megabits);
      await sleep(free - performance.now());
      entry.bytes += piece.length;
      response.write(piece);
    }
    response.end();
  });
  await new Promise((resolve) => server.listen(0, 'localhost', resolve));
  return {
    origin: `http://localhost:${server.address().port}`,
    fetched,
    close() {
      server.close();
      server.closeAllConnections();
    },
  };
}

/** In the page, before its own scripts: notes when what is first seen, in ms since the navigation. */
function note() {
  globalThis.seen = {};
  const { seen } = globalThis;
  const frame = () => {
    const store = document.querySelector('sillon-app')?.studio?.store;
    if (store === undefined) {
      requestAnimationFrame(frame);
      return;
    }
    seen.page = performance.now();
    const drawn = (name) => {
      seen[name] = 0;
      requestAnimationFrame(() => requestAnimationFrame(() => (seen[name] = performance.now())));
    };
    const look = (state) => {
      if (state.engine !== undefined) seen.engine ??= performance.now();
      if (state.shimmer !== undefined && seen.shimmer === undefined) drawn('shimmer');
      if (state.result !== undefined) seen.plate ??= performance.now();
      if (state.result?.measured === true) seen.measured ??= performance.now();
    };
    store.subscribe(look);
    look(store.state);
  };
  requestAnimationFrame(frame);
}

/** Another plate like the first, of which nothing can be kept. @returns [ms] until it is there */
const another = (page, k) =>
  page.evaluate(async (k) => {
    const { studio } = document.querySelector('sillon-app');
    const { store } = studio;
    const idle = () => {
      const { result, progress, summary } = store.state;
      return result?.measured === true && progress === undefined && summary !== undefined;
    };
    while (!idle()) await new Promise((resolve) => setTimeout(resolve, 100));
    const begin = performance.now();
    studio.change(({ pictures, toolpath, ...plate }) => ({
      ...plate,
      pictures: { ...pictures, lampSize: pictures.lampSize + k / 10_000 },
      toolpath: { ...toolpath, bridge: toolpath.spacing + k / 1000 },
    }));
    return new Promise((resolve) => {
      const end = store.subscribe(({ result, plate }) => {
        if (result?.plate !== plate) return;
        end();
        resolve(performance.now() - begin);
      });
    });
  }, k);

async function visit(context, site) {
  const page = await context.newPage();
  page.setDefaultTimeout(patience);
  const begin = site.fetched.length;
  await page.addInitScript(note);
  const sent = {};
  const bytes = () => site.fetched.slice(begin).reduce((sum, one) => sum + one.bytes, 0);
  const until = async (name) => {
    await page.waitForFunction((name) => globalThis.seen[name] > 0 || globalThis.seen.plate > 0, name);
    sent[name] = bytes();
  };
  await page.goto(site.origin);
  await until('shimmer');
  await until('plate');
  const seen = await page.evaluate(() => globalThis.seen);
  return { page, seen, sent };
}

/** The next visitor is new, the files are not. From a page without the studio's: its connections would hold its storage. */
async function forget(context, site) {
  const page = await context.newPage();
  await page.goto(`${site.origin}/icon.svg`);
  await page.evaluate(async () => {
    localStorage.clear();
    for (const { name } of await indexedDB.databases()) {
      await new Promise((resolve) => (indexedDB.deleteDatabase(name).onsuccess = resolve));
    }
  });
  await page.close();
}

const kb = (bytes) => `${(bytes / 1000).toFixed(0).padStart(4)} kB`;
const ms = (values) => `${median(values).toFixed(0).padStart(5)} ms (${Math.min(...values).toFixed(0)})`.padEnd(17);

const first = [];
const second = [];
const third = [];
const firstPlates = [];
const nextPlates = [];
for (let k = 0; k < rounds; ++k) {
  const browser = await startChromium();
  const site = await serveSlowly();
  try {
    const context = await browser.newContext({ viewport: { width: 1000, height: 600 }, serviceWorkers: 'allow' });
    const arrival = await visit(context, site);
    first.push(arrival);
    firstPlates.push(arrival.seen.plate - arrival.seen.engine);
    for (let j = 0; j < 4; ++j) {
      const took = await another(arrival.page, 1 + 4 * k + j);
      if (j > 0) nextPlates.push(took); // what the first measures compiled may still be on its way
    }
    await arrival.page.evaluate(() => navigator.serviceWorker.ready);
    await arrival.page.close();
    for (const later of [second, third]) {
      await forget(context, site);
      const { page, ...told } = await visit(context, site);
      later.push(told);
      await page.close();
    }
  } finally {
    await browser.close();
    site.close();
  }
}

console.log(
  `${megabits} Mbit/s, ${latency} ms; Chromium without a GPU; medians of ${rounds} (least), since the navigation`,
);
console.log(
  'visit     page              first shimmer     engine            first plate       sent until shimmer, plate',
);
for (const [name, visits] of [
  ['first', first],
  ['second', second],
  ['third', third],
]) {
  const at = (what) => ms(visits.map(({ seen }) => seen[what] ?? NaN));
  const sent = ['shimmer', 'plate'].map((what) => kb(median(visits.map(({ sent }) => sent[what]))));
  console.log(`${name.padEnd(8)} ${at('page')} ${at('shimmer')} ${at('engine')} ${at('plate')} ${sent.join('  ')}`);
}
const ratio = median(firstPlates) / median(nextPlates);
console.log(`plate of the engine, the first ${ms(firstPlates)} later ones ${ms(nextPlates)} ratio ${ratio.toFixed(2)}`);
