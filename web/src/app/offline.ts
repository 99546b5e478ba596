// Starts the service worker, and tells when the page works without a network and when a new version is there.
import { words } from '../i18n/en/about.js';
import { say, t } from '../i18n/text.js';
import type { Studio } from '../studio/studio.js';

const reloaded = 'sillon-reloaded-for-threads';
const patience = 10_000; // [ms]

/** Never twice in a tab, whatever comes of it; and not at all where that cannot be remembered. */
function reloadOnce(): void {
  try {
    if (sessionStorage.getItem(reloaded) !== null) return;
    sessionStorage.setItem(reloaded, 'yes');
  } catch {
    return;
  }
  location.reload();
}

function watchForUpdates(
  registration: ServiceWorkerRegistration,
  broughtBy: ServiceWorker | null,
  studio: Studio,
): void {
  const { serviceWorker } = navigator;
  const offer = (run: () => void): void => {
    studio.tell({ text: say(words, 'offline.update'), actions: [{ label: t('verb.reload'), run }], stays: true });
  };
  const reload = (): void => {
    location.reload();
  };
  const tell = (waiting: ServiceWorker): void => {
    offer(() => {
      // Another tab may have been faster: there will be no other change.
      if (waiting.state === 'activated') reload();
      else serviceWorker.addEventListener('controllerchange', reload, { once: true });
      // Browsers let the old version finish what it does, which may never end; a page that is loaded anew ends it.
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
      // Without a controller it is no update but the first.
      if (installing.state === 'installed' && serviceWorker.controller !== null) tell(installing);
    });
  };
  registration.addEventListener('updatefound', watchInstalling);
  // Other tabs may have found a version, or taken it, before this one registered.
  watchInstalling();
  if (registration.waiting !== null) tell(registration.waiting);
  else if (broughtBy !== null && serviceWorker.controller !== broughtBy) offer(reload);
}

/** Quietly does nothing where there are no service workers: old browsers, sandboxes, frames of other sites, plain http.
 * @param broughtBy  the service worker that brought this page; null: none */
export async function workOffline(studio: Studio, broughtBy: ServiceWorker | null): Promise<void> {
  try {
    const { serviceWorker } = navigator;
    const registration = await serviceWorker.register(new URL('sw.js', document.baseURI), { updateViaCache: 'none' });
    watchForUpdates(registration, broughtBy, studio);
    await serviceWorker.ready;
  } catch {
    return;
  }
  if (broughtBy !== null) return;
  studio.notify(say(words, 'offline.ready'));
  // Hosts without headers need it once for threads; not where an edit would be lost.
  if (!crossOriginIsolated && window.top === window && !studio.store.canUndo) reloadOnce();
}
