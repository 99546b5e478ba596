// <sillon-view>: plates shimmer in other people's pages, many with one graphics context, without the engine.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

import { lacking, startChromium } from '../../../wasm/test/support/browsers.js';
import { serve as servePlain } from '../../../wasm/test/support/server.js';
import { serve } from '../../serve.js';

const skip = lacking('Chromium');
const path = (name) => fileURLToPath(new URL(name, import.meta.url));
const program = path('../../../build/release/sillon');
const element = path('../../dist/embed/sillon-view.js');

let folder, browser, studio, site, page, problems;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'sillon-view-'));
  writeFileSync(join(folder, 'page.html'), '<!doctype html><title>A shop</title><link rel="icon" href="data:," />');
  writeFileSync(join(folder, 'not.png'), 'not a picture');
  // Beads along x on the left, along y on the right.
  for (const [name, project] of [
    ['flat', { shape: { builtin: 'rectangle', size: [20, 20] }, directions: { angle: 0 } }],
    ['steep', { shape: { builtin: 'disc', size: [20, 20] }, directions: { angle: 90 } }],
  ]) {
    writeFileSync(
      join(folder, `${name}.json`),
      JSON.stringify({ sillon: 1, ...project, toolpath: { perimeterMode: 'none' } }),
    );
    execFileSync(program, ['generate', join(folder, `${name}.json`), '--quiet', '--view', join(folder, `${name}.png`)]);
  }
  if (skip) return;
  browser = await startChromium();
  studio = await serve(path('../../dist'), 0);
  site = await servePlain({ '/': `${folder}/` });
});
after(async () => {
  await browser?.close();
  studio?.close();
  site?.close();
  rmSync(folder, { recursive: true });
});
afterEach(async () => {
  await page?.context().close();
  page = undefined;
});

async function open(options = {}) {
  const context = await browser.newContext({
    reducedMotion: 'reduce',
    viewport: { width: 600, height: 600 },
    ...options,
  });
  page = await context.newPage();
  problems = [];
  page.on('pageerror', (error) => problems.push(String(error)));
  await options.prepare?.(page);
  await page.goto(`${site.origin.replace('localhost', '127.0.0.1')}/page.html`);
  await page.evaluate(async (url) => {
    await import(url);
    globalThis.view = (attributes, size = 100) => {
      const view = document.createElement('sillon-view');
      for (const [name, value] of Object.entries(attributes)) view.setAttribute(name, value);
      view.style.width = `${size}px`;
      view.style.display = 'inline-block'; // side by side: what is off the screen is not drawn
      const done = new Promise((resolve) => {
        view.addEventListener('load', () => resolve('load'));
        view.addEventListener('error', ({ detail }) => resolve(detail));
      });
      document.body.append(view);
      return { view, done };
    };
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    /** Two frames on, what was asked for before has been drawn. */
    globalThis.drawn = async () => {
      for (let k = 0; k < 2; ++k) await frame();
    };
    /** Mean of red, green and blue in a square of the middle, once it stands still. */
    globalThis.tone = async ({ view }) => {
      const canvas = view.shadowRoot.querySelector('canvas');
      let last;
      for (;;) {
        await globalThis.drawn();
        if (canvas.hidden) continue;
        const { width, height } = canvas;
        const side = Math.floor(width / 4);
        const data = canvas.getContext('2d').getImageData((width - side) / 2, (height - side) / 2, side, side).data;
        const sums = [0, 0, 0, 0];
        data.forEach((value, k) => (sums[k % 4] += value));
        const tone = sums.map((sum) => sum / (data.length / 4));
        if (JSON.stringify(tone) === JSON.stringify(last)) return tone;
        last = tone;
      }
    };
  }, `${studio.origin}/embed/sillon-view.js`);
}

test('it fits its budget, and is no engine', (t) => {
  const text = readFileSync(element, 'utf8');
  const size = gzipSync(text).length;
  t.diagnostic(`${size} bytes`);
  assert.ok(size <= 25_000, `${size} bytes; the budget is 25000`);
  assert.doesNotMatch(text, /WebAssembly|new Worker|SharedArrayBuffer|\beval\b|new Function/);
  assert.doesNotMatch(text, /^import\b|\bimport\(/m);
});

test('beads across the light are bright, along it dark, and the pointer turns that round', { skip }, async () => {
  await open();
  const tones = await page.evaluate(async () => {
    const { view, tone } = globalThis;
    const found = {};
    for (const azimuth of [0, 90]) {
      for (const name of ['flat', 'steep']) {
        const one = view({ src: `${name}.png`, light: 'fixed', azimuth, elevation: 30 });
        await one.done;
        found[`${name} ${azimuth}`] = (await tone(one))[0];
        one.view.remove();
      }
    }
    return found;
  });
  assert.ok(tones['flat 90'] > tones['flat 0'] + 60, JSON.stringify(tones));
  assert.ok(tones['steep 0'] > tones['steep 90'] + 60, JSON.stringify(tones));

  await page.evaluate(() => (globalThis.one = globalThis.view({ src: 'flat.png' }, 300)));
  const under = async (x, y) => {
    await page.mouse.move(x, y);
    return page.evaluate(async () => (await globalThis.tone(globalThis.one))[0]);
  };
  const [above, beside] = [await under(158, 20), await under(300, 158)];
  assert.ok(above > beside + 30, `${above}, ${beside}`);
  assert.deepEqual(problems, []);
});

test('a poster stands in for what is not there yet, or cannot be', { skip }, async () => {
  await open();
  const seen = await page.evaluate(async () => {
    const state = ({ view }) =>
      ['img', 'canvas'].map((name) => (view.shadowRoot.querySelector(name).hidden ? 'hidden' : 'shown')).join();
    const poster = 'flat.png';
    const found = {};
    for (const src of [
      'missing.png',
      'not.png',
      'javascript:globalThis.ran=1',
      'data:image/png,x',
      'http://[',
      'flat.json',
    ]) {
      const one = globalThis.view({ src, poster });
      const { code, message } = await one.done;
      found[src] = [code, state(one), message.length > 10];
    }
    const good = globalThis.view({ src: 'flat.png', poster, alt: 'A plate' });
    found.before = state(good);
    await good.done;
    await globalThis.tone(good);
    found.after = state(good);
    found.name = [good.view.getAttribute('role'), good.view.getAttribute('aria-label')];
    const wrong = globalThis.view({ src: 'flat.png', poster: 'javascript:globalThis.ran=2' });
    found.wrong = wrong.view.shadowRoot.querySelector('img').getAttribute('src');
    found.ran = globalThis.ran ?? null;
    return found;
  });
  const { before: early, after: late, name, wrong, ran, ...refused } = seen;
  for (const [src, outcome] of Object.entries(refused)) {
    assert.deepEqual(outcome, ['LoadFailed', 'shown,hidden', true], src);
  }
  assert.deepEqual(
    { early, late, name, wrong, ran },
    {
      early: 'shown,hidden',
      late: 'hidden,shown',
      name: ['img', 'A plate'],
      wrong: null,
      ran: null,
    },
  );
});

test('many elements share one context, which may be lost and comes back', { skip }, async () => {
  await open({
    prepare: (page) =>
      page.addInitScript(() => {
        globalThis.contexts = [];
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
          const context = original.call(this, kind, ...rest);
          if (kind === 'webgl2' && !globalThis.contexts.includes(context)) globalThis.contexts.push(context);
          return context;
        };
      }),
  });
  const found = await page.evaluate(async () => {
    const { view, tone } = globalThis;
    const all = Array.from({ length: 24 }, (_, k) =>
      view({ src: k % 2 ? 'flat.png' : 'steep.png', light: 'fixed' }, 60),
    );
    await Promise.all(all.map(({ done }) => done));
    const before = await tone(all[1]);
    const { contexts } = globalThis;
    const lost = contexts[0].getExtension('WEBGL_lose_context');
    const told = (name) => new Promise((resolve) => contexts[0].canvas.addEventListener(name, resolve, { once: true }));
    const losing = told('webglcontextlost');
    lost.loseContext();
    await losing;
    const canvas = all[1].view.shadowRoot.querySelector('canvas');
    canvas.getContext('2d').clearRect(0, 0, 999, 999);
    all[1].view.setAttribute('azimuth', '60');
    await globalThis.drawn();
    const without = canvas.getContext('2d').getImageData(30, 30, 1, 1).data[3];
    const restoring = told('webglcontextrestored');
    // Not within the event of the loss, after which the browser first has to let it.
    await new Promise((resolve) => setTimeout(resolve));
    lost.restoreContext();
    await restoring;
    await globalThis.drawn();
    return { contexts: contexts.length, before, without, after: await tone(all[1]) };
  });
  assert.equal(found.contexts, 1);
  assert.equal(found.without, 0);
  assert.deepEqual(found.after, found.before);
  assert.deepEqual(problems, []);
});

test('the light rests where motion is not wanted, and moves by itself where it is', { skip }, async () => {
  /** How many pictures are seen within a second, or until there are enough. */
  const pictures = (enough) =>
    page.evaluate(async (enough) => {
      const one = globalThis.view({ src: 'flat.png', light: 'orbit' });
      await one.done;
      const canvas = one.view.shadowRoot.querySelector('canvas');
      while (canvas.hidden) await globalThis.drawn();
      const read = () => String(canvas.getContext('2d').getImageData(50, 50, 1, 1).data);
      const seen = new Set();
      const end = performance.now() + 1200;
      while (enough === undefined ? performance.now() < end : seen.size < enough) {
        await globalThis.drawn();
        seen.add(read());
      }
      return seen.size;
    }, enough);
  await open();
  assert.equal(await pictures(), 1);
  await page.context().close();
  await open({ reducedMotion: 'no-preference' });
  assert.equal(await pictures(3), 3); // they never end
});

test('without graphics the poster stays and the reason is told', { skip }, async () => {
  await open({
    prepare: (page) =>
      page.addInitScript(() => {
        HTMLCanvasElement.prototype.getContext = () => null;
      }),
  });
  const { message } = await page.evaluate(() => globalThis.view({ src: 'flat.png', poster: 'flat.png' }).done);
  assert.match(message, /WebGL2/);
});
