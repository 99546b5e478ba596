// <sillon-view>: plates shimmer in other people's pages, many with one graphics context, without the engine.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

import { lacking, startChromium } from '../../../wasm/test/support/browsers.js';
import { serve as servePlain } from '../../../wasm/test/support/server.js';
import { serve } from '../../serve.js';
import { roundView } from './support/view-png.js';

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
    ['flat', { shape: { builtin: 'rectangle', size: [20, 20] }, layers: [{ kind: 'direction' }] }],
    ['steep', { shape: { builtin: 'disc', size: [20, 20] }, layers: [{ kind: 'direction', angle: 90 }] }],
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
    globalThis.frames = async (count) => {
      for (let k = 0; k < count; ++k) await new Promise((resolve) => requestAnimationFrame(resolve));
    };
    const canvasOf = ({ view }) => view.shadowRoot.querySelector('canvas');
    /** How often a view was drawn. */
    const counts = new Map();
    const draw = CanvasRenderingContext2D.prototype.drawImage;
    CanvasRenderingContext2D.prototype.drawImage = function (...words) {
      draw.apply(this, words);
      counts.set(this.canvas, (counts.get(this.canvas) ?? 0) + 1);
    };
    globalThis.count = (one) => counts.get(canvasOf(one)) ?? 0;
    /** Once it was drawn more often than so. */
    globalThis.drawn = async (one, before = 0) => {
      while (globalThis.count(one) <= before) await globalThis.frames(1);
    };
    /** Mean of red, green and blue in a square of the middle. */
    globalThis.tone = (one) => {
      const canvas = canvasOf(one);
      const { width, height } = canvas;
      const side = Math.floor(width / 4);
      const data = canvas.getContext('2d').getImageData((width - side) / 2, (height - side) / 2, side, side).data;
      const sums = [0, 0, 0, 0];
      data.forEach((value, k) => (sums[k % 4] += value));
      return sums.map((sum) => sum / (data.length / 4));
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
    const { view, tone, drawn } = globalThis;
    const found = {};
    for (const azimuth of [0, 90]) {
      for (const name of ['flat', 'steep']) {
        const one = view({ src: `${name}.png`, light: 'fixed', azimuth, elevation: 30 });
        await drawn(one);
        found[`${name} ${azimuth}`] = tone(one)[0];
        one.view.remove();
      }
    }
    return found;
  });
  assert.ok(tones['flat 90'] > tones['flat 0'] + 60, JSON.stringify(tones));
  assert.ok(tones['steep 0'] > tones['steep 90'] + 60, JSON.stringify(tones));

  await page.evaluate(async () => {
    globalThis.one = globalThis.view({ src: 'flat.png' }, 300);
    await globalThis.drawn(globalThis.one);
  });
  const under = async (x, y) => {
    const before = await page.evaluate(() => globalThis.count(globalThis.one));
    await page.mouse.move(x, y);
    return page.evaluate(async (before) => {
      await globalThis.drawn(globalThis.one, before);
      return globalThis.tone(globalThis.one)[0];
    }, before);
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
    await globalThis.drawn(good);
    found.after = state(good);
    found.name = [good.view.getAttribute('role'), good.view.getAttribute('aria-label')];
    good.view.removeAttribute('alt');
    found.name.push(good.view.getAttribute('aria-label'));
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
      name: ['img', 'A plate', null],
      wrong: null,
      ran: null,
    },
  );
});

test('properties are attributes: null and undefined take them away, and none is too early', { skip }, async () => {
  const early = () =>
    addEventListener('DOMContentLoaded', () => {
      globalThis.early = Object.assign(document.createElement('sillon-view'), { alt: 'A plate', light: 'fixed' });
      document.body.append(globalThis.early);
    });
  await open({ prepare: (page) => page.addInitScript(early) });
  const seen = await page.evaluate(() => {
    const { early: view } = globalThis;
    const found = [view.getAttribute('light'), view.getAttribute('aria-label')];
    view.alt = 'Another';
    found.push(view.getAttribute('alt'));
    view.alt = undefined;
    view.light = null;
    return [...found, view.getAttribute('alt'), view.getAttribute('light')];
  });
  assert.deepEqual(seen, ['fixed', 'A plate', 'Another', null, null]);
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
    const { view, tone, drawn, count } = globalThis;
    const all = Array.from({ length: 24 }, (_, k) =>
      view({ src: k % 2 ? 'flat.png' : 'steep.png', light: 'fixed' }, 60),
    );
    for (const one of all) await drawn(one);
    const before = tone(all[1]);
    const { contexts } = globalThis;
    const lost = contexts[0].getExtension('WEBGL_lose_context');
    const told = (name) => new Promise((resolve) => contexts[0].canvas.addEventListener(name, resolve, { once: true }));
    const losing = told('webglcontextlost');
    lost.loseContext();
    await losing;
    const canvas = all[1].view.shadowRoot.querySelector('canvas');
    canvas.getContext('2d').clearRect(0, 0, 999, 999);
    all[1].view.setAttribute('azimuth', '60');
    await globalThis.frames(3);
    const without = canvas.getContext('2d').getImageData(30, 30, 1, 1).data[3];
    const restoring = told('webglcontextrestored');
    // Not within the event of the loss, after which the browser first has to let it.
    await new Promise((resolve) => setTimeout(resolve));
    lost.restoreContext();
    const pictures = count(all[1]);
    await restoring;
    await drawn(all[1], pictures);
    return { contexts: contexts.length, before, without, after: tone(all[1]) };
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
      await globalThis.drawn(one);
      const canvas = one.view.shadowRoot.querySelector('canvas');
      const read = () => String(canvas.getContext('2d').getImageData(50, 50, 1, 1).data);
      const seen = new Set();
      const end = performance.now() + 1200;
      while (enough === undefined ? performance.now() < end : seen.size < enough) {
        await globalThis.frames(2);
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

test('an orbit goes on when the visitor no longer prefers reduced motion', { skip }, async () => {
  await open();
  await page.evaluate(async () => {
    globalThis.one = globalThis.view({ src: 'flat.png', light: 'orbit' });
    await globalThis.drawn(globalThis.one);
    await globalThis.frames(5);
  });
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  const moved = await page.evaluate(async () => {
    const before = globalThis.count(globalThis.one);
    await Promise.race([globalThis.drawn(globalThis.one, before), new Promise((resolve) => setTimeout(resolve, 5000))]);
    return globalThis.count(globalThis.one) > before;
  });
  assert.ok(moved);
});

test('an empty attribute counts as absent', { skip }, async () => {
  await open();
  const tones = await page.evaluate(async () => {
    const found = [];
    for (const attributes of [{}, { azimuth: '', elevation: ' ' }]) {
      const one = globalThis.view({ src: 'flat.png', light: 'fixed', ...attributes });
      await globalThis.drawn(one);
      found.push(globalThis.tone(one));
    }
    return found;
  });
  assert.deepEqual(tones[1], tones[0]);
});

test('load and error wait for the decoding, however often the view leaves the neighbourhood', { skip }, async () => {
  await open();
  const found = await page.evaluate(async () => {
    const { view, frames } = globalThis;
    const decode = globalThis.createImageBitmap;
    let release;
    const held = new Promise((resolve) => {
      release = resolve;
    });
    let damaged = false;
    globalThis.createImageBitmap = async (...words) => {
      await held;
      if (damaged) throw new Error('damaged');
      return decode(...words);
    };
    // The first view is being decoded; the second waits for its turn and leaves meanwhile.
    const told = [];
    const first = view({ src: 'flat.png' });
    const second = view({ src: 'steep.png' });
    for (const name of ['load', 'error']) second.view.addEventListener(name, () => told.push(name));
    const fetched = (name) => performance.getEntriesByType('resource').some((entry) => entry.name.endsWith(name));
    while (!fetched('steep.png')) await frames(1);
    await frames(10);
    second.view.style.cssText += 'position: absolute; top: 9000px';
    await frames(10);
    release();
    await first.done;
    await frames(10);
    const far = [...told];
    damaged = true;
    second.view.style.top = '0';
    const outcome = await Promise.race([second.done, new Promise((resolve) => setTimeout(resolve, 5000, 'nothing'))]);
    const failed = [...told];
    // A new source loads, and tells so once, also if it is decoded again.
    damaged = false;
    told.length = 0;
    second.view.setAttribute('src', 'steep.png?2');
    while (told.length === 0) await frames(1);
    second.view.style.top = '9000px';
    await frames(10);
    second.view.style.top = '0';
    await globalThis.drawn(second, globalThis.count(second));
    return { far, code: outcome.code, failed, again: told };
  });
  assert.deepEqual(found, { far: [], code: 'LoadFailed', failed: ['error'], again: ['load'] });
  assert.deepEqual(problems, []);
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

test(
  'files of others: claims, stumps and streams without end are refused in words, unread and undecoded',
  { skip },
  async () => {
    const plate = roundView(64);
    const claiming = (wide, tall) => {
      const file = Buffer.from(plate);
      file.writeUInt32BE(wide, 16);
      file.writeUInt32BE(tall, 20);
      return file;
    };
    const files = {
      'huge.png': [claiming(10_000, 10_000), /10000 x 10000 texels; at most 1048576/],
      'long.png': [claiming(4_000_000_000, 1), /at most 1048576/],
      'square.png': [claiming(1025, 1024), /1025 x 1024 texels/],
      'header.png': [plate.subarray(0, 60), /not a view of a plate/],
      'stump.png': [plate.subarray(0, plate.length / 2), undefined], // browsers may show the part that is there
      'wrong.png': [claiming(65, 64), undefined],
      'padded.png': [Buffer.concat([plate, Buffer.alloc(600_000)]), /more than 500000 bytes/],
      'empty.png': [Buffer.alloc(0), /not a view of a plate/],
    };
    let sent = 0;
    const closed = new Promise((resolve) => {
      files.closed = resolve;
    });
    const server = createServer((request, response) => {
      const name = request.url.slice(1);
      response.writeHead(200, { 'Content-Type': 'image/png', 'Access-Control-Allow-Origin': '*' });
      if (name !== 'endless.png') return response.end(files[name]?.[0]);
      // A view whose picture never ends.
      response.on('close', files.closed);
      response.write(plate.subarray(0, 200));
      const more = () => {
        while (!response.destroyed && response.write(Buffer.alloc(1 << 14))) sent += 1 << 14;
      };
      response.on('drain', more);
      return more();
    });
    await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
    try {
      await open();
      const told = await page.evaluate(
        async ({ origin, names }) => {
          let decoded = 0;
          const decode = globalThis.createImageBitmap;
          globalThis.createImageBitmap = (...words) => {
            ++decoded;
            return decode(...words);
          };
          const found = {};
          for (const name of names) {
            decoded = 0;
            const one = globalThis.view({ src: `${origin}/${name}`, poster: 'flat.png' });
            found[name] = { outcome: await one.done, decoded };
            one.view.remove();
          }
          return found;
        },
        {
          origin: `http://127.0.0.1:${server.address().port}`,
          names: [...Object.keys(files).filter((name) => name.endsWith('.png')), 'endless.png'],
        },
      );
      for (const [name, [, words]] of Object.entries(files).filter(([name]) => name.endsWith('.png'))) {
        const { outcome, decoded } = told[name];
        if (words === undefined) assert.ok(outcome === 'load' || outcome.code === 'LoadFailed', name);
        else {
          assert.equal(outcome.code, 'LoadFailed', name);
          assert.match(outcome.message, words, name);
          assert.equal(decoded, 0, name);
        }
      }
      assert.match(told['endless.png'].outcome.message, /more than 500000 bytes/);
      await closed; // the browser has hung up
      assert.ok(sent < 50e6, `${sent} bytes were sent`); // what lies in buffers on the way
      assert.deepEqual(problems, []);
    } finally {
      server.closeAllConnections();
      server.close();
    }
  },
);

test(
  'files are fetched and pictures kept for what is near the window, and drawn of what is in it',
  { skip },
  async () => {
    const asked = [];
    await open({ prepare: (page) => page.on('request', (request) => asked.push(new URL(request.url()).search)) });
    const found = await page.evaluate(async () => {
      // Rows of 120 px: the window shows five, and what comes within 800 px of it is near.
      const all = Array.from({ length: 40 }, (_, k) => {
        const one = globalThis.view({ src: `flat.png?${k}`, light: 'fixed' });
        one.view.style.cssText = 'display: block; width: 100px; margin-bottom: 20px';
        return one;
      });
      await Promise.all(all.slice(0, 10).map(({ done }) => done));
      await globalThis.drawn(all[0]);
      const sides = () => all.map(({ view }) => view.shadowRoot.querySelector('canvas').width);
      const above = { first: all.slice(0, 3).map(globalThis.count), last: globalThis.count(all[39]), side: sides()[0] };
      scrollTo(0, 1e6);
      await globalThis.drawn(all[39]);
      while (sides()[0] > 0) await globalThis.frames(1);
      const below = { last: sides()[39], hidden: all[0].view.shadowRoot.querySelector('canvas').hidden };
      const before = globalThis.count(all[0]);
      scrollTo(0, 0);
      await globalThis.drawn(all[0], before);
      return { above, below, again: sides()[0] };
    });
    assert.equal(found.above.last, 0);
    assert.equal(found.above.side, 100);
    assert.deepEqual(found.below, { last: 100, hidden: true });
    assert.equal(found.again, 100);
    const files = asked.filter((search) => search !== '');
    assert.ok(!files.slice(0, 10).includes('?39'));
    assert.equal(new Set(files).size, files.length, 'a file was fetched twice');
    assert.ok(files.length < 40, 'what was leapt over was fetched');
  },
);

test('of many views that orbit, a frame draws twelve at most, and none that is out of sight', { skip }, async () => {
  await open({ reducedMotion: 'no-preference' });
  const found = await page.evaluate(async () => {
    const all = Array.from({ length: 48 }, (_, k) => globalThis.view({ src: `flat.png?${k}` }, 90));
    await Promise.all(all.slice(0, 36).map(({ done }) => done));
    const inSight = new Set(all.filter(({ view }) => view.getBoundingClientRect().top < innerHeight));
    for (const one of inSight) await globalThis.drawn(one);
    let most = 0;
    const total = () => all.reduce((sum, one) => sum + globalThis.count(one), 0);
    for (let k = 0; k < 100 || most === 0; ++k) {
      const before = total();
      await globalThis.frames(1);
      most = Math.max(most, total() - before);
    }
    const hidden = all.filter((one) => !inSight.has(one)).map(globalThis.count);
    return { most, hidden: Math.max(...hidden), inSight: inSight.size };
  });
  assert.ok(found.inSight > 12 && found.inSight < 48, JSON.stringify(found));
  assert.ok(found.most >= 1 && found.most <= 12, JSON.stringify(found));
  assert.equal(found.hidden, 0);
});
