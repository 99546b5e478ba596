// Keeps the work over reloads, in the browser's own storage. Storage may be denied, full, of another version, or shared with
// another tab: whatever it does, the page goes on.
import { createStore, delMany, getMany, keys, promisifyRequest } from 'idb-keyval';
import { fieldsOf, numberIn, plateFrom, textIn, Unfit } from '../model/check-plate.js';
import type { Plate, SourceFile } from '../model/plate.js';
import type { Problem } from '../model/problem.js';
import { filesOf, plateData } from './plate-data.js';

const version = 1;
const recordKey = 'plate';
const fileKey = (id: string): string => `file/${id}`;
const settleAfter = 500; // [ms] without a change
const patience = 10_000; // [ms]: some browsers never answer

/** What a browser's storage can do. */
export interface Storage {
  /** undefined for what is not there. */
  getMany(keys: string[]): Promise<unknown[]>;
  /** All or nothing. */
  setMany(entries: [string, unknown][]): Promise<void>;
  delMany(keys: string[]): Promise<void>;
  keys(): Promise<string[]>;
}

export interface Autosave {
  /** @returns undefined where nothing, or nothing that can be used, was kept */
  load(): Promise<Plate | undefined>;
  /** Soon, when no other has come. */
  save(plate: Plate): void;
  /** What waits is saved now. */
  flush(): Promise<void>;
  forget(): Promise<void>;
}

/** IndexedDB; opened by the first call, which is where it may be denied. */
function browserStorage(database: string): Storage {
  let opened: ReturnType<typeof createStore> | undefined;
  const store = (): ReturnType<typeof createStore> => (opened ??= createStore(database, 'work'));
  return {
    getMany: async (names) => getMany(names, store()),
    setMany: async (entries) =>
      store()('readwrite', (kept) => {
        for (const [name, value] of entries) kept.put(value, name);
        kept.transaction.commit(); // unasked, it would wait for answers, which a page that is being closed gets none of
        return promisifyRequest(kept.transaction);
      }),
    delMany: async (names) => delMany(names, store()),
    keys: async () => keys<string>(store()),
  };
}

const inTime = <Result>(promise: Promise<Result>): Promise<Result> => {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => {
      reject(new Error('the storage does not answer'));
    }, patience);
  });
  return Promise.race([promise, late]).finally(() => {
    clearTimeout(timer);
  });
};

async function recordedPlate(storage: Storage, record: unknown): Promise<Plate> {
  const fields = fieldsOf(record, '', ['version', 'files', 'plate']);
  numberIn(fields['version'], 'version', version, version);
  const ids = (Array.isArray(fields['files']) ? fields['files'] : []).map((id) => textIn(id, 'files', 1000));
  const blobs = await storage.getMany(ids.map(fileKey));
  const bytes = new Map(ids.map((id, k) => [id, blobs[k]]));
  return plateFrom(fields['plate'], (told, where): SourceFile => {
    const file = fieldsOf(told, where, ['id', 'name']);
    const id = textIn(file['id'], where, 1000);
    const blob = bytes.get(id);
    if (!(blob instanceof Blob)) throw new Unfit(where, told);
    return { id, name: textIn(file['name'], where, 1000), bytes: blob };
  });
}

/** @param written  ids of the files that this page has put there; changed */
async function write(storage: Storage, plate: Plate, written: Set<string>): Promise<void> {
  const files = filesOf(plate);
  const ids = files.map(({ id }) => id);
  const entryOf = ({ id, bytes }: SourceFile): [string, unknown] => [fileKey(id), bytes];
  const record = { version, files: ids, plate: plateData(plate, ({ id, name }) => ({ id, name })) };
  // First of all, at once: a page that is being closed gets no answers any more.
  await storage.setMany([...files.filter(({ id }) => !written.has(id)).map(entryOf), [recordKey, record]]);
  written.clear();
  for (const id of ids) written.add(id);

  const there = await storage.keys();
  const lost = files.filter(({ id }) => !there.includes(fileKey(id))); // another tab has thrown them away
  if (lost.length > 0) await storage.setMany(lost.map(entryOf));
  const unused = there.filter((key) => key !== recordKey && !ids.some((id) => key === fileKey(id)));
  if (unused.length > 0) await storage.delMany(unused);
}

/** @param onProblem  is told once that work cannot be kept
 * @param host  a page that shows the studio, and the name that it gave the work: none sees another's; empty: the studio's own */
export function createAutosave(
  { onProblem, host = '' }: { onProblem: (problem: Problem) => void; host?: string },
  storage: Storage = browserStorage(host === '' ? 'sillon-studio' : `sillon-studio ${host}`),
): Autosave {
  let waiting: Plate | undefined;
  let saved: Plate | undefined;
  const written = new Set<string>();
  let timer: ReturnType<typeof setTimeout> | undefined;
  let told = false;
  let last = Promise.resolve(); // one after the other, so that the newest is what stays

  const attempt = (action: () => Promise<void>): Promise<void> => {
    last = last.then(async () => {
      try {
        await inTime(action());
      } catch (error) {
        if (told) return;
        told = true;
        onProblem({ code: 'StorageFull', values: {}, detail: error instanceof Error ? error.message : String(error) });
      }
    });
    return last;
  };

  const flush = (): Promise<void> => {
    clearTimeout(timer);
    const plate = waiting;
    waiting = undefined;
    if (plate === undefined || plate === saved) return last;
    return attempt(async () => {
      await write(storage, plate, written);
      saved = plate;
    });
  };

  return {
    async load() {
      let record: unknown;
      try {
        [record] = await inTime(storage.getMany([recordKey]));
        if (record === undefined) return undefined;
        saved = await inTime(recordedPlate(storage, record));
        for (const { id } of filesOf(saved)) written.add(id);
        return saved;
      } catch (error) {
        // A broken record would be found broken for ever; of a storage that does not answer, `save` will tell.
        if (error instanceof Unfit) await inTime(storage.delMany([recordKey])).catch(() => undefined);
        return undefined;
      }
    },
    save(plate) {
      waiting = plate;
      clearTimeout(timer);
      timer = setTimeout(() => void flush(), settleAfter);
    },
    flush,
    forget() {
      clearTimeout(timer);
      waiting = undefined;
      saved = undefined;
      written.clear();
      return attempt(async () => {
        await storage.delMany(await storage.keys());
      });
    },
  };
}
