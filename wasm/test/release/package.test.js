// The package as others get it: packed, installed in an empty folder without network, then used there.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import {
  copyFileSync,
  cpSync,
  existsSync,
  mkdtempSync,
  readFileSync,
  readdirSync,
  rmSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { promisify } from 'node:util';

import { lacking, launch } from '../support/browsers.js';
import { root } from '../support/projects.js';
import { headerSets, serve } from '../support/server.js';

const wasm = join(root, 'wasm');
const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
const write = (name, content) => writeFileSync(join(folder, name), content);
const run = async (program, args, cwd = folder) => (await promisify(execFile)(program, args, { cwd })).stdout;
const runTool = (path, ...args) => run(process.execPath, [join(root, 'node_modules', path), ...args]);

// A page and a script of the same few lines.
const app = `
import { createEngine } from 'sillon';

globalThis.attempt = async (_task, options) => {
  const engine = await createEngine({ threads: 3, ...options });
  const { toolpath, report } = await engine.generateToolpath({ shape: { builtin: 'disc', size: [30, 30] } });
  const { blob } = await engine.writeGcode(toolpath, {}, { date: new Date(0) });
  engine.dispose();
  const hash = new Uint8Array(await crypto.subtle.digest('SHA-256', await blob.arrayBuffer()));
  return { ...engine.info, digest: report.digest, gcode: hash.join(), bytes: blob.size };
};
`;
let packed, refusal, expected;

before(async () => {
  // Packed from a copy, into which the licences come as ./dev package npm gathers them.
  const source = join(folder, 'source');
  cpSync(wasm, source, { recursive: true, filter: (path) => !/[\\/](test|node_modules)$/.test(path) });
  rmSync(join(source, 'THIRD-PARTY-LICENCES'), { force: true });
  const pack = () => run('npm', ['pack', '--json', '--pack-destination', folder], source);
  refusal = await pack().catch((error) => error.stderr);
  write('source/THIRD-PARTY-LICENCES', 'of the libraries inside');
  [packed] = JSON.parse(await pack());
  const npm = (...args) => run('npm', args);
  write('package.json', JSON.stringify({ name: 'consumer', private: true, type: 'module' }));
  await npm('install', '--offline', '--no-audit', '--no-fund', '--ignore-scripts', `./${packed.filename}`);

  write('app.js', app);
  write('index.html', '<!doctype html><title>consumer</title><script type="module" src="./app.js"></script>');
  write('script.js', `import './app.js';\nconsole.log(JSON.stringify(await globalThis.attempt()));`);
  expected = JSON.parse(await run(process.execPath, ['script.js']));
});
after(() => rmSync(folder, { recursive: true }));

test('without the licences of its libraries it is not packed', () => {
  assert.match(refusal, /sillon is not packed: THIRD-PARTY-LICENCES missing/);
});

test('it holds what is to be published and nothing else', () => {
  const compiled = (path) =>
    readdirSync(join(wasm, 'src', path))
      .filter((name) => name.endsWith('.ts'))
      .map((name) => `dist/${path}${name.replace(/ts$/, 'js')}`);
  const engine = ['mt.js', 'mt.wasm', 'mt.worker.js', 'st.js', 'st.wasm'].map((name) => `dist/engine/sillon-${name}`);
  const fonts = ['bebas-neue', 'caveat', 'fredoka', 'nunito', 'roboto-slab'].map((name) => `dist/engine/${name}.ttf`);
  const texts = ['dist/engine/text.js', 'dist/engine/harfbuzz.wasm', 'dist/engine/unpack.js', ...fonts];
  const tables = ['filaments', 'presets', 'printers'].flatMap((name) => [
    `data/${name}.d.ts`,
    `dist/data/${name}.json`,
  ]);
  const elements = [
    ...['index.d.ts', 'react.d.ts', 'vue.d.ts', 'server.js'].map((name) => `elements/${name}`),
    ...['studio', 'view'].map((name) => `dist/elements/sillon-${name}.js`),
  ];
  assert.deepEqual(
    packed.files.map(({ path }) => path).sort(),
    [
      'LICENSE',
      'README.md',
      'THIRD-PARTY-LICENCES',
      'package.json',
      'sillon.d.ts',
      ...tables,
      ...elements,
      'dist/cli/sillon.cjs',
      'dist/cli/sillon.wasm',
      ...compiled(''),
      ...compiled('engine/'),
      ...engine,
      ...texts,
    ].sort(),
  );
});

test('its tables are those of the engine', async () => {
  write(
    'tables.js',
    `import presets from 'sillon/presets.json' with { type: 'json' };
    import printers from 'sillon/printers.json' with { type: 'json' };
    import filaments from 'sillon/filaments.json' with { type: 'json' };
    import { createEngine } from 'sillon';
    const engine = await createEngine({ threads: 'off' });
    const named = await engine.profiles();
    engine.dispose();
    console.log(JSON.stringify({ presets, printers, filaments, named }));`,
  );
  const { presets, printers, filaments, named } = JSON.parse(await run(process.execPath, ['tables.js']));
  assert.deepEqual(named.printers.map(({ id }) => id).sort(), Object.keys(printers.printers).sort());
  assert.ok('pla' in filaments.filaments);
  assert.deepEqual(presets.presets.standard, {});
});

test('its elements are there for browsers, and nothing of them for servers', async () => {
  write(
    'elements.js',
    `import 'sillon/view.js';
    import 'sillon/studio.js';
    console.log(import.meta.resolve('sillon/view.js'));`,
  );
  assert.match(await run(process.execPath, ['elements.js']), /elements\/server\.js/);
  const page = await run(process.execPath, [
    '--conditions=browser',
    '--input-type=module',
    '--eval',
    `console.log(['view', 'studio'].map((name) => import.meta.resolve('sillon/' + name + '.js')).join())`,
  ]);
  assert.match(page, /dist\/elements\/sillon-view\.js,.*dist\/elements\/sillon-studio\.js/);
});

test('installed, its command line runs', async () => {
  const program = join(folder, 'node_modules/.bin/sillon');
  assert.match(await run(program, ['--version']), /^sillon \d+\.\d+\.\d+\n$/);
});

test('installed, it needs nothing else', () => {
  assert.deepEqual(
    readdirSync(join(folder, 'node_modules')).filter((name) => !name.startsWith('.')),
    ['sillon'],
  );
});

test('a script makes a plate and its G-code with several threads', () => {
  const { variant, threads, reason, bytes } = expected;
  assert.deepEqual({ variant, threads, reason }, { variant: 'mt', threads: 3, reason: '' });
  assert.ok(bytes > 10_000);
});

test('it runs where a worker has a location that cannot be assigned, as in Deno', async () => {
  write('location.cjs', `Object.defineProperty(globalThis, 'location', { get: () => 'its own', configurable: true });`);
  const env = { ...process.env, NODE_OPTIONS: `--require ${JSON.stringify(join(folder, 'location.cjs'))}` };
  const { stdout } = await promisify(execFile)(process.execPath, ['script.js'], { cwd: folder, env });
  assert.deepEqual(JSON.parse(stdout), expected);
});

test('the example for Node writes a file', async () => {
  copyFileSync(join(root, 'examples/node/plate.js'), join(folder, 'plate.js'));
  const said = await run(process.execPath, ['plate.js', 'disc.gcode']);
  assert.match(said, /1 toolpath/);
  assert.match(readFileSync(join(folder, 'disc.gcode'), 'utf8'), /^G1 .*E/m);
});

test('the example for shops writes a folder, and nothing for what is no upload', async () => {
  copyFileSync(join(root, 'examples/node/shop.js'), join(folder, 'shop.js'));
  const said = await run(process.execPath, ['shop.js', join(root, 'examples/inputs/strokes.svg'), 'plate']);
  assert.match(said, /^60 x 36 mm, \d\.\d g, \d+ minutes, 0 findings\n$/);
  assert.deepEqual(readdirSync(join(folder, 'plate')).sort(), [
    'plate.gcode',
    'plate.json',
    'plate.view.png',
    'poster.png',
  ]);
  await assert.rejects(run(process.execPath, ['shop.js', 'package.json', 'none']), ({ code, stderr }) => {
    assert.equal(code, 2);
    assert.match(stderr, /shape\.file/);
    return true;
  });
  assert.ok(!existsSync(join(folder, 'none')));
});

test('a script that asks for the impossible fails with a SillonError that says what', async () => {
  write(
    'fails.js',
    `import { createEngine } from 'sillon';
     const engine = await createEngine({ threads: 'off' });
     await engine.generateToolpath({ shape: { builtin: 'disc', size: [30, 30] } }, { spacing: -1 });`,
  );
  await assert.rejects(run(process.execPath, ['fails.js']), ({ code, stderr }) => {
    assert.equal(code, 1);
    assert.match(stderr, /SillonError: .*spacing.*-1.*0\.05/);
    assert.match(stderr, /code: 'InvalidArgument'/);
    return true;
  });
});

const consumer = `
import { SillonError, createEngine, type Engine, type ToolpathResult, type Report } from 'sillon';

const engine: Engine = await createEngine({ threads: 'auto', assetBase: new URL('https://example.org/engine/') });
const plate: ToolpathResult = await engine.generateToolpath(
  { shape: { file: '<svg/>', pageWidth: 80 }, layers: [{ kind: 'map', file: new Blob([]), encoding: 'tangent' }] },
  { spacing: 0.45, perimeterMode: 'soft' },
  { signal: new AbortController().signal, onProgress: ({ stage, fraction }) => stage.repeat(fraction) },
);
const report: Report = plate.report;
const coverage: number | undefined = report.coverage;
const { blob, summary } = await engine.writeGcode(plate.toolpath, { flavor: 'klipper' }, { date: new Date(0) });
export const facts: [number, number, number | undefined] = [blob.size, summary.seconds, coverage];
export const isTooLarge = (error: unknown): boolean => error instanceof SillonError && error.code === 'TooLarge';

// @ts-expect-error: no such parameter
await engine.generateToolpath({}, { spacings: 1 });
// @ts-expect-error: no such option
await createEngine({ threads: 'many' });
// @ts-expect-error: no such code
export const isOdd = (error: SillonError): boolean => error.code === 'Odd';
`;

for (const [moduleResolution, module] of [
  ['bundler', 'esnext'],
  ['nodenext', 'nodenext'],
]) {
  test(`its types hold with moduleResolution ${moduleResolution}`, async () => {
    write('consumer.ts', consumer);
    const options = ['--strict', '--noEmit', '--target', 'es2022', '--lib', 'es2022,dom', '--module', module];
    await assert.doesNotReject(
      runTool('typescript/bin/tsc', ...options, '--moduleResolution', moduleResolution, 'consumer.ts'),
      ({ stdout }) => assert.fail(stdout),
    );
  });
}

/** What the app, opened at `url`, makes. */
async function inPage(url) {
  const browser = await launch('Chromium');
  try {
    return await browser.attempt(url, 'make');
  } finally {
    await browser.close();
  }
}

test('Vite builds an app with it without configuration', { skip: lacking('Chromium') }, async () => {
  await runTool('vite/bin/vite.js', 'build', '--logLevel', 'warn');
  const site = await serve({ '/': join(folder, 'dist') }, headerSets.isolated);
  try {
    assert.deepEqual(await inPage(`${site.origin}/index.html`), expected);
  } finally {
    site.close();
  }
});

test("Vite's development server serves an app with it, with threads", { skip: lacking('Chromium') }, async () => {
  const { createServer } = await import('vite');
  const server = await createServer({
    root: folder,
    configFile: false,
    logLevel: 'warn',
    server: { port: 0, headers: headerSets.isolated },
  });
  try {
    await server.listen();
    assert.deepEqual(await inPage(server.resolvedUrls.local[0]), expected);
  } finally {
    await server.close();
  }
});
