// Draws the pictures of the examples anew, from the built studio: node web/gallery.js
import { mkdirSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import { startChromium } from '../wasm/test/support/browsers.js';
import { serve } from './serve.js';

const folder = fileURLToPath(new URL('public/gallery', import.meta.url));
const side = 320;

/** Runs in the page. */
async function picture(index, side) {
  const { studio } = document.querySelector('sillon-app');
  const { store } = studio;
  const until = async (done) => {
    while (!done()) await new Promise((resolve) => setTimeout(resolve, 30));
  };
  studio.show('gallery');
  const inside = (element, name) => element?.renderRoot?.querySelector(name);
  const gallery = () => inside(document.querySelector('sillon-app'), 'sillon-gallery');
  await until(() => inside(gallery(), 'li') !== undefined && inside(gallery(), 'li') !== null);
  const button = gallery().renderRoot.querySelectorAll('li button')[index];
  if (button === undefined) return undefined;
  const id = /(\w+)\.webp$/.exec(button.querySelector('img').src)[1];
  const before = store.state.plate;
  button.click();
  await until(() => store.state.plate !== before);
  await until(() => store.state.made?.plate === store.state.plate && store.state.made.measured);
  store.set({ light: { azimuth: 62, elevation: 38 }, lightMode: 'fixed', compare: false });
  const image = await createImageBitmap(await studio.stage.capture(4 * side));
  const canvas = document.createElement('canvas');
  canvas.width = side;
  canvas.height = side;
  const scale = side / Math.max(image.width, image.height);
  const [width, height] = [image.width * scale, image.height * scale];
  const context = canvas.getContext('2d');
  context.imageSmoothingQuality = 'high';
  context.drawImage(image, (side - width) / 2, (side - height) / 2, width, height);
  return { id, data: canvas.toDataURL('image/webp', 0.7) };
}

const { origin, close } = await serve(fileURLToPath(new URL('dist', import.meta.url)), 0);
const browser = await startChromium();
try {
  const page = await browser.newPage({ viewport: { width: 1000, height: 700 }, reducedMotion: 'reduce' });
  await page.goto(origin);
  await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.made?.measured);
  mkdirSync(folder, { recursive: true });
  for (let index = 0; ; ++index) {
    // One string: the page's policy forbids nothing that the tool itself runs.
    const made = await page.evaluate(`(${picture})(${index}, ${side})`);
    if (made === undefined) break;
    const bytes = Buffer.from(made.data.split(',')[1], 'base64');
    writeFileSync(`${folder}/${made.id}.webp`, bytes);
    console.log(`${made.id}.webp ${bytes.length}`);
  }
} finally {
  await browser.close();
  close();
}
