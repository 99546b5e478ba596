// A note for people who take a file to a printer, once on a device.
import { recallText, remember } from '../files/remember.js';
import { words } from '../i18n/en/export.js';
import { say, t } from '../i18n/text.js';
import type { Studio } from './studio.js';

const told = 'untried';

/** Says that nothing was tried on a printer yet, and offers the print that helps most. */
export function tellUntried(studio: Studio): void {
  if (recallText(told) !== undefined) return;
  remember(told, 'yes');
  studio.notify(say(words, 'export.untried'), {
    label: t('verb.first'),
    run: () => {
      studio.show('first');
    },
  });
}
