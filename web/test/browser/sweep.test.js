// No control is covered or cut at any width from 320 to 2560 pixels, in any view and any language. Without graphics, which
// would be drawn in software and have no part in it.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { overlaps } from './support/covered.js';
import { languages } from './support/languages.js';
import { sharedBench } from './support/shared.js';
import { smallPlate } from './support/small.js';
import { skip, start } from './support/studio.js';

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
  const bars = ['SILLON-HEADER', 'SILLON-STAGE', 'SILLON-APP', 'SILLON-LIGHT', 'SILLON-LAMP-BAR', 'SILLON-STATUS'];
  return all(document)
    .filter((one) => one.matches('button, select') && bars.includes(one.getRootNode().host?.tagName))
    .filter((one) => one.checkVisibility({ visibilityProperty: true }) && !one.closest('[popover]'))
    .filter((one) => getComputedStyle(one).clipPath === 'none')
    .flatMap((one) => {
      const { left, right, width } = one.getBoundingClientRect();
      const out = width > 0 && (left < -0.5 || right > globalThis.innerWidth + 0.5);
      const words = one.tagName === 'BUTTON' && one.scrollWidth > one.clientWidth + 1;
      const name = (one.ariaLabel ?? one.textContent).trim().slice(0, 40);
      return out || words ? [`button "${name}" is cut ${out ? 'by the window' : 'inside'}`] : [];
    });
}

for (const language of languages) {
  test(`no control is covered or cut, whatever the width, ${language}`, { skip }, async () => {
    const keep = await bench.browser.newContext({ reducedMotion: 'reduce', viewport: { width: 1000, height: 760 } });
    await keep.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
    const { page } = await bench.open({ keep, path: `/?lang=${language}${smallPlate}` });
    await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.made !== undefined);
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
}
