// Makes the Back button close whatever is open over the page, as sheets on phones do, instead of leaving the page: each
// open part has a history entry while it is open.

/** Functions that close the open parts, the topmost last. */
const open: (() => void)[] = [];
/** The history is on its way to another entry: the browser reports it later, and no entry can be added before. */
let leaving = false;
let following = false;

/** Returns the number of history entries that stand for open parts; an address that is opened in between starts
 * again at 0. */
function entries(): number {
  const state: unknown = history.state;
  return typeof state === 'object' && state !== null && 'open' in state ? Number(state.open) : 0;
}

/** Brings the history in line with the open parts. */
function follow(): void {
  following = false;
  if (leaving) return;
  const before = entries();
  leaving = open.length < before;
  if (leaving) history.go(open.length - before);
  for (let entry = before + 1; entry <= open.length; ++entry) history.pushState({ open: entry }, '');
}

/** Updates the history after the current turn: if one part
 * opens in place of another within it, no entry is left over. */
function followSoon(): void {
  if (following) return;
  following = true;
  setTimeout(follow);
}

addEventListener('popstate', () => {
  // If this module went back itself, parts that were opened in the meantime stay open.
  const ours = leaving;
  leaving = false;
  while (!ours && open.length > entries()) open.pop()?.();
  followSoon(); // Forward leads to an entry of a closed part, so the history goes back again
});

/** Registers an open part, which Back closes from now on. In a
 * frame the history belongs to another page, so nothing is done.
 * @returns function to call when the part is closed, in whatever way */
export function closesByBack(close: () => void): () => void {
  if (parent !== window) return () => undefined;
  const own = (): void => close();
  open.push(own);
  followSoon();
  return () => {
    const at = open.indexOf(own);
    if (at < 0) return;
    open.splice(at, 1);
    followSoon();
  };
}
