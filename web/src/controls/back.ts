// Back closes what is open over the page, as on phones it closes sheets, instead of leaving the page: each open thing has an
// entry of the history while it is open.

/** The ways to close what is open, the topmost last. */
const open: (() => void)[] = [];
/** Entries are being left: what comes of it is told by the browser later, and none can be added before. */
let leaving = false;
let following = false;

/** The entries that lead to this one and stand for open things. An address that is opened meanwhile begins anew. */
function entries(): number {
  const state: unknown = history.state;
  return typeof state === 'object' && state !== null && 'open' in state ? Number(state.open) : 0;
}

function follow(): void {
  following = false;
  if (leaving) return;
  const before = entries();
  leaving = open.length < before;
  if (leaving) history.go(open.length - before);
  for (let entry = before + 1; entry <= open.length; ++entry) history.pushState({ open: entry }, '');
}

/** One thing may open in the place of another within a turn, and nothing is left then. */
function followSoon(): void {
  if (following) return;
  following = true;
  setTimeout(follow);
}

addEventListener('popstate', () => {
  // An entry of our own is left: what was opened meanwhile, in the place of what it stood for, stays.
  const ours = leaving;
  leaving = false;
  while (!ours && open.length > entries()) open.pop()?.();
  followSoon(); // Forward, to what is open no more, leads back
});

/** Something is open now, and Back closes it. In a frame the history is another page's.
 * @returns what is to be called when it is closed, however that came */
export function closesByBack(close: () => void): () => void {
  if (parent !== window) return () => undefined;
  const own = (): void => {
    close();
  };
  open.push(own);
  followSoon();
  return () => {
    const at = open.indexOf(own);
    if (at < 0) return;
    open.splice(at, 1);
    followSoon();
  };
}
