// Nothing lies over anything that is to be pressed: in all sizes from a phone's to a desk's, in the page and in frames, with
// the words that come and go and without.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { settled } from './support/waits.js';

const bench = sharedBench(skip, start);

const sizes = [
  [320, 480],
  [360, 740],
  [400, 500],
  [480, 360],
  [600, 400],
  [721, 560],
  [900, 600],
  [1180, 700],
  [1400, 900],
];
const pages = [
  { mode: 'edit', path: '/', panels: ['print'] },
  { mode: 'edit', path: '/embed.html?lang=fr', panels: ['', 'directions'] },
  {
    mode: 'customize',
    path: '/embed.html?mode=customize&controls=size,filament,toolpath.spacing,toolpath,download',
    panels: ['', 'own'],
  },
  { mode: 'view', path: '/embed.html?mode=view', panels: [''] },
];
const views = ['toolpath', 'appearance'];

/** Runs in the page. @returns what lies over what, in words */
function overlaps() {
  const all = (root) =>
    [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
  const above = (one) => one.assignedSlot ?? one.parentElement ?? one.getRootNode().host;
  /** What is seen of it: scrolled parts are not. */
  const seen = (one) => {
    let { left, top, right, bottom } = one.getBoundingClientRect();
    for (let around = one; around; around = above(around)) {
      const { overflow, clipPath, pointerEvents, position } = getComputedStyle(around);
      if (clipPath !== 'none') return undefined; // for screen readers
      if (around === one && pointerEvents === 'none') return undefined;
      if (around !== one && overflow !== 'visible') {
        const box = around.getBoundingClientRect();
        [left, top] = [Math.max(left, box.left), Math.max(top, box.top)];
        [right, bottom] = [Math.min(right, box.right), Math.min(bottom, box.bottom)];
      }
      if (position === 'fixed') break;
    }
    const width = Math.min(right, globalThis.innerWidth) - Math.max(left, 0);
    const height = Math.min(bottom, globalThis.innerHeight) - Math.max(top, 0);
    return width > 2 && height > 2 && one.checkVisibility({ visibilityProperty: true })
      ? { left, top, right, bottom, width, height }
      : undefined;
  };
  const within = (one, test) => {
    for (let around = one; around; around = above(around)) if (test(around)) return around;
    return undefined;
  };
  /** What sticks to an edge of its panel lies over what is scrolled there. */
  const sticks = (one) => within(one, (around) => getComputedStyle(around).position === 'sticky') !== undefined;
  const panel = (one) => within(one, ({ id }) => id === 'panel');
  const scrolls = (one, other) => panel(one) && panel(one) === panel(other) && sticks(one) !== sticks(other);
  const name = (one) =>
    `${one.tagName.toLowerCase()} "${(one.ariaLabel ?? one.textContent).replace(/\s+/g, ' ').trim().slice(0, 40)}"`;
  const ofNotices = (one) => one.getRootNode().host?.tagName === 'SILLON-NOTICES';
  const boxes = all(document)
    .filter((one) => one.matches('button, select, input, a[href], .notice'))
    .filter((one) => !ofNotices(one) || one.matches('.notice'))
    .flatMap((one) => {
      const box = seen(one);
      return box === undefined ? [] : [{ one, box }];
    });
  const found = boxes.flatMap(({ one, box }, k) =>
    boxes
      .slice(k + 1)
      .filter(
        ({ one: another, box: other }) =>
          !scrolls(one, another) &&
          Math.min(box.right, other.right) - Math.max(box.left, other.left) > 1 &&
          Math.min(box.bottom, other.bottom) - Math.max(box.top, other.top) > 1,
      )
      .map((other) => `${name(one)} and ${name(other.one)} overlap`),
  );
  const notices = boxes.filter(({ one }) => one.matches('.notice'));
  const { notices: words, problem } = document.querySelector('sillon-app').studio.store.state;
  if ((words.length > 0 || problem !== undefined) && !(notices[0]?.box.height >= 24)) found.push('no notice is seen');
  // Hit where it is seen: nothing lies over it that is no button itself.
  const deepest = (x, y) => {
    let hit = document.elementFromPoint(x, y);
    while (hit?.shadowRoot?.elementFromPoint(x, y)) {
      const inner = hit.shadowRoot.elementFromPoint(x, y);
      if (inner === hit) break;
      hit = inner;
    }
    return hit;
  };
  for (const { one, box } of boxes.filter(({ one }) => one.matches('button'))) {
    const hit = deepest((box.left + box.right) / 2, (box.top + box.bottom) / 2);
    if (!within(hit, (around) => around === one) && !scrolls(one, hit))
      found.push(`${name(one)} is under ${hit ? name(hit) : 'nothing'}`);
  }
  return found;
}

for (const { mode, path, panels } of pages) {
  test(`nothing lies over a button: ${path}`, { skip }, async () => {
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
        for (const view of views) {
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
                        { id: -1, text: long, action: { label: 'Undo that', run() {} } },
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
    assert.deepEqual(wrong, []);
  });
}

test('figures and values are whole in a narrow page in French, and so is a comma', { skip }, async () => {
  const visit = await bench.open({ small: true, viewport: { width: 768, height: 700 }, locale: 'fr-FR' });
  await visit.idle();
  const figures = visit.page.locator('sillon-status .figures');
  assert.ok(await figures.evaluate((one) => one.scrollWidth <= one.clientWidth), await figures.innerText());
  await visit.section('Trajet');
  await visit.page.locator('summary').first().click();
  const jitter = visit.page.getByLabel('Force de la graine', { exact: true });
  assert.equal(await jitter.inputValue(), '0.025');
  assert.ok(await jitter.evaluate((one) => one.scrollWidth <= one.clientWidth && one.clientWidth > 50));

  const spacing = visit.page.locator('input[type=number]').first();
  await spacing.fill('');
  await spacing.pressSequentially('0,5');
  assert.equal(await spacing.inputValue(), '0.5');
  await visit.until('({ plate }) => plate.toolpath.spacing === 0.5');
  await spacing.evaluate((one) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData('text/plain', ' 0,75 ');
    one.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, cancelable: true }));
  });
  await visit.until('({ plate }) => plate.toolpath.spacing === 0.75');
  await visit.close();
});
