// Which tab has which plate: never two the same.

export interface Locks {
  /** @param wait  for a moment, while the page that is being reloaded lets go
   * @param steal  from another tab, which hears of it by `onLost`
   * @returns whether this tab has it now, until it is closed */
  take(id: string, how: { wait?: boolean; steal?: boolean; onLost: (id: string) => void }): Promise<boolean>;
  /** By any tab. */
  held(): Promise<ReadonlySet<string>>;
  /** By this tab. */
  mine(id: string): boolean;
}

/** What tabs tell each other where there are no locks. `since` is when the tab took the plate [ms since 1970]. */
type Word =
  | { kind: 'who'; tab: string }
  | { kind: 'ask' | 'steal'; tab: string; id: string }
  | { kind: 'have'; tab: string; id: string; since: number };

/** What of a BroadcastChannel it takes. */
export interface Channel {
  onmessage: ((event: { data: Word }) => void) | null;
  postMessage(word: Word): void;
}

const answersWithin = 500; // [ms], also from a tab that is busy

/** Tabs ask each other. A tab that answers too late has the plate nevertheless: of two, the one that took it first keeps it, and
 * the other goes on with a copy.
 * @param open  a channel that all tabs hear, and not the one that speaks
 * @param now  [ms since 1970] @param patience  for answers [ms] */
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
  channel.onmessage = ({ data }) => {
    hear(data);
  };
  const later = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, patience));
  return {
    async take(id, { steal = false, onLost }) {
      if (mine.has(id)) return true;
      if (!steal) {
        const had = new Promise<boolean>((resolve) => {
          waiting.set(id, () => {
            resolve(true);
          });
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

const reloadsWithin = 1000; // [ms]

/** @param space  of names, shared by the tabs of an origin */
export function webLocks(space: string): Locks {
  const mine = new Set<string>();
  const { locks } = (globalThis as { navigator?: { locks?: LockManager } }).navigator ?? {};
  const nameOf = (id: string): string => `${space} plate ${id}`;
  // Browsers lend no locks to pages without TLS.
  if (locks === undefined) return askedLocks(space);
  return {
    take(id, { wait = false, steal = false, onLost }) {
      if (mine.has(id)) return Promise.resolve(true);
      return new Promise((resolve) => {
        const has = (lock: Lock | null): Promise<void> | undefined => {
          resolve(lock !== null);
          if (lock === null) return undefined;
          mine.add(id);
          return new Promise(() => undefined); // until the tab is closed
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
