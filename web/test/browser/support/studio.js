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

/** An answer to the sheet that asks for a printer before the first file: none in particular. */
const printed = ['sillon.print', JSON.stringify({ profile: 'generic' })];

/** Runs in a page that has just begun, and later brings it back to where it was then: a page costs as much as ten changes. */
async function beginAgain({ language, printed }) {
  const { studio } = document.querySelector('sillon-app');
  const { store } = studio;
  const followsFromPlate = ['directions', 'result', 'summary', 'check', 'progress', 'marks', 'scan', 'engine'];
  const shown = Object.entries(store.state).filter(([name]) => !followsFromPlate.includes(name));
  globalThis.begun ??= { ...Object.fromEntries(shown), notices: [] };
  const { plate, ...others } = globalThis.begun;
  // Services that a test has replaced by its own would answer the next test, too.
  globalThis.ownServices ??= { ...studio.services };
  Object.assign(studio.services, globalThis.ownServices);
  const frames = async () => {
    for (let k = 0; k < 2; ++k) await new Promise((resolve) => requestAnimationFrame(resolve));
  };
  const all = (root) =>
    [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
  for (const one of all(document)) if (one.matches(':popover-open')) one.hidePopover();
  for (let one = document.activeElement; one; one = one.shadowRoot?.activeElement) one.blur();
  document.documentElement.style.fontSize = '';
  const { cancelled } = store.state;
  store.set({ panel: '', dialog: undefined, view: 'directions' });
  await frames(); // what was open is gone, with its places and choices
  await studio.setLanguage(language);
  if (store.state.plate !== plate) studio.services.newPlate(); // a record of its own in the storage
  store.restore({ past: [], plate, future: [] });
  const panel = matchMedia('(min-width: 721px)').matches ? 'layers' : '';
  store.set({ ...others, panel, language });
  studio.setOpened(undefined);
  studio.stage.fit();
  if (cancelled) studio.services.retry();
  await frames();
  localStorage.clear();
  localStorage.setItem(...printed);
  sessionStorage.clear();
}

const desk = { width: 1000, height: 600 };

/** Tells whether a visit is about what happens in a page, whatever has happened there before, so that it need not load it. */
const isPlain = ({ small, path, ...options }) =>
  (path === undefined ? small === true : path.startsWith('/#plate=')) &&
  Object.keys(options).every((name) =>
    ['viewport', 'colorScheme', 'language', 'locale', 'hasTouch', 'isMobile'].includes(name),
  );

/** One browser and one server for a file of tests. */
export async function start() {
  assert.ok(existsSync(`${dist}/index.html`), 'there is no web/dist; ./dev build makes it');
  const browser = await startChromium();
  const site = await serve(dist, 0);
  /** Pages that one visit leaves to the next, by the options of their contexts. */
  const left = new Map();
  const taken = new Set();

  const load = async ({
    small = false,
    visited = false,
    asks = false,
    path = small ? `/${smallPlate}` : '/',
    keep,
    places = false,
    prepare,
    language,
    ...options
  } = {}) => {
    const context =
      keep ??
      (await browser.newContext({
        viewport: desk,
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
    if (!asks) {
      await context.addInitScript(([name, text]) => {
        try {
          if (localStorage.getItem(name) === null) localStorage.setItem(name, text);
        } catch {
          // denied: it is asked
        }
      }, printed);
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
    if (language !== undefined)
      await page.evaluate((name) => document.querySelector('sillon-app').studio.setLanguage(name), language);
    return visit;
  };

  /** A page that another visit has left, or a new one for the next visits, at its beginning. */
  const reuse = async ({ path, viewport = desk, colorScheme = 'light', language, ...options }) => {
    const { small: _, ...made } = options;
    const key = JSON.stringify(Object.entries(made).sort());
    if (taken.has(key)) return load({ ...made, path: path ?? `/${smallPlate}`, viewport, colorScheme, language });
    taken.add(key);
    const visit = left.get(key) ?? (await load({ ...made, small: true, viewport }));
    left.delete(key);
    visit.key = key;
    const { page } = visit;
    await page.setViewportSize(viewport);
    await page.emulateMedia({ colorScheme });
    await page.mouse.move(0, 0);
    await page.evaluate(beginAgain, { language: language ?? (options.locale ?? 'en').slice(0, 2), printed });
    if (path !== undefined) {
      await page.evaluate((hash) => (location.hash = hash), path.slice(1));
      await page.waitForFunction(() => {
        const { begun } = globalThis;
        return location.hash === '' && document.querySelector('sillon-app').studio.store.state.plate !== begun.plate;
      });
    }
    return visit;
  };

  return {
    browser,
    origin: site.origin,
    /** A visit to the studio. One with a `small` plate or another plate's link, and no more than a window, a language or colours of
     * its own, may find a page that another visit has left, brought back to its beginning.
     * @param options  of the browser's context; `path` of the page; `small`: it begins with a small plate; `visited`: the
     * visitor has been here before, so that it begins with a new plate; `asks`: nobody has said which printer files are for;
     * `fresh`: in a page of its own, as what is tested is the
     * loading, the storage, or a change of the browser that would stay; `language` of the page; `keep`: a context to open it in;
     * `places`: it may ask for files that can be saved in their place; `prepare`: run in the page before its own scripts */
    open({ fresh = false, ...options } = {}) {
      return !fresh && isPlain(options) ? reuse(options) : load(options);
    },
    /** After a visit. @param well  whether its page may be another visit's */
    async leave(visit, well) {
      const { page, context, problems, key } = visit;
      taken.delete(key);
      if (key === undefined || !well || problems.length > 0 || page.isClosed()) {
        await context.close();
        return;
      }
      for (const name of ['download', 'filechooser', 'request']) page.removeAllListeners(name);
      await page.unrouteAll({ behavior: 'ignoreErrors' });
      for (const one of context.pages()) if (one !== page) await one.close();
      left.set(key, visit);
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
        ...{ name: plate.name, width: plate.width, height: plate.height, layers: plate.layers.map(({ kind }) => kind) },
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

  /** The directions, which are seen in the place of the path. */
  async directions() {
    await this.view('Path');
    await this.page.getByLabel('Colour by').selectOption('directions');
  }

  /** Chooses from the page's menu. */
  async menu(name) {
    await this.page.locator('[popovertarget=menu]').click();
    await this.page.locator('#menu').getByRole('button', { name }).click();
  }

  /** Unfolds all that a plate may be filled with. */
  async ways() {
    const more = this.button('More ways');
    if ((await more.count()) > 0 && (await more.getAttribute('aria-expanded')) === 'false') await more.click();
  }

  /** Opens what is rarely changed of the view. @returns its fields */
  async options() {
    await this.page.locator('[popovertarget=options]').click();
    return this.page.locator('sillon-view-options');
  }

  /** Chooses in a list of those. */
  async option(label, value) {
    await (await this.options()).getByLabel(label, { exact: true }).selectOption(value);
    await this.page.keyboard.press('Escape');
  }

  async download(product) {
    const begins = new RegExp(`^${product.replace(/[()]/g, '\\$&')}`); // what other products are for may name it, too
    await this.page.locator('[popovertarget=export]').click();
    const [download] = await Promise.all([
      this.page.waitForEvent('download'),
      this.page.locator('#export').getByRole('button', { name: begins }).click(),
    ]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }

  /** As if they had been dragged from another window. */
  async drop(files, text = '') {
    await this.#hand('drop', files, text);
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
