// How soon the studio shows what a hand does: from a move of the comb, from another size, shape or fill, and from a step of a
// slider, to the first frame that differs there, and to the plate made anew. Where there is no graphics card, frames of the appearance take most of the time.
// Prints; asserts nothing.   ./dev bench live

import { start } from './test/browser/support/studio.js';

const rounds = Number(process.argv[2] ?? 9);
const warmUps = 3;
const threads = 2;

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** In the page, before its own scripts: what draws may be read after its frame, and what `watch` needs. */
function prepare() {
  const getContext = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, options) {
    return getContext.call(this, kind, kind === 'webgl2' ? { ...options, preserveDrawingBuffer: true } : options);
  };
  const studio = () => document.querySelector('sillon-app').studio;
  const afterFrame = () =>
    new Promise((resolve) => {
      requestAnimationFrame(() => {
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = resolve;
        port2.postMessage('');
      });
    });
  /** Of both canvases, drawing finished. @param box  [x, y, side] from the upper left corner [pixels] */
  const look = ([x, y, side]) => {
    const { drawing, overlay } = globalThis.benched;
    const gl = drawing.getContext('webgl2');
    const pixels = new Uint8Array(4 * side * side);
    gl.readPixels(x, drawing.height - y - side, side, side, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const over = side > 32 ? [] : overlay.getContext('2d').getImageData(x, y, side, side).data; // a slider changes beads
    let sum = 0;
    for (const bytes of [pixels, over]) for (const byte of bytes) sum = (Math.imul(sum, 31) + byte) | 0;
    return sum;
  };
  addEventListener('pointermove', ({ timeStamp }) => (globalThis.moved = timeStamp), { capture: true });
  globalThis.findCanvases = () => {
    const roots = (root) =>
      [...root.querySelectorAll('*')].flatMap((one) =>
        one.localName === 'sillon-canvas' ? [one] : one.shadowRoot ? roots(one.shadowRoot) : [],
      );
    const [canvas] = roots(document);
    const [drawing, overlay] = ['.drawing', '.overlay'].map((name) => canvas.shadowRoot.querySelector(name));
    globalThis.benched = { drawing, overlay };
  };
  /** @param begin  when it began, once it has [ms] @returns [ms] from there to the first frame that differs within the box,
   * and to the one with the plate that was made for it */
  globalThis.watch = async (box, begin) => {
    const plate = studio().store.state.plate;
    const before = look(box);
    let [first, came, made, spacing] = [0, 0, 0, 0];
    for (const late = performance.now() + 20_000; (first === 0 || made === 0) && performance.now() < late;) {
      await afterFrame();
      const since = begin();
      if (since === undefined) continue;
      const differs = first === 0 && look(box) !== before;
      const now = performance.now() - since;
      if (differs) first = now;
      if (came !== 0 && made === 0) made = now;
      const { state } = studio().store;
      if (came !== 0 || state.plate === plate || state.result?.plate !== state.plate) continue;
      came = performance.now() - since;
      ({ spacing } = state.result.toolpath);
    }
    return { first, came, made, spacing };
  };
  /** A slider shows nothing before its preview: nothing is read, and so waited for, until that has been drawn. */
  globalThis.slide = (box, key, value) =>
    new Promise((resolve) => {
      const { store } = studio();
      look(box);
      const began = performance.now();
      const end = store.subscribe(async ({ plate, result }) => {
        if (result?.plate !== plate) return;
        end();
        const came = performance.now() - began;
        await afterFrame();
        look(box);
        const made = performance.now() - began;
        resolve({ first: made, came, made, spacing: result.toolpath.spacing });
      });
      studio().change((plate) => ({ ...plate, toolpath: { ...plate.toolpath, [key]: value } }), key);
    });
  /** A move of the lamp. @returns [ms] until the plate is drawn under it */
  globalThis.light = async (box, azimuth) => {
    look(box);
    const began = performance.now();
    studio().setLight({ azimuth });
    await afterFrame();
    look(box);
    return performance.now() - began;
  };
  globalThis.rest = () => studio().settle();
}

const inMs = (values) =>
  `${median(values).toFixed(0).padStart(6)} ms ${`(${Math.min(...values).toFixed(0)})`.padEnd(7)}`;

function tell(what, found) {
  const kept = found.slice(warmUps);
  const of = (key) => inMs(kept.map((one) => one[key]));
  const spacing = median(kept.map((one) => one.spacing)).toFixed(2);
  console.log(`  ${what.padEnd(28)} ${of('first')}   ${of('came')}   ${of('made')}   ${spacing} mm`);
}

const site = await start();
try {
  const visit = await site.open({ visited: true, path: `/?threads=${threads}`, deviceScaleFactor: 1, prepare });
  const { page } = visit;
  await visit.until(({ result }) => result?.measured === true);
  await visit.idle();
  await page.evaluate(() => globalThis.findCanvases());
  const told = await visit.state(({ engine, plate }) => `${engine.threads} threads, plate of ${plate.width} mm`);
  const gl = await page.evaluate(() => {
    const context = document.createElement('canvas').getContext('webgl2');
    return context?.getParameter(context.getExtension('WEBGL_debug_renderer_info')?.UNMASKED_RENDERER_WEBGL ?? 7937);
  });
  console.log(`Chromium, ${told}, drawn by ${gl}`);
  console.log(
    `medians of ${rounds} (least)               first change       plate is there     and drawn          its spacing`,
  );
  const box = await visit.canvas();

  for (const view of ['appearance', 'directions']) {
    await page.evaluate((view) => document.querySelector('sillon-app').studio.setView(view), view);
    const found = [];
    for (let k = 0; k < warmUps + rounds; ++k) {
      if (k % 4 === 0) {
        await page.mouse.up();
        await visit.idle();
        await page.evaluate(() => document.querySelector('sillon-app').studio.store.set({ tool: 'comb' }));
        await page.mouse.move(box.x + box.width * 0.36, box.y + box.height * (0.3 + 0.09 * (k / 4)));
        await page.mouse.down();
        await page.mouse.move(box.x + box.width * 0.37, box.y + box.height * (0.3 + 0.09 * (k / 4)));
        await page.waitForTimeout(200);
      }
      const [x, y] = [box.width * (0.37 + 0.06 * ((k % 4) + 1)), box.height * (0.3 + 0.09 * Math.floor(k / 4))];
      const spot = [Math.round(x - 0.03 * box.width), Math.round(y), 5];
      const watched = page.evaluate((spot) => {
        globalThis.moved = undefined;
        return globalThis.watch(spot, () => globalThis.moved);
      }, spot);
      await page.waitForTimeout(30);
      await page.mouse.move(box.x + x, box.y + y);
      found.push(await watched);
    }
    await page.mouse.up();
    await visit.idle();
    tell(`comb, ${view}`, found);
  }
  await page.evaluate(() => document.querySelector('sillon-app').studio.setView('appearance'));
  const middle = [Math.round(box.width / 2) - 100, Math.round(box.height / 2) - 100, 200];
  // Each is another than the one before, and is seen in the middle.
  const edits = {
    size: (plate, k) => ({ ...plate, width: 60 + k, height: 60 + k }),
    shape: (plate, k) => ({ ...plate, shape: { ...plate.shape, kind: k % 2 === 0 ? 'heart' : 'disc' } }),
    fill: ({ layers: [ground, ...others], ...plate }, k) => ({
      ...plate,
      layers: [{ ...ground, kind: 'pattern', pattern: k % 2 === 0 ? 'radial' : 'spiral' }, ...others],
    }),
  };
  for (const [name, edit] of Object.entries(edits)) {
    const found = [];
    for (let k = 0; k < warmUps + rounds; ++k) {
      found.push(
        await page.evaluate(`(() => {
          const { studio } = document.querySelector('sillon-app');
          const watched = globalThis.watch(${JSON.stringify(middle)}, () => globalThis.began);
          globalThis.began = performance.now();
          studio.change((plate) => (${edit.toString()})(plate, ${k}));
          return watched;
        })()`),
      );
      await visit.idle();
    }
    tell(`${name}, appearance`, found);
  }
  const lit = [];
  for (let k = 0; k < warmUps + rounds; ++k) {
    lit.push(await page.evaluate(([box, azimuth]) => globalThis.light(box, azimuth), [middle, 20 * k]));
  }
  console.log(`  ${'lamp, appearance'.padEnd(28)} ${inMs(lit.slice(warmUps))}`);
  await page.evaluate(() => document.querySelector('sillon-app').studio.setView('toolpath'));
  for (const [key, from, step] of [
    ['spacing', 0.4, 0.005],
    ['maxWidth', 1.5, 0.01],
    ['widthBalance', 0.3, 0.01],
  ]) {
    const found = [];
    for (let k = 0; k < warmUps + rounds; ++k) {
      found.push(
        await page.evaluate(
          ([box, key, value]) => globalThis.slide(box, key, value),
          [middle, key, from + step * (k + 1)],
        ),
      );
    }
    await page.evaluate(() => globalThis.rest());
    await visit.idle();
    tell(`${key}, toolpath`, found);
  }
} finally {
  await site.close();
}
