// Files that the system hands to the installed page, shared from another app or opened with it.
import { filesOf } from './in-place.js';

/** Name of the cache, which must be the same in service-worker/sw.ts. */
const cacheName = (): string => `sillon-shared ${new URL('./', document.baseURI).href}`;

/** Takes the files that were shared last; a second call returns none. */
export async function sharedFiles(): Promise<File[]> {
  const cache = await caches.open(cacheName());
  const files: File[] = [];
  for (const request of await cache.keys()) {
    const response = await cache.match(request);
    if (response === undefined) continue;
    const name = decodeURIComponent(new URL(request.url).searchParams.get('name') ?? '');
    const blob = await response.blob();
    files.push(new File([blob], name || 'file', { type: blob.type }));
  }
  await caches.delete(cacheName());
  return files;
}

interface Launch {
  files?: readonly FileSystemFileHandle[];
}
interface Queue {
  setConsumer(consume: (launch: Launch) => void): void;
}

/** Calls `open` with the files that the page was started with. @param handles  receives their handles */
export function onLaunched(open: (files: File[]) => void, handles: WeakMap<File, FileSystemHandle>): void {
  const { launchQueue } = window as { launchQueue?: Queue };
  launchQueue?.setConsumer(({ files = [] }) => {
    void filesOf(files, handles).then((opened) => {
      if (opened.length > 0) open(opened);
    });
  });
}
