// The service worker: the studio works without a network after the first visit, and with threads on hosts that send no
// headers. A version is kept whole or not at all: files whose bytes are not those that were built fail the installation,
// and the next visit tries again.

export {};

/** Put in front of this file by the build (vite.config.js). */
declare const build: {
  version: string;
  /** SHA-256 in base64, by address relative to this file. */
  files: Record<string, string>;
  isolation: Record<string, string>;
};

const worker = self as unknown as ServiceWorkerGlobalScope;
const { scope } = worker.registration;
const ours = `sillon ${scope} `; // caches are shared by all that an origin hosts
const cacheName = ours + build.version;
const known = new Set(Object.keys(build.files).map((name) => new URL(name, scope).href));

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

async function keep(cache: Cache, name: string, hash: string): Promise<void> {
  const url = new URL(name, scope).href;
  const response = await fetch(url, { cache: 'no-cache', credentials: 'same-origin' });
  if (!response.ok) throw new Error(`${url} came with status ${response.status}`);
  const bytes = await response.clone().arrayBuffer();
  const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', bytes));
  if (btoa(String.fromCharCode(...digest)) !== hash) throw new Error(`${url} is not of version ${build.version}`);
  await cache.put(url, response);
}

async function install(): Promise<void> {
  try {
    const cache = await caches.open(cacheName);
    await Promise.all(Object.entries(build.files).map(([name, hash]) => keep(cache, name, hash)));
  } catch (error) {
    await caches.delete(cacheName);
    throw error;
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

async function answer(request: Request, url: string): Promise<Response> {
  const cache = await caches.open(cacheName);
  const kept = await cache.match(url);
  try {
    return isolated(kept ?? (await fetch(request)));
  } catch {
    return Response.error(); // no network
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
worker.addEventListener('message', ({ data }) => {
  if (data === 'activate') void worker.skipWaiting();
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
  url.search = '';
  url.hash = '';
  const asked = url.href.replace(/\/index\.html$/, '/');
  if (asked === new URL('embed.html', scope).href) {
    event.respondWith(frames(request));
    return;
  }
  if (!known.has(asked)) return; // neither another site's nor another page's below this one
  event.respondWith(asked === scope ? page(request, asked) : answer(request, asked));
});
