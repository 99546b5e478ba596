// The page's side and the worker's side of the worker of directions, joined by a worker that is none.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';

import type { Picture } from 'sillon';

import { createRasteriser, type Wanted } from '../../src/generators/rasteriser.js';
import { rasterise } from '../../src/generators/rasterise.js';
import type { Request } from '../../src/generators/request.js';
import { createServer } from '../../src/generators/serve.js';
import { newFileDirections, newGenerator } from '../../src/model/defaults.js';
import type { SourceFile, Stroke } from '../../src/model/plate.js';
import { fileOf, greyPicture } from './support/pictures.js';

/** Clones and transfers as a worker does, and answers one turn later. */
class FakeWorker {
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onerror: ((event: { message: string }) => void) | null = null;
  ended = false;
  readonly requests: Request[] = [];
  crashNext = false;
  readonly #serve = createServer((_, { width, height }) => greyPicture(width, height, (x) => (x < 5 ? 1 : 0)));

  postMessage(message: Request, transfer: ArrayBuffer[]): void {
    const request = structuredClone(message, { transfer });
    this.requests.push(request);
    void this.#serve(request).then((reply) => {
      if (this.ended) return;
      if (this.crashNext) this.onerror?.({ message: 'out of memory' });
      else this.onmessage?.({ data: structuredClone(reply) });
    });
  }

  terminate(): void {
    this.ended = true;
  }
}

function setUp() {
  const workers: FakeWorker[] = [];
  const decoded: string[] = [];
  const picture = (): Picture => greyPicture(40, 40, (x) => x / 39);
  const rasteriser = createRasteriser(
    (file: SourceFile) => {
      decoded.push(file.name);
      if (file.name === 'broken.png') return Promise.reject(new Error('it is cut off'));
      return Promise.resolve(picture());
    },
    () => {
      const worker = new FakeWorker();
      workers.push(worker);
      return worker as unknown as Worker;
    },
  );
  return { rasteriser, workers, decoded, picture };
}

const waves: Wanted = {
  source: newGenerator('waves'),
  modes: { mode: 'constrained' },
  strokes: [],
  page: [70, 70],
  resolution: 50,
};
const stroke = (x: number): Stroke => ({ tool: 'comb', points: [x, 0, x, 1], radius: 0.1, softness: 0.5 });
const directly = ({ source, modes, strokes, page, resolution }: Wanted, picture?: Picture) =>
  rasterise(source, modes, strokes, page, resolution, picture === undefined ? {} : { source: picture });

describe('rasteriser', () => {
  test('gives what the pure functions give, also for codes and letters', async () => {
    const { rasteriser } = setUp();
    assert.deepEqual(await rasteriser.rasterise(waves), directly(waves));
    const letters = { ...waves, source: newGenerator('text') };
    const drawn = greyPicture(50, 50, (x) => (x < 5 ? 1 : 0));
    assert.deepEqual(await rasteriser.rasterise(letters), directly(letters, drawn));
    const code = await rasteriser.rasterise({ ...waves, source: newGenerator('qr') });
    assert.equal(new Set(code?.angle).size, 2);
  });

  test('while one runs only the newest of the others waits', async () => {
    const { rasteriser, workers } = setUp();
    const calls = [10, 20, 30, 40].map((resolution) => rasteriser.rasterise({ ...waves, resolution }));
    const sizes = (await Promise.all(calls)).map((raster) => raster?.width);
    assert.deepEqual(sizes, [10, undefined, undefined, 40]);
    assert.equal(workers[0]?.requests.length, 2);
  });

  test('only what is new of strokes is sent, in any order of undo and redo', async () => {
    const { rasteriser, workers } = setUp();
    const [a, b, c] = [stroke(0.2), stroke(0.5), stroke(0.8)];
    for (const strokes of [[a], [a, b], [a, b, c], [a], [a, c], [], [c, b, a]]) {
      const wanted = { ...waves, strokes };
      assert.deepEqual(await rasteriser.rasterise(wanted), directly(wanted));
    }
    const sent = workers[0]?.requests.map(({ keptStrokes, newStrokes }) => [keptStrokes, newStrokes.length]);
    assert.deepEqual(sent, [
      [0, 1],
      [1, 1],
      [2, 1],
      [1, 0],
      [1, 1],
      [0, 0],
      [0, 3],
    ]);
  });

  test('a file is decoded and sent once while it is in use', async () => {
    const { rasteriser, workers, decoded, picture } = setUp();
    const source = newFileDirections('tone', fileOf('a.png'));
    for (const contrast of [1, 2, 3]) {
      const wanted = { ...waves, source: { ...source, contrast } };
      assert.deepEqual(await rasteriser.rasterise(wanted), directly(wanted, picture()));
    }
    assert.deepEqual(decoded, ['a.png']);
    await rasteriser.rasterise({ ...waves, source, modes: { mode: 'parallel', file: fileOf('a.png') } });
    assert.deepEqual(decoded, ['a.png']);
    await rasteriser.rasterise(waves);
    await rasteriser.rasterise({ ...waves, source });
    assert.deepEqual(decoded, ['a.png', 'a.png']);
    assert.deepEqual(
      workers[0]?.requests.map(({ pictures }) => pictures.size),
      [1, 0, 0, 0, 0, 1],
    );
  });

  test('errors come out, and the next call works', async () => {
    const { rasteriser } = setUp();
    const broken = { ...waves, source: newFileDirections('tone', fileOf('broken.png')) };
    await assert.rejects(rasteriser.rasterise(broken), /cut off/);
    const long = { ...waves, source: { ...newGenerator('qr'), text: 'x'.repeat(3000) } };
    await assert.rejects(rasteriser.rasterise(long), { code: 'TextTooLong', values: { length: 3000, most: 2331 } });
    assert.deepEqual(await rasteriser.rasterise(waves), directly(waves));
  });

  test('a worker that ends is replaced, and gets all files and strokes again', async () => {
    const { rasteriser, workers, picture } = setUp();
    const wanted = {
      ...waves,
      source: newFileDirections('tone', fileOf('a.png')),
      strokes: [stroke(0.3), stroke(0.6)],
    };
    await rasteriser.rasterise(wanted);
    const [first] = workers;
    assert.ok(first);
    first.crashNext = true;
    await assert.rejects(rasteriser.rasterise(wanted), { code: 'Crashed' });
    assert.ok(first.ended);
    assert.deepEqual(await rasteriser.rasterise(wanted), directly(wanted, picture()));
    assert.equal(workers.length, 2);
  });
});
