// The visitor's own spools, kept in this browser's storage as the text of a file of spools.
import type { OwnSpool } from '../model/plate.js';
import { readSpools, spoolsText } from './spools.js';
import type { Studio } from '../studio/studio.js';

/** Loads the spools into the state, unless they are there already. */
export function loadSpools(studio: Studio): void {
  if (studio.store.state.spools !== undefined) return;
  let spools: readonly OwnSpool[] = [];
  try {
    spools = readSpools(studio.recall('spools') ?? spoolsText([]));
  } catch {
    // A later version wrote the text. It stays as it is until another spool is kept.
  }
  studio.store.set({ spools });
}

/** Changes the kept spools, including those that another tab has added since. @param change  receives the list from
 * the storage */
export function changeSpools(studio: Studio, change: (spools: readonly OwnSpool[]) => readonly OwnSpool[]): void {
  studio.store.set({ spools: undefined });
  loadSpools(studio);
  const spools = change(studio.store.state.spools ?? []);
  studio.remember('spools', spoolsText(spools));
  studio.store.set({ spools });
}
