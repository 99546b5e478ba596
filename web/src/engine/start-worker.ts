// Starts a worker from a script of this site, in sandboxed frames too.

/** @param url  of a classic script, or a module without imports */
export function startWorker(url: string, name: string): Worker {
  if (self.origin !== 'null') return new Worker(url, { type: 'module', name });
  // An opaque origin is nobody's own: browsers take only a script that the page holds itself, and no module.
  const address = JSON.stringify(new URL(url, document.baseURI).href);
  const script = new Blob([`importScripts(${address})`], { type: 'text/javascript' });
  const held = URL.createObjectURL(script);
  const worker = new Worker(held, { name });
  worker.addEventListener(
    'message',
    () => {
      URL.revokeObjectURL(held); // it has come
    },
    { once: true },
  );
  return worker;
}
