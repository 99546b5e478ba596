// Asks for the engine's files while those of the page are on their way, since they are most of a first visit. The engine finds
// them in the browser's cache. A page asks only where it knows which engine it will start, and a kept one is there already.

function kind(): 'mt' | 'st' | undefined {
  const asked = new URLSearchParams(location.search).get('threads') ?? 'auto';
  if (asked === 'off' || navigator.hardwareConcurrency === 1) return 'st';
  if (asked !== 'auto') return undefined;
  if (crossOriginIsolated) return 'mt';
  return window.top === window ? undefined : 'st'; // a page of its own may be loaded anew with threads (offline.ts)
}

/** Frames of an opaque origin share no cache with the worker that they start. */
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
    // Whoever does not read an answer to its end keeps it from getting into the cache. What fails is asked for again and told.
    void fetch(new URL(name, new URL(folder, document.baseURI)), { priority: 'low' })
      .then((response) => response.arrayBuffer())
      .catch(() => undefined);
  }
}

export {};
