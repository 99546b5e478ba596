// The studio in frames of all kinds of pages, and on all kinds of hosts: as many threads as it can have there, and in every
// one the native program's bytes. docs/guide/embedding.md has the table.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { availableParallelism, tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { lacking, launch, startChromium, withoutGraphics } from '../../../wasm/test/support/browsers.js';
import { serve as serveWith } from '../../../wasm/test/support/server.js';
import { isolation } from '../../headers.js';
import { serve } from '../../serve.js';
import { natively } from '../browser/support/native.js';

const dist = fileURLToPath(new URL('../../dist', import.meta.url));
const pages = fileURLToPath(new URL('../browser/pages/', import.meta.url));
const web = fileURLToPath(new URL('../..', import.meta.url));
const vite = fileURLToPath(new URL('../../../node_modules/vite/bin/vite.js', import.meta.url));
const enginePath = fileURLToPath(new URL('../../../wasm/dist/engine/', import.meta.url));
const all = Math.min(8, availableParallelism());

/** A plate with all that a project can have but files. */
const project = {
  sillon: 1,
  shape: { builtin: 'rounded', size: [24, 18], radius: 4 },
  layers: [{ kind: 'direction', angle: 25 }],
  toolpath: { spacing: 0.45, seed: 3 },
  print: { layers: 1, base: 1 },
};

const coep = {
  'Cross-Origin-Opener-Policy': isolation['Cross-Origin-Opener-Policy'],
  'Cross-Origin-Embedder-Policy': isolation['Cross-Origin-Embedder-Policy'],
};
const strict = (studio) => ({
  'Content-Security-Policy': `default-src 'none'; script-src 'self' ${studio}; style-src 'self'; frame-src ${studio}`,
});
const hosts = {
  plain: () => ({}),
  isolated: () => coep,
  credentialless: () => ({ ...coep, 'Cross-Origin-Embedder-Policy': 'credentialless' }),
  document: () => ({ 'Document-Isolation-Policy': isolation['Document-Isolation-Policy'] }),
  strict,
};

/** `threads` by browser: Chromium, Firefox, WebKit; 0: the frame does not start; undefined: not asked. */
const contexts = [
  { name: 'element in a plain page', host: 'plain', task: 'plate', threads: [all, 1, 1] },
  { name: 'element in an isolated page', host: 'isolated', task: 'plate', threads: [all, all, 1] },
  {
    name: 'element in an isolated page (credentialless)',
    host: 'credentialless',
    task: 'plate',
    threads: [all, all, 1],
  },
  { name: 'frame without allow in an isolated page', host: 'isolated', task: 'raw', threads: [all, all, 1] },
  { name: 'element in a page of a document isolation policy', host: 'document', task: 'plate', threads: [all, 1, 1] },
  { name: 'element in a page of a strict policy', host: 'strict', task: 'plate', threads: [all, 1, 1] },
  {
    name: 'sandboxed frame of opaque origin',
    host: 'plain',
    task: 'raw',
    args: { sandbox: 'allow-scripts' },
    threads: [all, 1, undefined],
  },
  {
    name: 'sandboxed frame of opaque origin in an isolated page',
    host: 'isolated',
    task: 'raw',
    args: { sandbox: 'allow-scripts', allow: 'cross-origin-isolated' },
    threads: [all, undefined, undefined],
  },
  {
    name: 'sandboxed frame of its own origin',
    host: 'plain',
    task: 'plate',
    args: { attributes: { sandbox: 'allow-scripts allow-same-origin allow-downloads' } },
    threads: [all, 1, 1],
  },
  {
    name: 'threads switched off',
    host: 'plain',
    task: 'plate',
    args: { attributes: { threads: 'off' } },
    threads: [1],
  },
  { name: 'a studio without headers', host: 'plain', studio: 'bare', task: 'plate', threads: [1, 1, 1] },
];
const browsers = ['Chromium', 'Firefox', 'WebKit'];
const plain = { graphics: false }; // else most of the time would go into pictures, drawn in software, that nobody looks at

const sites = {};
let expected;

before(async () => {
  assert.ok(existsSync(`${dist}/embed.html`), 'there is no web/dist; ./dev build makes it');
  sites.studio = await serve(dist, 0);
  // As most hosts of static files: other sites may read them, nothing more.
  sites.bare = await serveWith({ '/': `${dist}/` }, { 'Access-Control-Allow-Origin': '*' });
  for (const [name, headers] of Object.entries(hosts)) {
    sites[name] = await serveWith({ '/': pages }, headers(sites.studio.origin));
  }
  if (lacking('Chromium')) return;
  const browser = await launch('Chromium', plain);
  try {
    const { value } = await browser.attempt(hostPage('plain'), 'plate', {
      studio: studioAt('studio'),
      project,
      zip: true,
    });
    const { length, hash } = value;
    assert.equal(natively(Buffer.from(value.zip, 'base64'), value.gcode), value.gcode);
    expected = { length, hash };
  } finally {
    await browser.close();
  }
});
after(() => {
  for (const site of Object.values(sites)) site.close();
});

/** Another site than the studio's localhost. */
const hostPage = (name) => `${sites[name].origin.replace('localhost', '127.0.0.1')}/host.html`;
const studioAt = (name) => `${sites[name].origin}/`;

browsers.forEach((name, k) => {
  describe(name, { skip: lacking('Chromium') || lacking(name) }, () => {
    let browser;
    before(async () => {
      browser = await launch(name, plain);
    });
    after(() => browser?.close());

    for (const { name: context, host, studio = 'studio', task, args, threads } of contexts) {
      if (threads[k] === undefined) continue;
      test(context, async () => {
        const asked = { studio: studioAt(studio), project, ...args };
        const { value, error } = await browser.attempt(hostPage(host), task, asked);
        assert.equal(error, undefined);
        assert.equal(value.threads, threads[k]);
        assert.match(value.why, value.threads > 1 ? /^$/ : /thread/i);
        assert.match(value.name, /^project_0\.4mm_PLA_\d+m\.gcode$/);
        const { length, hash } = value;
        assert.deepEqual({ length, hash }, expected);
      });
    }
  });
});

describe('Chromium', { skip: lacking('Chromium') }, () => {
  let browser;
  before(async () => {
    browser = await startChromium(withoutGraphics);
  });
  after(() => browser?.close());

  /** The studio's own page: threads, and the same plate's bytes. */
  async function studioPage(context, address, settled) {
    const page = await context.newPage();
    const elsewhere = [];
    page.on('request', (request) => {
      if (!request.url().startsWith(address) && !request.url().startsWith('blob:')) elsewhere.push(request.url());
    });
    await page.goto(address);
    if (settled !== undefined) await page.waitForFunction(settled);
    await page.waitForFunction(() => document.querySelector('sillon-app')?.studio.store.state.result?.measured);
    const made = await page.evaluate(async (project) => {
      const { studio } = document.querySelector('sillon-app');
      await studio.services.open([new File([JSON.stringify(project)], 'project.json')]);
      const { blob } = await studio.make('gcode');
      return { threads: studio.store.state.engine.threads, gcode: await blob.text() };
    }, project);
    const zip = await page.evaluate(async () => {
      const { blob } = await document.querySelector('sillon-app').studio.make('project');
      return Array.from(new Uint8Array(await blob.arrayBuffer()));
    });
    assert.equal(natively(Buffer.from(zip), made.gcode), made.gcode);
    assert.deepEqual(elsewhere, [], 'other sites were asked for something');
    await context.close();
    return made.threads;
  }

  test('the studio’s own page, with its headers', async () => {
    assert.equal(await studioPage(await browser.newContext(), studioAt('studio')), all);
  });

  test('the studio’s own page, without headers or service worker', async () => {
    assert.equal(await studioPage(await browser.newContext({ serviceWorkers: 'block' }), studioAt('bare')), 1);
  });

  test('the studio’s own page, with headers by its service worker', async () => {
    assert.equal(await studioPage(await browser.newContext(), studioAt('bare'), () => crossOriginIsolated), all);
  });

  test('a studio whose engine lies on another site', async () => {
    const outDir = mkdtempSync(join(tmpdir(), 'sillon-engine-'));
    // As of a CDN: other sites may read the files, nothing more.
    const cdn = await serveWith({ '/engine/': enginePath }, { 'Access-Control-Allow-Origin': '*' });
    const page = await browser.newPage();
    try {
      const engine = `${cdn.origin.replace('localhost', '127.0.0.1')}/engine/`;
      execFileSync(process.execPath, [vite, 'build', '--logLevel', 'warn', '--outDir', outDir], {
        cwd: web,
        env: { ...process.env, SILLON_ENGINE: engine },
      });
      assert.ok(!existsSync(join(outDir, 'engine')));
      const site = await serveWith({ '/': `${outDir}/` }, { ...isolation, 'Access-Control-Allow-Origin': '*' });
      sites.apart = site;
      const asked = [];
      page.on('request', (request) => asked.push(request.url()));
      await page.goto(hostPage('plain'));
      // Whoever writes the frame's address cannot send it elsewhere.
      const address = {
        studio: studioAt('apart'),
        path: `embed.html?engine=${encodeURIComponent('https://evil.example/')}`,
      };
      const { value, error } = await page.evaluate((asked) => globalThis.attempt('raw', asked), {
        ...address,
        project,
      });
      assert.equal(error, undefined);
      const { threads, length, hash } = value;
      assert.deepEqual({ threads, length, hash }, { threads: all, ...expected });
      assert.ok(asked.some((url) => url.startsWith(`${engine}sillon-mt`)));
      assert.deepEqual(
        asked.filter(
          (url) =>
            !['blob:', engine, hostPage('plain').replace('host.html', ''), studioAt('apart')].some((from) =>
              url.startsWith(from),
            ),
        ),
        [],
      );
    } finally {
      await page.close();
      cdn.close();
      rmSync(outDir, { recursive: true });
    }
  });

  test('storage denied', async () => {
    const context = await browser.newContext();
    await context.addInitScript(() => {
      const denied = () => {
        throw new DOMException('denied', 'SecurityError');
      };
      for (const name of ['indexedDB', 'localStorage', 'sessionStorage']) {
        Object.defineProperty(globalThis, name, { get: denied });
      }
    });
    const page = await context.newPage();
    await page.goto(hostPage('plain'));
    const asked = { studio: studioAt('studio'), project, attributes: { autosave: 'work' } };
    const { value, error } = await page.evaluate((asked) => globalThis.attempt('plate', asked), asked);
    assert.equal(error, undefined);
    const { threads, length, hash } = value;
    assert.deepEqual({ threads, length, hash }, { threads: all, ...expected });
    await context.close();
  });

  test('a frame that the browser blocks becomes a link', async () => {
    const page = await browser.newPage();
    await page.goto(hostPage('isolated'));
    // The element's script must come with leave, or the page could not even have it.
    await page.route(`${studioAt('bare')}embed/*`, async (route) => {
      const response = await route.fetch();
      await route.fulfill({
        response,
        headers: { ...response.headers(), 'cross-origin-resource-policy': 'cross-origin' },
      });
    });
    for (const [lang, message] of [
      [undefined, 'The studio cannot be shown here.'],
      ['de-AT', 'Das Studio kann hier nicht angezeigt werden.'],
    ]) {
      const { value, error } = await page.evaluate((asked) => globalThis.attempt('blocked', asked), {
        studio: studioAt('bare'),
        lang,
      });
      assert.equal(error, undefined);
      const href = studioAt('bare');
      assert.deepEqual(value, { code: 'Blocked', refused: 'Blocked', message, href, target: '_blank' });
    }
    await page.close();
  });
});
