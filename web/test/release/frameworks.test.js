// The snippets of docs/guide/embedding.md for React and Vue, as they stand there: their types hold, and built they take what the
// visitor downloads, and show a view.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { after, afterEach, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';

import vue from '@vitejs/plugin-vue';
import ts from 'typescript';
import { build } from 'vite';

import { lacking, startChromium } from '../../../wasm/test/support/browsers.js';
import { serve as servePlain } from '../../../wasm/test/support/server.js';
import { serve } from '../../serve.js';
import { patience, until } from '../browser/support/waits.js';

const skip = lacking('Chromium');
const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const page = readFileSync(at('../../../docs/guide/embedding.md'), 'utf8');
const snippet = (language) => new RegExp(`\`\`\`${language}\n(.*?)\n\`\`\``, 's').exec(page)[1];

/** Beside the packages, which are looked for from there. */
const folder = at('../../build/frameworks');

const apps = {
  react: {
    file: 'Shop.tsx',
    language: 'tsx',
    main: `import { createRoot } from 'react-dom/client';
import { Shop } from './Shop';
const ordered = (gcode: Blob) => void (document.title = \`\${gcode.type} of \${gcode.size} bytes\`);
createRoot(document.querySelector('#app')!).render(<Shop onOrder={ordered} />);`,
    checker: 'typescript/bin/tsc',
    // a name and a type that are wrong
    wrong: ['onexport={(event)', 'onexport={(event: number)'],
    plugins: [],
  },
  vue: {
    file: 'Shop.vue',
    language: 'vue',
    main: `import { createApp } from 'vue';
import Shop from './Shop.vue';
const onOrder = (gcode: Blob) => void (document.title = \`\${gcode.type} of \${gcode.size} bytes\`);
createApp(Shop, { onOrder }).mount('#app');`,
    checker: 'vue-tsc/bin/vue-tsc.js',
    wrong: ['$event.detail.threads', '$event.detail.thread'],
    plugins: [vue({ template: { compilerOptions: { isCustomElement: (tag) => tag.startsWith('sillon-') } } })],
  },
};

/** What the checker says; '': nothing. */
function check(checker, project) {
  try {
    const program = createRequire(import.meta.url).resolve(checker);
    execFileSync(process.execPath, [program, '--noEmit', '--project', project], { stdio: 'pipe' });
    return '';
  } catch ({ stdout }) {
    return stdout.toString();
  }
}

let browser, studio, site, visit;

before(async () => {
  rmSync(folder, { recursive: true, force: true });
  if (skip) return;
  browser = await startChromium();
  studio = await serve(at('../../dist'), 0);
});
after(async () => {
  await browser?.close();
  studio?.close();
});
afterEach(async () => {
  await visit?.close();
  site?.close();
  visit = site = undefined;
});

for (const [name, { file, language, main, checker, wrong, plugins }] of Object.entries(apps)) {
  describe(name, () => {
    const root = `${folder}/${name}`;
    const write = (path, text) => writeFileSync(`${root}/${path}`, text);
    before(() => {
      mkdirSync(root, { recursive: true });
      write(file, snippet(language));
      write(name === 'react' ? 'main.tsx' : 'main.ts', main);
      const compilerOptions = {
        target: 'ES2022',
        module: 'ESNext',
        moduleResolution: 'bundler',
        jsx: 'react-jsx',
        lib: ['ES2022', 'DOM', 'DOM.Iterable'],
        types: [],
        strict: true,
        skipLibCheck: true, // ours are checked with the package
      };
      write('tsconfig.json', JSON.stringify({ compilerOptions, include: ['.'] }));
    });

    test('its types hold, and refuse what is wrong', () => {
      const [right, mistaken] = wrong;
      assert.ok(snippet(language).includes(right));
      write(`Wrong${file}`, snippet(language).replace(right, mistaken));
      const said = check(checker, root);
      rmSync(`${root}/Wrong${file}`);
      const faults = said.split('\n').filter((line) => /error TS/.test(line));
      assert.ok(faults.length > 0);
      assert.deepEqual(
        faults.filter((line) => !line.includes(`Wrong${file}`)),
        [],
      );
    });

    test('it takes what is ordered and what is downloaded', { skip }, async () => {
      const scripts = ['studio', 'view'].map(
        (one) => `<script type="module" src="${studio.origin}/embed/sillon-${one}.js"></script>`,
      );
      const entry = `<script type="module" src="./main.ts${name === 'react' ? 'x' : ''}"></script>`;
      write(
        'index.html',
        `<!doctype html><html lang="en"><title>A shop</title><link rel="icon" href="data:," />${scripts.join('')}${entry}<div id="app"></div></html>`,
      );
      const outDir = `${root}/built`;
      await build({
        root,
        base: './',
        plugins,
        logLevel: 'error',
        configFile: false,
        build: { outDir, target: 'es2022' },
      });
      for (const one of ['plate.json', 'plate.view.png']) {
        cpSync(at(`../../../examples/embed-page/${one}`), `${outDir}/${one}`);
      }
      site = await servePlain({ '/': `${outDir}/` });
      visit = await browser.newPage({ reducedMotion: 'reduce', locale: 'en-US' });
      visit.setDefaultTimeout(patience);
      const problems = [];
      visit.on('pageerror', (error) => problems.push(String(error)));
      await visit.goto(`${site.origin.replace('localhost', '127.0.0.1')}/index.html`);
      // Found once it can be clicked: retried clicks scroll the page first, and may then land in the frame above.
      await visit.getByRole('button', { name: 'Order', disabled: false }).click();
      const gcode = /^text\/x-gcode of \d{5,} bytes$/;
      await until(async () => gcode.test(await visit.title()), 'the ordered file');
      await visit.evaluate(() => (document.title = ''));
      const frame = await (await visit.locator('sillon-studio iframe').elementHandle()).contentFrame();
      const downloads = [];
      visit.on('download', (download) => downloads.push(download));
      await frame.locator('[popovertarget=export]').click();
      await frame
        .locator('#export')
        .getByRole('button', { name: /^G-code/ })
        .click();
      await until(async () => gcode.test(await visit.title()), 'the downloaded file');
      assert.deepEqual(downloads, []);
      await visit.locator('sillon-view').scrollIntoViewIfNeeded();
      await visit.locator('sillon-view canvas:not([hidden])').waitFor();
      assert.deepEqual(problems, []);
    });
  });
}

test('the types name the attributes that the elements have', { skip }, async () => {
  const program = ts.createProgram([at('../../../wasm/elements/index.d.ts')], {});
  const checker = program.getTypeChecker();
  const file = program.getSourceFile(at('../../../wasm/elements/index.d.ts'));
  const attributes = (name) => {
    const symbol = checker.getExportsOfModule(checker.getSymbolAtLocation(file)).find((one) => one.name === name);
    return checker
      .getPropertiesOfType(checker.getDeclaredTypeOfSymbol(symbol))
      .map((one) => one.name)
      .sort();
  };
  visit = await browser.newPage();
  await visit.goto(`${studio.origin}/icon.svg`);
  const observed = await visit.evaluate(async () => {
    await Promise.all(['studio', 'view'].map((one) => import(`/embed/sillon-${one}.js`)));
    return ['studio', 'view'].map((one) => [...customElements.get(`sillon-${one}`).observedAttributes].sort());
  });
  assert.deepEqual(observed, [attributes('StudioAttributes'), attributes('ViewAttributes')]);
});
