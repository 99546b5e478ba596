import assert from 'node:assert/strict';
import { test } from 'node:test';
import { newPlate } from '../../src/model/new-plate.js';
import type { Plate } from '../../src/model/plate.js';
import { Store } from '../../src/model/store.js';

interface Small {
  plate: Plate;
  view: string;
}

const newStore = (): Store<Small> => new Store<Small>({ plate: newPlate(), view: 'a' });
const wide =
  (width: number) =>
  (plate: Plate): Plate => ({ ...plate, width });
const turn = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));

test('undo gives back the very plates, redo the ones that were left', () => {
  const store = newStore();
  const plates = [store.state.plate];
  for (const width of [10, 20, 30]) {
    store.change(wide(width));
    plates.push(store.state.plate);
  }
  for (const plate of plates.slice(0, -1).reverse()) {
    store.undo();
    assert.equal(store.state.plate, plate);
  }
  assert.equal(store.canUndo, false);
  for (const plate of plates.slice(1)) {
    store.redo();
    assert.equal(store.state.plate, plate);
  }
  assert.equal(store.canRedo, false);
});

test('a new change drops what could be redone', () => {
  const store = newStore();
  store.change(wide(10));
  store.undo();
  store.change(wide(20));
  assert.equal(store.canRedo, false);
  store.redo();
  assert.equal(store.state.plate.width, 20);
});

test('a drag is one step, until it settles', () => {
  const store = newStore();
  const before = store.state.plate;
  for (const width of [10, 11, 12]) store.change(wide(width), 'width');
  store.settle();
  const between = store.state.plate;
  for (const width of [13, 14]) store.change(wide(width), 'width');
  store.undo();
  assert.equal(store.state.plate, between);
  store.undo();
  assert.equal(store.state.plate, before);
  assert.equal(store.canUndo, false);
});

test('another gesture, or a change without one, is another step', () => {
  const store = newStore();
  store.change(wide(10), 'width');
  store.change((plate) => ({ ...plate, height: 5 }), 'height');
  store.change(wide(11));
  store.change(wide(12));
  let steps = 0;
  for (; store.canUndo; ++steps) store.undo();
  assert.equal(steps, 4);
});

test('after an undo a drag goes on as a new step', () => {
  const store = newStore();
  store.change(wide(10), 'width');
  store.undo();
  store.change(wide(11), 'width');
  assert.equal(store.canUndo, true);
});

test('a change that gives back the same plate is no step and drops nothing', () => {
  const store = newStore();
  store.change(wide(10));
  store.undo();
  store.change((plate) => plate);
  assert.equal(store.canUndo, false);
  assert.equal(store.canRedo, true);
});

test('what is not the plate stays through undo', () => {
  const store = newStore();
  store.change(wide(10));
  store.set({ view: 'b' });
  store.undo();
  assert.equal(store.state.view, 'b');
});

test('the depth is bounded', () => {
  const store = newStore();
  for (let k = 1; k <= 1000; ++k) store.change(wide(k));
  let steps = 0;
  for (; store.canUndo; ++steps) store.undo();
  assert.equal(steps, 200);
  assert.equal(store.state.plate.width, 800);
});

test('a drag that is abandoned has never been: what could be redone still can, as deep as before', () => {
  const store = newStore();
  for (let k = 1; k <= 300; ++k) store.change(wide(k));
  store.undo();
  const { past, plate, future } = store.steps;
  for (const width of [11, 12]) store.change(wide(width), 'width');
  store.abandon();
  assert.deepEqual(store.steps, { past, plate, future });
  assert.equal(store.state.plate, plate);
  store.abandon(); // nothing goes on
  store.change(wide(13), 'width');
  store.settle();
  store.abandon();
  assert.equal(store.state.plate.width, 13);
});

test('random changes, drags, undos and redos agree with plain lists of plates', () => {
  // Numerical Recipes' generator: the same sequences on every run.
  let seed = 1;
  const random = (below: number): number => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    return Math.floor((seed / 2 ** 32) * below);
  };
  for (let round = 0; round < 50; ++round) {
    const store = newStore();
    // The model: all plates of the line of time and the place in it.
    let line = [store.state.plate];
    let at = 0;
    let gesture: number | undefined;
    for (let k = 0; k < 150; ++k) {
      const what = random(10);
      if (what < 5) {
        const drag = what < 3 ? random(2) : undefined;
        store.change(wide(1000 * round + k + 100), drag === undefined ? undefined : `drag ${drag}`);
        if (drag !== undefined && drag === gesture) {
          line[at] = store.state.plate;
        } else {
          line = [...line.slice(0, at + 1), store.state.plate];
          ++at;
        }
        gesture = drag;
      } else if (what < 7) {
        store.undo();
        at = Math.max(0, at - 1);
        gesture = undefined;
      } else if (what < 9) {
        store.redo();
        at = Math.min(line.length - 1, at + 1);
        gesture = undefined;
      } else {
        store.settle();
        gesture = undefined;
      }
      assert.equal(store.state.plate, line[at]);
      assert.equal(store.canUndo, at > 0);
      assert.equal(store.canRedo, at < line.length - 1);
    }
  }
});

test('listeners hear once per turn, with the state before it', async () => {
  const store = newStore();
  const first = store.state;
  const heard: [Readonly<Small>, Readonly<Small>][] = [];
  const end = store.subscribe((state, before) => heard.push([state, before]));
  store.set({ view: 'b' });
  store.change(wide(10));
  store.set({ view: 'c' });
  assert.equal(heard.length, 0);
  await turn();
  assert.deepEqual(heard, [[store.state, first]]);
  assert.equal(store.state.view, 'c');
  end();
  store.set({ view: 'd' });
  await turn();
  assert.equal(heard.length, 1);
});

test('a change made by a listener is told in another round', async () => {
  const store = newStore();
  const heard: string[] = [];
  store.subscribe(({ view }) => {
    heard.push(view);
    if (view === 'b') store.set({ view: 'c' });
  });
  store.set({ view: 'b' });
  await turn();
  assert.deepEqual(heard, ['b', 'c']);
});

test('a listener that throws is reported and does not keep others from hearing', async () => {
  const reported: unknown[] = [];
  const global = globalThis as { reportError?: (error: unknown) => void };
  const { reportError } = global;
  global.reportError = (error) => reported.push(error);
  try {
    const store = newStore();
    const problem = new Error('broken');
    let heard = 0;
    store.subscribe(() => {
      throw problem;
    });
    store.subscribe(() => ++heard);
    store.set({ view: 'b' });
    await turn();
    assert.equal(heard, 1);
    assert.deepEqual(reported, [problem]);
  } finally {
    if (reportError === undefined) delete global.reportError;
    else global.reportError = reportError;
  }
});
