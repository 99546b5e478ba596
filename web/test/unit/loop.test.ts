import assert from 'node:assert/strict';
import { test } from 'node:test';
import { animatedWebp } from '../../src/files/webp.js';
import { loopLights } from '../../src/views/loop-lights.js';

const rounded = (value: number): number => Number(value.toFixed(3));
/** Returns azimuth, elevation and duration of each frame, to compare with the numbers of tests/look/loop_test.cpp. */
const told = (lamps: [number, number][]): number[][] =>
  loopLights(lamps.map(([azimuth, elevation]) => ({ azimuth, elevation }))).map(({ light, milliseconds }) => [
    rounded(light.azimuth),
    rounded(light.elevation),
    milliseconds,
  ]);

test('one lamp goes round once, in even steps', () => {
  const frames = told([[350, 40]]);
  assert.equal(frames.length, 36);
  assert.deepEqual(frames.slice(0, 3), [
    [350, 40, 100],
    [0, 40, 100],
    [10, 40, 100],
  ]);
  assert.deepEqual(frames.at(-1), [340, 40, 100]); // a step before the first
});

test('several lamps are held in turn, with a quick way to the next, the short way round', () => {
  const frames = told([
    [350, 40],
    [20, 60],
  ]);
  assert.deepEqual(
    frames.map(([, , milliseconds]) => milliseconds),
    [1200, 60, 60, 60, 60, 60, 60, 1200, 60, 60, 60, 60, 60, 60],
  );
  assert.deepEqual(frames[0], [350, 40, 1200]);
  assert.deepEqual(frames[1], [351.662, 41.108, 60]);
  assert.deepEqual(frames[7], [20, 60, 1200]);
  assert.deepEqual(frames[13], [351.662, 41.108, 60]);
});

/** A file of one chunk, as an encoder writes it, or with a canvas of its own before it. */
function still(data: number[], extended = false): Uint8Array {
  const even = data.length % 2 === 0 ? data : [...data, 0];
  const picture = [...Buffer.from('VP8 '), data.length, 0, 0, 0, ...even];
  const before = extended ? [...Buffer.from('VP8X'), 10, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0] : [];
  const body = [...Buffer.from('WEBP'), ...before, ...picture];
  return Uint8Array.of(...Buffer.from('RIFF'), body.length, 0, 0, 0, ...body);
}

interface Chunk {
  name: string;
  data: Buffer;
}

function chunksOf(bytes: Buffer): Chunk[] {
  const chunks: Chunk[] = [];
  for (let at = 0; at < bytes.length;) {
    const length = bytes.readUInt32LE(at + 4);
    chunks.push({ name: bytes.toString('latin1', at, at + 4), data: bytes.subarray(at + 8, at + 8 + length) });
    at += 8 + length + (length % 2);
  }
  return chunks;
}

test('frames lie in the container in turn, whole and for as long as they are shown', () => {
  const frames = [
    { bytes: still([1, 2, 3]), milliseconds: 1200 },
    { bytes: still([4, 5], true), milliseconds: 60 },
  ];
  const file = Buffer.from(animatedWebp(frames, 560, 300));
  const [riff, ...more] = chunksOf(file) as [Chunk, ...Chunk[]];
  assert.deepEqual([riff.name, more.length], ['RIFF', 0]);
  assert.equal(riff.data.toString('latin1', 0, 4), 'WEBP');
  const inside = chunksOf(riff.data.subarray(4));
  assert.deepEqual(
    inside.map(({ name }) => name),
    ['VP8X', 'ANIM', 'ANMF', 'ANMF'],
  );
  const [canvas, loop, first, second] = inside.map(({ data }) => data) as [Buffer, Buffer, Buffer, Buffer];
  assert.equal(canvas[0], 2); // animated, without transparency
  assert.deepEqual([canvas.readUIntLE(4, 3) + 1, canvas.readUIntLE(7, 3) + 1], [560, 300]);
  assert.equal(loop.readUInt16LE(4), 0); // without end
  for (const [data, milliseconds, picture] of [
    [first, 1200, [1, 2, 3]],
    [second, 60, [4, 5]],
  ] as const) {
    assert.deepEqual([data.readUIntLE(6, 3) + 1, data.readUIntLE(9, 3) + 1], [560, 300]);
    assert.equal(data.readUIntLE(12, 3), milliseconds);
    const [own, ...rest] = chunksOf(data.subarray(16)) as [Chunk, ...Chunk[]];
    assert.deepEqual([own.name, [...own.data], rest.length], ['VP8 ', picture, 0]);
  }
});
