// Keeps work on a sliced print that was left, and resumes it at once or at another visit.
import type { KeptPrint } from '../files/autosave.js';
import { r } from '../i18n/rebrush.js';
import { wishFrom, type Wish } from '../model/rebrush.js';
import type { Studio } from '../studio/studio.js';

/** Choices of prints whose work was left. */
export const left = new WeakMap<File, Wish>();

/** Offers to resume the work on a print. */
export function offer(studio: Studio, file: File): void {
  const goOn = {
    label: r('goOn'),
    run: () => studio.store.set({ sliced: file, dialog: 'rebrush' }),
  };
  studio.tell({ text: r('kept', { name: file.name }), actions: [goOn], stays: true });
}

/** Resumes the print of an earlier visit: at once if its view was open, otherwise by an offer. */
export function takeUp(studio: Studio, { file, wish, open }: KeptPrint): void {
  const wanted = wishFrom(wish);
  if (wanted !== undefined) left.set(file, wanted);
  if (!open) {
    offer(studio, file);
    return;
  }
  studio.store.set({ sliced: file, dialog: 'rebrush' });
  studio.notify(r('resumed', { name: file.name }));
}
