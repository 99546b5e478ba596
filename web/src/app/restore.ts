// Work of an earlier visit becomes the page's own again. A plate that stops the page before it is shown must not be restored by
// itself at the next visit: a mark is set before it is restored, and taken away once it is shown. Fetched when there is work.
import type { Kept, Opened } from '../files/autosave.js';
import { words } from '../i18n/en/plates.js';
import { say, t } from '../i18n/text.js';
import type { Plate } from '../model/plate.js';
import type { NoticeAction } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import { forget, recallText, remember } from '../files/remember.js';

const shownAfter = 1000; // [ms] from its path, in which it is drawn
const longest = 60_000; // [ms]; some plates cannot be made

const markOf = (id: string): string => `opening ${id}`;

/** Whether the plate of a record was restored once and never shown, nor left in good order. */
const wasNeverShown = (id: string): boolean => recallText(markOf(id)) !== undefined;

/** Marks a record's plate until it is shown, told of as a problem, or left in good order. */
function markUntilShown(id: string, { store }: Studio): void {
  const mark = markOf(id);
  const before = store.state;
  remember(mark, 'yes');
  let timer = setTimeout(end, longest);
  const unsubscribe = store.subscribe(({ result, problem }) => {
    const answered = result !== undefined && result !== before.result;
    if (!answered && (problem === undefined || problem === before.problem)) return;
    unsubscribe();
    clearTimeout(timer);
    timer = setTimeout(end, shownAfter);
  });
  const leaving = (): void => {
    if (document.visibilityState === 'hidden') end();
  };
  // A page that stands still hears of neither.
  addEventListener('pagehide', end);
  document.addEventListener('visibilitychange', leaving);

  function end(): void {
    forget(mark);
    unsubscribe();
    clearTimeout(timer);
    removeEventListener('pagehide', end);
    document.removeEventListener('visibilitychange', leaving);
  }
}

/** With the steps that led to it: undone, a plate must not become the one that was shown before.
 * @param begin  goes on in its record */
export function showKept(studio: Studio, { id, steps, print }: Opened, begin: (plate: Plate) => void): void {
  begin(steps.plate);
  markUntilShown(id, studio);
  studio.store.restore(steps);
  studio.look();
  if (print !== undefined)
    void studio.attempt(async () => {
      (await import('../rebrush/kept.js')).takeUp(studio, print);
    });
}

const listPlates = (studio: Studio): NoticeAction => ({
  label: t('verb.plates'),
  run: () => {
    studio.show('plates');
  },
});

/** @param shows  whether it is still wanted; what comes too late is offered instead @param begin  goes on in its record
 * @returns whether the plate that was found is shown, or is open in another tab */
export function restore(studio: Studio, found: Kept, shows: boolean, begin: (plate: Plate) => void): boolean {
  const plates = studio.framed ? [] : [listPlates(studio)];
  if (found.state === 'elsewhere') {
    if (shows) studio.notify(say(words, 'plates.left'), listPlates(studio));
    return shows;
  }
  if (found.state === 'foreign') {
    if (shows) studio.notify(say(words, 'plates.foreignLeft'), ...plates);
    return false;
  }
  const open = (label: string): NoticeAction => ({
    label,
    run: () => {
      showKept(studio, found, begin);
    },
  });
  if (!shows) {
    studio.notify(say(words, 'restore.late'), open(say(words, 'restore.show')));
    return false;
  }
  // The last visit ended before its plate was shown: the plate may have stopped the page, and would again.
  if (found.state === 'own' && wasNeverShown(found.id)) {
    studio.tell({
      text: say(words, 'plates.unshown'),
      actions: [open(say(words, 'plates.openAnyway')), ...plates],
      stays: true,
    });
    return false;
  }
  showKept(studio, found, begin);
  if (found.state === 'copy') {
    studio.notify(say(words, 'plates.copied'));
    return true;
  }
  studio.notify(say(words, 'restore.done'), {
    label: say(words, 'restore.discard'),
    run: () => {
      studio.services.newPlate();
    },
  });
  return true;
}
