// Draws the pictures of the examples and of the qualities anew, and the view of the example that the studio opens with, from
// the built studio: node web/gallery.js
import { mkdirSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import { startChromium } from '../wasm/test/support/browsers.js';
import { serve } from './serve.js';
import { linkOf } from './test/browser/support/small.js';

const folder = fileURLToPath(new URL('public/gallery', import.meta.url));
const opening = fileURLToPath(new URL('public/opening.view.png', import.meta.url));
const presets = fileURLToPath(new URL('public/presets', import.meta.url));
const side = 320;
const presetSide = 128;
/** Small, so that single beads are seen. */
const sample = linkOf({
  shape: { builtin: 'disc', size: [10, 10] },
  layers: [{ kind: 'pattern', pattern: 'waves', angle: 20, amplitude: 50, waveLength: 6 }],
  pictures: { spool: 'greyPla' },
});

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
  await until(() => store.state.result?.plate === store.state.plate && store.state.result.measured);
  const light = studio.lamps()[0] ?? { azimuth: 62, elevation: 38 };
  store.set({ light, lightMode: 'fixed', compare: false });
  const image = await createImageBitmap(await studio.stage.capture(4 * side));
  const canvas = document.createElement('canvas');
  canvas.width = side;
  canvas.height = side;
  const scale = side / Math.max(image.width, image.height);
  const [width, height] = [image.width * scale, image.height * scale];
  const context = canvas.getContext('2d');
  context.imageSmoothingQuality = 'high';
  context.drawImage(image, (side - width) / 2, (side - height) / 2, width, height);
  const view = new Uint8Array(await (await studio.services.view()).arrayBuffer());
  return { id, data: canvas.toDataURL('image/webp', 0.7), view: view.toBase64() };
}

/** Of the sample in one quality, by its place in the list; runs in the page. */
async function quality(index, side) {
  const { studio } = document.querySelector('sillon-app');
  const { store } = studio;
  const until = async (done) => {
    while (!done()) await new Promise((resolve) => setTimeout(resolve, 30));
  };
  studio.setPanel('toolpath');
  const buttons = () =>
    document
      .querySelector('sillon-app')
      .renderRoot.querySelector('sillon-toolpath-panel')
      ?.renderRoot.querySelectorAll('input[name=quality]') ?? [];
  await until(() => buttons().length > 0);
  const button = buttons()[index];
  if (button === undefined) return undefined;
  if (!button.checked) button.click();
  await until(() => button.checked && store.state.result?.plate === store.state.plate && store.state.result.measured);
  store.set({ light: { azimuth: 62, elevation: 38 }, lightMode: 'fixed', compare: false });
  const image = await createImageBitmap(await studio.stage.capture(8 * side));
  const canvas = document.createElement('canvas');
  canvas.width = side;
  canvas.height = side;
  const context = canvas.getContext('2d');
  context.imageSmoothingQuality = 'high';
  // The upper left part, with the border.
  const [left, top, part] = [0.12 * image.width, 0.08 * image.height, 0.34 * image.width];
  context.drawImage(image, left, top, part, part, 0, 0, side, side);
  return { id: button.value, data: canvas.toDataURL('image/webp', 0.8) };
}

const { origin, close } = await serve(fileURLToPath(new URL('dist', import.meta.url)), 0);
const browser = await startChromium();
try {
  const page = await browser.newPage({ viewport: { width: 1000, height: 700 }, reducedMotion: 'reduce' });
  await page.goto(origin);
  await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result?.measured);
  mkdirSync(folder, { recursive: true });
  for (let index = 0; ; ++index) {
    // One string: the page's policy forbids nothing that the tool itself runs.
    const made = await page.evaluate(`(${picture})(${index}, ${side})`);
    if (made === undefined) break;
    const bytes = Buffer.from(made.data.split(',')[1], 'base64');
    writeFileSync(`${folder}/${made.id}.webp`, bytes);
    console.log(`${made.id}.webp ${bytes.length}`);
    if (index === 0) writeFileSync(opening, Buffer.from(made.view, 'base64'));
  }
  await page.goto(`${origin}/${sample}`);
  await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result?.measured);
  mkdirSync(presets, { recursive: true });
  for (let index = 0; ; ++index) {
    const made = await page.evaluate(`(${quality})(${index}, ${presetSide})`);
    if (made === undefined) break;
    const bytes = Buffer.from(made.data.split(',')[1], 'base64');
    writeFileSync(`${presets}/${made.id}.webp`, bytes);
    console.log(`presets/${made.id}.webp ${bytes.length}`);
  }
} finally {
  await browser.close();
  close();
}
