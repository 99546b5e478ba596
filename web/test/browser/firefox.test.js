// The studio's own page in Firefox: files that are dropped there become Chromium's G-code, to the byte but for its date.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { lacking, launch } from '../../../wasm/test/support/browsers.js';
import { serve } from '../../../wasm/test/support/server.js';
import { headers } from '../../headers.js';
import { smallPlate } from './support/small.js';
import { inputs } from './support/studio.js';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const names = ['Chromium', 'Firefox'];
const skip = lacking('Chromium') || lacking('Firefox');
const plain = { graphics: false }; // pictures would be drawn in software, and nobody looks at them

const files = [
  { address: '/files/photo.png', type: 'image/png' },
  { address: '/pages/two-colours.svg', type: 'image/svg+xml' },
];

let site;
const browsers = {};

before(async () => {
  if (skip) return;
  assert.ok(existsSync(at('../../dist/index.html')), 'there is no web/dist; ./dev build makes it');
  site = await serve({ '/': at('../../dist/'), '/pages/': at('pages/'), '/files/': `${inputs}/` }, headers);
  for (const name of names) browsers[name] = await launch(name, plain);
});
after(async () => {
  for (const browser of Object.values(browsers)) await browser.close();
  site?.close();
});

for (const { address, type } of files) {
  test(`${address} becomes the same G-code in Firefox as in Chromium`, { skip }, async () => {
    const made = [];
    for (const browser of names) {
      const asked = { path: `/${smallPlate}`, address, type };
      const { value, error } = await browsers[browser].attempt(`${site.origin}/pages/studio.html`, 'download', asked);
      assert.equal(error, undefined, `${browser}: ${error?.stack}`);
      const date = /\d{4}-\d\d-\d\d at \d\d:\d\d:\d\d UTC/;
      assert.match(value.gcode, date);
      made.push({ ...value, gcode: value.gcode.replace(date, 'DATE') });
    }
    const [chromium, firefox] = made;
    assert.ok(chromium.gcode.length > 20_000, `${chromium.gcode.length} bytes`);
    assert.equal(firefox.gcode === chromium.gcode, true, `${firefox.gcode.length} bytes, not ${chromium.gcode.length}`);
    assert.deepEqual([firefox.name, firefox.threads], [chromium.name, chromium.threads]);
  });
}
