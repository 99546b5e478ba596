// Reads the query of the page's address, for example ?src=plate.svg&mode=view
import { spoken } from '../i18n/languages.js';
import type { Unfit } from '../model/check.js';
import type { Asked } from './fetching.js';
import { guestSettings, type GuestSettings } from '../model/guest.js';

/** Attributes that name files, with the role of each file; '': the file's bytes tell its role. */
export const fileAttributes = { src: '', project: '', shape: 'shape', image: 'image' } as const;

export interface Addressed {
  given: Partial<GuestSettings>;
  wrong: Unfit[];
  files: Asked[];
  /** The host is about to load a plate. */
  waits: boolean;
}

/** Reads settings and file addresses from a query; values that do not fit are returned in `wrong`. */
export function addressed(search: string): Addressed {
  const query = new URLSearchParams(search);
  const files = Object.entries(fileAttributes).flatMap(([name, role]) => {
    const url = query.get(name);
    return url === null || url === '' ? [] : [{ url, role }];
  });
  return { ...guestSettings((name) => query.get(name) ?? undefined, spoken), files, waits: query.has('waits') };
}
