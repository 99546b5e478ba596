// For everybody: screen readers (axe-core), keys alone, narrow screens and fingers, French, still pictures, small first views.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { violations } from './support/axe.js';
import { sharedBench } from './support/shared.js';
import { skip, start } from './support/studio.js';
import { settled, until } from './support/waits.js';

const bench = sharedBench(skip, start);

test('where a word’s button goes that had the focus, the plate gets it', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.idle();
  const notify = () =>
    page.evaluate(() => {
      const { studio } = document.querySelector('sillon-app');
      studio.notify('A word.', { label: 'Tell more', run: () => studio.show('help') });
    });
  const atPlate = () => page.locator('sillon-canvas .overlay').evaluate((one) => one.matches(':focus'));
  await notify();
  await page.locator('sillon-notices').getByRole('button', { name: 'Dismiss' }).last().press('Enter');
  assert.equal(await atPlate(), true);
  await notify();
  await page.getByRole('button', { name: 'Tell more' }).press('Enter');
  await page.getByRole('dialog').waitFor();
  await page.keyboard.press('Escape');
  await page.getByRole('dialog').waitFor({ state: 'detached' });
  assert.equal(await atPlate(), true);
});

test('those who hear the page hear that the plate is ready, or that its work was cancelled', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const { page } = visit;
  const said = page.locator('sillon-status .said');
  const change = (width) =>
    page.evaluate(
      (width) => document.querySelector('sillon-app').studio.change((plate) => ({ ...plate, width })),
      width,
    );
  await change(30);
  await page.waitForFunction(() => {
    const { renderRoot } = document.querySelector('sillon-app');
    const stage = renderRoot.querySelector('sillon-stage').renderRoot;
    return /^The plate is ready: .*, \d+\.\d g\.$/.test(
      stage.querySelector('sillon-status').renderRoot.querySelector('.said').textContent,
    );
  });
  assert.equal(await said.getAttribute('role'), 'status');
  assert.match(
    await page.locator('sillon-canvas .overlay').getAttribute('aria-label'),
    /^Untitled plate, Look, 30 × 24 mm\. Arrow keys/,
  );
  await change(90);
  await visit.until(({ progress }) => progress !== undefined);
  await page.evaluate(() => document.querySelector('sillon-app').studio.services.cancel());
  await page.getByText('Cancelled. Change anything to start again.').first().waitFor();
  assert.match(await said.textContent(), /^Cancelled/);
});

test('a dialog opens on its first field, not on its cross', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  for (const [dialog, name] of [
    ['palette', /All actions/],
    ['share', /./],
  ]) {
    await page.evaluate((name) => document.querySelector('sillon-app').studio.show(name), dialog);
    await page.locator(`sillon-${dialog} dialog[open]`).waitFor();
    const label = await focused(page);
    assert.doesNotMatch(label, /^Close$/);
    assert.match(label, name);
    await page.keyboard.press('Escape');
    await page.locator(`sillon-${dialog}`).waitFor({ state: 'detached' });
  }
});

/** What has the focus, through all shadows. */
const focused = (page) =>
  page.evaluate(() => {
    let element = document.activeElement;
    while (element?.shadowRoot?.activeElement) element = element.shadowRoot.activeElement;
    return element === null
      ? ''
      : `${element.tagName} ${element.getAttribute('aria-label') ?? element.textContent.trim()}`;
  });

test('what was opened gives the focus back to what it was opened from', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const { page } = visit;
  const leave = async () => {
    await page.getByRole('dialog').waitFor();
    await page.keyboard.press('Escape');
    await page.getByRole('dialog').waitFor({ state: 'detached' });
  };
  for (const [id, name] of [
    ['export', /Download/],
    ['menu', /Menu/],
  ]) {
    await page.locator(`[popovertarget=${id}]`).press('Enter');
    await page.locator(`#${id} .item`).first().focus();
    await page.keyboard.press('Escape');
    await page.locator(`#${id}`).waitFor({ state: 'hidden' });
    assert.match(await focused(page), name);
    await page.locator(`[popovertarget=${id}]`).press('Enter');
    await page
      .locator(`#${id}`)
      .getByRole('button', { name: id === 'menu' ? 'Calibrate' : 'Share' })
      .press('Enter');
    await leave();
    assert.match(await focused(page), name);
  }
  // From no control at all: to the plate, where keys do something.
  await page.evaluate(() => {
    for (let one = document.activeElement; one; one = one.shadowRoot?.activeElement) one.blur();
  });
  await page.keyboard.press('Control+k');
  await leave();
  assert.equal(await page.locator('sillon-canvas .overlay').evaluate((one) => one.matches(':focus')), true);
});

test(
  'arrow keys go through cards, and only Space and Enter choose, so that none asks for a file',
  { skip },
  async () => {
    const visit = await bench.open({ small: true });
    await visit.idle();
    const { page } = visit;
    let asked = 0;
    page.on('filechooser', () => ++asked);
    await visit.ways();
    const card = (name) => page.getByRole('radio', { name, exact: true });
    const pattern = ({ plate }) => plate.layers[0].pattern;
    const hasFocus = (name) => card(name).evaluate((one) => one.matches(':focus'));
    await card('Waves').focus();
    await page.keyboard.press('ArrowLeft');
    assert.equal(await hasFocus('Spiral'), true);
    assert.equal(await visit.state(pattern), 'waves');
    await page.keyboard.press('Space');
    await visit.until(({ plate }) => plate.layers[0].pattern === 'spiral');
    await page.keyboard.press('ArrowDown');
    assert.equal(await visit.state(pattern), 'spiral');
    await page.keyboard.press('Enter');
    await visit.until(({ plate }) => plate.layers[0].pattern === 'waves');
    await card('Colours').focus();
    await page.keyboard.press('ArrowRight');
    assert.equal(await hasFocus('Direction map'), true);
    assert.equal(await visit.state(pattern), 'waves');
    assert.equal(asked, 0);
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.keyboard.press('Enter')]);
    assert.ok(chooser);
  },
);

for (const colorScheme of ['light', 'dark']) {
  test(`axe finds nothing in any section, view and dialog, ${colorScheme}`, { skip }, async () => {
    const visit = await bench.open({ colorScheme, small: true });
    await visit.idle();
    const { page } = visit;
    // In the dark, the colours alone are others.
    const rules = colorScheme === 'dark' ? { runOnly: ['color-contrast'] } : {};
    for (const view of ['Look', 'Path', 'Check']) {
      await visit.view(view);
      await settled(page);
      assert.deepEqual(await violations(page, rules), [], view);
    }
    for (const section of ['Shape', 'Print', 'Picture']) {
      await visit.section(section);
      await settled(page);
      assert.deepEqual(await violations(page, rules), [], section);
    }
    for (const fill of ['Spiral', 'Noise', 'Rays']) {
      await page.getByRole('radio', { name: fill }).check();
      await visit.idle();
      assert.deepEqual(await violations(page, rules), [], fill);
    }
    const panel = page.locator('sillon-layers-panel');
    for (const [kind, name] of [
      ['text', 'Text'],
      ['code', 'QR code'],
    ]) {
      if (kind !== 'text') await panel.locator('#add').click();
      await panel
        .locator(kind === 'text' ? '.start' : '#kinds')
        .getByRole('button', { name })
        .click();
      await visit.until(`({ plate }) => plate.layers.at(-1).kind === '${kind}'`); // once there is a place for it
      await visit.idle();
      assert.deepEqual(await violations(page, rules), [], name);
    }
    await panel.locator('li .row').last().click(); // the ground
    await panel.getByRole('radio', { name: 'Rays' }).waitFor();
    await panel.locator('#add').click();
    await settled(page);
    assert.deepEqual(await violations(page, rules), [], 'the ground of several layers');
    for (const dialog of ['Examples', 'Share', 'Help']) {
      await (dialog === 'Examples' ? visit.button(dialog).click() : visit.menu(dialog));
      await page.getByRole('dialog').waitFor();
      await settled(page);
      assert.deepEqual(await violations(page, rules), [], dialog);
      await page.keyboard.press('Escape');
    }
    const show = (dialog) =>
      page.evaluate((dialog) => document.querySelector('sillon-app').studio.show(dialog), dialog);
    await show('calibrate');
    await page.getByRole('img', { name: 'Coupon, as it would look' }).waitFor();
    for (const tab of ['Prints', 'Photograph', 'Spools']) {
      await page.getByRole('radio', { name: tab, exact: true }).check();
      await settled(page);
      assert.deepEqual(await violations(page, rules), [], `calibrate, ${tab}`);
    }
    await page.keyboard.press('Escape');
    await visit.until((state) => state.dialog === undefined);
    for (const dialog of ['first', 'firstFile', 'card']) {
      await show(dialog);
      await page.getByRole('dialog').waitFor();
      await settled(page);
      assert.deepEqual(await violations(page, rules), [], dialog);
      await page.keyboard.press('Escape');
      await visit.until((state) => state.dialog === undefined);
    }
    await page.locator('[popovertarget=menu]').click();
    await page.locator('#menu .about').waitFor();
    assert.deepEqual(await violations(page, rules), [], 'menu');
  });
}

test('keys alone reach everything that the plate needs', { skip }, async () => {
  const visit = await bench.open({ small: true, fresh: true });
  await visit.idle();
  const { page } = visit;
  await page.keyboard.press('Tab');
  assert.match(await focused(page), /Skip to the plate/);
  const seen = new Set();
  for (let k = 0; k < 120; ++k) {
    await page.keyboard.press('Tab');
    seen.add(await focused(page));
  }
  const names = [...seen].join('\n');
  for (const name of ['Examples', 'Menu', 'Download', 'Shape', 'Print', 'Look', 'mm. Arrow keys']) {
    assert.ok(names.includes(name), `${name} is not reached; these are:\n${names}`);
  }
  // Views, tools, a stroke, undo, help: without a pointer.
  await page.locator('sillon-canvas .overlay').focus();
  await page.keyboard.press('2');
  await visit.until((state) => state.view === 'toolpath');
  await page.keyboard.press('b');
  await visit.until((state) => state.tool === 'comb');
  await page.locator('sillon-canvas .overlay').focus();
  await page.keyboard.press('Space');
  for (let k = 0; k < 4; ++k) await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Space');
  await visit.until(({ plate, live }) => plate.layers[1]?.kind === 'strokes' && !live);
  assert.equal(await visit.state(({ plate }) => plate.layers[1].strokes.length), 1);
  await visit.idle();
  await page.keyboard.press('Control+z');
  await visit.until(({ plate }) => plate.layers.length === 1);
  await page.keyboard.press('?');
  await page.getByRole('dialog').waitFor();
  await page.keyboard.press('Escape');
  await visit.until((state) => state.dialog === undefined);
  await page.keyboard.press('1');
  await visit.until((state) => state.view === 'appearance');
});

test('Escape means the topmost open thing, and the work behind it goes on', { skip }, async () => {
  const visit = await bench.open({ small: true });
  const { page } = visit;
  await visit.idle();
  await page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    globalThis.cancelled = 0;
    studio.services.cancel = () => ++globalThis.cancelled;
  });
  const busy = () =>
    page.evaluate(() => {
      const progress = { job: 'making', stage: '', fraction: 0.5, secondsLeft: undefined };
      document.querySelector('sillon-app').studio.store.set({ progress });
    });
  const cancelled = () => page.evaluate(() => globalThis.cancelled);
  const escape = async (what) => {
    await busy();
    await page.keyboard.press('Escape');
    assert.equal(await cancelled(), 0, what);
  };
  for (const name of ['menu', 'export']) {
    await page.locator(`[popovertarget=${name}]`).click();
    await page.locator(`#${name}:popover-open`).waitFor();
    await escape(name);
    await page.locator(`#${name}:popover-open`).waitFor({ state: 'detached' });
  }
  await page.locator('[popovertarget=menu]').click();
  await page.locator('#menu').getByRole('combobox').first().focus();
  await escape('a select in the menu');
  await page.locator('#menu:popover-open').waitFor({ state: 'detached' });
  await visit.section('Print');
  await page.locator('#printer').focus();
  await escape('a select');
  for (const field of ['Bottom layers', 'Speed']) {
    await page.getByRole('spinbutton', { name: field }).focus();
    await page.keyboard.type('1');
    await escape(field);
  }
  await visit.menu('Share');
  await page.getByRole('dialog').waitFor();
  await escape('a dialog');
  await page.getByRole('dialog').waitFor({ state: 'detached' });
  const { x, y, width, height } = await visit.canvas();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + 30, y + height / 2, { steps: 3 });
  await escape('a drag');
  await page.mouse.up();
  // Nothing is open any more.
  await busy();
  await page.keyboard.press('Escape');
  assert.equal(await cancelled(), 1);
});

test('what opens while a sheet closes stays open', { skip }, async () => {
  const visit = await bench.open({ small: true });
  await visit.idle();
  const { page } = visit;
  await visit.menu('Help');
  await page.getByRole('dialog').waitFor();
  // The event of the closing comes after what is opened in the same task.
  const kept = await page.evaluate(async () => {
    const { studio } = document.querySelector('sillon-app');
    const sheets = [];
    const look = (root) => {
      for (const element of root.querySelectorAll('*')) {
        if (element.localName === 'dialog' && element.open) sheets.push(element);
        if (element.shadowRoot) look(element.shadowRoot);
      }
    };
    look(document);
    const closed = new Promise((resolve) => {
      sheets[0].addEventListener('close', resolve);
    });
    sheets[0].close();
    studio.show('share');
    await closed;
    return [sheets.length, studio.store.state.dialog];
  });
  assert.deepEqual(kept, [1, 'share']);
  await page.getByRole('dialog', { name: 'Share' }).waitFor();
});

test('what goes wrong behind a sheet is told in it, and can be reached', { skip }, async () => {
  const visit = await bench.open({
    small: true,
    viewport: { width: 360, height: 640 },
    hasTouch: true,
    isMobile: true,
  });
  await visit.idle();
  const { page } = visit;
  await page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.notify('Before.', { label: 'Stays a while', run: () => undefined });
    studio.show('first');
  });
  const sheet = page.locator('sillon-first dialog');
  const [chooser] = await Promise.all([
    page.waitForEvent('filechooser'),
    sheet.getByRole('button', { name: 'From your slicer’s file…' }).tap(),
  ]);
  await chooser.setFiles({ name: 'bare.gcode', mimeType: '', buffer: Buffer.from('G28\nG1 X1\n') });
  const told = sheet.getByRole('alert').locator('.problem');
  await told.waitFor();
  assert.match(await told.innerText(), /bare\.gcode/);
  assert.equal(await sheet.getByText('Before.').count(), 0); // and nothing else is
  await told.getByRole('button', { name: 'Dismiss' }).tap();
  await told.waitFor({ state: 'detached' });
  assert.equal(await sheet.locator('.body').evaluate((one) => one.matches(':focus')), true);
});

test('at 360 pixels nothing sticks out, and fingers can do it all', { skip }, async () => {
  const visit = await bench.open({
    small: true,
    viewport: { width: 360, height: 740 },
    hasTouch: true,
    isMobile: true,
  });
  await visit.idle();
  const { page } = visit;
  const wide = () => page.evaluate(() => document.documentElement.scrollWidth);
  assert.equal(await wide(), 360);
  for (const section of ['Shape', 'Picture', 'Print']) {
    await page.locator('nav').getByRole('button', { name: section, exact: true }).tap();
    await settled(page);
    assert.equal(await wide(), 360, section);
    // What is in the panel keeps inside of it.
    const outside = await page.evaluate(() => {
      const panel = document.querySelector('sillon-app').renderRoot.querySelector('.panel');
      const right = panel.getBoundingClientRect().right;
      const all = (root) =>
        [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
      return all(panel)
        .filter((one) => getComputedStyle(one).visibility !== 'hidden')
        .filter((one) => one.getBoundingClientRect().width > 0 && one.getBoundingClientRect().right > right + 1)
        .map((one) => one.outerHTML.slice(0, 90));
    });
    assert.deepEqual(outside, [], section);
  }
  // Targets for fingers: 24 pixels at least, as WCAG 2.2 asks.
  const small = await page.evaluate(() => {
    const all = (root) =>
      [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
    return all(document)
      .filter((one) => one.matches('button, select, a[href]'))
      .map((one) => [one.getBoundingClientRect(), one])
      .filter(([box]) => box.width > 0 && Math.min(box.width, box.height) < 24)
      .map(([box, one]) => `${one.outerHTML.slice(0, 90)} ${box.width} × ${box.height}`);
  });
  assert.deepEqual(small, []);
});

test(
  'with the system’s own colours, what is selected differs from the rest, and sliders have tracks',
  { skip },
  async () => {
    const visit = await bench.open({ small: true, forcedColors: 'active' });
    const ground = (one) => one.evaluate((element) => getComputedStyle(element).backgroundColor);
    const tab = (selected) => visit.page.locator(`[role=tab][aria-selected=${selected}]`).first();
    const section = (expanded) => visit.page.locator(`nav [aria-expanded=${expanded}]`).first();
    await visit.section('Print');
    await visit.page.locator('.cards :checked').waitFor();
    const card = (checked) => visit.page.locator('.cards label', { has: visit.page.locator(checked) }).first();
    for (const [chosen, other] of [
      [tab(true), tab(false)],
      [section(true), section(false)],
      [card(':checked'), card(':not(:checked)')],
    ])
      assert.notEqual(await ground(chosen), await ground(other));
    const adjusted = (one) => one.evaluate((element) => getComputedStyle(element).forcedColorAdjust);
    assert.equal(await adjusted(visit.page.locator('input[type=range]').first()), 'none');
    assert.equal(await adjusted(visit.page.locator('select').first()), 'none');
  },
);

test('French, from the browser or from the menu, and it stays', { skip }, async () => {
  const visit = await bench.open({ small: true, locale: 'fr-FR' });
  await visit.idle();
  assert.equal(await visit.page.evaluate(() => document.documentElement.lang), 'fr');
  assert.ok(await visit.button('Exemples').isVisible());
  await visit.page.locator('[popovertarget=menu]').click();
  await visit.page.locator('#language').selectOption('en');
  await visit.until((state) => state.language === 'en');
  await visit.page.reload();
  await visit.idle();
  assert.ok(await visit.button('Examples').isVisible());
});

test('the light keeps still for people who ask for less motion, and moves for others', { skip }, async () => {
  const azimuth = (state) => state.light.azimuth;
  // By itself it would stand still on a machine without a graphics card, too.
  const orbit = (visit) => visit.page.evaluate(() => document.querySelector('sillon-app').studio.setLightMode('orbit'));
  const calm = await bench.open({ small: true, reducedMotion: 'reduce' });
  await calm.until((state) => state.result !== undefined);
  await orbit(calm);
  const first = await calm.state(azimuth);
  await calm.page.evaluate(async () => {
    for (let frame = 0; frame < 30; ++frame) await new Promise(requestAnimationFrame);
  });
  assert.equal(await calm.state(azimuth), first);
  await calm.close();
  const lively = await bench.open({ small: true, reducedMotion: 'no-preference' });
  await lively.until((state) => state.result !== undefined);
  await orbit(lively);
  const before = await lively.state(azimuth);
  await until(async () => (await lively.state(azimuth)) !== before, 'the light’s move');
});

test('the page can be used before the engine is there', { skip }, async () => {
  const visit = await bench.open({ path: '/404' });
  await visit.page.route('**/engine/**', () => undefined); // never answered
  await visit.page.goto(bench.origin);
  await visit.section('Print');
  const spacing = visit.page.getByRole('spinbutton', { name: 'Line width' });
  await spacing.fill('0.6');
  await visit.page.keyboard.press('Enter');
  await visit.until((state) => state.plate.toolpath.spacing === 0.6 && state.progress?.job === 'loading');
  await visit.page.keyboard.press('Control+z');
  await visit.page.getByRole('combobox', { name: 'Printer' }).waitFor();
});
