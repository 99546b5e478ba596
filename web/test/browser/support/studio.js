// The built studio, served and opened in Chromium, and what tests do with it.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { basename, extname } from 'node:path';
import { fileURLToPath } from 'node:url';

import { lacking, startChromium } from '../../../../wasm/test/support/browsers.js';
import { serve } from '../../../serve.js';
import { smallPlate } from './small.js';
import { patience, until } from './waits.js';

const dist = fileURLToPath(new URL('../../../dist', import.meta.url));
export const inputs = fileURLToPath(new URL('../../../../examples/inputs', import.meta.url));
export const skip = lacking('Chromium');

const types = { '.png': 'image/png', '.svg': 'image/svg+xml', '.jpg': 'image/jpeg', '.json': 'application/json' };

/** A file as the page gets it. */
export const fileAt = (path) => ({
  name: basename(path),
  type: types[extname(path)] ?? '',
  data: readFileSync(path).toString('base64'),
});
export const fileOf = (name, bytes, type = '') => ({ name, type, data: Buffer.from(bytes).toString('base64') });

/** One browser and one server for a file of tests. */
export async function start() {
  assert.ok(existsSync(`${dist}/index.html`), 'there is no web/dist; ./dev build makes it');
  const browser = await startChromium();
  const site = await serve(dist, 0);
  return {
    browser,
    origin: site.origin,
    /** @param options  of the browser's context; `path` of the page; `small`: it begins with a small plate; `visited`: the
     * visitor has been here before, so that it begins with a new plate; `keep`: a context to open it in; `places`: it may ask
     * for files that can be saved in their place; `prepare`: run in the page before its own scripts */
    async open({
      small = false,
      visited = false,
      path = small ? `/${smallPlate}` : '/',
      keep,
      places = false,
      prepare,
      ...options
    } = {}) {
      const context =
        keep ??
        (await browser.newContext({
          viewport: { width: 1000, height: 600 },
          deviceScaleFactor: 0.5, // pictures are drawn in software
          reducedMotion: 'reduce',
          locale: 'en-US',
          acceptDownloads: true,
          serviceWorkers: 'block', // it would fetch and keep all of the studio: a fifth of a visit's CPU time
          ...options,
        }));
      // Playwright answers inputs alone; files in their place have a test of their own.
      if (!places) await context.addInitScript(() => delete globalThis.showOpenFilePicker);
      if (visited) {
        await context.addInitScript(() => {
          localStorage.setItem('sillon.welcomed', 'yes');
        });
      }
      if (prepare !== undefined) await context.addInitScript(prepare);
      const page = await context.newPage();
      page.setDefaultTimeout(patience);
      const problems = [];
      page.on('console', (message) => message.type() === 'error' && problems.push(message.text()));
      page.on('pageerror', (error) => problems.push(String(error)));
      await page.goto(site.origin + path);
      const visit = new Visit(page, context, problems);
      // A page that is long without its link begins with another plate, and then takes what a test has made of that away.
      if (path === `/${smallPlate}`) await visit.until((state) => state.plate.width === 24);
      return visit;
    },
    async close() {
      await browser.close();
      site.close();
    },
  };
}

class Visit {
  constructor(page, context, problems) {
    this.page = page;
    this.context = context;
    /** What the browser's console said of errors. */
    this.problems = problems;
  }

  /** Waits until the plate is whole and measured, and its file is written: a change takes the summary away at once. */
  async idle() {
    await this.page.waitForFunction(() => {
      const state = document.querySelector('sillon-app')?.studio.store.state;
      return (
        state?.result?.measured === true &&
        !state.result.coarse &&
        state.summary !== undefined &&
        state.progress === undefined
      );
    });
  }

  /** A function of the studio's state, run in the page. */
  state(read) {
    return this.page.evaluate(`(${read})(document.querySelector('sillon-app').studio.store.state)`);
  }

  /** Waits until a function of the state gives true: the page's language comes before the studio does. */
  async until(read) {
    await this.page.waitForFunction(() => document.querySelector('sillon-app')?.studio !== undefined);
    try {
      await until(() => this.state(read), read);
    } catch (error) {
      const found = await this.state(({ plate, progress, cancelled, problem, live, result }) => ({
        ...{ name: plate.name, width: plate.width, height: plate.height, directions: plate.directions.kind },
        ...{ progress, cancelled, problem, live, coarse: result?.coarse, measured: result?.measured },
      }));
      error.message += `\nthe studio is at ${JSON.stringify(found)}`;
      throw error;
    }
  }

  /** What the line below the plate says. */
  status() {
    return this.page.locator('sillon-status').locator('.figures, .job').allInnerTexts();
  }

  button(name) {
    return this.page.getByRole('button', { name, exact: true });
  }

  async section(name) {
    await this.page.locator('nav').getByRole('button', { name, exact: true }).click();
  }

  async view(name) {
    await this.page.getByRole('tab', { name, exact: true }).click();
  }

  async download(product) {
    await this.page.locator('[popovertarget=export]').click();
    const [download] = await Promise.all([
      this.page.waitForEvent('download'),
      this.page.locator('#export').getByRole('button', { name: product }).click(),
    ]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }

  /** As if they had been dragged from another window. */
  async drop(files) {
    await this.#hand('drop', files);
  }

  async paste(files, text = '') {
    await this.#hand('paste', files, text);
  }

  async #hand(way, files, text) {
    await this.page.locator('sillon-app').waitFor({ state: 'attached' });
    await this.page.evaluate(
      ({ way, files, text }) => {
        const transfer = new DataTransfer();
        for (const { name, type, data } of files) {
          const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
          transfer.items.add(new File([bytes], name, { type }));
        }
        if (text !== '') transfer.setData('text/plain', text);
        const event =
          way === 'drop'
            ? new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true })
            : new ClipboardEvent('paste', { clipboardData: transfer, bubbles: true, cancelable: true });
        document.querySelector('sillon-app').dispatchEvent(event);
      },
      { way, files, text },
    );
  }

  /** Box of the canvas on the page. */
  canvas() {
    return this.page.locator('sillon-canvas').boundingBox();
  }

  /** Drags over the plate; places are shares of the canvas. */
  async stroke(...places) {
    const box = await this.canvas();
    const at = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
    const [first, ...rest] = places.map(at);
    await this.page.mouse.move(...first);
    await this.page.mouse.down();
    for (const place of rest) await this.page.mouse.move(...place, { steps: 8 });
    await this.page.mouse.up();
  }

  close() {
    return this.context.close();
  }
}
