// The npm package in other people's tools, untouched and without configuration: each builds a small app with it, which then
// makes the same plate. The tools come from npm's registry; where it cannot be reached, the tests say so and are skipped.
// ./dev test packages makes the package first.
import assert from 'node:assert/strict';
import { execFile, spawn, spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { promisify } from 'node:util';

import { lacking, startChromium } from '../../wasm/test/support/browsers.js';
import { headerSets, serve } from '../../wasm/test/support/server.js';

const made = join(dirname(fileURLToPath(import.meta.url)), '../../out/package');
const registry = spawnSync('npm', ['view', 'esbuild', 'version', '--fetch-retries=0', '--fetch-timeout=20000']);
const offline = registry.status !== 0 && "npm's registry cannot be reached from here";
const skip = offline || lacking('Chromium');

const folder = mkdtempSync(join(tmpdir(), 'sillon-bundlers-'));
after(() => rmSync(folder, { recursive: true }));

const env = { ...process.env, NEXT_TELEMETRY_DISABLED: '1', CI: '1' };
async function run(cwd, program, ...args) {
  const { stdout } = await promisify(execFile)(program, args, { cwd, env, maxBuffer: 1 << 26 }).catch((error) => {
    throw new Error(`${program} ${args.join(' ')}: ${error.message}\n${error.stdout}\n${error.stderr}`);
  });
  return stdout;
}

function write(path, content) {
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, content);
}

/** A folder of an app's own, with the package and the tools in it. */
async function appWith(name, tools, files) {
  const app = join(folder, name);
  write(join(app, 'package.json'), JSON.stringify({ name, private: true, type: 'module' }));
  for (const [path, content] of Object.entries(files)) write(join(app, path), content);
  const packed = readdirSync(made).filter((file) => /^sillon-[\d.]+\.tgz$/.test(file));
  assert.equal(packed.length, 1, `out/package holds ${readdirSync(made).join(', ')}`);
  await run(app, 'npm', 'install', '--no-audit', '--no-fund', '--prefer-offline', join(made, packed[0]), ...tools);
  return app;
}

/** Letters and codes come by scripts and files of their own. */
const makes = `
  const engine = await createEngine(options);
  const { toolpath, report } = await engine.generateToolpath({
    shape: { builtin: 'disc', size: [30, 30] },
    layers: [
      { kind: 'text', text: 'ANNA', textSize: 5, at: [15, 6] },
      { kind: 'code', text: 'x', size: [12, 12], at: [15, 18] },
    ],
  });
  const { blob } = await engine.writeGcode(toolpath, {}, { date: new Date(0) });
  engine.dispose();
  const hash = new Uint8Array(await crypto.subtle.digest('SHA-256', await blob.arrayBuffer()));
  const made = { digest: report.digest, gcode: hash.join(), threads: engine.info.threads };
`;
const page = `
import { createEngine } from 'sillon';
globalThis.attempt = async (_task, options) => {${makes} return made; };
`;
const html = (script) => `<!doctype html><title>app</title><script type="module" src="${script}"></script>`;
const script = `${page} console.log(JSON.stringify(await globalThis.attempt('', { threads: 2 })));`;

let expected;
before(async () => {
  if (offline) return;
  const app = await appWith('node', [], { 'script.js': script });
  expected = JSON.parse(await run(app, process.execPath, 'script.js'));
});

/** What the app at this address makes, with two threads, or one where the page cannot have more. */
async function madeAt(url, threads = 2, options = {}) {
  const browser = await startChromium();
  try {
    const visit = await browser.newPage();
    const problems = [];
    visit.on('pageerror', (error) => problems.push(String(error)));
    visit.setDefaultTimeout(180_000);
    await visit.goto(url);
    await visit.waitForFunction(() => globalThis.attempt !== undefined);
    const made = await visit.evaluate((more) => globalThis.attempt('make', { threads: 2, ...more }), options);
    assert.deepEqual(made, { ...expected, threads });
    assert.deepEqual(problems, []);
  } finally {
    await browser.close();
  }
}

async function madeIn(dist, path = 'index.html', options = {}) {
  const site = await serve({ '/': `${dist}/` }, headerSets.isolated);
  try {
    await madeAt(`${site.origin}/${path}`, 2, options);
  } finally {
    site.close();
  }
}

test('Node: modules and CommonJS', { skip: offline }, async () => {
  assert.equal(expected.threads, 2);
  const app = join(folder, 'node');
  const imported = `import('sillon').then(async ({ createEngine }) => { const options = { threads: 2 }; ${makes}
    console.log(JSON.stringify(made)); });`;
  write(join(app, 'imported.cjs'), imported);
  assert.deepEqual(JSON.parse(await run(app, process.execPath, 'imported.cjs')), expected);
  // Since 20.19 and 22.12.
  if (!process.features.require_module) return;
  write(join(app, 'required.cjs'), `const sillon = require('sillon');\n${imported.replace("import('sillon')", 'Promise.resolve(sillon)')}`);
  assert.deepEqual(JSON.parse(await run(app, process.execPath, 'required.cjs')), expected);
});

test('a page without bundler: its files as they are, and an import map', { skip }, async () => {
  const app = join(folder, 'node');
  const map = JSON.stringify({ imports: { sillon: './node_modules/sillon/dist/index.js' } });
  write(join(app, 'page.js'), page);
  write(join(app, 'index.html'), `<script type="importmap">${map}</script>${html('./page.js')}`);
  await madeIn(app);
});

for (const version of [7, 8]) {
  test(`Vite ${version}: built, and by its development server`, { skip }, async () => {
    const files = { 'index.html': html('./page.js'), 'page.js': page };
    const app = await appWith(`vite${version}`, [`vite@${version}`], files);
    await run(app, 'npx', 'vite', 'build', '--logLevel', 'warn');
    await madeIn(join(app, 'dist'));
    const { createServer } = await import(pathToFileURL(join(app, 'node_modules/vite/dist/node/index.js')));
    const server = await createServer({
      root: app,
      configFile: false,
      logLevel: 'warn',
      server: { port: 0, headers: headerSets.isolated },
    });
    try {
      await server.listen();
      await madeAt(server.resolvedUrls.local[0]);
    } finally {
      await server.close();
    }
  });
}

test('webpack', { skip }, async () => {
  const app = await appWith('webpack', ['webpack@5', 'webpack-cli@6'], { 'src/index.js': page });
  await run(app, 'npx', 'webpack', '--mode', 'production');
  write(join(app, 'dist/index.html'), html('./main.js'));
  await madeIn(join(app, 'dist'));
});

/** esbuild and rollup leave addresses as they are: the engine's files must lie beside the bundle. */
const besideBundle = (app) => cpSync(join(app, 'node_modules/sillon/dist/engine'), join(app, 'dist/engine'), { recursive: true });

test('esbuild: for pages and for Node, with the folder of the engine copied beside, or named', { skip }, async () => {
  const app = await appWith('esbuild', ['esbuild'], { 'page.js': page, 'script.js': script, 'dist/index.html': html('./page.js') });
  await run(app, 'npx', 'esbuild', 'page.js', '--bundle', '--format=esm', '--outdir=dist');
  besideBundle(app);
  await madeIn(join(app, 'dist'));
  await run(app, 'npx', 'esbuild', 'script.js', '--bundle', '--platform=node', '--format=esm', '--outfile=out/script.js');
  assert.deepEqual(JSON.parse(await run(app, process.execPath, 'out/script.js')), expected);

  // A plain script, which does not know where it is.
  await run(app, 'npx', 'esbuild', 'page.js', '--bundle', '--log-level=error', '--outfile=dist/plain.js');
  write(join(app, 'dist/plain.html'), '<!doctype html><title>app</title><script src="./plain.js"></script>');
  await madeIn(join(app, 'dist'), 'plain.html', { assetBase: 'engine' });
  await assert.rejects(madeIn(join(app, 'dist'), 'plain.html'), /SillonError: .*assetBase/);

  // CommonJS, run from another folder.
  write(
    join(app, 'later.js'),
    `const options = { threads: 2 };
    import('sillon').then(async ({ createEngine }) => {${makes} console.log(JSON.stringify(made)); });`,
  );
  const words = ['--bundle', '--platform=node', '--format=cjs', '--log-level=error'];
  await run(app, 'npx', 'esbuild', 'later.js', ...words, '--outfile=dist/script.cjs');
  assert.deepEqual(JSON.parse(await run(folder, process.execPath, join(app, 'dist/script.cjs'))), expected);
  cpSync(join(app, 'dist/script.cjs'), join(app, 'alone/script.cjs'));
  await assert.rejects(
    run(folder, process.execPath, join(app, 'alone/script.cjs')),
    /beside file:\S+alone\/script\.cjs nor below .*assetBase/,
  );
});

test('rollup, with the folder of the engine copied beside', { skip }, async () => {
  const app = await appWith('rollup', ['rollup@4', '@rollup/plugin-node-resolve@16'], {
    'page.js': page,
    'dist/index.html': html('./page.js'),
  });
  await run(app, 'npx', 'rollup', 'page.js', '--dir', 'dist', '--plugin', 'node-resolve={browser:true}', '--silent');
  besideBundle(app);
  await madeIn(join(app, 'dist'));
});

const nextApp = {
  'app/layout.js': `export default function Layout({ children }) { return <html lang="en"><body>{children}</body></html>; }`,
  'app/page.js': `'use client';
    import { createEngine } from 'sillon';
    import 'sillon/view.js';
    import { useEffect } from 'react';
    export default function Page() {
      useEffect(() => { globalThis.attempt = async (_task, options) => {${makes} return made; }; }, []);
      return <sillon-view alt="A plate" />;
    }`,
  'app/api/plate/route.js': `import { createEngine } from 'sillon';
    export const dynamic = 'force-dynamic';
    export async function GET() { const options = { threads: 2 }; ${makes} return Response.json(made); }`,
};

for (const [bundler, words] of [
  ['Turbopack', []],
  ['webpack', ['--webpack']],
]) {
  test(`Next.js by ${bundler}: a client component and an API route, without configuration`, { skip }, async () => {
    const app = join(folder, 'next');
    if (!existsSync(app)) await appWith('next', ['next@16', 'react@19', 'react-dom@19'], nextApp);
    rmSync(join(app, '.next'), { recursive: true, force: true });
    await run(app, 'npx', 'next', 'build', ...words);
    const server = spawn(process.execPath, ['node_modules/next/dist/bin/next', 'start', '--port', '0'], { cwd: app, env });
    try {
      const origin = await new Promise((found, failed) => {
        let said = '';
        const listen = (text) => {
          said += text;
          const address = /http:\/\/localhost:\d+/.exec(said);
          if (address !== null) found(address[0]);
        };
        server.stdout.on('data', listen);
        server.stderr.on('data', listen);
        server.on('exit', (code) => failed(new Error(`next start ended with ${code}: ${said}`)));
      });
      const response = await fetch(`${origin}/api/plate`);
      const body = await response.text();
      assert.equal(response.status, 200, body);
      assert.deepEqual(JSON.parse(body), expected);
      await madeAt(origin, 1);
    } finally {
      server.kill();
    }
  });
}
