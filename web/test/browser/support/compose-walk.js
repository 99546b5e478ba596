// The ways of somebody who makes a template of the examples their own, from the first page to a file.
import { basename, join } from 'node:path';

import { inputs } from './studio.js';

const logo = {
  name: 'own-logo.svg',
  mimeType: 'image/svg+xml',
  buffer: Buffer.from(
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 50"><path d="M0 0h40v20L20 50 0 20z"/></svg>',
  ),
};
const photograph = join(inputs, 'photo.png');

/** `changes`: the rows of layers by their names, and what a hand puts into each. */
const tasks = {
  'name sign': { template: 'Name sign', changes: [['Amélie', { text: 'Jonathan' }]] },
  'logo coaster': { template: 'Logo coaster', changes: [['strokes.svg', { file: logo }]] },
  'photo ring': {
    template: 'Picture in a ring',
    changes: [
      ['moon.png', { file: photograph }],
      ['TO THE MOON AND BACK', { text: 'OUR SUMMER AT THE SEA' }],
    ],
  },
  keychain: { template: 'Key ring tag', changes: [['LÉON', { text: 'MIA' }]] },
  'QR code': {
    template: 'QR code in a frame',
    changes: [['https://example.org/menu', { text: 'https://sillon.example/us' }]],
  },
};

const nameOf = (file) => (typeof file === 'string' ? basename(file) : file.name);

export const composingTasks = Object.keys(tasks);

/**
 * @param visit  of the studio
 * @param task  one of composingTasks
 * @param opened  is called once the template is there
 * @returns what a hand does, the download, and what the plate should have then: words, and names of files
 */
export async function walkToComposed(visit, task, opened = () => {}) {
  const { page } = visit;
  const { template, changes } = tasks[task];
  const done = { clicks: 0, fields: 0, keys: 0, files: 0 };
  const click = async (locator) => {
    ++done.clicks;
    await locator.click();
  };
  await click(visit.button('Examples').first());
  await click(page.locator('sillon-gallery').getByRole('button', { name: template }));
  const panel = page.locator('sillon-layers-panel');
  await visit.until(`({ plate }) => plate.name === ${JSON.stringify(template)}`);
  await opened();
  for (const [row, { text, file }] of changes) {
    await click(panel.getByRole('button', { name: row, exact: true }).first());
    if (text !== undefined) {
      const field = panel.locator('#layer-text');
      await click(field);
      await page.keyboard.press('ControlOrMeta+a');
      await field.pressSequentially(text);
      ++done.fields;
      done.keys += 1 + text.length;
    }
    if (file !== undefined) {
      const [chooser] = await Promise.all([
        page.waitForEvent('filechooser'),
        click(panel.getByRole('button', { name: /^Replace/ })),
      ]);
      await chooser.setFiles(file);
      ++done.files;
      const name = nameOf(file);
      await visit.until(
        `({ plate }) => plate.layers.flatMap(({ file, pictures }) => [file, ...pictures.map((one) => one.file)])
          .some((one) => one?.name === '${name}')`,
      );
    }
  }
  await click(page.locator('[popovertarget=export]'));
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    click(page.locator('#export').getByRole('button', { name: /^G-code/ })),
  ]);
  const wanted = changes.map(([, { text, file }]) => text ?? nameOf(file));
  return { ...done, download, wanted };
}
