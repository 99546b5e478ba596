// Starts the service worker, chooses which files it keeps, and reports a new version.
import { words } from '../i18n/en/about.js';
import { say, t } from '../i18n/text.js';
import { markUnfetched } from '../model/problem.js';
import type { Studio } from '../studio/studio.js';

const begun = 'sillon-begun-without-worker';
const patience = 10_000; // [ms] for the old version to end

/** Remembers that this tab began without a service worker. @returns true if it had before; undefined: unknown */
function beginsWithout(now: boolean): boolean | undefined {
  try {
    const before = sessionStorage.getItem(begun) !== null;
    if (now) sessionStorage.setItem(begun, 'yes');
    return before;
  } catch {
    return undefined;
  }
}

interface Line {
  saveData?: boolean;
  /** Kind of connection; browsers tell it on phones only. */
  type?: string;
}

/** Tells whether downloads are probably free of charge. If the browser does not say, a phone's connection is assumed
 * to cost money. */
function isFree(): boolean {
  const { saveData = false, type }: Line = (navigator as { connection?: Line }).connection ?? {};
  if (saveData) return false;
  if (type !== undefined) return type === 'wifi' || type === 'ethernet';
  return matchMedia('(hover: hover) and (pointer: fine)').matches;
}

/** Tells the worker to keep files. @returns true if it keeps them all */
function keep(names: string[] | 'all', worker: ServiceWorker): Promise<boolean> {
  const { port1, port2 } = new MessageChannel();
  return new Promise((resolve) => {
    port1.onmessage = ({ data }: MessageEvent<boolean>) => resolve(data);
    worker.postMessage({ keep: names }, [port2]);
  });
}

/** Keeps all parts of the page on this device, at the user's request.
 * @throws Error if some cannot be fetched, or this browser keeps none */
export async function keepAll(studio: Studio): Promise<void> {
  const active = (await navigator.serviceWorker.getRegistration())?.active;
  if (active == null || !(await keep('all', active))) {
    const error = new Error('not all of the page could be kept');
    markUnfetched(error);
    throw error;
  }
  studio.notify(say(words, 'offline.ready'));
}

/** Offers to reload the page when a new version is installed. */
function watchForUpdates(
  registration: ServiceWorkerRegistration,
  broughtBy: ServiceWorker | null,
  studio: Studio,
): void {
  const { serviceWorker } = navigator;
  const offer = (run: () => void): void => {
    studio.tell({ text: say(words, 'offline.update'), actions: [{ label: t('verb.reload'), run }], stays: true });
  };
  const reload = (): void => location.reload();
  const tell = (waiting: ServiceWorker): void => {
    offer(() => {
      // Another tab may have activated the version already: then no change follows.
      if (waiting.state === 'activated') reload();
      else serviceWorker.addEventListener('controllerchange', reload, { once: true });
      // Browsers let the old version finish its work, which may never end; reloading the page ends it.
      setTimeout(reload, patience);
      waiting.postMessage('activate');
    });
  };
  let watched: ServiceWorker | null = null;
  const watchInstalling = (): void => {
    const { installing } = registration;
    if (installing === watched) return;
    watched = installing;
    installing?.addEventListener('statechange', () => {
      // Without a controller, this is the first version and no update.
      if (installing.state === 'installed' && serviceWorker.controller !== null) tell(installing);
    });
  };
  registration.addEventListener('updatefound', watchInstalling);
  // Other tabs may have found or activated a version before this one registered.
  watchInstalling();
  if (registration.waiting !== null) tell(registration.waiting);
  else if (broughtBy !== null && serviceWorker.controller !== broughtBy) offer(reload);
}

/** Starts the service worker; does nothing without service workers: in old browsers, sandboxes, frames of other
 * sites, and on plain http.
 * @param broughtBy  service worker that served this page; null: none */
export async function workOffline(studio: Studio, broughtBy: ServiceWorker | null): Promise<void> {
  const begunWithout = beginsWithout(broughtBy === null);
  let active: ServiceWorker | null;
  try {
    const { serviceWorker } = navigator;
    const registration = await serviceWorker.register(new URL('sw.js', document.baseURI), { updateViaCache: 'none' });
    watchForUpdates(registration, broughtBy, studio);
    ({ active } = await serviceWorker.ready);
  } catch {
    return;
  }
  // Hosts without headers need one reload to get threads. It is skipped if an edit would be lost, and never done twice
  // in a tab.
  const helps = broughtBy === null && begunWithout === false && !crossOriginIsolated && window.top === window;
  if (helps && !studio.store.canUndo) {
    location.reload();
    return;
  }
  if (active === null) return;
  // A first visit keeps what it has loaded anyway, at no cost; a later visit keeps the whole page.
  if (broughtBy === null || begunWithout !== false)
    await keep(
      performance.getEntriesByType('resource').map(({ name }) => name),
      active,
    );
  else if (isFree()) await keep('all', active);
}
