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
  /** @returns undefined where nothing, or nothing that can be used, was kept; some storages never answer. Until it has
   * answered, nothing is written over what was kept. */
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

const entryOf = ({ id, bytes }: SourceFile): [string, unknown] => [fileKey(id), bytes];

/** @param known  whether a file is in the storage */
async function write(storage: Storage, plate: Plate, known: (id: string) => boolean): Promise<void> {
  const files = filesOf(plate);
  const record = {
    version,
    files: files.map(({ id }) => id),
    plate: plateData(plate, ({ id, name }) => ({ id, name })),
  };
  await storage.setMany([...files.filter(({ id }) => !known(id)).map(entryOf), [recordKey, record]]);
}

/** Exactly the files of the plate are to be there. @param stands  whether the plate is the last that was written */
async function tidy(storage: Storage, plate: Plate, stands: () => boolean): Promise<void> {
  const files = filesOf(plate);
  const there = await storage.keys();
  const lost = files.filter(({ id }) => !there.includes(fileKey(id))); // another tab has thrown them away
  if (lost.length > 0 && stands()) await storage.setMany(lost.map(entryOf));
  const unused = there.filter((key) => key !== recordKey && !files.some(({ id }) => key === fileKey(id)));
  if (unused.length > 0 && stands()) await storage.delMany(unused);
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
  let turn = 0; // of the last that was written or forgotten
  /** Nothing is written before what was kept has been read, nor while it is being forgotten. */
  let open: Promise<unknown> = Promise.resolve();
  let last = Promise.resolve();

  const wrote = (plate: Plate): void => {
    saved = plate;
    written.clear();
    for (const { id } of filesOf(plate)) written.add(id);
  };

  const attempt = (action: Promise<void>): Promise<void> => {
    const done = inTime(action).catch((error: unknown) => {
      if (told) return;
      told = true;
      onProblem({ code: 'StorageFull', values: {}, detail: error instanceof Error ? error.message : String(error) });
    });
    last = last.then(() => done);
    return last;
  };

  const flush = (): Promise<void> => {
    clearTimeout(timer);
    const plate = waiting;
    waiting = undefined;
    if (plate === undefined || plate === saved) return last;
    const mine = ++turn;
    const stands = (): boolean => mine === turn;
    return attempt(
      // At once, also while an earlier plate is being written: the storage does one after the other, and a page that is
      // being closed hears no answers any more.
      open.then(async () => {
        await write(storage, plate, (id) => written.has(id));
        wrote(plate);
        if (stands()) await tidy(storage, plate, stands);
      }),
    );
  };

  const read = async (): Promise<Plate | undefined> => {
    try {
      const [record] = await storage.getMany([recordKey]);
      if (record === undefined) return undefined;
      const plate = await recordedPlate(storage, record);
      wrote(plate);
      return plate;
    } catch (error) {
      // A broken record would be found broken for ever; of a storage that denies itself, `save` will tell.
      if (error instanceof Unfit) await storage.delMany([recordKey]).catch(() => undefined);
      return undefined;
    }
  };

  return {
    load() {
      const kept = read();
      open = kept;
      return kept;
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
      ++turn;
      const gone = open.then(async () => {
        saved = undefined;
        written.clear();
        await storage.delMany(await storage.keys());
      });
      open = gone.catch(() => undefined);
      return attempt(gone);
    },
  };
}
