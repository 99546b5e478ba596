// Names that screen readers and voice control tell things by: no two buttons or landmarks in sight at once have the same.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { sharedBench } from './support/shared.js';
import { fileAt, inputs, skip, start } from './support/studio.js';
import { settled } from './support/waits.js';

const bench = sharedBench(skip, start);

/** Runs in the page. @returns the names that several things of one kind have, in words */
function repeated() {
  const all = (root) =>
    [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
  const kinds = {
    button: 'button, [role=button]',
    landmark: 'nav, aside, main, [role=main], [role=banner], [role=navigation], [role=region], section[aria-label]',
    tab: '[role=tab]',
  };
  const textOf = (one) => one.getAttribute('aria-label') ?? one.textContent;
  const nameOf = (one) => {
    const labels = one.getAttribute('aria-labelledby')?.split(' ') ?? [];
    const texts = labels.map((id) => textOf(one.getRootNode().getElementById(id)));
    return (texts.join(' ') || textOf(one)).replaceAll(/\s+/g, ' ').trim();
  };
  const isClosed = (one) => one.closest('[popover]')?.matches(':popover-open') === false;
  const seen = all(document).filter((one) => one.checkVisibility({ visibilityProperty: true }) && !isClosed(one));
  return Object.entries(kinds).flatMap(([kind, selector]) => {
    const names = seen.filter((one) => one.matches(selector)).map((one) => nameOf(one));
    const twice = names.filter((name, k) => name !== '' && names.indexOf(name) < k);
    return [...new Set(twice)].map((name) => `${kind} “${name}”`);
  });
}

const layers = [
  { kind: 'border' },
  { kind: 'text', text: 'A' },
  { kind: 'text', text: 'A' },
  { kind: 'direction', size: [10, 10] },
];

for (const [width, height] of [
  [1280, 800],
  [390, 844],
]) {
  test(`no two things in sight have one name: ${width} × ${height}`, { skip }, async () => {
    const visit = await bench.open({ small: true, fresh: true, visited: true, viewport: { width, height } });
    await visit.until(({ plate }) => plate.width === 24);
    const { page } = visit;
    await visit.drop([fileAt(`${inputs}/photo.png`)]);
    await visit.until(({ plate, reading }) => plate.layers[0].kind === 'picture' && reading === undefined);
    await visit.drop([fileAt(`${inputs}/relief.png`)]);
    await visit.button('Show both, turn the lamp').click();
    await visit.until(({ plate }) => plate.layers[0].pictures.length === 2);
    await page.evaluate(async (layers) => {
      const { studio } = document.querySelector('sillon-app');
      studio.change((plate) => ({
        ...plate,
        layers: [
          ...plate.layers,
          ...layers.map((values, k) => ({ ...plate.layers[0], pictures: [], ...values, id: k + 2 })),
        ],
      }));
      studio.store.set({ notices: [] });
    }, layers);
    await visit.until(({ plate, result }) => result?.plate === plate);
    const wrong = [];
    const look = async (where) => {
      await settled(page);
      const found = await page.evaluate(repeated);
      wrong.push(...found.map((what) => `${where}: ${what}`));
    };
    const set = (change) => page.evaluate((to) => document.querySelector('sillon-app').studio.store.set(to), change);
    for (const view of ['directions', 'toolpath', 'appearance', 'quality']) {
      await set({ view, panel: '' });
      await look(view);
    }
    for (const panel of ['shape', 'layers', 'toolpath', 'print', 'quality']) {
      for (const layer of panel === 'layers' ? [1, 2, 3, 5, null] : [null]) {
        await set({ panel });
        await page.evaluate((layer) => {
          document.querySelector('sillon-app').studio.store.set({ layer: layer ?? undefined });
          const all = (root) =>
            [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
          for (const one of all(document)) if (one.matches('details')) one.open = true;
        }, layer);
        await look(`${panel} ${layer ?? ''}`);
      }
    }
    await set({ panel: '' });
    for (const dialog of ['gallery', 'plates', 'help', 'share', 'first', 'calibrate', 'spools', 'palette']) {
      await set({ dialog });
      await page.getByRole('dialog').waitFor();
      await look(`dialog ${dialog}`);
      await set({ dialog: undefined });
      await page.evaluate(() => document.querySelector('sillon-app').studio.show(undefined));
      await page.getByRole('dialog').waitFor({ state: 'detached' });
    }
    assert.deepEqual(wrong, []);
  });
}
