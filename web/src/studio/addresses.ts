// Handles addresses that are pasted or dropped: a Sillon link
// opens its plate; for other addresses a notice says what to do.
import { words } from '../i18n/en/files.js';
import { say } from '../i18n/text.js';
import type { Studio } from './studio.js';

/** Opens a link to a plate. @param text  pasted text or a list of addresses; other text is ignored */
export function openAddress(studio: Studio, text: string): void {
  const [address = ''] = text.trim().split(/[\r\n]+/);
  const [, host, hash = ''] = /^https?:\/\/([^/?#\s]+)[^#\s]*(#\S*)?$/i.exec(address) ?? [];
  if (host === undefined) return;
  if (!hash.startsWith('#plate=')) studio.notify(say(words, 'files.address', { host }));
  else if (studio.store.state.mode === 'edit') {
    studio.show(undefined);
    location.replace(hash); // the hash is removed from the address after it is read
  }
}
