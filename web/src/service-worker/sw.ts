// The service worker: after the first visit, the studio opens without a network, with the parts that were used, and has
// threads even if the host sends no headers. All parts are kept if a page asks for that (app/offline.ts). A version is
// installed completely or not at all: each kept file of the previous version must have a successor, and a file whose
// bytes differ from the build fails the installation; the next visit tries again.

export {};

/** The build puts this in front of the file (vite.config.js). */
declare const build: {
  version: string;
  /** SHA-256 in base64, by address relative to this file; '': any content. */
  files: Record<string, string>;
  /** Names of the files that every visit needs. */
  first: string[];
  isolation: Record<string, string>;
};

const worker = self as unknown as ServiceWorkerGlobalScope;
const { scope } = worker.registration;
const ours = `sillon ${scope} `; // caches are shared by everything that an origin hosts
const cacheName = ours + build.version;
const known = new Map(Object.entries(build.files).map(([name, hash]) => [new URL(name, scope).href, hash]));
const first = build.first.map((name) => new URL(name, scope).href);

/** Returns the address under which a file is kept. */
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

/** Tells whether single documents can be isolated, as in Chromium on desktops. The older pair of headers separates a
 * page from its opener, so it is only for other browsers. */
function knowsDocumentIsolation(): boolean {
  const { userAgentData } = navigator as { userAgentData?: Brands };
  if (userAgentData === undefined || userAgentData.mobile) return false;
  return userAgentData.brands.some(({ brand, version }) => brand === 'Chromium' && Number(version) >= 137);
}

const added = knowsDocumentIsolation()
  ? ['Document-Isolation-Policy', 'Cross-Origin-Resource-Policy']
  : ['Cross-Origin-Opener-Policy', 'Cross-Origin-Embedder-Policy', 'Cross-Origin-Resource-Policy'];

/** Returns a response with the headers that let threads share memory; headers of the host take precedence. */
function isolated(response: Response): Response {
  if (response.type !== 'basic' && response.type !== 'default') return response;
  const headers = new Headers(response.headers);
  for (const name of added) {
    const value = build.isolation[name];
    if (value !== undefined && !headers.has(name)) headers.set(name, value);
  }
  // A new response is no longer "redirected"; browsers refuse redirected responses as pages.
  const { status, statusText } = response;
  return new Response(status === 204 || status === 304 ? null : response.body, { status, statusText, headers });
}

// --- Installing a version ------------------------------------------------------------------------------------------------

/** Tells whether the content is the one that was built. */
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

/** Keeps a file of this version: from an older version or the browser's cache; it is fetched only if it has changed.
 * @throws Error if no source has it */
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

/** Returns the address without the hash of its content. */
const lasting = (url: string): string => url.replace(/(?<=\/engine\/)[\da-f]{12}\/|-[\w-]{8}(?=\.\w+$)/, '');

/** Installs this version, or nothing at all. */
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

/** Keeps named files, or all of them, one after another, so that the page's own requests go first.
 * @returns true if all of them are kept now */
async function keepMore(names: string[] | 'all'): Promise<boolean> {
  const cache = await caches.open(cacheName);
  const wanted = names === 'all' ? [...known.keys()] : names.map(addressOf).filter((url) => known.has(url));
  try {
    for (const url of wanted) await keep(cache, url, []);
    return true;
  } catch {
    return false; // no network, no space, or the server has another version
  }
}

/** Deletes older versions and takes over their pages. */
async function activate(): Promise<void> {
  const names = await caches.keys();
  await Promise.all(
    names.filter((name) => name.startsWith(ours) && name !== cacheName).map((name) => caches.delete(name)),
  );
  await worker.clients.claim();
}

/** Returns the kept page with the host's current headers, which also say who may frame it. The page itself is of the
 * kept version, like the engine's files beside it. */
async function page(request: Request, url: string): Promise<Response> {
  const kept = await (await caches.open(cacheName)).match(url);
  const fresh = await fetch(request).catch(() => undefined);
  if (kept === undefined) return fresh === undefined ? Response.error() : isolated(fresh);
  if (fresh?.ok !== true) return isolated(kept);
  const headers = new Headers(fresh.headers);
  for (const name of ['Content-Encoding', 'Content-Length']) headers.delete(name); // they describe the body that is not used
  void fresh.body?.cancel();
  return isolated(new Response(kept.body, { headers }));
}

/** Fetches the page for frames, which is never kept: the host decides each time who may frame it. */
const frames = (request: Request): Promise<Response> => fetch(request).then(isolated, () => Response.error());

/** Returns a kept file, or fetches and keeps it. A file with other bytes is passed on unchanged: names of scripts,
 * and of the engine's folder, contain hashes of their content, so it cannot be code of another version.
 * @param lasts  makes the browser wait for a promise */
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
    // The transfer broke off, or there is no space: the file is fetched again next time.
  }
}

/** Keeps files that another app shares with the installed page
 * (manifest), until that page takes them (files/handed.ts). */
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

// Pages of an older version keep their files: the new version waits until those pages are closed, or activate it.
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
  if (!known.has(asked)) return; // files of other sites, and of other pages below this one, are not handled
  const lasts = event.waitUntil.bind(event);
  event.respondWith(asked === scope ? page(request, asked) : answer(request, asked, lasts));
});
