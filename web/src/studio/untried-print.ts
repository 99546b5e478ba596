// Notes for people who take a file to a printer: once per device,
// that no file was tried yet; each time, the place of the lamp.
import { words } from '../i18n/en/export.js';
import { machineName } from '../i18n/say.js';
import { say, t } from '../i18n/text.js';
import type { Plate } from '../model/plate.js';
import type { Studio } from './studio.js';

const told = 'untried';

/** Returns a sentence that nothing was tried on the plate's printer, and what to print first. */
export function untriedText({ printer }: Plate): string {
  const name = machineName(printer);
  return name === '' ? say(words, 'export.untried') : say(words, 'export.untriedOn', { printer: name });
}

/** Remembers that the note was on the screen. */
export const markUntried = (studio: Studio): void => studio.remember(told, 'yes');

/** Tells where to put the lamp for a downloaded file and, once per device, that nothing was tried on the printer. */
export function tellPrint(studio: Studio, name: string): void {
  studio.notify(t('export.done', { name }), {
    label: say(words, 'card.title'),
    run: studio.opens('card'),
  });
  if (studio.recall(told) !== undefined) return;
  markUntried(studio);
  studio.notify(untriedText(studio.store.state.plate), {
    label: t('verb.first'),
    run: studio.opens('first'),
  });
}
