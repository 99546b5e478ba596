import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { crc32 as zlibCrc32, inflateSync } from 'node:zlib';
import { createEngine, type Engine } from 'sillon';
import { crc32, encodeGreyPng } from '../../src/files/png16.js';
import { chances } from './support/pictures.js';

let engine: Engine;
before(async () => {
  engine = await createEngine({ threads: 'off' });
});
after(() => {
  engine.dispose();
});

const ofLength = (length: number, at: (k: number) => number): Uint16Array =>
  Uint16Array.from({ length }, (_, k) => at(k));

test('the checksum is the usual one', () => {
  assert.equal(crc32(new TextEncoder().encode('123456789')), 0xcbf43926);
  assert.equal(crc32(new Uint8Array(0)), 0);
  if (typeof zlibCrc32 === 'function') assert.equal(crc32(Uint8Array.of(1, 2, 3)), zlibCrc32(Uint8Array.of(1, 2, 3)));
});

test('the engine reads every sample back', async () => {
  const chance = chances(7);
  const pictures: [string, number, number, Uint8Array | Uint16Array][] = [
    ['one sample', 1, 1, Uint16Array.of(0x1234)],
    ['noise', 37, 23, ofLength(37 * 23, () => Math.floor(65536 * chance()))],
    ['a ramp across', 300, 20, ofLength(6000, (k) => (k % 300) * 218)],
    ['a ramp down', 20, 300, ofLength(6000, (k) => Math.floor(k / 20) * 218)],
    ['bytes', 41, 17, Uint8Array.from({ length: 41 * 17 }, () => Math.floor(256 * chance()))],
    ['modes', 64, 64, Uint8Array.from({ length: 4096 }, (_, k) => 85 * (k % 4))],
  ];
  for (const [what, width, height, samples] of pictures) {
    const picture = await engine.decodePicture(await encodeGreyPng(width, height, samples));
    assert.deepEqual([picture.width, picture.height, picture.channels], [width, height, 1], what);
    const scale = picture.samples.BYTES_PER_ELEMENT > samples.BYTES_PER_ELEMENT ? 257 : 1;
    assert.deepEqual(
      Array.from(picture.samples),
      Array.from(samples, (sample) => sample * scale),
      what,
    );
  }
});

test('each row is told in the way that suits it', async () => {
  const filtersOf = async (samples: Uint16Array): Promise<Set<number>> => {
    const png = await encodeGreyPng(256, 64, samples);
    const at = Buffer.from(png).indexOf('IDAT');
    const rows = inflateSync(png.subarray(at + 4, png.length - 16));
    return new Set(Array.from({ length: 64 }, (_, y) => rows[y * 513] as number).slice(1));
  };
  assert.deepEqual(await filtersOf(ofLength(256 * 64, (k) => 257 * (k % 256))), new Set([2]), 'columns');
  assert.deepEqual(await filtersOf(ofLength(256 * 64, (k) => 257 * ((k >> 8) * 40 + ((k & 255) >> 2)))), new Set([1]));
});

test('smooth directions take less room than as they are', async () => {
  const samples = ofLength(512 * 512, (k) => 100 * (k % 512) + 7 * Math.floor(k / 512));
  const png = await encodeGreyPng(512, 512, samples);
  assert.ok(png.length < samples.byteLength / 10, `${png.length} bytes`);
  assert.deepEqual(await encodeGreyPng(512, 512, samples), png);
});
