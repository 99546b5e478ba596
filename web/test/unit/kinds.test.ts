// What files are by their bytes, how large drawings are, and what can be seen of pictures and codes.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { qrAngles, qrPicture } from '../../src/generators/qr.js';
import { fitOf } from '../../src/generators/text.js';
import { factsOf } from '../../src/files/guess.js';
import { browserPicture } from '../../src/files/kind.js';
import { hasUnits } from '../../src/files/open.js';
import { newGenerator, newPlate } from '../../src/model/defaults.js';
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

test('a code lies whole within a disc, whatever its margin', async () => {
  const source = { ...newGenerator('qr'), margin: 0 };
  const modules = await qrPicture(source.text);
  const size = { width: 400, height: 400 };
  const corners = (round: boolean): number => {
    const angles = qrAngles(source, size, [50, 50], modules, round);
    const ground = angles[0] as number; // where the page's corner is light, else it is the code's
    let out = 0;
    for (let y = 0, k = 0; y < 400; ++y) {
      for (let x = 0; x < 400; ++x, ++k) {
        if (Math.hypot(x - 199.5, y - 199.5) > 199 && angles[k] !== ground) ++out;
      }
    }
    return out;
  };
  assert.ok(corners(false) > 0, 'the test sees no code that is cut');
  assert.equal(corners(true), 0);
});

test('letters stay within the page, and within a disc', () => {
  assert.equal(fitOf(0.5, 0.2, false), 1);
  assert.equal(fitOf(1.88, 0.2, false), 0.5);
  // The corners of their box lie on an ellipse of 0.94 times the page.
  const fit = fitOf(0.9, 0.9, true);
  assert.ok(Math.abs(Math.hypot(0.9 * fit, 0.9 * fit) - 0.94) < 1e-12);
  assert.equal(fitOf(0.5, 0.2, true), 1);
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
