// The Print section: few fields at first, and sentences that lead to the settings that they name.
import assert from 'node:assert/strict';
import { after, afterEach, before, beforeEach, test } from 'node:test';

import { skip, start } from './support/studio.js';

let studio, visit;
before(async () => {
  if (!skip) studio = await start();
});
after(() => studio?.close());
beforeEach(async () => {
  if (!skip) visit = await studio.open({ small: true });
});
afterEach(async ({ passed }) => {
  if (!skip) await studio.leave(visit, passed);
});

/** Waits until a field has the focus, and tells whether it can be seen. */
async function focusedAt(id) {
  await visit.page.waitForFunction((id) => {
    let one = document.activeElement;
    while (one?.shadowRoot?.activeElement) one = one.shadowRoot.activeElement;
    return one?.id === id || one?.name === id;
  }, id);
  const box = await visit.page.locator(`#${id}, input[name='${id}']:checked`).first().boundingBox();
  return box.y > 0 && box.y + box.height < 600;
}

/** What the engine would say. */
const warn = (part, warning) =>
  visit.page.evaluate(
    ([part, warning]) => {
      const { store } = document.querySelector('sillon-app').studio;
      const { summary, result } = store.state;
      const warnings = [{ message: '', ...warning }];
      store.set(
        part === 'summary'
          ? { summary: { ...summary, warnings } }
          : { result: { ...result, report: { ...result.report, warnings } } },
      );
    },
    [part, warning],
  );

test('at first few fields are seen, and warnings stand below them', { skip }, async () => {
  await visit.idle();
  await warn('summary', { code: 'NoPressureAdvance', values: { speed: 20, minutes: 4, asked: 50 } });
  await visit.section('Print');
  await visit.page.getByText('Nothing sets pressure advance').waitFor();
  const seen = () =>
    visit.page.evaluate(() => {
      const { renderRoot } = document.querySelector('sillon-app').renderRoot.querySelector('sillon-print-panel');
      const fields = [...renderRoot.querySelectorAll('.field, .cards')].filter((one) => one.checkVisibility());
      const [warning] = renderRoot.querySelectorAll('.warnings li');
      return [fields.length, fields.every((one) => one.compareDocumentPosition(warning) & 4)];
    });
  const [atFirst, above] = await seen();
  assert.ok(atFirst > 8 && atFirst <= 15, `${atFirst} fields`);
  assert.ok(above, 'a field stands below the warning');
  await visit.page.getByText('Advanced settings').click();
  await visit.page.getByText('Flow and retraction').waitFor();
  assert.equal((await seen())[0], atFirst, 'groups are folded');
  await visit.page.getByRole('button', { name: 'note before you print' }).click();
  assert.ok((await visit.page.getByText('Nothing sets pressure advance').boundingBox()).y < 600);
});

test('a setting that a warning names is unfolded and gets the focus', { skip }, async () => {
  await visit.idle();
  await warn('summary', { code: 'NoPressureAdvance', values: { speed: 20, minutes: 4, asked: 50 } });
  await visit.section('Print');
  await visit.page.getByRole('button', { name: 'Speed, top layers', exact: true }).click();
  assert.ok(await focusedAt('printer-showSpeed'));
  await visit.page.getByRole('button', { name: 'Set pressure advance', exact: true }).click();
  assert.ok(await focusedAt('printer-setPressureAdvance'));
});

test('a setting that is refused can be reached from the sentence that refuses it', { skip }, async () => {
  await visit.idle();
  await visit.page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.change((plate) => ({ ...plate, print: { ...plate.print, layerHeight: 0.5 } }));
    studio.settle();
  });
  const told = visit.page.locator('sillon-notices .problem');
  await told.getByRole('button', { name: 'Layer height', exact: true }).click();
  assert.ok(await focusedAt('print-layerHeight'));
});

test('choices of words can be reached, and those that are not there by what brings them', { skip }, async () => {
  await visit.idle();
  const show = async (label, text) => {
    await visit.page.keyboard.press('Control+k');
    await visit.page.locator('sillon-palette input').fill(text);
    await visit.page.locator('sillon-palette [role=option]', { hasText: label }).first().click();
  };
  await show('Print: Side to show', 'side to show');
  assert.ok(await focusedAt('print-showSide'));
  await show('Print: Rim width', 'rim width');
  assert.ok(await focusedAt('print-rim'));
});

test('the check lists layers with problems, and leads to them and to what would help', { skip }, async () => {
  await visit.idle();
  await warn('result', { code: 'ThinLetters', values: { layer: 1, percent: 40 } });
  await visit.view('Check');
  const panel = visit.page.locator('sillon-quality-panel');
  await panel.getByText('Layers with problems').waitFor();
  assert.match(await panel.locator('.verdicts').last().innerText(), /40% of what layer 1 draws is narrower/);
  await panel.getByRole('button', { name: 'Line width', exact: true }).click();
  assert.ok(await focusedAt('toolpath-spacing'));
  await visit.view('Check');
  await panel.locator('[aria-labelledby=layers-title]').getByRole('button').first().click();
  await visit.until(({ panel, layer, plate }) => panel === 'layers' && layer === plate.layers[0].id);
});
