import assert from 'node:assert/strict';
import { after, afterEach, before, beforeEach, mock, test } from 'node:test';
import { createEngine, type Engine } from 'sillon';
import { createAutosave, type Autosave, type Kept } from '../../src/files/autosave.js';
import { filesOf } from '../../src/files/plate-project.js';
import { newFileShape, newShape } from '../../src/model/defaults.js';
import { filledWith, groundOf } from '../../src/model/fills.js';
import { newLayer, withLayer } from '../../src/model/layer-list.js';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import type { Problem } from '../../src/model/problem.js';
import type { Steps } from '../../src/model/store.js';
import { fileOf } from './support/pictures.js';
import { layered, strokes, unfinished } from './support/plates.js';
import { Box, Browser } from './support/storage.js';

let engine: Engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
});

let box: Box;
let browser: Browser;
let problems: Problem[];
let taken: number;

/** A tab. @param session  what it remembers over a reload */
function start(session: { id?: string } = {}): Autosave {
  return createAutosave(
    {
      onProblem: (problem) => problems.push(problem),
      onTaken: () => ++taken,
      engine: () => Promise.resolve(engine),
    },
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
const withFiles = (): Plate => {
  const plate: Plate = { ...named('leaf'), shape: newFileShape(shape, 'mm') };
  const filled = filledWith(plate, 'brightness', { file: picture, modeFile: picture, mode: 'smoothest' });
  return withLayer(filled, newLayer(plate, 'strokes', { strokes: [...strokes] }));
};
async function keep(autosave: Autosave, plate: Plate): Promise<Plate> {
  autosave.save(steps(plate));
  await autosave.flush();
  return plate;
}

async function contents(plate: Plate | undefined): Promise<unknown> {
  assert.ok(plate?.shape.kind === 'file');
  const { file, modeFile } = groundOf(plate) ?? assert.fail();
  return [await plate.shape.file.bytes.text(), await file?.bytes.text(), await modeFile?.bytes.text()];
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
  const stroke = { tool: 'comb' as const, points: new Array<number>(160_000).fill(0), radius: 1, soft: 0 };
  const long = (): Plate => withLayer(named('long'), newLayer(newPlate(), 'strokes', { strokes: [stroke] }));
  const large = (id: string): Plate =>
    filledWith(named('large'), 'brightness', { file: { id, name: id, bytes: new Blob([new Uint8Array(20e6)]) } });
  for (const [past, left] of [
    [[long(), long(), long()], 2],
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
  const host = { onProblem: (problem: Problem) => problems.push(problem), engine: () => Promise.resolve(engine) };
  const autosave = createAutosave(host, 'test', undefined, browser.tab());
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

// --- Layers ------------------------------------------------------------------------------------------------------------

const font = fileOf('Own.ttf', 'letters');
const files = { drawing: shape, photo: picture, modes: fileOf('modes.png', 'modes'), font };

test('layers of every kind come back in their order, with their files', async () => {
  const plate = await keep(start(), layered(files));
  const back = plateOf(await later().load()) ?? assert.fail();
  assert.deepEqual(back, plate);
  const texts = await Promise.all(filesOf(back).map(async ({ name, bytes }) => [name, await bytes.text()]));
  assert.deepEqual(Object.fromEntries(texts), {
    ...{ 'leaf.svg': '<svg/>', 'photo.png': 'pixels', 'modes.png': 'modes', 'Own.ttf': 'letters' },
  });
  const turned = { ...plate, layers: [...plate.layers].reverse().map((layer, k) => ({ ...layer, id: k + 1 })) };
  await keep(start(), turned);
  assert.deepEqual(plateOf(await later().load())?.layers, turned.layers);
});

test('layers that nobody has finished are kept as they are, each with what it has and lacks', async () => {
  const plate = unfinished(files).reduce(withLayer, newPlate());
  await keep(start(), plate);
  assert.deepEqual(plateOf(await later().load()), plate);
  assert.deepEqual(fileKeys(), [shape.id]);
  // One after the other, beside others that have everything.
  for (const layer of unfinished(files)) {
    const one = [newLayer(newPlate(), 'border'), layer, newLayer(newPlate(), 'text', { text: '-' })];
    const mixed = one.reduce(withLayer, newPlate());
    await keep(start(), mixed);
    assert.deepEqual(plateOf(await later().load()), mixed, layer.kind);
  }
});

test('files of equal bytes are one after a reload, for a plate and all its steps', async () => {
  const again = { ...picture, bytes: new Blob(['pixels']) }; // opened twice
  const plate = filledWith(newPlate(), 'brightness', { file: picture, modeFile: again });
  const earlier = filledWith(newPlate(), 'edges', { file: again });
  const later1 = withLayer(plate, newLayer(plate, 'picture', { pictures: [{ file: again, lamp: null }] }));
  const autosave = start();
  autosave.save({ past: [earlier], plate, future: [later1] });
  await autosave.flush();
  assert.equal(box.puts.filter((key) => key.startsWith('file/')).length, 1);
  const kept = await later().load();
  assert.ok(kept !== undefined && 'steps' in kept);
  const { past, plate: now, future } = kept.steps;
  const found = [...past, now, ...future].flatMap(({ layers }) =>
    layers.flatMap(({ file, modeFile, pictures }) => [file, modeFile, ...pictures.map((one) => one.file)]),
  );
  const told = found.filter((file) => file !== null);
  assert.equal(told.length, 5 + 1);
  for (const file of told) assert.equal(file, told[0]);
});

test('a printer that waits for its visitor waits on after a reload, and its spool stays', async () => {
  const brought = { ...newPlate().printer, name: 'Theirs', startGcode: 'G28', profile: 'prusa-mk4s' };
  const spool = { key: 'mine', colour: [1, 2, 3], fine: { nozzleSide: [3, 14], bedSide: [2, 9] } } as const;
  const plate = { ...newPlate(), brought, spool: structuredClone(spool) as unknown as NonNullable<Plate['spool']> };
  await keep(start(), plate);
  assert.deepEqual(plateOf(await later().load()), plate);
});

// --- Other versions ------------------------------------------------------------------------------------------------------

type Told = Record<string, unknown> & { project: Record<string, unknown> };

/** What was kept, its record, and the key of that. */
async function keptRecord(plate: Plate) {
  await keep(start(), plate);
  const kept = structuredClone([...box.kept]);
  const [key = ''] = records();
  const good = box.kept.get(key) as Record<string, unknown> & { plate: Told };
  const refill = (record: unknown): void => {
    box.kept.clear();
    for (const [name, value] of kept) box.kept.set(name, value);
    box.kept.set(key, record);
  };
  return { kept, key, good, refill };
}

/** The record in the storage cannot be opened, is told to be of another version, and stays until its owner deletes it. */
async function staysForeign(key: string, what: string): Promise<void> {
  const before = [...box.kept];
  const autosave = later();
  assert.deepEqual(await autosave.load(), { state: 'foreign' }, what);
  assert.equal(await autosave.open(key.slice('plate/'.length)), undefined, what);
  await keep(autosave, named('another'));
  const [{ id } = assert.fail(what), ...others] = (await autosave.list()).filter(({ foreign }) => foreign);
  assert.deepEqual([`plate/${id}`, others.length], [key, 0]);
  for (const [name, value] of before) assert.equal(box.kept.get(name), value, name);
  assert.equal((await autosave.stored(id)).files.size, 2);
  await autosave.remove(id);
  assert.ok(before.every(([name]) => !box.kept.has(name)));
  assert.deepEqual(problems, []);
}

test('a record of another version stays as it is, is listed, and goes when its owner deletes it', async () => {
  const { good, key, refill } = await keptRecord(withFiles());
  const first = {
    ...{ version: 1, files: [shape.id, picture.id], past: [], future: [] },
    plate: { name: 'first', width: 70, height: 70, shape: { kind: 'disc' }, directions: { kind: 'angle', angle: 3 } },
  };
  const wrong: unknown[] = [
    ...[null, 'text', 7, {}, [], first],
    { ...good, version: 1 },
    { ...good, version: 3 },
    { ...good, files: 'all' },
    { ...good, files: [...(good['files'] as string[]), 'gone'] },
    { ...good, plate: undefined },
    { ...good, plate: 7 },
    { ...good, more: 1 },
  ];
  for (const record of wrong) {
    refill(record);
    await staysForeign(key, JSON.stringify(record));
  }
});

test('a record that the core refuses stays as well, and nothing of it is taken', async () => {
  const { good, key, refill } = await keptRecord(withFiles());
  const { project } = good.plate;
  const studio = project['studio'] as object;
  const told = (change: object): object => ({ ...good, plate: { ...good.plate, project: { ...project, ...change } } });
  const wrong: object[] = [
    { ...good, plate: {} },
    { ...good, plate: { ...good.plate, extra: 1 } },
    { ...good, plate: { project: null } },
    told({ pictures: { spool: 'purple' } }),
    told({ toolpath: { spacing: 1e9 } }),
    told({ layers: [{ kind: 'sparkle' }] }),
    told({ layers: [{ kind: 'strokes', strokes: [{ points: [1] }] }] }),
    told({ printer: { profile: 'unknown' } }),
    told({ sparkle: 1 }),
    told({ studio: { ...studio, version: 3 } }),
    told({ studio: { ...studio, name: 7 } }),
    { ...good, plate: { ...good.plate, brought: { speed: 'fast' } } },
    // Files that the record does not have: no layer that lacks one.
    { ...good, files: [] },
    told({ shape: { file: 'unknown', pageWidth: 70 } }),
    told({ layers: [{ kind: 'map', file: 'unknown' }] }),
    told({ layers: [{ kind: 'picture', pictures: [{ file: picture.id }, { file: 'unknown' }] }] }),
  ];
  for (const record of wrong) {
    refill(record);
    await staysForeign(key, JSON.stringify(record).slice(0, 2000));
  }
});

test('a plate whose file is gone is not opened', async () => {
  const { kept, key, good, refill } = await keptRecord(withFiles());
  for (const gone of [shape.id, picture.id]) {
    refill(good);
    for (const [name] of kept) if (name.endsWith(gone)) box.kept.delete(name);
    const autosave = later();
    assert.deepEqual(await autosave.load(), { state: 'foreign' });
    assert.equal(await autosave.open(key.slice('plate/'.length)), undefined);
  }
});

test('a step that cannot be one is left out, with all before it', async () => {
  const { good, refill } = await keptRecord(withFiles());
  const { plate } = good;
  const bad = { ...plate, project: { ...plate.project, toolpath: { spacing: -1 } } };
  for (const one of [bad, 7, null, { ...plate, more: 1 }]) {
    refill({ ...good, past: [plate, one, plate], future: [plate, plate, one] });
    const found = await later().load();
    assert.ok(found !== undefined && 'steps' in found);
    assert.deepEqual([found.steps.past.length, found.steps.future.length], [1, 2]);
    assert.deepEqual(found.steps.plate, withFiles());
  }
  refill({ ...good, past: 'all', future: 7 });
  const found = await later().load();
  assert.ok(found !== undefined && 'steps' in found);
  assert.deepEqual([found.steps.past, found.steps.future, problems], [[], [], []]);
});

test('an engine that cannot be had keeps nobody from going on, and nothing is lost', async () => {
  await keep(start(), withFiles());
  const before = [...box.kept];
  browser.close();
  const autosave = createAutosave(
    { onProblem: (problem) => problems.push(problem), engine: () => Promise.reject(new Error('not fetched')) },
    ...(['test', box, browser.tab(), { get: () => undefined, set: () => undefined }] as const),
  );
  assert.equal(await autosave.load(), undefined);
  await keep(autosave, named('another'));
  for (const [name, value] of before) assert.equal(box.kept.get(name), value, name);
  assert.equal((await autosave.list()).length, 2);
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

const sliced = (name = 'part.gcode', text = 'G28'): File => new File([text], name);
const wanted = { way: 'hand', chosen: new Set([1, 2]) };
const printOf = (kept: Kept | undefined) => (kept !== undefined && 'steps' in kept ? kept.print : undefined);

test('a sliced print over a plate comes back with it, with what was wanted of it', async () => {
  const first = start();
  await keep(first, named('plate'));
  first.savePrint({ file: sliced(), wish: wanted, open: true });
  mock.timers.tick(500);
  await first.flush();
  const print = printOf(await later().load());
  assert.ok(print !== undefined);
  assert.deepEqual(
    [print.file.name, await print.file.text(), print.wish, print.open],
    ['part.gcode', 'G28', wanted, true],
  );
});

test('the file of a print is written once, and what is wanted of it half a second after the last change', async () => {
  const autosave = start();
  await keep(autosave, named('plate'));
  const file = sliced();
  box.puts = [];
  for (const angle of [1, 2, 3]) {
    autosave.savePrint({ file, wish: { angle }, open: true });
    mock.timers.tick(499);
  }
  assert.equal(box.puts.length, 0);
  await autosave.flush();
  autosave.savePrint({ file, wish: { angle: 4 }, open: false });
  await autosave.flush();
  assert.equal(box.puts.filter((key) => key.endsWith('/file')).length, 1);
  assert.equal(box.puts.length, 3);
  const print = printOf(await later().load());
  assert.deepEqual([print?.wish, print?.open], [{ angle: 4 }, false]);
});

test('a print that is left is kept no more, and goes with its plate', async () => {
  const prints = (): string[] => [...box.kept.keys()].filter((key) => key.startsWith('sliced/'));
  const autosave = start();
  await keep(autosave, named('plate'));
  autosave.savePrint({ file: sliced(), wish: wanted, open: true });
  await autosave.flush();
  assert.equal(prints().length, 2);
  autosave.savePrint(undefined);
  await autosave.flush();
  assert.deepEqual(prints(), []);
  autosave.savePrint({ file: sliced(), wish: wanted, open: true });
  const copy = await autosave.duplicate(autosave.current(), 'copy');
  assert.ok(copy !== undefined);
  assert.equal(prints().length, 2);
  const back = await autosave.remove(autosave.current());
  assert.deepEqual(prints(), []);
  await back();
  assert.equal(prints().length, 2);
});

test('a plate that nobody changed stays in the list while a print lies over it', async () => {
  const first = start();
  const plate = named('fresh');
  first.begin(plate, true);
  await keep(first, plate);
  first.savePrint({ file: sliced(), wish: wanted, open: true });
  await first.flush();
  const second = later();
  await second.list();
  assert.equal(printOf(await second.load())?.file.name, 'part.gcode');
});

test('no room for a print is told once, and its plate is kept all the same', async () => {
  const autosave = start();
  await keep(autosave, named('plate'));
  const file = sliced();
  box.failure = new Error('full');
  autosave.savePrint({ file, wish: wanted, open: true });
  await autosave.flush();
  box.failure = undefined;
  await keep(autosave, named('plate'));
  box.puts = [];
  autosave.savePrint({ file, wish: {}, open: true });
  await autosave.flush();
  assert.deepEqual(
    problems.map(({ code }) => code),
    ['StorageFull'],
  );
  assert.deepEqual(box.puts, []);
});

test('another tab goes on with its own print, and a copy has none', async () => {
  const first = start();
  await keep(first, named('plate'));
  first.savePrint({ file: sliced(), wish: wanted, open: true });
  await first.flush();
  const opened = await start().open(first.current());
  assert.equal(opened?.state, 'copy');
  assert.equal(opened.print, undefined);
});
