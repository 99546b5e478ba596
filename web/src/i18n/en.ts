// English, as the other languages' files; what no first view shows is loaded with what shows it (en/).
import { words as hints } from './en/core/hints.js';
import { words as settings } from './en/core/settings.js';
import { words as page } from './en/page.js';

/** Said by <sillon-studio> in another page, where the browser blocks the studio itself. */
export const frame = { blocked: 'The studio cannot be shown here.', open: 'Open it in a tab of its own' };

export const en = { ...page, ...settings, ...hints };
