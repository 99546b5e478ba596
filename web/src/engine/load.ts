// Loads and starts the engine, after the page's first paint.
import type { Engine } from 'sillon';

const paintWithin = 500; // [ms]; frames out of sight are never painted, but a plate may be requested from them

/** Resolves once the page has been painted; at once if it is hidden and will not be. */
function afterPaint(): Promise<void> {
  if (document.visibilityState === 'hidden') return Promise.resolve();
  return new Promise((resolve) => {
    setTimeout(resolve, paintWithin);
    requestAnimationFrame(() => {
      setTimeout(resolve, 0);
    });
  });
}

/** Loads the engine.
 * @param threads  from the address: `?threads=off`
 * @param first  requests that use the network before the engine does */
export async function loadEngine(threads: 'auto' | 'off' | number, first?: Promise<unknown>): Promise<Engine> {
  await Promise.all([afterPaint(), first]);
  const { createEngine } = await import('sillon');
  // The build sets this, no address can (headers.js).
  const elsewhere = document.querySelector<HTMLMetaElement>('meta[name="sillon-engine"]')?.content;
  const engine = await createEngine({ threads, assetBase: new URL(elsewhere ?? 'engine/', document.baseURI) });
  engine.warm().catch(() => undefined); // the plate's own job reports the failure
  return engine;
}
