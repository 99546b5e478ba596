// ./dev pictures draws web/public/preview.jpg in Chromium: messengers show it as the card of the studio's address.
import { readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

import { startChromium } from '../wasm/test/support/browsers.js';
import { plate, scratch, sunMoon, wave } from './pictures.mjs';

const at = (path) => fileURLToPath(new URL(`../${path}`, import.meta.url));
const base64 = (path) => readFileSync(at(path)).toString('base64');

const html = `<style>
  @font-face { font-family: name; src: url(data:font/ttf;base64,${base64('core/data/fonts/nunito.ttf')}); }
  body { margin: 0; width: 1200px; height: 630px; background: #262422; color: #e8e4dc; font: 44px name; }
  canvas { position: absolute; }
  p { position: absolute; left: 56px; bottom: 22px; margin: 0; }
</style><p>Sillon: pictures in one filament</p>`;

/** Runs in the page, and puts one frame of a moving picture in its place. */
async function show({ data, share, left, top, width, height }) {
  const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
  const decoder = new globalThis.ImageDecoder({ data: bytes, type: 'image/webp' });
  await decoder.tracks.ready;
  const frameIndex = Math.floor(share * decoder.tracks.selectedTrack.frameCount);
  const { image } = await decoder.decode({ frameIndex });
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  Object.assign(canvas.style, { left: `${left}px`, top: `${top}px` });
  canvas.getContext('2d').drawImage(image, 0, 0, width, height);
  document.body.append(canvas);
}

/** Draws a moving picture as large as the card shows it. */
function drawn(name, width, line) {
  plate(name, width, line).draw(scratch);
  return readFileSync(join(scratch, name)).toString('base64');
}

/** @param path  of the JPEG */
export async function drawCard(path) {
  const discs = drawn('card-discs.webp', 268, sunMoon);
  const parts = [
    { data: discs, share: 0, left: 40, top: 10, width: 268, height: 268 },
    { data: discs, share: 0.5, left: 40, top: 280, width: 268, height: 268 },
    { data: drawn('card-wave.webp', 800, wave), share: 0.15, left: 350, top: 10, width: 800, height: 538 },
  ];
  const browser = await startChromium();
  try {
    const page = await browser.newPage({ viewport: { width: 1200, height: 630 } });
    await page.route('http://localhost/', (route) => route.fulfill({ contentType: 'text/html', body: html }));
    await page.goto('http://localhost/'); // decoders need an origin that is trusted
    for (const part of parts) await page.evaluate(show, part);
    await page.evaluate(() => document.fonts.ready);
    writeFileSync(path, await page.screenshot({ type: 'jpeg', quality: 85 }));
  } finally {
    await browser.close();
  }
}

if (process.argv[1] !== undefined && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
  await drawCard(at('web/public/preview.jpg'));
}
