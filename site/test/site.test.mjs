// The site as it is published: whole in itself, readable by everybody, and its gallery opens in the studio.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, posix } from 'node:path';
import { after, before, test } from 'node:test';

import { lacking, startChromium } from '../../wasm/test/support/browsers.js';
import { serve } from '../../web/serve.js';
import { buildSite, exampleNames } from '../build.mjs';
import { root } from '../pages.mjs';

const folder = mkdtempSync(join(tmpdir(), 'sillon-site-'));
let site, browser;

before(async () => {
  await buildSite(folder, ['stress_17', 'stress_35']); // the quickest
  site = await serve(folder, 0);
  if (!lacking('Chromium')) browser = await startChromium();
});
after(async () => {
  await browser?.close();
  site?.close();
  rmSync(folder, { recursive: true });
});

const htmlFiles = () =>
  readdirSync(folder, { recursive: true }).filter((name) => /^(docs|gallery)\/.*\.html$/.test(name));

test('every link and picture of every page is there, and nothing comes from elsewhere', () => {
  const files = htmlFiles();
  assert.ok(files.length > 40);
  const broken = [];
  for (const file of files) {
    const html = readFileSync(join(folder, file), 'utf8');
    for (const [, kind, address] of html.matchAll(/<[^>]*?\b(href|src)="([^"]*)"/g)) {
      if (/^[a-z]+:/.test(address)) {
        if (kind === 'src' || /<link[^>]*$/.test(html.slice(0, html.indexOf(address))))
          broken.push(`${file}: ${address}`);
        continue;
      }
      const [path, anchor] = address.split('#');
      const target = path === '' ? file : posix.join(posix.dirname(file), path);
      const found = [target, posix.join(target, 'index.html')].find(
        (name) => /\.\w+$/.test(name) && existsSync(join(folder, name)),
      );
      if (found === undefined) broken.push(`${file}: ${address}`);
      else if (anchor && /^(docs|gallery)\//.test(found)) {
        if (!readFileSync(join(folder, found), 'utf8').includes(`id="${anchor}"`)) broken.push(`${file}: ${address}`);
      }
    }
  }
  assert.deepEqual(broken, []);
});

test('every page says in a sentence what it is about, and the licences of all parts are there', () => {
  const without = htmlFiles().filter(
    (file) => !/<meta name="description" content="[^"]{10,}" \/>/.test(readFileSync(join(folder, file), 'utf8')),
  );
  assert.deepEqual(without, []);
  const licences = readFileSync(join(folder, 'licences.txt'), 'utf8');
  for (const name of ['eigen3', 'stb', 'fast-float', 'musl', 'minisearch', 'lit']) {
    assert.match(licences, new RegExp(`^==== ${name}[ ,]`, 'm'));
  }
});

test('every example has its place in the gallery', () => {
  const files = readdirSync(join(root, 'examples')).filter((name) => name.endsWith('.json'));
  assert.deepEqual(
    exampleNames()
      .map((name) => `${name}.json`)
      .sort(),
    files.sort(),
  );
});

for (const colorScheme of ['light', 'dark']) {
  for (const path of [
    'docs/',
    'docs/internals/how-it-works.html',
    'docs/reference/project.html',
    'docs/source/examples/minimal.cpp.html',
    'docs/search.html',
    'gallery/',
  ]) {
    test(`${path} is accessible and fits a phone, ${colorScheme}`, { skip: lacking('Chromium') }, async () => {
      const page = await browser.newPage({ viewport: { width: 360, height: 720 }, colorScheme, bypassCSP: true });
      const asked = [];
      page.on('request', (request) => asked.push(new URL(request.url()).origin));
      try {
        await page.goto(`${site.origin}/${path}`);
        assert.deepEqual([...new Set(asked)], [site.origin]);
        const excess = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(excess <= 0, `${excess} pixels wider than the page`);
        await page.addScriptTag({ path: join(root, 'node_modules/axe-core/axe.min.js') });
        const { violations } = await page.evaluate(() => globalThis.axe.run());
        assert.deepEqual(
          violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`),
          [],
        );
      } finally {
        await page.close();
      }
    });
  }
}

test('search finds the section that a word stands in', { skip: lacking('Chromium') }, async () => {
  const page = await browser.newPage();
  try {
    await page.goto(`${site.origin}/docs/search.html?q=kernel%20radius`);
    const glossary = page.locator('#results a[href*="reference/glossary.html"]');
    await glossary.first().waitFor();
    await page.fill('input[type=search]', 'qqqqzz');
    await page.waitForFunction(() => document.querySelector('#state').textContent.startsWith('Nothing was found'));
    assert.equal(await page.locator('#results li').count(), 0);
  } finally {
    await page.close();
  }
});

test(
  'a plate of the gallery opens in the studio, and no other address does',
  { skip: lacking('Chromium') },
  async () => {
    assert.ok(existsSync(join(folder, 'sw.js')), 'the studio is not built; ./dev build web');
    const page = await browser.newPage({ reducedMotion: 'reduce' });
    const plate = () => page.evaluate(() => document.querySelector('sillon-app').studio.store.state.plate);
    try {
      await page.goto(`${site.origin}/gallery/`);
      await page.click('text=Open stress_35 in the studio');
      await page.waitForFunction(
        () => document.querySelector('sillon-app')?.studio.store.state.plate.shape.kind === 'file',
      );
      const { shape, width, layers } = await plate();
      assert.deepEqual(
        [shape.file.name, width, layers[0].kind, layers[0].modeFile.name],
        ['stress.svg', 35, 'map', 'stress_mode.png'],
      );
      assert.ok(!page.url().includes('#'));

      const fetched = [];
      const fresh = await browser.newContext({ reducedMotion: 'reduce' });
      const other = await fresh.newPage();
      other.on('request', (request) => fetched.push(request.url()));
      for (const wrong of ['gallery/../sw.js', '//example.org/gallery/a.zip', 'https://example.org/a.zip']) {
        await other.goto('about:blank');
        await other.goto(`${site.origin}/#open=${wrong}`);
        await other.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result);
      }
      assert.deepEqual(
        fetched.filter((url) => /example\.org|\.zip/.test(url)),
        [],
      );
      await fresh.close();
    } finally {
      await page.close();
    }
  },
);
