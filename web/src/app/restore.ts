// Restores work of an earlier visit. A plate that crashes or freezes the page before it is shown must not be restored
// again by itself: a mark is set before the plate is restored, and removed once it is shown. The module is loaded only
// if there is such work.
import type { Kept, Opened } from '../files/autosave.js';
import { words } from '../i18n/en/plates.js';
import { say, t } from '../i18n/text.js';
import type { Plate } from '../model/plate.js';
import type { NoticeAction } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import { forget, recallText, remember } from '../files/remember.js';

const shownAfter = 1000; // [ms] after its path is there, in which a plate is drawn
const longest = 60_000; // [ms] for a plate that never gets a path

const markOf = (id: string): string => `opening ${id}`;

/** Tells whether the plate of a record was restored once, but neither shown nor left in good order. */
const wasNeverShown = (id: string): boolean => recallText(markOf(id)) !== undefined;

/** Marks a record's plate until it is shown, reported as a problem, or left in good order. */
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
  // A page that hangs receives neither event.
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

/** Shows a kept plate with its undo steps, so that undo does not lead to the plate that was shown before.
 * @param begin  continues its record */
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
  run: studio.opens('plates'),
});

/** Restores work of an earlier visit, or offers it.
 * @param shows  it is still wanted; otherwise it is offered
 * @param begin  continues its record
 * @returns true if the plate is shown, or is open in another tab */
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
    run: () => showKept(studio, found, begin),
  });
  if (!shows) {
    studio.notify(say(words, 'restore.late'), open(say(words, 'restore.show')));
    return false;
  }
  // The last visit ended before its plate was shown: the plate may have crashed or frozen the page, and would again.
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
    run: () => studio.services.newPlate(),
  });
  return true;
}
