// What the address, or the page around this one, sets: the mode, controls, words and look of the studio, and its printer.
import { spoken } from '../i18n/languages.js';
import { withoutBrought } from '../model/brought.js';
import { guestSettings, type GuestSettings } from '../model/guest.js';
import { StudioError } from '../model/problem.js';
import { withPrinter } from '../model/printers.js';
import type { Studio } from '../studio/studio.js';
import { asked } from './address.js';

/** @param studio  of a plate that has come: its printer is the one that was asked for */
export function usePrinter({ store }: Studio, key = asked.given.printer): void {
  if (key !== undefined) store.change((plate) => withPrinter(withoutBrought(plate), key));
}

/** The section that is open at first; '': none. */
export function firstPanel({ store }: Studio): string {
  if (!matchMedia('(min-width: 721px)').matches) return '';
  const { mode } = store.state;
  return mode === 'edit' ? 'directions' : mode === 'customize' ? 'own' : '';
}

export async function configure(
  studio: Studio,
  { mode, controls, units, theme, language, printer }: Partial<GuestSettings>,
): Promise<void> {
  const { store } = studio;
  store.set({
    ...(mode === undefined ? {} : { mode }),
    ...(controls === undefined ? {} : { controls }),
    ...(units === undefined ? {} : { units }),
    ...(theme === undefined ? {} : { theme }),
  });
  if (mode !== undefined || controls !== undefined) store.set({ panel: firstPanel(studio), tool: 'pan' });
  usePrinter(studio, printer);
  if (language !== undefined) await studio.speak(language);
}

/** @param textOf  what the host says of an attribute @throws StudioError GuestValue */
export async function configureAsHost(studio: Studio, textOf: (attribute: string) => unknown): Promise<void> {
  const { given, wrong } = guestSettings(textOf, spoken);
  const [first] = wrong;
  if (first !== undefined) throw new StudioError('GuestValue', { where: first.where, value: first.value });
  asked.given = { ...asked.given, ...given };
  await configure(studio, given);
}
