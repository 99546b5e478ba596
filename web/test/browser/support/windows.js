// The page in many windows, views, panels and languages: what of its controls is covered or cut. Tests that a change may break look
// at a few windows, those before a release at all of them.
import assert from 'node:assert/strict';

import { overlaps } from './covered.js';
import { languages } from './languages.js';
import { smallPlate } from './small.js';
import { settled } from './waits.js';

const views = ['appearance', 'directions', 'toolpath', 'quality'];
const speak = (page, language) =>
  page.evaluate((name) => document.querySelector('sillon-app').studio.setLanguage(name), language);

/** Runs in the page. @returns controls whose words, or which themselves, are cut off, in words */
function cut() {
  const all = (root) =>
    [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
  const bars = ['SILLON-HEADER', 'SILLON-STAGE', 'SILLON-APP', 'SILLON-LOOKS', 'SILLON-STATUS'];
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

/** Graphics would be drawn in software, and have no part in it. */
const withoutGraphics = () => {
  HTMLCanvasElement.prototype.getContext = () => null;
};

/** @param widthsOf  of a view [pixels] @returns what of its controls is covered or cut, in words */
export async function inAllViews(bench, widthsOf) {
  const { page } = await bench.open({ path: `/${smallPlate}`, prepare: withoutGraphics });
  await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result !== undefined);
  const wrong = [];
  for (const language of languages) {
    await speak(page, language);
    for (const view of views) {
      for (const width of widthsOf(view)) {
        await page.setViewportSize({ width, height: 760 });
        await page.evaluate(
          async ({ view, panel }) => {
            const { store } = document.querySelector('sillon-app').studio;
            store.set({ view, panel, notices: [], problem: undefined });
            for (let n = 0; n < 2; ++n) await new Promise((resolve) => requestAnimationFrame(resolve));
          },
          { view, panel: width > 720 ? 'layers' : '' },
        );
        const found = [...(await page.evaluate(overlaps)), ...(await page.evaluate(cut))];
        wrong.push(...found.map((what) => `${language}, ${width}, ${view}: ${what}`));
      }
    }
  }
  return wrong;
}

/** @param widths  [pixels] @returns what of calibration, the first print, the printer's sheet and the lamp card reaches out or is cut, in words */
export async function inDialogs(bench, widths) {
  const { page } = await bench.open({ small: true });
  await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result !== undefined);
  const wrong = [];
  for (const dialog of ['calibrate', 'spools', 'first', 'firstFile', 'card']) {
    await page.evaluate((dialog) => document.querySelector('sillon-app').studio.show(dialog), dialog);
    await page.locator('dialog[open]').waitFor();
    const tabs = dialog === 'calibrate' ? 2 : 1; // the third is `spools`
    for (let tab = 0; tab < tabs; ++tab) {
      if (dialog === 'calibrate') await page.locator('.tabs input').nth(tab).check();
      if (dialog === 'calibrate' && tab === 0) await page.locator('sillon-calibrate-prints figure img').waitFor();
      for (const language of languages) {
        await speak(page, language);
        for (const width of widths) {
          await page.setViewportSize({ width, height: 760 });
          await settled(page);
          const found = await page.evaluate(outside);
          wrong.push(...found.map((what) => `${language}, ${dialog} ${tab}, ${width}: ${what}`));
        }
      }
    }
    await page.keyboard.press('Escape');
    await page.waitForFunction(() => document.querySelector('sillon-app').studio.store.state.dialog === undefined);
  }
  return wrong;
}

/** The page and its frames, and which panels of each are looked at. */
export const pages = [
  { mode: 'edit', path: '/', panels: ['print'] },
  { mode: 'edit', path: '/embed.html?lang=fr', panels: ['', 'layers'] },
  {
    mode: 'customize',
    path: '/embed.html?mode=customize&controls=size,filament,toolpath.spacing,toolpath,download',
    panels: ['', 'own'],
  },
  { mode: 'view', path: '/embed.html?mode=view', panels: [''] },
];
const shownViews = ['toolpath', 'appearance'];

/** @param sizes  of windows [pixels] @returns what lies over a control of one of `pages`, with words over it and without */
export async function inWindows(bench, { mode, path, panels }, sizes) {
  const visit = await bench.open({ path: '/404' });
  const { page } = visit;
  await page.route('**/engine/**', () => undefined); // never answered: the page alone, without a plate
  await page.goto(bench.origin + path);
  await page.locator('sillon-app').waitFor();
  await visit.until((state) => state.progress?.job === 'loading');
  assert.equal(await visit.state((state) => state.mode), mode);
  const wrong = [];
  for (const [width, height] of sizes) {
    await page.setViewportSize({ width, height });
    for (const panel of panels) {
      for (const view of shownViews) {
        for (const words of [false, true]) {
          await page.evaluate(
            ({ panel, view, words }) => {
              const { store } = document.querySelector('sillon-app').studio;
              const long = 'A word of what has just happened here, with a name_that_is_long_enough_to_wrap.gcode';
              store.set({
                panel,
                view,
                notices: words
                  ? [
                      { id: -1, text: long, actions: [{ label: 'Undo that', run() {} }] },
                      { id: -2, text: 'Short.' },
                    ]
                  : [],
                problem: words ? { code: 'Internal', values: {}, detail: 'what the engine said of it' } : undefined,
              });
            },
            { panel, view, words },
          );
          await settled(page);
          const where = `${width} × ${height}, ${panel || 'no panel'}, ${view}${words ? ', words' : ''}`;
          wrong.push(...(await page.evaluate(overlaps)).map((what) => `${where}: ${what}`));
        }
      }
    }
  }
  return wrong;
}
