// The service worker: the studio opens without a network after the first visit, with the parts that were used, and with threads
// on hosts that send no headers. All parts are kept when a page asks for that (app/offline.ts). A version is taken whole or not
// at all: it comes with a successor of every file that is kept of the one before, and files whose bytes are not those that
// were built fail the installation; the next visit tries again.

export {};

/** Put in front of this file by the build (vite.config.js). */
declare const build: {
  version: string;
  /** SHA-256 in base64, by address relative to this file; '': whatever comes. */
  files: Record<string, string>;
  /** Names of the files that every visit needs. */
  first: string[];
  isolation: Record<string, string>;
};

const worker = self as unknown as ServiceWorkerGlobalScope;
const { scope } = worker.registration;
const ours = `sillon ${scope} `; // caches are shared by all that an origin hosts
const cacheName = ours + build.version;
const known = new Map(Object.entries(build.files).map(([name, hash]) => [new URL(name, scope).href, hash]));
const first = build.first.map((name) => new URL(name, scope).href);

/** The name under which a file is kept. */
function addressOf(asked: string | URL): string {
  const url = new URL(asked, scope);
  url.search = '';
  url.hash = '';
  return url.href.replace(/\/index\.html$/, '/');
}

// --- Headers -------------------------------------------------------------------------------------------------------------

interface Brands {
  mobile: boolean;
  brands: { brand: string; version: string }[];
}

/** Chromium on desktops isolates single documents. The older pair of headers cuts a page off from those that opened it, so
 * it is for other browsers only. */
function knowsDocumentIsolation(): boolean {
  const { userAgentData } = navigator as { userAgentData?: Brands };
  if (userAgentData === undefined || userAgentData.mobile) return false;
  return userAgentData.brands.some(({ brand, version }) => brand === 'Chromium' && Number(version) >= 137);
}

const added = knowsDocumentIsolation()
  ? ['Document-Isolation-Policy', 'Cross-Origin-Resource-Policy']
  : ['Cross-Origin-Opener-Policy', 'Cross-Origin-Embedder-Policy', 'Cross-Origin-Resource-Policy'];

/** With the headers that let threads share memory. What the host says goes first. */
function isolated(response: Response): Response {
  if (response.type !== 'basic' && response.type !== 'default') return response;
  const headers = new Headers(response.headers);
  for (const name of added) {
    const value = build.isolation[name];
    if (value !== undefined && !headers.has(name)) headers.set(name, value);
  }
  // Made anew, it is also no longer "redirected", which browsers refuse as a page.
  const { status, statusText } = response;
  return new Response(status === 204 || status === 304 ? null : response.body, { status, statusText, headers });
}

// --- A version's life ----------------------------------------------------------------------------------------------------

async function isOfThisVersion(response: Response, url: string): Promise<boolean> {
  const hash = known.get(url);
  if (hash === '') return true;
  const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', await response.clone().arrayBuffer()));
  return btoa(String.fromCharCode(...digest)) === hash;
}

const olderCaches = async (): Promise<Cache[]> => {
  const names = await caches.keys();
  return Promise.all(
    names.filter((name) => name.startsWith(ours) && name !== cacheName).map((name) => caches.open(name)),
  );
};

/** Keeps a file of this version: as an older version or the browser has it, and fetched only if it has changed.
 * @throws Error if it cannot be had */
async function keep(cache: Cache, url: string, older: readonly Cache[]): Promise<void> {
  if ((await cache.match(url)) !== undefined) return;
  const ask = (how: RequestCache) => () => fetch(url, { cache: how, credentials: 'same-origin' });
  const sources = [...older.map((one) => () => one.match(url)), ask('force-cache'), ask('no-cache')];
  for (const source of sources) {
    const response = await source();
    if (response?.ok !== true || !(await isOfThisVersion(response, url))) continue;
    await cache.put(url, response);
    return;
  }
  throw new Error(`${url} is not to be had as of version ${build.version}`);
}

/** The address without the hash of its content. */
const lasting = (url: string): string => url.replace(/(?<=\/engine\/)[\da-f]{12}\/|-[\w-]{8}(?=\.\w+$)/, '');

async function install(): Promise<void> {
  try {
    const cache = await caches.open(cacheName);
    const older = await olderCaches();
    const before = (await Promise.all(older.map((one) => one.keys()))).flat().map(({ url }) => lasting(url));
    const wanted = [...known.keys()].filter((url) => first.includes(url) || before.includes(lasting(url)));
    await Promise.all(wanted.map((url) => keep(cache, url, older)));
  } catch (error) {
    await caches.delete(cacheName);
    throw error;
  }
}

/** Keeps files that a page names, or all, one after another: what a page fetches meanwhile goes first.
 * @returns whether all of them are kept now */
async function keepMore(names: string[] | 'all'): Promise<boolean> {
  const cache = await caches.open(cacheName);
  const wanted = names === 'all' ? [...known.keys()] : names.map(addressOf).filter((url) => known.has(url));
  try {
    for (const url of wanted) await keep(cache, url, []);
    return true;
  } catch {
    return false; // no network, no room, or another version lies there
  }
}

async function activate(): Promise<void> {
  const names = await caches.keys();
  await Promise.all(
    names.filter((name) => name.startsWith(ours) && name !== cacheName).map((name) => caches.delete(name)),
  );
  await worker.clients.claim();
}

/** Headers as the host sends them now, who may frame the page among them; the page itself of the version that is kept, as the
 * engine's files beside it are. */
async function page(request: Request, url: string): Promise<Response> {
  const kept = await (await caches.open(cacheName)).match(url);
  const fresh = await fetch(request).catch(() => undefined);
  if (kept === undefined) return fresh === undefined ? Response.error() : isolated(fresh);
  if (fresh?.ok !== true) return isolated(kept);
  const headers = new Headers(fresh.headers);
  for (const name of ['Content-Encoding', 'Content-Length']) headers.delete(name); // of the body that is not used
  void fresh.body?.cancel();
  return isolated(new Response(kept.body, { headers }));
}

/** The page for frames is never kept: who may frame it is the host's to say, every time. */
const frames = (request: Request): Promise<Response> => fetch(request).then(isolated, () => Response.error());

/** A file that is kept, or that is from now on. One with other bytes is passed on as it came: names of scripts, and of the
 * engine's folder, hold hashes of what is in them, so that it is no other version's code.
 * @param lasts  tells the browser to wait for something */
async function answer(request: Request, url: string, lasts: (done: Promise<unknown>) => void): Promise<Response> {
  const cache = await caches.open(cacheName);
  const kept = await cache.match(url);
  if (kept !== undefined) return isolated(kept);
  let fresh: Response;
  try {
    fresh = await fetch(request);
  } catch {
    return Response.error(); // no network
  }
  if (fresh.ok) lasts(keepFresh(cache, url, fresh.clone()));
  return isolated(fresh);
}

async function keepFresh(cache: Cache, url: string, fresh: Response): Promise<void> {
  try {
    if (await isOfThisVersion(fresh, url)) await cache.put(url, fresh);
  } catch {
    // It broke off, or there is no room: it is asked for again.
  }
}

/** Files that another app shares with the installed page (manifest): kept until that page takes them (files/handed.ts). */
async function share(request: Request): Promise<Response> {
  const cache = await caches.open(`sillon-shared ${scope}`);
  const form = await request.formData();
  const files = form.getAll('files').filter((one) => typeof one !== 'string');
  for (const [k, file] of files.entries()) {
    const headers = { 'Content-Type': file.type || 'application/octet-stream' };
    await cache.put(
      new URL(`shared-${k}?name=${encodeURIComponent(file.name)}`, scope),
      new Response(file, { headers }),
    );
  }
  return Response.redirect(`${scope}#shared`, 303);
}

worker.addEventListener('install', (event) => {
  event.waitUntil(install());
});

// Pages of an older version keep theirs: the new one waits until they are closed, or say so.
worker.addEventListener('message', (event) => {
  const asked = event.data as 'activate' | { keep: string[] | 'all' };
  if (asked === 'activate') void worker.skipWaiting();
  else event.waitUntil(keepMore(asked.keep).then((all) => event.ports[0]?.postMessage(all)));
});

worker.addEventListener('activate', (event) => {
  event.waitUntil(activate());
});

worker.addEventListener('fetch', (event) => {
  const { request } = event;
  const url = new URL(request.url);
  if (request.method === 'POST' && request.mode === 'navigate' && url.href === scope) {
    event.respondWith(share(request));
    return;
  }
  if (request.method !== 'GET' || url.origin !== worker.location.origin || request.headers.has('range')) return;
  const asked = addressOf(url);
  if (asked === new URL('embed.html', scope).href) {
    event.respondWith(frames(request));
    return;
  }
  if (!known.has(asked)) return; // neither another site's nor another page's below this one
  const lasts = event.waitUntil.bind(event);
  event.respondWith(asked === scope ? page(request, asked) : answer(request, asked, lasts));
});
