// Starts a worker from a script of this site, also in sandboxed frames.

/** Starts a worker. @param url  address of a classic script, or of a module without imports */
export function startWorker(url: string, name: string): Worker {
  if (self.origin !== 'null') return new Worker(url, { type: 'module', name });
  // For an opaque origin, browsers accept only scripts from a blob of the page itself, and no modules.
  const address = JSON.stringify(new URL(url, document.baseURI).href);
  const script = new Blob([`importScripts(${address})`], { type: 'text/javascript' });
  const held = URL.createObjectURL(script);
  const worker = new Worker(held, { name });
  worker.addEventListener(
    'message',
    () => {
      URL.revokeObjectURL(held); // the script has been loaded
    },
    { once: true },
  );
  return worker;
}
