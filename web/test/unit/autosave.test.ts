import assert from 'node:assert/strict';
import { afterEach, beforeEach, mock, test } from 'node:test';
import { createAutosave, type Storage } from '../../src/files/autosave.js';
import { newFileDirections, newPlate } from '../../src/model/defaults.js';
import type { Plate } from '../../src/model/plate.js';
import type { Problem } from '../../src/model/problem.js';
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

let box: Box;
let problems: Problem[];
const start = (): ReturnType<typeof createAutosave> =>
  createAutosave({ onProblem: (problem) => problems.push(problem) }, box);

beforeEach(() => {
  box = new Box();
  problems = [];
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
  shape: { kind: 'file', file: shape, unitless: 'mm' },
  directions: newFileDirections('tone', picture),
  modes: { base: 'smoothest', file: picture },
  strokes: [{ tool: 'mode', points: [0.1, 0.2, 0.3, 0.4], radius: 0.05, softness: 0.5, mode: 'parallel' }],
});

async function contents(plate: Plate | undefined): Promise<unknown> {
  assert.ok(plate?.shape.kind === 'file' && plate.directions.kind === 'tone');
  const { file } = plate.directions;
  return [await plate.shape.file.bytes.text(), await file.bytes.text(), await plate.modes.file?.bytes.text()];
}

test('what was saved comes back after a reload, files and all', async () => {
  const first = start();
  assert.equal(await first.load(), undefined);
  first.save(withFiles());
  await first.flush();
  const plate = await start().load();
  assert.deepEqual(plate, withFiles());
  assert.deepEqual(await contents(plate), ['<svg/>', 'pixels', 'pixels']);
  assert.deepEqual(problems, []);
});

test('only the last of many changes is written, half a second after it', async () => {
  const autosave = start();
  for (const name of ['a', 'b', 'c']) {
    autosave.save(named(name));
    mock.timers.tick(499);
  }
  assert.deepEqual(box.puts, []);
  mock.timers.tick(1);
  await autosave.flush();
  assert.deepEqual(box.puts, ['plate']);
  assert.equal((await start().load())?.name, 'c');
});

test('a file is written once, and thrown away with its last use', async () => {
  const autosave = start();
  autosave.save(withFiles());
  await autosave.flush();
  autosave.save({ ...withFiles(), name: 'leaf 2' });
  await autosave.flush();
  const fileKeys = box.puts.filter((key) => key.startsWith('file/'));
  assert.equal(fileKeys.length, 2); // the picture is used twice
  autosave.save({ ...withFiles(), shape: { kind: 'disc' } });
  await autosave.flush();
  assert.deepEqual([...box.kept.keys()].sort(), [`file/${picture.id}`, 'plate']);
  autosave.save(named('none'));
  await autosave.flush();
  assert.deepEqual([...box.kept.keys()], ['plate']);
});

test('files that another tab threw away are written again', async () => {
  const autosave = start();
  autosave.save(withFiles());
  await autosave.flush();
  const other = start();
  other.save(named('other'));
  await other.flush();
  autosave.save({ ...withFiles(), name: 'again' });
  await autosave.flush();
  assert.equal((await start().load())?.name, 'again');
});

test('what has not changed is not written', async () => {
  const autosave = start();
  const plate = named('same');
  autosave.save(plate);
  await autosave.flush();
  autosave.save(plate);
  await autosave.flush();
  await autosave.flush();
  assert.deepEqual(box.puts, ['plate']);
});

test('forgotten is forgotten, also what waited', async () => {
  const autosave = start();
  autosave.save(withFiles());
  await autosave.flush();
  autosave.save(named('later'));
  await autosave.forget();
  mock.timers.tick(1000);
  await autosave.flush();
  assert.equal(box.kept.size, 0);
  autosave.save(named('new'));
  await autosave.flush();
  assert.equal((await start().load())?.name, 'new');
});

test('a denied or full storage is told of once, and keeps nobody from going on', async () => {
  box.failure = new DOMException('no room', 'QuotaExceededError');
  const autosave = start();
  assert.equal(await autosave.load(), undefined);
  assert.deepEqual(problems, []);
  for (const name of ['a', 'b']) {
    autosave.save(named(name));
    await autosave.flush();
  }
  await autosave.forget();
  assert.deepEqual(problems, [{ code: 'StorageFull', values: {}, detail: 'no room' }]);
  box.failure = undefined;
  autosave.save(named('c'));
  await autosave.flush();
  assert.equal((await start().load())?.name, 'c');
});

test('where the browser has no storage at all', async () => {
  const autosave = createAutosave({ onProblem: (problem) => problems.push(problem) });
  assert.equal(await autosave.load(), undefined);
  autosave.save(named('a'));
  await autosave.flush();
  assert.deepEqual(
    problems.map(({ code }) => code),
    ['StorageFull'],
  );
});

test('a storage that never answers is told of', async () => {
  box.answers = new Promise(() => undefined);
  const autosave = start();
  void autosave.load();
  autosave.save(named('a'));
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
    autosave.save(named(name));
    void autosave.flush();
    await Promise.resolve(); // a closed page does what is ready, and hears no answers
  }
  box.answers = undefined;
  assert.equal((await start().load())?.name, 'newest');
});

test('nothing is written over what was kept before that has been read', async () => {
  const first = start();
  first.save(named('kept'));
  await first.flush();
  let answer = (): void => undefined;
  box.answers = new Promise(
    (resolve) =>
      (answer = () => {
        resolve(undefined);
      }),
  );
  const autosave = start();
  const loading = autosave.load();
  autosave.save(named('early'));
  const saving = autosave.flush();
  await Promise.resolve();
  assert.deepEqual(box.puts, ['plate']);
  answer();
  assert.equal((await loading)?.name, 'kept');
  await saving;
  assert.equal((await start().load())?.name, 'early');
});

test('an earlier plate does not throw away the files of a later one', async () => {
  const autosave = start();
  autosave.save(withFiles());
  await autosave.flush();
  autosave.save(named('without'));
  const saving = autosave.flush();
  while (box.asked < 2) await Promise.resolve(); // it has been written, and asks what else is there
  autosave.save(withFiles());
  await Promise.all([autosave.flush(), saving]);
  assert.deepEqual(await contents(await start().load()), ['<svg/>', 'pixels', 'pixels']);
});

test('a record that cannot be one of ours is dropped', async () => {
  const autosave = start();
  autosave.save(withFiles());
  await autosave.flush();
  const good = structuredClone(box.kept.get('plate')) as Record<string, unknown>;
  const plate = good['plate'] as Record<string, unknown>;
  const records: unknown[] = [
    null,
    'text',
    {},
    { ...good, version: 2 },
    { ...good, files: [] },
    { ...good, files: 'all' },
    { ...good, plate: undefined },
    { ...good, plate: { ...plate, width: '70' } },
    { ...good, plate: { ...plate, width: NaN } },
    { ...good, plate: { ...plate, extra: 1 } },
    { ...good, plate: { ...plate, shape: { kind: 'file', file: { id: 'unknown', name: 'x' }, unitless: 'px' } } },
    { ...good, plate: { ...plate, strokes: [{ tool: 'comb', points: [1], radius: 0.1, softness: 0 }] } },
    { ...good, plate: { ...plate, toolpath: { spacing: 1e9 } } },
  ];
  for (const record of records) {
    box.kept.set('plate', record);
    assert.equal(await start().load(), undefined, JSON.stringify(record));
    assert.ok(!box.kept.has('plate'), JSON.stringify(record));
  }
  box.kept.set('plate', good);
  box.kept.delete(`file/${shape.id}`);
  assert.equal(await start().load(), undefined, 'a file is gone');
  assert.deepEqual(problems, []);
});
