// Chooses the plate that a page begins with: from its address,
// from an earlier visit, or the one that welcomes a first visit.
import type { PrinterValues } from 'sillon';
import type { Kept } from '../files/autosave.js';
import { t } from '../i18n/text.js';
import { onOwnPrinter, withoutBrought } from '../model/brought.js';
import type { Plate } from '../model/plate.js';
import { problemOf, StudioError } from '../model/problem.js';
import { withPrinter } from '../model/printers.js';
import type { Shimmer } from '../model/view.js';
import type { Studio } from '../studio/studio.js';
import { asked, firstVisit, framed } from './address.js';
import type { Keeper } from './keeping.js';
import type { Opener } from './opening.js';

export const restoreWithin = 1500; // [ms] after which the page begins with what it has; the plate may still come

export const elapsed = (time: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, time));

export interface Arriving {
  studio: Studio;
  keeper: Keeper;
  opener: Opener;
  /** Picture that a first visit sees until there are beads. */
  shimmer: Promise<Shimmer | undefined> | undefined;
}

/** Shows the plate of the page's address, or else the one that was left here; if both exist, the latter is offered. */
export async function arrive(page: Arriving): Promise<void> {
  const { studio, keeper, opener } = page;
  const { store } = studio;
  for (const { where, value } of asked.wrong) studio.fail({ code: 'GuestValue', values: { where, value }, detail: '' });
  if (framed) {
    if (!(await openLink(page))) await openAddress(page);
    return;
  }
  const first = store.state.plate;
  const opening = firstVisit ? opener.first() : undefined; // loads while the storage is read
  opening?.catch(() => undefined);
  const kept = keeper.begin();
  const opened = (await openLink(page, kept)) || (await openAddress(page, kept));
  const restored = await keeper.restore(kept, () => !opened);
  if (!opened && !restored && studio.recall('welcomed') === undefined) {
    greet(page, await (opening ?? opener.first()).catch(() => first), first); // the page works without that plate
  }
}

/** Welcomes a first visit: the light moves over a plate until somebody touches it. @param first  plate shown so far */
function greet({ studio, shimmer }: Arriving, plate: Plate, first: Plate): void {
  const { store } = studio;
  if (store.state.plate !== first) return; // the user has already changed the plate
  store.change(() => plate);
  studio.look();
  store.forgetSteps();
  store.set({ welcome: true, flipping: plate !== first && !studio.calm() });
  void shimmer?.then((drawn) => {
    if (store.state.plate === plate && store.state.result === undefined) store.set({ shimmer: drawn });
  });
}

/** Returns the printer of the work that was left here, which may still be loading, or else of the current plate. */
async function ownPrinter({ store }: Studio, kept: Promise<Kept | undefined> | undefined): Promise<PrinterValues> {
  const found = await Promise.race([kept, elapsed(restoreWithin)]);
  const plate = found !== undefined && 'steps' in found ? found.steps.plate : store.state.plate;
  return (store.state.own?.on(plate) ?? plate).printer;
}

/** Begins the page with the printer and filament that the visitor has named. */
export async function useOwnPrint(studio: Studio): Promise<void> {
  const { store } = studio;
  await studio.recallOwnPrint().catch(() => undefined); // the visitor is asked again
  const { own, plate } = store.state;
  if (own === undefined) return;
  store.change(() => own.begin(plate.printer));
  store.forgetSteps();
}

/** Uses a printer, whatever a plate brings. @param key  key of the printer that the address or a host names */
export function usePrinter({ store }: Studio, key = asked.given.printer): void {
  if (key !== undefined) store.change((plate) => withPrinter(withoutBrought(plate), key));
}

/** Opens the plate that the address names. In a frame, nothing else is shown in its place.
 * @returns false if it cannot be opened */
function openNamed({ studio, keeper }: Arriving, named: () => Promise<void>): Promise<boolean> {
  const open = (): Promise<void> => keeper.untried.during(named);
  return studio.attempt(async () => {
    if (!framed) await open();
    else await (await import('../embed/frame.js')).showNamed(studio, open);
  });
}

/** Opens the files that the address names, on this page's own site. */
async function openAddress(page: Arriving, kept?: Promise<Kept | undefined>): Promise<boolean> {
  if (asked.files.length === 0) return false;
  return openNamed(page, async () => {
    const { fetchFiles } = await import('../embed/fetching.js');
    const files = await fetchFiles(asked.files, document.baseURI).catch((error: unknown) => {
      throw new StudioError('GuestFile', {}, problemOf(error).detail);
    });
    const printer = await ownPrinter(page.studio, kept);
    page.studio.store.change((plate) => ({ ...plate, printer }));
    await page.opener.load(files.map(({ name, bytes, role }) => ({ file: new File([bytes], name), role })));
    usePrinter(page.studio);
  });
}

/** Opens the plate in the address's hash: of a link, the gallery, or another app. @returns false if there is none */
export async function openLink(page: Arriving, kept?: Promise<Kept | undefined>): Promise<boolean> {
  const { hash } = location;
  // Only projects of the site's own gallery are allowed.
  const project = /^#open=(gallery\/\w+\.zip)$/.exec(hash)?.[1];
  if (project === undefined && hash !== '#shared' && !hash.startsWith('#plate=')) return false;
  // A reload must bring back the work that followed, not the link.
  history.replaceState(null, '', location.pathname + location.search);
  const { studio, keeper, opener } = page;
  return openNamed(page, async () => {
    if (project !== undefined) {
      await opener.openOwn(project);
      return;
    }
    if (hash === '#shared') {
      const { sharedFiles } = await import('../files/handed.js');
      await studio.open(await sharedFiles());
      return;
    }
    const linked = await (await import('../plates/links.js')).plateOfLink(hash, () => studio.services.engine());
    if (linked === undefined) return;
    keeper.show(onOwnPrinter(linked.plate, await ownPrinter(studio, kept)));
    studio.notify(`${t('link.opened')} ${linked.told}`.trim());
  });
}
