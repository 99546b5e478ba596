// Keeps plates over reloads in the browser's own storage. Each has a record of its own, together with the sliced print
// that is re-brushed over it, and only one tab writes it. Storage may be denied, full, written by another version, or
// shared with other tabs; whatever it does, the page goes on and nothing is overwritten.
import { createStore, getMany, keys, promisifyRequest } from 'idb-keyval';
import { fieldsOf, numberIn, textIn, Unfit, type Fields } from '../model/check.js';
import { isFontFile } from '../model/layer-list.js';
import { pageOf, type Plate, type SourceFile } from '../model/plate.js';
import { isOfFile, type Problem } from '../model/problem.js';
import type { Steps } from '../model/store.js';
import { webLocks, type Locks } from './locks.js';
import { filesOf, nothing, plateOf, projectData, type ProjectEngine } from './plate-project.js';

/** Version of the records. Version 1 kept plates in another form, which only the studio could read. */
const version = 2;
const settleAfter = 500; // [ms] without a change before work is saved; smaller: more writes; larger: more is lost when the browser crashes
const patience = 10_000; // [ms] to wait for the storage, since some browsers never answer
/** Limits of the history that is kept in either direction: steps, points in their strokes, and bytes of files that
 * only they use. */
const most = { steps: 60, points: 200_000, bytes: 32e6 };

const recordKey = (id: string): string => `plate/${id}`;
const aboutKey = (id: string): string => `about/${id}`;
const filesKey = (id: string): string => `file/${id}/`;
/** Key of the choices for a sliced print over a plate. The print's file, large and never changed, has a key of its
 * own (`printKey`). */
const slicedKey = (id: string): string => `sliced/${id}`;
const printKey = (id: string): string => `sliced/${id}/file`;
const idOfKey = (key: string): string | undefined => /^(?:about|plate)\/(.+)$/.exec(key)?.[1];

/** The calls of a browser's storage that the studio uses. */
export interface Storage {
  /** Reads values; undefined for keys that are not there. */
  getMany(keys: string[]): Promise<unknown[]>;
  /** Writes all entries or, where that fails, none. */
  setMany(entries: [string, unknown][]): Promise<void>;
  delMany(keys: string[]): Promise<void>;
  keys(): Promise<string[]>;
}

/** Memory that a tab keeps over a reload and shares with no other tab. */
export interface Session {
  get(): string | undefined;
  set(id: string): void;
}

/** A kept plate, as a list shows it. */
export interface Listed {
  id: string;
  name: string;
  /** Width of the page [mm]. */
  width: number;
  height: number;
  /** Time of the last change [ms since 1970]. */
  changed: number;
  picture: Blob | undefined;
  /** True where this tab shows the plate; `elsewhere` is true where another tab has it. */
  here: boolean;
  elsewhere: boolean;
  /** True for a record of another version, or a damaged one: it cannot be opened, only downloaded and deleted. */
  foreign: boolean;
}

/** A sliced print that is re-brushed over a plate. */
export interface KeptPrint {
  file: File;
  /** Choices for the print, unchecked because an older version may have written them. */
  wish: unknown;
  /** True where the print's view was still open. */
  open: boolean;
}

/** A kept plate to go on with. In state 'copy' another tab has the plate, and this one works on a copy. */
export interface Opened {
  state: 'own' | 'copy';
  /** Id of the record in which the work goes on. */
  id: string;
  steps: Steps;
  print?: KeptPrint | undefined;
}

/** The plate that this tab had before; 'elsewhere': another tab has it open; 'foreign': another version wrote it. */
export type Kept = Opened | { state: 'elsewhere' } | { state: 'foreign' };

/** All values kept for a plate, whichever version wrote them. */
export interface Stored {
  record: unknown;
  about: unknown;
  /** Contents of the files, by their ids. */
  files: ReadonlyMap<string, unknown>;
}

/** Storage in IndexedDB. The first call opens it, so that is where access may be denied. */
function browserStorage(database: string): Storage {
  let opened: ReturnType<typeof createStore> | undefined;
  const store = (): ReturnType<typeof createStore> => (opened ??= createStore(database, 'work'));
  return {
    getMany: async (names) => getMany(names, store()),
    setMany: async (entries) =>
      store()('readwrite', (kept) => {
        for (const [name, value] of entries) kept.put(value, name);
        kept.transaction.commit(); // commits at once; otherwise it would wait for answers, which a closing page never gets
        return promisifyRequest(kept.transaction);
      }),
    delMany: async (names) =>
      store()('readwrite', (kept) => {
        for (const name of names) kept.delete(name);
        kept.transaction.commit();
        return promisifyRequest(kept.transaction);
      }),
    keys: async () => keys<string>(store()),
  };
}

/** Session in the tab's own storage. Where that is denied, a reload shows the plate that was changed last. */
function tabSession(name: string): Session {
  const key = `${name} plate`;
  return {
    get() {
      try {
        return sessionStorage.getItem(key) ?? undefined;
      } catch {
        return undefined;
      }
    },
    set(id) {
      try {
        sessionStorage.setItem(key, id);
      } catch {
        // denied or full
      }
    },
  };
}

/** Rejects a promise of the storage that is not settled in time. */
const inTime = <Result>(promise: Promise<Result>): Promise<Result> => {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error('the storage does not answer')), patience);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
};

const newId = (): string =>
  Array.from(crypto.getRandomValues(new Uint32Array(3)), (word) => word.toString(36)).join('');

// --- Records -----------------------------------------------------------------------------------------------------------

/** The data that the list shows for a plate. */
interface About {
  name: string;
  width: number;
  height: number;
  changed: number;
  /** True while nobody has changed the plate. */
  fresh: boolean;
  picture?: Blob;
}

/** Reads the data for the list. @returns undefined where any field is missing */
function aboutFrom(value: unknown): About | undefined {
  const given = value as Partial<About> | null | undefined;
  if (
    typeof given !== 'object' ||
    given === null ||
    typeof given.name !== 'string' ||
    typeof given.changed !== 'number'
  )
    return undefined;
  const { name, width, height, changed, fresh, picture } = given;
  if (typeof width !== 'number' || typeof height !== 'number') return undefined;
  const about = { name, width, height, changed, fresh: fresh === true };
  return picture instanceof Blob ? { ...about, picture } : about;
}

/** The data for the list, as far as they can be read from a record of another version. */
function aboutLike(value: unknown): About {
  const { name, width, height, changed } = (typeof value === 'object' ? (value ?? {}) : {}) as Record<string, unknown>;
  const number = (given: unknown): number => (typeof given === 'number' && Number.isFinite(given) ? given : 0);
  return {
    name: typeof name === 'string' ? name.slice(0, 200) : '',
    width: number(width),
    height: number(height),
    changed: number(changed),
    fresh: false,
  };
}

const pointsOf = ({ layers }: Plate): number =>
  layers.reduce((sum, { strokes }) => strokes.reduce((all, { points }) => all + points.length / 2, sum), 0);

/** The steps next to the plate, within the limits of `most`. @param plates  all steps in one direction, the nearest
 * first */
function nearest(plate: Plate, plates: readonly Plate[], isOf: (plate: Plate) => boolean): Plate[] {
  const files = new Set(filesOf(plate).map(({ id }) => id));
  const kept: Plate[] = [];
  let [points, bytes] = [0, 0];
  for (const one of plates) {
    points += pointsOf(one);
    for (const { id, bytes: blob } of filesOf(one)) {
      if (!files.has(id)) bytes += blob.size;
      files.add(id);
    }
    if (!isOf(one) || kept.length >= most.steps || points > most.points || bytes > most.bytes) break;
    kept.push(one);
  }
  return kept;
}

const allFiles = ({ past, plate, future }: Steps): SourceFile[] => [
  ...new Map([...past, plate, ...future].flatMap(filesOf).map((file) => [file.id, file])).values(),
];

/** Path of a file in a record. Fonts get an ending, because the core recognises them by it. */
const pathOf = ({ id, name }: SourceFile): string => (isFontFile(name) ? `${id}.ttf` : id);

/** A plate as it is kept: a project, and the printer that a design has brought. */
const told = (plate: Plate): unknown => ({
  project: projectData(plate, pathOf, true),
  ...(plate.brought !== undefined && { brought: plate.brought }),
});

/** A copy of a record with another name for its plate. */
function renamed(record: object, name: string): object {
  const { plate } = record as { plate?: { project?: { studio?: object } } };
  const studio = { ...plate?.project?.studio, name };
  return { ...record, plate: { ...plate, project: { ...plate?.project, studio } } };
}

/** Compares the histories, too: undoing a change at once leaves the same plate but one more step to redo. */
const areSame = (a: Steps, b: Steps | undefined): boolean =>
  b !== undefined && a.plate === b.plate && areEqual(a.past, b.past) && areEqual(a.future, b.future);
const areEqual = (a: readonly Plate[], b: readonly Plate[]): boolean =>
  a.length === b.length && a.every((plate, k) => plate === b[k]);

const idsIn = (record: unknown): string[] => {
  const { files } = (record ?? {}) as { files?: unknown };
  if (!Array.isArray(files)) throw new Unfit('files', files);
  return files.map((id) => textIn(id, 'files', 1000));
};

/** Returns the fields of a record. @throws Unfit for a record of another version */
function fieldsIn(record: unknown): Fields {
  const fields = fieldsOf(record, '', ['version', 'files', 'plate', 'past', 'future']);
  numberIn(fields['version'], 'version', version, version);
  return fields;
}

/** A function that reads the plates of one record, which share their files. @param bytesOf  content of a file, by
 * its id */
function plateReader(record: unknown, bytesOf: (id: string) => unknown, engine: ProjectEngine) {
  const ids = new Map(
    idsIn(record).flatMap((id): [string, string][] => [
      [id, id],
      [`${id}.ttf`, id],
    ]),
  );
  const files = new Map<string, SourceFile>();
  const fileAt = (path: string, name: string): Promise<SourceFile | undefined> => {
    const id = ids.get(path);
    const bytes = id === undefined ? undefined : bytesOf(id);
    if (path === nothing.id) return Promise.resolve(undefined);
    if (id === undefined || !(bytes instanceof Blob)) return Promise.reject(new Unfit('files', path));
    const known = files.get(`${id} ${name}`) ?? { id, name, bytes };
    files.set(`${id} ${name}`, known); // steps share files that did not change
    return Promise.resolve(known);
  };
  return async (kept: unknown): Promise<Plate> => {
    const { project, brought } = fieldsOf(kept, 'plate', ['project', 'brought']);
    const plate = await plateOf(JSON.stringify(project ?? null), '', fileAt, engine);
    if (brought === undefined) return plate;
    const read = await engine.readProject(JSON.stringify({ sillon: 1, printer: brought }));
    const { profile, filament, ...printer } = read.printer;
    const machine = { ...printer, ...(profile !== '' && { profile }), ...(filament !== '' && { filament }) };
    return { ...plate, brought: machine };
  };
}

/** Reads plates, the nearest step first, up to the first that cannot be read; the steps beyond it are dropped. */
async function platesFrom(value: unknown, read: (kept: unknown) => Promise<Plate>): Promise<Plate[]> {
  const plates: Plate[] = [];
  for (const one of Array.isArray(value) ? (value as unknown[]) : []) {
    const plate = await read(one).catch(() => undefined);
    if (plate === undefined) break;
    plates.push(plate);
  }
  return plates;
}

/** Reads the plate of a record with its steps. @param bytesOf  content of a file, by its id @throws Unfit, errors of
 * the engine */
async function stepsFrom(record: unknown, bytesOf: (id: string) => unknown, engine: ProjectEngine): Promise<Steps> {
  const fields = fieldsIn(record);
  const read = plateReader(record, bytesOf, engine);
  const plate = await read(fields['plate']);
  const [past, future] = [await platesFrom(fields['past'], read), await platesFrom(fields['future'], read)];
  return { past: past.reverse(), plate, future: future.reverse() };
}

/** Reads the plate of a record without its steps. @throws Unfit, errors of the engine */
export const keptPlate = (record: unknown, bytesOf: (id: string) => unknown, engine: ProjectEngine): Promise<Plate> =>
  plateReader(record, bytesOf, engine)(fieldsIn(record)['plate']);

/** Tells whether this version can open the plate of a record. @param has  tells whether a file is kept, by its id */
function isFit(record: unknown, has: (id: string) => boolean): boolean {
  try {
    const { plate } = fieldsIn(record);
    return typeof plate === 'object' && plate !== null && idsIn(record).every(has);
  } catch (error) {
    if (error instanceof Unfit) return false;
    throw error;
  }
}

/** Reads a kept print. @returns undefined for anything else */
function printFrom(record: unknown, bytes: unknown): KeptPrint | undefined {
  const { name, wish, open } = (record ?? {}) as Partial<KeptPrint> & { name?: unknown };
  if (!(bytes instanceof Blob) || typeof name !== 'string') return undefined;
  return { file: new File([bytes], name), wish, open: open === true };
}

/** Creates the keeper of this tab's plates.
 * @param onProblem  called when work cannot be kept, and again if that recurs after a success
 * @param onTaken  called when another tab has taken the plate, and this one goes on with a copy
 * @param host  a page that shows the studio, and the name that it gave the work, so that no page sees another's;
 * empty: the studio's own */
export function createAutosave(
  {
    onProblem,
    onTaken = () => undefined,
    engine,
    host = '',
  }: {
    onProblem: (problem: Problem) => void;
    onTaken?: () => void;
    engine: () => Promise<ProjectEngine>;
    host?: string;
  },
  name = host === '' ? 'sillon-studio' : `sillon-studio ${host}`,
  storage: Storage = browserStorage(name),
  locks: Locks = webLocks(name),
  session: Session = tabSession(name),
) {
  /** Record id of every plate that is in a record or in the history of one. */
  const idOf = new WeakMap<Plate, string>();
  /** Plates by record id, as they were when nobody had changed them. */
  const begun = new Map<string, Plate>();
  /** Steps that were written last, by record id, before `cut` shortened them. */
  const saved = new Map<string, Steps>();
  const written = new Map<string, Set<string>>();
  /** Records that failed to open although they look like this version's. */
  const unfit = new Set<string>();
  /** Records that this tab has written, perhaps before reading what was kept. */
  const begunHere = new Set<string>();
  let current = newId();
  const before = session.get();
  let waiting: { id: string; steps: Steps } | undefined;
  let waitingPrint: { id: string; print: KeptPrint | undefined } | undefined;
  /** Files of prints that are already in the storage, by record id. */
  const prints = new Map<string, File>();
  /** Files that did not fit into the storage, so that this is reported once for each. */
  const tooLarge = new WeakSet<File>();
  let timer: ReturnType<typeof setTimeout> | undefined;
  let failing = false;
  let turn = 0; // number of the last write; a later one makes an earlier `tidy` void
  let last = Promise.resolve();

  const attempt = (action: Promise<void>): Promise<void> => {
    const done = inTime(action).then(
      () => {
        failing = false;
      },
      (error: unknown) => {
        if (failing) return;
        failing = true;
        onProblem({ code: 'StorageFull', values: {}, detail: error instanceof Error ? error.message : String(error) });
      },
    );
    last = last.then(() => done);
    return last;
  };

  /** Goes on with a copy after another tab has taken the record of the plate that is shown. */
  const lost = (id: string): void => {
    written.delete(id);
    saved.delete(id);
    prints.delete(id);
    moved.set(id, newId());
    if (current !== id) return;
    current = moved.get(id) as string;
    settle();
    onTaken();
  };
  /** Ids of the copies that this tab goes on with, by the records that other tabs have taken. */
  const moved = new Map<string, string>();
  const live = (id: string): string => {
    const next = moved.get(id);
    return next === undefined ? id : live(next);
  };

  /** Makes the current record this tab's own. */
  function settle(): void {
    session.set(current);
    void locks.take(current, { onLost: lost });
  }

  const wrote = (id: string, given: Steps, kept: Steps): void => {
    saved.set(id, given);
    written.set(id, new Set(allFiles(kept).map((file) => file.id)));
  };

  const isOf =
    (id: string) =>
    (plate: Plate): boolean => {
      const known = idOf.get(plate);
      return known === undefined || live(known) === id; // without an id: of several plates in one turn, only the last is saved
    };

  /** The steps that are kept, the nearest first. */
  function cut({ past, plate, future }: Steps, id: string): Steps {
    const before = nearest(plate, [...past].reverse(), isOf(id));
    const after = nearest(plate, [...future].reverse(), isOf(id));
    return { past: before, plate, future: after };
  }

  /** Deletes files that the record no longer uses. @param stands  tells whether no later write has begun */
  async function tidy(id: string, steps: Steps, stands: () => boolean): Promise<void> {
    const wanted = new Set(allFiles(steps).map((file) => filesKey(id) + file.id));
    const unused = (await storage.keys()).filter((key) => key.startsWith(filesKey(id)) && !wanted.has(key));
    if (unused.length > 0 && stands()) await storage.delMany(unused);
  }

  async function write(id: string, given: Steps): Promise<void> {
    const mine = ++turn;
    const steps = cut(given, id);
    const { plate, past, future } = steps;
    const files = allFiles(steps);
    const known = written.get(id);
    const record = {
      version,
      files: files.map((file) => file.id),
      plate: told(plate),
      past: past.map(told),
      future: future.map(told),
    };
    const [width, height] = pageOf(plate);
    const about: About = {
      name: plate.name,
      width,
      height,
      changed: Date.now(),
      fresh: begun.get(id) === plate,
      ...(pictures.has(id) ? { picture: pictures.get(id) } : {}),
    };
    await storage.setMany([
      ...files
        .filter((file) => known?.has(file.id) !== true)
        .map((file): [string, unknown] => [filesKey(id) + file.id, file.bytes]),
      [recordKey(id), record],
      [aboutKey(id), about],
    ]);
    wrote(id, given, steps);
    const stands = (): boolean => mine === turn;
    if (stands()) await tidy(id, steps, stands);
  }
  /** Pictures for the list, by record id. */
  const pictures = new Map<string, Blob>();

  async function writePrint(id: string, print: KeptPrint | undefined): Promise<void> {
    if (print === undefined) {
      prints.delete(id);
      await storage.delMany([slicedKey(id), printKey(id)]);
      return;
    }
    const { file, wish, open } = print;
    try {
      await storage.setMany([
        ...(prints.get(id) === file ? [] : [[printKey(id), new Blob([file])] as [string, unknown]]),
        [slicedKey(id), { name: file.name, wish, open }],
      ]);
      prints.set(id, file);
    } catch (error) {
      tooLarge.add(file);
      throw error;
    }
  }

  const later = (): void => {
    clearTimeout(timer);
    timer = setTimeout(() => void flush(), settleAfter);
  };

  const flush = (): Promise<void> => {
    clearTimeout(timer);
    const [work, sliced] = [waiting, waitingPrint];
    waiting = waitingPrint = undefined;
    if (sliced !== undefined) void attempt(writePrint(live(sliced.id), sliced.print));
    if (work === undefined || areSame(work.steps, saved.get(work.id))) return last;
    // A write starts at once, even during an earlier one. The storage does them in order, and a closing page would not
    // learn of the first one's end.
    begunHere.add(live(work.id));
    return attempt(write(live(work.id), work.steps));
  };

  const namesOf = async (id: string): Promise<string[]> =>
    (await storage.keys()).filter(
      (key) => [recordKey(id), aboutKey(id), slicedKey(id), printKey(id)].includes(key) || key.startsWith(filesKey(id)),
    );

  async function abouts(): Promise<{ id: string; about: About }[]> {
    const names = await storage.keys();
    const ids = [...new Set(names.flatMap((key) => idOfKey(key) ?? []))];
    const values = await storage.getMany(ids.map(aboutKey));
    return ids
      .flatMap((id, k) => {
        const about = aboutFrom(values[k]) ?? (names.includes(recordKey(id)) ? aboutLike(values[k]) : undefined);
        return about === undefined ? [] : [{ id, about }];
      })
      .sort((a, b) => b.about.changed - a.about.changed);
  }

  /** Records, among these, that this version cannot open. */
  async function foreignOf(ids: readonly string[]): Promise<Set<string>> {
    const [names, records] = await Promise.all([storage.keys(), storage.getMany(ids.map(recordKey))]);
    const there = new Set(names);
    return new Set(
      ids.filter((id, k) => {
        const isOpen = (): boolean => !unfit.has(id) && isFit(records[k], (file) => there.has(filesKey(id) + file));
        return there.has(recordKey(id)) && !isOpen();
      }),
    );
  }

  /** Reads a plate and its steps. @returns undefined where it is gone or cannot be opened */
  async function stepsOf(id: string): Promise<Steps | undefined> {
    const [record, about] = await storage.getMany([recordKey(id), aboutKey(id)]);
    if (record === undefined) return undefined;
    try {
      const ids = idsIn(record);
      const blobs = await storage.getMany(ids.map((file) => filesKey(id) + file));
      const bytes = new Map(ids.map((file, k) => [file, blobs[k]]));
      if (!isFit(record, (file) => bytes.get(file) instanceof Blob)) return undefined;
      const steps = await stepsFrom(record, (file) => bytes.get(file), await engine());
      const picture = aboutFrom(about)?.picture;
      if (picture !== undefined) pictures.set(id, picture);
      return steps;
    } catch (error) {
      if (!(error instanceof Unfit || isOfFile(error))) throw error;
      unfit.add(id); // the record stays, since another version may open it
      return undefined;
    }
  }

  /** Assigns all plates of a history to this record. */
  function claim(id: string, steps: Steps): void {
    for (const plate of [...steps.past, steps.plate, ...steps.future]) idOf.set(plate, id);
  }

  /** Opens a record under its lock, or as a copy where another tab holds the lock. */
  async function taken(id: string, wait: boolean, steal = false): Promise<Opened | undefined> {
    const own = await locks.take(id, { wait, steal, onLost: lost });
    const steps = await stepsOf(id);
    if (steps === undefined) return undefined;
    const record = own ? id : newId();
    claim(record, steps);
    if (!own) {
      if (pictures.has(id)) pictures.set(record, pictures.get(id) as Blob);
      return { state: 'copy', id: record, steps };
    }
    wrote(id, steps, steps);
    const print = printFrom(...((await storage.getMany([slicedKey(id), printKey(id)])) as [unknown, unknown]));
    if (print !== undefined) prints.set(id, print.file);
    return { state: 'own', id, steps, print };
  }

  async function read(): Promise<Kept | undefined> {
    try {
      const foreign = await foreignOf((await abouts()).map(({ id }) => id));
      if (before !== undefined && foreign.has(before)) return { state: 'foreign' };
      const own = before === undefined ? undefined : await taken(before, true);
      if (own !== undefined) return own;
      if (before !== undefined && unfit.has(before)) return { state: 'foreign' };
      const newest = (await abouts()).find(({ id }) => !begunHere.has(id));
      if (newest === undefined) return undefined;
      if (foreign.has(newest.id)) return { state: 'foreign' }; // without its lock, so that a tab of that version can take it
      if (!(await locks.take(newest.id, { onLost: lost }))) return { state: 'elsewhere' };
      return (await taken(newest.id, false)) ?? (unfit.has(newest.id) ? { state: 'foreign' } : undefined);
    } catch {
      return undefined; // a storage that is denied will be reported by `save`
    }
  }

  return {
    /** Loads this tab's plate or, if it has none, the one that was changed last. May never resolve, since some storages
     * do not answer.
     * @returns undefined where nothing usable was kept */
    load: read,
    /** Shows a plate from now on, with its own record.
     * @param fresh  nobody has changed the plate yet, so it is not kept after its tab is closed */
    begin(plate: Plate, fresh = false): void {
      const known = idOf.get(plate);
      const id = known === undefined ? newId() : live(known);
      idOf.set(plate, id);
      if (known === undefined && fresh) begun.set(id, plate);
      current = id;
      settle();
    },
    /** Id of the record of the plate that is shown. */
    current: (): string => current,
    /** Saves the plate and its steps after a short pause without another change. */
    save(steps: Steps): void {
      const { plate } = steps;
      const known = idOf.get(plate);
      const id = known === undefined ? current : live(known);
      idOf.set(plate, id);
      if (id !== current || saved.size === 0) {
        current = id;
        settle();
      }
      if (waiting !== undefined && waiting.id !== id) void flush();
      waiting = { id, steps };
      later();
    },
    /** Saves, likewise, the sliced print over the plate that is shown; undefined: it has none any more. */
    savePrint(print: KeptPrint | undefined): void {
      if (print !== undefined && tooLarge.has(print.file)) return;
      waitingPrint = { id: current, print };
      if (print === undefined) void flush();
      else later();
    },
    /** Saves now what `save` and `savePrint` have delayed. */
    flush,
    /** Lists the kept plates, the latest first. */
    async list(): Promise<Listed[]> {
      await flush();
      const [all, held] = await Promise.all([abouts(), locks.held()]);
      const [foreign, names] = await Promise.all([foreignOf(all.map(({ id }) => id)), storage.keys()]);
      const isKept = (id: string): boolean =>
        id === current || held.has(id) || foreign.has(id) || names.includes(slicedKey(id));
      const shown = all.filter(({ id, about }) => !about.fresh || isKept(id));
      // A plate that nobody ever changed is deleted once its tab is gone.
      const left = all.filter((one) => !shown.includes(one));
      for (const { id } of left) await storage.delMany(await namesOf(id));
      return shown.map(({ id, about: { name, width, height, changed, picture } }) => ({
        id,
        name,
        width,
        height,
        changed,
        picture,
        here: id === current,
        elsewhere: held.has(id) && !locks.mine(id),
        foreign: foreign.has(id),
      }));
    },
    /** Opens a kept plate. Where another tab has it, one of the two tabs goes on with a copy.
     * @param take  takes the plate itself and leaves the copy to the other tab; otherwise this tab gets the copy
     * @returns undefined where the plate is gone */
    async open(id: string, take = false): Promise<Opened | undefined> {
      await flush();
      return taken(id, false, take);
    },
    async rename(id: string, name: string): Promise<void> {
      await flush();
      const [record, about] = await storage.getMany([recordKey(id), aboutKey(id)]);
      const known = aboutFrom(about);
      if (known === undefined || typeof record !== 'object' || record === null) return;
      await storage.setMany([
        [recordKey(id), renamed(record, name)],
        [aboutKey(id), { ...known, name, fresh: false }],
      ]);
    },
    /** Copies a plate under another name. @returns the copy's id; undefined where there is nothing to copy */
    async duplicate(id: string, name: string): Promise<string | undefined> {
      await flush();
      const names = (await namesOf(id)).filter((key) => key !== slicedKey(id) && key !== printKey(id));
      const values = await storage.getMany(names);
      if (!names.includes(recordKey(id))) return undefined;
      const copy = newId();
      const entries = names.map((key, k): [string, unknown] => {
        const value = values[k];
        if (key === recordKey(id)) return [recordKey(copy), renamed(value as object, name)];
        if (key === aboutKey(id))
          return [aboutKey(copy), { ...(value as object), name, changed: Date.now(), fresh: false }];
        return [filesKey(copy) + key.slice(filesKey(id).length), value];
      });
      await storage.setMany(entries);
      return copy;
    },
    /** Deletes a plate. @returns a function that restores it */
    async remove(id: string): Promise<() => Promise<void>> {
      await flush();
      const names = await namesOf(id);
      const values = await storage.getMany(names);
      await storage.delMany(names);
      saved.delete(id);
      written.delete(id);
      prints.delete(id);
      return () => storage.setMany(names.map((key, k) => [key, values[k]]));
    },
    /** Reads all values kept for a plate as they are, so that they can be downloaded. */
    async stored(id: string): Promise<Stored> {
      await flush();
      const names = (await namesOf(id)).filter((key) => key.startsWith(filesKey(id)));
      const [record, about, ...bytes] = await storage.getMany([recordKey(id), aboutKey(id), ...names]);
      const files = new Map(names.map((key, k) => [key.slice(filesKey(id).length), bytes[k]]));
      return { record, about, files };
    },
    /** Sets the plate's picture in the list. */
    async picture(plate: Plate, picture: Blob): Promise<void> {
      const id = live(idOf.get(plate) ?? '');
      if (id === '') return; // a plate that nobody has changed is not kept
      pictures.set(id, picture);
      await flush();
      const about = aboutFrom((await storage.getMany([aboutKey(id)]))[0]);
      if (about !== undefined) await storage.setMany([[aboutKey(id), { ...about, picture }]]);
    },
  };
}

/** The keeper of a tab's plates. */
export type Autosave = ReturnType<typeof createAutosave>;
