// Pictures of README and docs show what the program makes today: all are drawn again and compared.
import assert from 'node:assert/strict';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { after, test } from 'node:test';

import { lacking, startChromium } from '../../wasm/test/support/browsers.js';
import { drawCard } from '../../tools/card.mjs';
import { drawPictures, pictures } from '../../tools/pictures.mjs';
import { contentsOf } from '../markdown.mjs';
import { isPicture, pages, root, sources, targetOf } from '../pages.mjs';

const folder = mkdtempSync(join(tmpdir(), 'sillon-pictures-'));
after(() => rmSync(folder, { recursive: true }));

const names = pictures.flatMap(({ names }) => names);
/** It is drawn by ./dev generate. Pages show the studio as web/test/browser/screens.test.js compares it. */
const others = ['docs/pictures/rooms.svg'];
const mostBytes = { readme: 1_000_000, guide: 150_000 };

test('every picture in docs is drawn by a command, and stands on a page', () => {
  const drawn = [...names.map((name) => `docs/pictures/${name}`), ...others];
  const there = sources('docs').filter(isPicture);
  assert.deepEqual(there.sort(), drawn.sort());
  const shown = new Set(
    pages().flatMap((page) =>
      contentsOf(readFileSync(join(root, page), 'utf8')).links.map((href) => targetOf(page, href)),
    ),
  );
  assert.deepEqual(
    there.filter((path) => !shown.has(path)),
    [],
  );
});

test('README has 800 words at most, and what it shows first is less than a megabyte', () => {
  const text = readFileSync(join(root, 'README.md'), 'utf8');
  assert.ok(text.split(/\s+/).filter((word) => word !== '').length <= 800);
  const first = text.slice(0, text.indexOf('\n## '));
  const files = [...first.matchAll(/!\[[^\]]*\]\(([^)]+)\)/g)].map(([, path]) => path);
  assert.ok(files.some((path) => path.endsWith('.webp')));
  const bytes = files.reduce((sum, path) => sum + readFileSync(join(root, path)).length, 0);
  assert.ok(bytes < mostBytes.readme, `${bytes} bytes`);
});

/** Moving pictures are compared as they are seen, because each version of libwebp writes other bytes. */
const mostDifference = 1; // of 255, mean over a frame

/** Gives the greatest mean difference of a frame; Infinity if the pictures have not the same frames. */
async function differenceOf(browser, type, ...files) {
  const page = await browser.newPage();
  try {
    await page.route('http://localhost/', (route) => route.fulfill({ contentType: 'text/html', body: '' }));
    await page.goto('http://localhost/'); // decoders need an origin that is trusted
    return await page.evaluate(
      async ({ type, files }) => {
        const frames = async (data) => {
          const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
          const decoder = new globalThis.ImageDecoder({ data: bytes, type });
          await decoder.tracks.ready;
          const all = [];
          for (let frameIndex = 0; frameIndex < decoder.tracks.selectedTrack.frameCount; ++frameIndex) {
            const { image } = await decoder.decode({ frameIndex });
            const canvas = new OffscreenCanvas(image.displayWidth, image.displayHeight);
            const context = canvas.getContext('2d');
            context.drawImage(image, 0, 0);
            all.push(context.getImageData(0, 0, canvas.width, canvas.height).data);
          }
          return all;
        };
        const [before, now] = await Promise.all(files.map(frames));
        if (before.length !== now.length) return Infinity;
        const differences = before.map((frame, k) => {
          if (frame.length !== now[k].length) return Infinity;
          return frame.reduce((sum, value, at) => sum + Math.abs(value - now[k][at]), 0) / (frame.length * 0.75);
        });
        return Math.max(...differences);
      },
      { type, files: files.map((path) => readFileSync(path).toString('base64')) },
    );
  } finally {
    await page.close();
  }
}

test('every picture is what the program draws today', async () => {
  drawPictures(folder);
  assert.deepEqual(readdirSync(folder).sort(), [...names].sort());
  let browser;
  const old = [];
  for (const name of names) {
    const kept = join(root, 'docs/pictures', name);
    const now = join(folder, name);
    if (readFileSync(kept).equals(readFileSync(now))) continue;
    if (name.endsWith('.webp') && !lacking('Chromium')) {
      browser ??= await startChromium();
      if ((await differenceOf(browser, 'image/webp', kept, now)) <= mostDifference) continue;
    }
    old.push(basename(name));
  }
  await browser?.close();
  assert.deepEqual(old, [], './dev pictures draws them anew; look at them');
});

test('the card of the studio is drawn of the same plates', { skip: lacking('Chromium') }, async () => {
  const now = join(folder, 'preview.jpg');
  await drawCard(now);
  const browser = await startChromium();
  try {
    const difference = await differenceOf(browser, 'image/jpeg', join(root, 'web/public/preview.jpg'), now);
    assert.ok(difference <= mostDifference, `${difference} of 255; ./dev pictures draws it anew`);
  } finally {
    await browser.close();
  }
});

test('pictures of guides are small', () => {
  const large = pages()
    .filter((page) => /^docs\/guide\/(start|tutorial|layers|rebrush|zones|shapes)\.md$/.test(page))
    .flatMap((page) => contentsOf(readFileSync(join(root, page), 'utf8')).links.map((href) => targetOf(page, href)))
    .filter((path) => isPicture(path) && readFileSync(join(root, path)).length > mostBytes.guide);
  assert.deepEqual(large, []);
});
