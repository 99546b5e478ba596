// A browser's storage, and its tabs.
import type { Storage } from '../../../src/files/autosave.js';
import type { Locks } from '../../../src/files/locks.js';

/** A storage as a Map that counts what is put into it. */
export class Box implements Storage {
  readonly kept = new Map<string, unknown>();
  puts: string[] = [];
  asked = 0;
  failure: Error | undefined;
  /** Acts in order, as databases do, but answers only after this. */
  answers: Promise<unknown> | undefined;

  async #answer<Result>(act: () => Result): Promise<Result> {
    if (this.failure !== undefined) throw this.failure;
    const result = act();
    await this.answers;
    return result;
  }
  getMany(names: string[]): Promise<unknown[]> {
    return this.#answer(() => names.map((name) => structuredClone(this.kept.get(name))));
  }
  setMany(entries: [string, unknown][]): Promise<void> {
    return this.#answer(() => {
      for (const [name, value] of entries) {
        this.puts.push(name);
        this.kept.set(name, structuredClone(value));
      }
    });
  }
  delMany(names: string[]): Promise<void> {
    return this.#answer(() => {
      for (const name of names) this.kept.delete(name);
    });
  }
  keys(): Promise<string[]> {
    ++this.asked; // what is there
    return this.#answer(() => [...this.kept.keys()]);
  }
}

/** A browser with tabs: each is told of what it lost. */
export class Browser {
  readonly #holders = new Map<string, { tab: object; onLost: (id: string) => void }>();

  tab(): Locks {
    const tab = {};
    return {
      take: (id, { steal = false, onLost }) => {
        const holder = this.#holders.get(id);
        if (holder !== undefined && holder.tab !== tab && !steal) return Promise.resolve(false);
        this.#holders.set(id, { tab, onLost });
        if (holder !== undefined && holder.tab !== tab) holder.onLost(id);
        return Promise.resolve(true);
      },
      held: () => Promise.resolve(new Set(this.#holders.keys())),
      mine: (id) => this.#holders.get(id)?.tab === tab,
    };
  }
  close(): void {
    this.#holders.clear();
  }
}
