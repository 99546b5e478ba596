// English as a dictionary like the other languages' files. Words that no first view shows are loaded later, with the
// parts that show them (en/).
import { words as hints } from './en/core/hints.js';
import { words as settings } from './en/core/settings.js';
import { words as page } from './en/page.js';

/** Told by <sillon-studio> in another page where the browser blocks the studio itself. */
export const frame = { blocked: 'The studio cannot be shown here.', open: 'Open it in a tab of its own' };

export const en = { ...page, ...settings, ...hints };
