// No control is covered or cut at any width from 320 to 2560 pixels, in any view and any language. Without graphics, which
// would be drawn in software and have no part in it.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { overlaps } from './support/covered.js';
import { languages } from './support/languages.js';
import { sharedBench } from './support/shared.js';
import { smallPlate } from './support/small.js';
import { skip, start } from './support/studio.js';
import { settled } from './support/waits.js';

const bench = sharedBench(skip, start);
const views = ['appearance', 'directions', 'toolpath', 'quality'];
const between = (from, to, step) =>
  Array.from({ length: Math.floor((to - from) / step) + 1 }, (_, k) => from + k * step);
// The view with the most controls in small steps, the others in large ones.
const widthsOf = (view) =>
  (view === 'appearance' ? between(320, 1480, 20) : between(320, 1440, 80)).concat([1720, 2120, 2560]);

/** Runs in the page. @returns controls whose words, or which themselves, are cut off, in words */
function cut() {
  const all = (root) =>
    [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
  const bars = ['SILLON-HEADER', 'SILLON-STAGE', 'SILLON-APP', 'SILLON-LIGHT', 'SILLON-LOOKS', 'SILLON-STATUS'];
  /** Selects do not scroll: what is chosen must fit between their paddings. Those that cannot be seen show no words. */
  const pen = new OffscreenCanvas(1, 1).getContext('2d');
  const chosen = (select) => {
    const { font, letterSpacing, opacity, paddingLeft, paddingRight } = getComputedStyle(select);
    pen.font = font;
    pen.letterSpacing = letterSpacing === 'normal' ? '0px' : letterSpacing;
    const room = select.clientWidth - Number.parseFloat(paddingLeft) - Number.parseFloat(paddingRight);
    return opacity !== '0' && pen.measureText(select.selectedOptions[0]?.label ?? '').width > room + 1;
  };
  return all(document)
    .filter((one) => one.matches('select') || (one.matches('button') && bars.includes(one.getRootNode().host?.tagName)))
    .filter((one) => one.checkVisibility({ visibilityProperty: true }) && !one.closest('[popover]'))
    .filter((one) => getComputedStyle(one).clipPath === 'none')
    .flatMap((one) => {
      const { left, right, width } = one.getBoundingClientRect();
      const out = width > 0 && (left < -0.5 || right > globalThis.innerWidth + 0.5);
      const words = one.tagName === 'BUTTON' ? one.scrollWidth > one.clientWidth + 1 : chosen(one);
      const name = (one.ariaLabel ?? one.textContent).trim().slice(0, 40);
      return out || words ? [`${one.tagName.toLowerCase()} "${name}" is cut ${out ? 'by the window' : 'inside'}`] : [];
    });
}

/** Runs in the page. @returns what reaches out of the open dialog, or is wider than its own box, in words */
function outside() {
  const all = (root) =>
    [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
  const dialog = all(document).find((one) => one.matches('dialog[open]'));
  const { left, right } = dialog.getBoundingClientRect();
  const name = (one) => `${one.localName} "${(one.ariaLabel ?? one.textContent ?? '').trim().slice(0, 40)}"`;
  return all(dialog)
    .filter((one) => one.checkVisibility({ visibilityProperty: true }) && getComputedStyle(one).clipPath === 'none')
    .flatMap((one) => {
      const box = one.getBoundingClientRect();
      if (box.width > 0 && (box.left < left - 0.5 || box.right > right + 0.5)) return [`${name(one)} reaches out`];
      const cut = one.matches('button, label, h2, p, b, dd, dt') && one.scrollWidth > one.clientWidth + 1;
      return cut && one.clientWidth > 0 && getComputedStyle(one).display !== 'inline' ? [`${name(one)} is cut`] : [];
    });
}

for (const language of languages) {
  test(`no control is covered or cut, whatever the width, ${language}`, { skip }, async () => {
    const keep = await bench.browser.newContext({
      reducedMotion: 'reduce',
      viewport: { width: 1000, height: 760 },
      serviceWorkers: 'block', // its notice may come at any time, over anything
    });
    await keep.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
    const { page } = await bench.open({ keep, path: `/?lang=${language}${smallPlate}` });
    await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result !== undefined);
    const wrong = [];
    for (const view of views) {
      for (const width of widthsOf(view)) {
        await page.setViewportSize({ width, height: 760 });
        await page.evaluate(
          async ({ view, panel }) => {
            const { store } = document.querySelector('sillon-app').studio;
            store.set({ view, panel, notices: [], problem: undefined });
            for (let n = 0; n < 2; ++n) await new Promise((resolve) => requestAnimationFrame(resolve));
          },
          { view, panel: width > 720 ? 'directions' : '' },
        );
        const found = [...(await page.evaluate(overlaps)), ...(await page.evaluate(cut))];
        wrong.push(...found.map((what) => `${width}, ${view}: ${what}`));
      }
    }
    assert.deepEqual(wrong, []);
  });

  test(`nothing of calibration and first print is cut, whatever the width, ${language}`, { skip }, async () => {
    const keep = await bench.browser.newContext({
      reducedMotion: 'reduce',
      viewport: { width: 1000, height: 760 },
      serviceWorkers: 'block', // its notice may come at any time, over anything
    });
    const { page } = await bench.open({ keep, path: `/?lang=${language}${smallPlate}` });
    await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result !== undefined);
    const wrong = [];
    for (const dialog of ['calibrate', 'spools', 'first']) {
      await page.evaluate((dialog) => document.querySelector('sillon-app').studio.show(dialog), dialog);
      await page.locator('dialog[open]').waitFor();
      const tabs = dialog === 'calibrate' ? 2 : 1; // the third is `spools`
      for (let tab = 0; tab < tabs; ++tab) {
        if (dialog === 'calibrate') await page.locator('.tabs input').nth(tab).check();
        if (dialog === 'calibrate' && tab === 0) await page.locator('sillon-calibrate-prints figure img').waitFor();
        for (const width of [320, 360, 400, 480, 560, 640, 720, 768, 860, 1024, 1440]) {
          await page.setViewportSize({ width, height: 760 });
          await settled(page);
          wrong.push(...(await page.evaluate(outside)).map((what) => `${dialog} ${tab}, ${width}: ${what}`));
        }
      }
      await page.keyboard.press('Escape');
      await page.waitForFunction(() => document.querySelector('sillon-app').studio.store.state.dialog === undefined);
    }
    assert.deepEqual(wrong, []);
  });
}
