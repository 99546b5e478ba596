// Locks that keep two tabs from having the same plate.

export interface Locks {
  /** Takes a plate's lock.
   * @param wait  waits a moment while the previous page of a reload releases it
   * @param steal  takes it from another tab, whose `onLost` is then called
   * @returns true where this tab holds the lock, which it does until it is closed */
  take(id: string, how: { wait?: boolean; steal?: boolean; onLost: (id: string) => void }): Promise<boolean>;
  /** Plates that any tab holds. */
  held(): Promise<ReadonlySet<string>>;
  /** Tells whether this tab holds the plate. */
  mine(id: string): boolean;
}

/** A message between tabs where the browser has no locks. `since` is when the tab took the plate [ms since 1970]. */
type Word =
  | { kind: 'who'; tab: string }
  | { kind: 'ask' | 'steal'; tab: string; id: string }
  | { kind: 'have'; tab: string; id: string; since: number };

/** The part of a BroadcastChannel that is used here. */
export interface Channel {
  onmessage: ((event: { data: Word }) => void) | null;
  postMessage(word: Word): void;
}

const answersWithin = 500; // [ms], enough for a busy tab to answer

/** Locks by messages between tabs. A tab that answers too late still has its plate: of two tabs with the same one, the
 * first to take it keeps it, and the other goes on with a copy.
 * @param space  prefix of the channel's name, shared by the tabs of an origin
 * @param open  opens a channel that all tabs hear except the one that speaks
 * @param now  [ms since 1970]
 * @param patience  time to wait for answers [ms] */
export function askedLocks(
  space: string,
  open: (name: string) => Channel = (name) => new BroadcastChannel(name) as Channel,
  now: () => number = Date.now,
  patience = answersWithin,
): Locks {
  const tab = crypto.getRandomValues(new Uint32Array(2)).join('-');
  const mine = new Map<string, { since: number; onLost: (id: string) => void }>();
  const waiting = new Map<string, () => void>();
  const others = new Set<string>();
  const channel = open(`${space} plates`);
  const tell = (id: string): void => {
    const held = mine.get(id);
    if (held !== undefined) channel.postMessage({ kind: 'have', tab, id, since: held.since });
  };
  const lose = (id: string): void => {
    const held = mine.get(id);
    mine.delete(id);
    held?.onLost(id);
  };
  const hear = (word: Word): void => {
    if (word.kind === 'who') {
      for (const id of mine.keys()) tell(id);
      return;
    }
    const { kind, id } = word;
    if (kind === 'steal') lose(id);
    if (kind === 'ask') tell(id);
    if (kind !== 'have') return;
    others.add(id);
    waiting.get(id)?.();
    const held = mine.get(id);
    if (held === undefined) return;
    const first = word.since < held.since || (word.since === held.since && word.tab < tab);
    if (first) lose(id);
    else tell(id);
  };
  channel.onmessage = ({ data }) => hear(data);
  const later = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, patience));
  return {
    async take(id, { steal = false, onLost }) {
      if (mine.has(id)) return true;
      if (!steal) {
        const had = new Promise<boolean>((resolve) => {
          waiting.set(id, () => resolve(true));
        });
        channel.postMessage({ kind: 'ask', tab, id });
        const other = await Promise.race([had, later().then(() => false)]);
        waiting.delete(id);
        if (other) return false;
      } else {
        channel.postMessage({ kind: 'steal', tab, id });
      }
      mine.set(id, { since: now(), onLost });
      tell(id);
      return true;
    },
    async held() {
      others.clear();
      channel.postMessage({ kind: 'who', tab });
      await later();
      return new Set([...others, ...mine.keys()]);
    },
    mine: (id) => mine.has(id),
  };
}

const reloadsWithin = 1000; // [ms] within which a reloading page releases its lock

/** Locks of the browser, or `askedLocks` where it has none. @param space  prefix of names, shared by the tabs of an
 * origin */
export function webLocks(space: string): Locks {
  const mine = new Set<string>();
  const { locks } = (globalThis as { navigator?: { locks?: LockManager } }).navigator ?? {};
  const nameOf = (id: string): string => `${space} plate ${id}`;
  // Browsers provide no locks to pages without TLS.
  if (locks === undefined) return askedLocks(space);
  return {
    take(id, { wait = false, steal = false, onLost }) {
      if (mine.has(id)) return Promise.resolve(true);
      return new Promise((resolve) => {
        const has = (lock: Lock | null): Promise<void> | undefined => {
          resolve(lock !== null);
          if (lock === null) return undefined;
          mine.add(id);
          return new Promise(() => undefined); // held until the tab is closed
        };
        const how: LockOptions = steal
          ? { steal: true }
          : wait
            ? { signal: AbortSignal.timeout(reloadsWithin) }
            : { ifAvailable: true };
        locks.request(nameOf(id), how, has).catch(() => {
          if (mine.delete(id)) onLost(id); // another tab has stolen it
          resolve(false);
        });
      });
    },
    async held() {
      const { held = [] } = await locks.query();
      const start = nameOf('');
      return new Set(held.flatMap(({ name = '' }) => (name.startsWith(start) ? [name.slice(start.length)] : [])));
    },
    mine: (id) => mine.has(id),
  };
}
