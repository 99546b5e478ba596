// The visitor's own spools, in this browser's storage: the text of a file of spools.
import type { OwnSpool } from '../model/plate.js';
import { readSpools, spoolsText } from './spools.js';
import type { Studio } from '../studio/studio.js';

/** Puts them into the state, where they are not yet. */
export function loadSpools(studio: Studio): void {
  if (studio.store.state.spools !== undefined) return;
  let spools: readonly OwnSpool[] = [];
  try {
    spools = readSpools(studio.recall('spools') ?? spoolsText([]));
  } catch {
    // of a later version: left alone until another one is kept
  }
  studio.store.set({ spools });
}

/** Those of another tab since then are kept, too. @param change  of the list as it is in the storage */
export function changeSpools(studio: Studio, change: (spools: readonly OwnSpool[]) => readonly OwnSpool[]): void {
  studio.store.set({ spools: undefined });
  loadSpools(studio);
  const spools = change(studio.store.state.spools ?? []);
  studio.remember('spools', spoolsText(spools));
  studio.store.set({ spools });
}
