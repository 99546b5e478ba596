import assert from 'node:assert/strict';
import { afterEach, beforeEach, mock, test } from 'node:test';
import { createAutosave, type Autosave, type Kept, type Storage } from '../../src/files/autosave.js';
import type { Locks } from '../../src/files/locks.js';
import { newFileDirections, newFileShape, newPlate, newShape } from '../../src/model/defaults.js';
import type { Plate } from '../../src/model/plate.js';
import type { Problem } from '../../src/model/problem.js';
import type { Steps } from '../../src/model/store.js';
import { fileOf } from './support/pictures.js';

/** A browser's storage, as a Map that counts what is put into it. */
class Box implements Storage {
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
class Browser {
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

let box: Box;
let browser: Browser;
let problems: Problem[];
let taken: number;

/** A tab. @param session  what it remembers over a reload */
function start(session: { id?: string } = {}): Autosave {
  return createAutosave(
    { onProblem: (problem) => problems.push(problem), onTaken: () => ++taken },
    'test',
    box,
    browser.tab(),
    {
      get: () => session.id,
      set: (id) => (session.id = id),
    },
  );
}
/** After all tabs were closed. */
function later(): Autosave {
  browser.close();
  return start();
}
const steps = (plate: Plate): Steps => ({ past: [], plate, future: [] });
const plateOf = (kept: Kept | undefined): Plate | undefined =>
  kept !== undefined && 'steps' in kept ? kept.steps.plate : undefined;
const records = (): string[] => [...box.kept.keys()].filter((key) => key.startsWith('plate/'));
const fileKeys = (): string[] =>
  [...box.kept.keys()].filter((key) => key.startsWith('file/')).map((key) => key.split('/').at(-1) ?? '');

beforeEach(() => {
  box = new Box();
  browser = new Browser();
  problems = [];
  taken = 0;
  mock.timers.enable({ apis: ['setTimeout'] });
});
afterEach(() => {
  mock.timers.reset();
});

const named = (name: string): Plate => ({ ...newPlate(), name });
const shape = fileOf('leaf.svg', '<svg/>');
const picture = fileOf('photo.png', 'pixels');
const withFiles = (): Plate => ({
  ...named('leaf'),
  shape: newFileShape(shape, 'mm'),
  directions: newFileDirections('tone', picture),
  modes: { mode: 'smoothest', file: picture },
  strokes: [{ tool: 'mode', points: [0.1, 0.2, 0.3, 0.4], radius: 0.05, softness: 0.5, mode: 'parallel' }],
});
async function keep(autosave: Autosave, plate: Plate): Promise<Plate> {
  autosave.save(steps(plate));
  await autosave.flush();
  return plate;
}

async function contents(plate: Plate | undefined): Promise<unknown> {
  assert.ok(plate?.shape.kind === 'file' && plate.directions.kind === 'tone');
  const { file } = plate.directions;
  return [await plate.shape.file.bytes.text(), await file.bytes.text(), await plate.modes.file?.bytes.text()];
}

test('what was saved comes back after a reload, files and all', async () => {
  const first = start();
  assert.equal(await first.load(), undefined);
  await keep(first, withFiles());
  const plate = plateOf(await later().load());
  assert.deepEqual(plate, withFiles());
  assert.deepEqual(await contents(plate), ['<svg/>', 'pixels', 'pixels']);
  assert.deepEqual(problems, []);
});

test('undo and redo come back with it, within bounds', async () => {
  const first = start();
  const plates = Array.from({ length: 200 }, (_, k) => ({ ...named(`step ${k}`), width: k + 1 }));
  const at = 120;
  first.save({ past: plates.slice(0, at), plate: plates[at] as Plate, future: plates.slice(at + 1).reverse() });
  await first.flush();
  const kept = await later().load();
  assert.ok(kept !== undefined && 'steps' in kept);
  const { past, plate, future } = kept.steps;
  assert.deepEqual(plate, plates[at]);
  assert.deepEqual(past, plates.slice(at - 60, at));
  assert.deepEqual(future, plates.slice(at + 1, at + 61).reverse());
});

test('a step that is undone before it was saved can be redone after a reload', async () => {
  const first = start();
  const plate = await keep(first, named('before'));
  const undone = named('undone');
  first.save({ past: [plate], plate: undone, future: [] });
  first.save({ past: [], plate, future: [undone] });
  await first.flush();
  const kept = await later().load();
  assert.ok(kept !== undefined && 'steps' in kept);
  assert.deepEqual(kept.steps, { past: [], plate, future: [undone] });
});

test('strokes without end, and files that only earlier steps use, do not fill the storage', async () => {
  const stroke = { tool: 'comb' as const, points: new Array<number>(200_000).fill(0), radius: 0.1, softness: 0 };
  const long = (count: number): Plate => ({ ...named('long'), strokes: new Array<typeof stroke>(count).fill(stroke) });
  const large = (id: string): Plate => ({
    ...named('large'),
    directions: newFileDirections('tone', { id, name: id, bytes: new Blob([new Uint8Array(20e6)]) }),
  });
  for (const [past, left] of [
    [[long(1), long(1), long(1)], 2],
    [[large('a'), large('b')], 1],
  ] as const) {
    box.kept.clear();
    const autosave = start();
    autosave.save({ past, plate: named('now'), future: [] });
    await autosave.flush();
    const kept = await later().load();
    assert.ok(kept !== undefined && 'steps' in kept);
    assert.equal(kept.steps.past.length, left);
  }
});

test('only the last of many changes is written, half a second after it', async () => {
  const autosave = start();
  for (const name of ['a', 'b', 'c']) {
    autosave.save(steps(named(name)));
    mock.timers.tick(499);
  }
  assert.deepEqual(box.puts, []);
  mock.timers.tick(1);
  await autosave.flush();
  assert.equal(records().length, 1);
  assert.equal(plateOf(await later().load())?.name, 'c');
});

test('a file is written once, and thrown away with its last use', async () => {
  const autosave = start();
  await keep(autosave, withFiles());
  await keep(autosave, { ...withFiles(), name: 'leaf 2' });
  assert.equal(box.puts.filter((key) => key.startsWith('file/')).length, 2); // the picture is used twice
  await keep(autosave, { ...withFiles(), shape: newShape('disc') });
  assert.deepEqual(fileKeys(), [picture.id]);
  await keep(autosave, named('none'));
  assert.deepEqual(fileKeys(), []);
});

test('what has not changed is not written', async () => {
  const autosave = start();
  const plate = await keep(autosave, named('same'));
  const puts = box.puts.length;
  await keep(autosave, plate);
  await autosave.flush();
  assert.equal(box.puts.length, puts);
});

test('two tabs never write the same plate', async () => {
  const one = start();
  const other = start();
  await keep(one, named('one'));
  assert.deepEqual(await other.load(), { state: 'elsewhere' });
  await keep(other, named('other'));
  await keep(one, named('one, changed'));
  const names = (await later().list()).map(({ name }) => name);
  assert.deepEqual(names.sort(), ['one, changed', 'other']);
});

test('each tab finds its own plate after a reload', async () => {
  const sessions = [{}, {}];
  for (const [k, session] of sessions.entries()) await keep(start(session), named(`tab ${k}`));
  browser.close();
  for (const [k, session] of sessions.entries()) {
    assert.equal(plateOf(await start(session).load())?.name, `tab ${k}`);
  }
});

test('a tab that was duplicated goes on with a copy', async () => {
  const session: { id?: string } = {};
  await keep(start(session), named('mine'));
  const copy = start({ ...session });
  const kept = await copy.load();
  assert.equal(kept?.state, 'copy');
  await keep(copy, { ...(plateOf(kept) as Plate), name: 'copied' });
  assert.deepEqual((await later().list()).map(({ name }) => name).sort(), ['copied', 'mine']);
});

test('a plate of another tab is opened as a copy, or taken over: nothing is lost', async () => {
  const one = start();
  const mine = await keep(one, named('mine'));
  const other = start();
  const [listed] = await other.list();
  assert.ok(listed?.elsewhere === true && !listed.here);
  const copy = await other.open(listed.id);
  assert.equal(copy?.state, 'copy');
  other.begin(copy.steps.plate);
  await keep(other, { ...copy.steps.plate, name: 'copied' });
  assert.equal(taken, 0);
  const own = await other.open(listed.id, true);
  assert.equal(own?.state, 'own');
  assert.equal(taken, 1);
  other.begin(own.steps.plate);
  await keep(other, { ...own.steps.plate, name: 'taken' });
  await keep(one, { ...mine, name: 'went on' });
  assert.deepEqual((await later().list()).map(({ name }) => name).sort(), ['copied', 'taken', 'went on']);
});

test('another plate has a record of its own, and undo leads back to the first one’s', async () => {
  const autosave = start();
  const first = await keep(autosave, named('first'));
  const second = named('second');
  autosave.begin(second);
  autosave.save({ past: [first], plate: second, future: [] });
  await autosave.flush();
  assert.equal(records().length, 2);
  autosave.save({ past: [], plate: first, future: [second] });
  await keep(autosave, { ...first, name: 'first again' });
  const again = later();
  const listed = await again.list();
  assert.deepEqual(listed.map(({ name }) => name).sort(), ['first again', 'second']);
  const kept = await again.open(listed.find(({ name }) => name === 'second')?.id ?? '');
  assert.deepEqual(kept?.steps.past, []); // of another plate
});

test('what nobody has changed goes with its tab', async () => {
  const autosave = start();
  const example = named('example');
  autosave.begin(example, true);
  await keep(autosave, example);
  assert.equal((await autosave.list()).length, 1);
  assert.deepEqual(await later().list(), []);
  assert.equal(box.kept.size, 0);
});

test('plates are renamed, duplicated, deleted, and brought back', async () => {
  const autosave = start();
  await keep(autosave, withFiles());
  await autosave.picture(await keep(autosave, { ...withFiles(), width: 33 }), new Blob(['small']));
  const [{ id } = assert.fail()] = await autosave.list();
  const other = later();
  await other.rename(id, 'new name');
  await other.duplicate(id, 'copy');
  const undo = await other.remove(id);
  assert.equal(await other.open(id), undefined);
  const [copy] = await other.list();
  assert.equal(copy?.name, 'copy');
  assert.equal(await copy.picture?.text(), 'small');
  const kept = await other.open(copy.id);
  assert.deepEqual(await contents(kept?.steps.plate), ['<svg/>', 'pixels', 'pixels']);
  await undo();
  const back = await other.open(id);
  assert.equal(back?.steps.plate.name, 'new name');
  assert.deepEqual(await contents(back.steps.plate), ['<svg/>', 'pixels', 'pixels']);
});

test('a denied or full storage is told of, once until it is mended, and keeps nobody from going on', async () => {
  box.failure = new DOMException('no room', 'QuotaExceededError');
  const autosave = start();
  assert.equal(await autosave.load(), undefined);
  assert.deepEqual(problems, []);
  for (const name of ['a', 'b']) await keep(autosave, named(name));
  const told = { code: 'StorageFull', values: {}, detail: 'no room' };
  assert.deepEqual(problems, [told]);
  const { failure } = box;
  box.failure = undefined;
  await keep(autosave, named('c'));
  assert.equal(plateOf(await later().load())?.name, 'c');
  box.failure = failure;
  await keep(autosave, named('d'));
  assert.deepEqual(problems, [told, told]);
});

test('where the browser has no storage at all', async () => {
  const autosave = createAutosave({ onProblem: (problem) => problems.push(problem) }, 'test', undefined, browser.tab());
  assert.equal(await autosave.load(), undefined);
  await keep(autosave, named('a'));
  assert.deepEqual(
    problems.map(({ code }) => code),
    ['StorageFull'],
  );
});

test('a storage that never answers is told of', async () => {
  box.answers = new Promise(() => undefined);
  const autosave = start();
  void autosave.load();
  autosave.save(steps(named('a')));
  const saving = autosave.flush();
  mock.timers.tick(10_000);
  await saving;
  assert.equal(problems.length, 1);
});

test('a page that is closed while an earlier plate is being written keeps the newest', async () => {
  const autosave = start();
  await autosave.load();
  box.answers = new Promise(() => undefined);
  for (const name of ['earlier', 'newest']) {
    autosave.save(steps(named(name)));
    void autosave.flush();
    await Promise.resolve(); // a closed page does what is ready, and hears no answers
  }
  box.answers = undefined;
  assert.equal(plateOf(await later().load())?.name, 'newest');
});

test('what is changed before what was kept has been read lies beside it', async () => {
  await keep(start(), named('kept'));
  browser.close();
  const autosave = start();
  const loading = autosave.load();
  autosave.save(steps(named('early')));
  await autosave.flush();
  assert.equal(plateOf(await loading)?.name, 'kept');
  assert.deepEqual((await later().list()).map(({ name }) => name).sort(), ['early', 'kept']);
});

test('an earlier plate does not throw away the files of a later one', async () => {
  const autosave = start();
  await keep(autosave, withFiles());
  const asked = box.asked;
  autosave.save(steps(named('without')));
  const saving = autosave.flush();
  while (box.asked === asked) await Promise.resolve(); // it has been written, and asks what else is there
  autosave.save(steps(withFiles()));
  await Promise.all([autosave.flush(), saving]);
  assert.deepEqual(await contents(plateOf(await later().load())), ['<svg/>', 'pixels', 'pixels']);
});

test('a record of another version stays as it is, is listed, and goes when its owner deletes it', async () => {
  await keep(start(), withFiles());
  const kept = structuredClone([...box.kept]);
  const [key = ''] = records();
  const good = box.kept.get(key) as Record<string, unknown>;
  const plate = good['plate'] as Record<string, unknown>;
  const wrong: unknown[] = [
    null,
    'text',
    {},
    { ...good, version: 3 },
    { ...good, plate: { ...plate, pictures: { spool: 'purple' } } },
    { ...good, files: [] },
    { ...good, files: 'all' },
    { ...good, plate: undefined },
    { ...good, plate: { ...plate, width: '70' } },
    { ...good, plate: { ...plate, width: NaN } },
    { ...good, plate: { ...plate, extra: 1 } },
    { ...good, plate: { ...plate, shape: { kind: 'file', file: { id: 'unknown', name: 'x' } } } },
    { ...good, plate: { ...plate, strokes: [{ tool: 'comb', points: [1], radius: 0.1, softness: 0 }] } },
    { ...good, plate: { ...plate, toolpath: { spacing: 1e9 } } },
  ];
  for (const record of wrong) {
    box.kept.clear();
    for (const [name, value] of kept) box.kept.set(name, value);
    box.kept.set(key, record);
    const before = [...box.kept];
    const autosave = later();
    assert.deepEqual(await autosave.load(), { state: 'foreign' }, JSON.stringify(record));
    assert.equal(await autosave.open(key.slice('plate/'.length)), undefined);
    await keep(autosave, named('another'));
    const [{ id } = assert.fail(), ...others] = (await autosave.list()).filter(({ foreign }) => foreign);
    assert.deepEqual([`plate/${id}`, others.length], [key, 0]);
    for (const [name, value] of before) assert.equal(box.kept.get(name), value, name);
    assert.equal((await autosave.stored(id)).files.size, 2);
    await autosave.remove(id);
    assert.ok(before.every(([name]) => !box.kept.has(name)));
  }
  box.kept.clear();
  for (const [name, value] of kept) if (!name.endsWith(shape.id)) box.kept.set(name, value);
  assert.deepEqual(await later().load(), { state: 'foreign' }, 'a file is gone');
  // A step that cannot be one is left out, with all before it.
  for (const [name, value] of kept) box.kept.set(name, value);
  box.kept.set(key, { ...good, past: [plate, { ...plate, width: -1 }, plate] });
  const found = await later().load();
  assert.ok(found !== undefined && 'steps' in found);
  assert.equal(found.steps.past.length, 1);
  assert.deepEqual(problems, []);
});

test('what another version says of its plates in the list may be anything', async () => {
  await keep(start(), named('theirs'));
  const [key = ''] = records();
  const good = box.kept.get(key) as Record<string, unknown>;
  box.kept.set(key, { ...good, version: 9 });
  for (const about of [undefined, null, 7, { title: 'theirs' }, { fresh: true, changed: Number.NaN, name: 'theirs' }]) {
    box.kept.set(key.replace('plate', 'about'), about);
    if (about === undefined) box.kept.delete(key.replace('plate', 'about'));
    const [{ foreign, width } = assert.fail(), ...others] = await later().list();
    assert.deepEqual([foreign, width, others.length], [true, 0, 0]);
  }
});
