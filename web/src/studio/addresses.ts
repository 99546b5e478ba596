// Addresses that are pasted or dropped: a link brings its plate; of others it is said what to do.
import { words } from '../i18n/en/files.js';
import { say } from '../i18n/text.js';
import type { Studio } from './studio.js';

/** @param text  as it was pasted, or a list of addresses; what is none means nothing */
export function openAddress(studio: Studio, text: string): void {
  const [address = ''] = text.trim().split(/[\r\n]+/);
  const [, host, hash = ''] = /^https?:\/\/([^/?#\s]+)[^#\s]*(#\S*)?$/i.exec(address) ?? [];
  if (host === undefined) return;
  if (!hash.startsWith('#plate=')) studio.notify(say(words, 'files.address', { host }));
  else if (studio.store.state.mode === 'edit') {
    studio.show(undefined);
    location.replace(hash); // which is taken out of the address again
  }
}
