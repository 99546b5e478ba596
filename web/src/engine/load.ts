// Fetches and starts the engine, behind the first picture of the page.
import type { Engine } from 'sillon';

const paintWithin = 500; // [ms]; frames that are out of their page's sight are not drawn, and may be asked for a plate

/** Resolves once the page has been drawn; at once where it is hidden and never will be. */
function afterPaint(): Promise<void> {
  if (document.visibilityState === 'hidden') return Promise.resolve();
  return new Promise((resolve) => {
    setTimeout(resolve, paintWithin);
    requestAnimationFrame(() => {
      setTimeout(resolve, 0);
    });
  });
}

/** @param threads  as the address asks: `?threads=off`
 * @param first  what is to have the network before */
export async function loadEngine(threads: 'auto' | 'off' | number, first?: Promise<unknown>): Promise<Engine> {
  await Promise.all([afterPaint(), first]);
  const { createEngine } = await import('sillon');
  // Set by the build, not by any address (headers.js).
  const elsewhere = document.querySelector<HTMLMetaElement>('meta[name="sillon-engine"]')?.content;
  const engine = await createEngine({ threads, assetBase: new URL(elsewhere ?? 'engine/', document.baseURI) });
  engine.warm().catch(() => undefined); // the plate itself will tell
  return engine;
}
