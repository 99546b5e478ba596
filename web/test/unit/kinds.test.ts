// What files are by their bytes, how large drawings are, and what can be seen of pictures.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { factsOf } from '../../src/files/guess.js';
import { browserPicture } from '../../src/files/kind.js';
import { hasUnits } from '../../src/files/open.js';
import { newPlate } from '../../src/model/new-plate.js';
import { isOf } from '../../src/model/result.js';
import type { PlateResult } from '../../src/model/state.js';
import { fileOf, greyPicture } from './support/pictures.js';

test('pictures that only browsers read are known by their first bytes', () => {
  const of = (text: string): string => browserPicture(Uint8Array.from(text, (letter) => letter.charCodeAt(0)));
  assert.equal(of('GIF89a'), 'image/gif');
  assert.equal(of('RIFF\x10\0\0\0WEBPVP8 '), 'image/webp');
  assert.equal(of('RIFF\x10\0\0\0WAVEfmt '), '');
  assert.equal(of('\0\0\0\x20ftypavif\0\0\0\0avifmif1'), 'image/avif');
  assert.equal(of('\0\0\0\x18ftypmif1\0\0\0\0mif1avif'), 'image/avif');
  assert.equal(of('\0\0\0\x18ftypheic\0\0\0\0mif1heic'), 'image/heic');
  assert.equal(of('\0\0\0\x18ftypmp42\0\0\0\0mp42isom'), '');
  assert.equal(of(''), '');
});

test('a drawing without units says nothing of its size', async () => {
  const says = (attributes: string): Promise<boolean> =>
    hasUnits(fileOf('a.svg', `<?xml version="1.0"?><svg ${attributes}/>`));
  assert.equal(await says('width="24" height="24" viewBox="0 0 24 24"'), false);
  assert.equal(await says('viewBox="0 0 72 72"'), false);
  assert.equal(await says('width="300px" height="200px"'), false);
  assert.equal(await says('width="100%"'), false);
  assert.equal(await says('width="20mm" height="16mm"'), true);
  assert.equal(await says("viewBox='0 0 1 1' height = '2.5 in'"), true);
  // What stands in another element counts for nothing.
  assert.equal(await hasUnits(fileOf('a.svg', '<svg viewBox="0 0 1 1"><rect width="2mm"/></svg>')), false);
});

test('a picture of one tone is known, and one of two or many is not', () => {
  assert.ok(factsOf(greyPicture(40, 40, () => 0.5)).oneTone);
  assert.ok(factsOf(greyPicture(40, 40, (x) => 0.5 + 0.01 * (x % 2))).oneTone);
  assert.ok(!factsOf(greyPicture(40, 40, (x) => x / 40)).oneTone);
  assert.ok(!factsOf(greyPicture(40, 40, (x) => (x < 2 ? 1 : 0))).oneTone);
});

test('figures belong to the plate that they were made of', () => {
  const plate = newPlate();
  const result = { plate } as PlateResult;
  assert.ok(isOf(result, { ...plate, name: 'other', print: { ...plate.print }, printer: { ...plate.printer } }));
  assert.ok(!isOf(result, { ...plate, width: 1000, height: 1000 }));
  assert.ok(!isOf(result, { ...plate, toolpath: { ...plate.toolpath } }));
  // The spool counts where pictures are made for it.
  assert.ok(isOf(result, { ...plate, pictures: { ...plate.pictures, spool: 'bluePla' } }));
});
