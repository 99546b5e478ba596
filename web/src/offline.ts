// Starts the service worker, and tells when the page works without a network and when a new version is there.

export interface OfflineEvents {
  /** For the first time: from now on the page works without a network. */
  onReady: () => void;
  /** @param apply  reloads the page with the new version. */
  onUpdate: (apply: () => void) => void;
  /** Whether nothing would be lost by reloading now, which hosts without headers need once for threads. */
  mayReload: () => boolean;
}

const reloaded = 'sillon-reloaded-for-threads';

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

function watchForUpdates(registration: ServiceWorkerRegistration, { onUpdate }: OfflineEvents): void {
  const tell = (waiting: ServiceWorker): void => {
    onUpdate(() => {
      if (waiting.state === 'activated') {
        location.reload(); // another tab was faster: there will be no other change
        return;
      }
      navigator.serviceWorker.addEventListener(
        'controllerchange',
        () => {
          location.reload();
        },
        { once: true },
      );
      waiting.postMessage('activate');
    });
  };
  if (registration.waiting !== null) tell(registration.waiting);
  registration.addEventListener('updatefound', () => {
    const { installing } = registration;
    installing?.addEventListener('statechange', () => {
      // Without a controller it is no update but the first.
      if (installing.state === 'installed' && navigator.serviceWorker.controller !== null) tell(installing);
    });
  });
}

/** Quietly does nothing where there are no service workers: old browsers, frames of other sites, plain http. */
export async function workOffline(events: OfflineEvents): Promise<void> {
  if (!('serviceWorker' in navigator)) return;
  const { serviceWorker } = navigator;
  const first = serviceWorker.controller === null;
  try {
    const registration = await serviceWorker.register(new URL('sw.js', document.baseURI), { updateViaCache: 'none' });
    watchForUpdates(registration, events);
    await serviceWorker.ready;
  } catch {
    return;
  }
  if (!first) return;
  events.onReady();
  if (!crossOriginIsolated && window.top === window && events.mayReload()) reloadOnce();
}
