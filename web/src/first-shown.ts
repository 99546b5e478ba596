// A plate that stops the page before it is shown must not be restored by itself at the next visit: a mark is set before it is
// restored, and taken away once it is shown.
import type { Store } from './model/store.js';
import type { State } from './model/state.js';
import { forget, recallText, remember } from './remember.js';

const shownAfter = 1000; // [ms] from its path, in which it is drawn
const longest = 60_000; // [ms]; some plates cannot be made

const markOf = (id: string): string => `opening ${id}`;

/** Whether the plate of a record was restored once and never shown, nor left in good order. */
export const wasNeverShown = (id: string): boolean => recallText(markOf(id)) !== undefined;

/** Marks a record's plate until it is shown, told of as a problem, or left in good order. */
export function markUntilShown(id: string, store: Pick<Store<State>, 'state' | 'subscribe'>): void {
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
