// Requests the engine's files while the page's own files are still on their way, since they are most of a first visit.
// The engine finds them in the browser's cache. The page requests them only if it knows which engine it will start, and
// if no service worker has them.

/** Returns the engine that the page will start, with or without threads; undefined: unknown yet. */
function kind(): 'mt' | 'st' | undefined {
  const asked = new URLSearchParams(location.search).get('threads') ?? 'auto';
  if (asked === 'off' || navigator.hardwareConcurrency === 1) return 'st';
  if (asked !== 'auto') return undefined;
  if (crossOriginIsolated) return 'mt';
  return window.top === window ? undefined : 'st'; // a page outside frames may be loaded again with threads (offline.ts)
}

/** Tells whether requests are useless: frames of an opaque origin share no cache with the worker that they start,
 * and a service worker has the files already. */
function isAlone(): boolean {
  try {
    return self.origin === 'null' || navigator.serviceWorker.controller !== null;
  } catch {
    return true;
  }
}

const engine = isAlone() ? undefined : kind();
const folder = document.querySelector<HTMLMetaElement>('meta[name="sillon-engine"]')?.content;
if (engine !== undefined && folder !== undefined) {
  const names = [`sillon-${engine}.wasm`, 'worker.js', `sillon-${engine}.js`];
  if (engine === 'mt') names.push('sillon-mt.worker.js');
  for (const name of names) {
    // The response is read to its end, since otherwise it would not
    // be cached. The engine repeats a failed request and reports it.
    void fetch(new URL(name, new URL(folder, document.baseURI)), { priority: 'low' })
      .then((response) => response.arrayBuffer())
      .catch(() => undefined);
  }
}

export {};
