// What a release offers, as a stranger gets it: unpacked in an empty folder and used there. ./dev test packages makes it first.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import {
  copyFileSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  readdirSync,
  rmSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const made = join(root, 'out/package');
const folder = mkdtempSync(join(tmpdir(), 'sillon-'));
after(() => rmSync(folder, { recursive: true }));

const run = (program, ...args) => execFileSync(program, args, { cwd: folder, encoding: 'utf8' });
const version = run(join(root, 'dev'), 'version').trim();
const named = (pattern) => {
  const names = readdirSync(made).filter((name) => pattern.test(name));
  assert.equal(names.length, 1, `out/package holds ${readdirSync(made).join(', ')}`);
  return join(made, names[0]);
};
const unpack = (archive) => run('cmake', '-E', 'tar', 'xf', archive);
/** HarfBuzz's own, which is a text of its own in the module. */
const versionInside = (module) => /\0(\d+\.\d+\.\d+)\0/.exec(readFileSync(module, 'latin1'))[1];
const hashOf = (file) => `sha384-${createHash('sha384').update(readFileSync(file)).digest('base64')}`;

test('the archive of the program holds a program that runs, an example, links that lead somewhere, and all licences', () => {
  const archive = named(/^sillon-[\d.]+-(linux|macos|windows)-\w+\.(tar\.gz|zip)$/);
  unpack(archive);
  const inside = archive.replace(/^.*[\\/]/, '').replace(/\.(tar\.gz|zip)$/, '');
  const program = ['sillon', 'sillon.exe'].map((name) => join(folder, inside, name)).find((path) => existsSync(path));
  assert.equal(run(program, '--version').trim(), `sillon ${version}`);
  run(program, 'generate', '--shape', 'disc', '--size', '15', '--angle', '30', '--gcode', 'disc.gcode', '--quiet');
  assert.match(run(program, 'check', 'disc.gcode'), /no fault|0 errors|no errors/i);
  run(program, 'generate', join(inside, 'examples/logo.json'), '--spacing', '1', '--gcode', 'logo.gcode', '--quiet');
  for (const name of readdirSync(join(folder, inside)).filter((name) => name.endsWith('.md'))) {
    const text = readFileSync(join(folder, inside, name), 'utf8');
    assert.deepEqual(text.match(/\]\((?!https?:|#)[^)]*\)/g) ?? [], [], name);
  }
  const { components } = JSON.parse(readFileSync(join(folder, inside, 'sbom.cdx.json'), 'utf8'));
  assert.ok(components.some(({ name }) => name === 'eigen3'));
  const shaper = components.find(({ name }) => name === 'harfbuzz');
  assert.equal(shaper.version, versionInside(join(root, 'node_modules/harfbuzzjs/dist/harfbuzz.wasm')));
  const licences = readFileSync(join(folder, inside, 'THIRD-PARTY-LICENCES'), 'utf8');
  for (const name of ['cli11', 'eigen3', 'fast-float', 'libwebp', 'nlohmann-json', 'rapidxml', 'stb']) {
    assert.ok(licences.includes(`==== ${name} `), name);
  }
});

/** A program for Linux may ask for these, which every distribution has, and for nothing else. */
const everywhere = /^(?:linux-vdso|ld-linux[\w-]*|lib(?:c|m|gcc_s|stdc\+\+))\.so[.\d]*$/;
const onLinux = process.platform === 'linux' ? false : 'libraries are looked up by ldd, on Linux';
test('the program makes letters, codes and moving pictures in a root that holds the C++ runtime alone', { skip: onLinux }, (context) => {
  const archive = named(/^sillon-[\d.]+-linux-\w+\.tar\.gz$/);
  const inside = join(folder, 'empty');
  mkdirSync(inside);
  run('tar', 'xzf', archive, '--strip-components=1', '-C', inside);
  const libraries = run('ldd', join(inside, 'sillon'))
    .trim()
    .split('\n')
    .map((line) => /^\s*(?:(\S+) => )?(\S+)/.exec(line));
  assert.deepEqual(
    libraries.map(([, name, path]) => basename(name ?? path)).filter((name) => !everywhere.test(name)),
    [],
  );
  if (process.getuid() !== 0) {
    context.diagnostic('not run in an empty root, which takes the rights of root');
    return;
  }
  for (const [, , path] of libraries.filter(([, , path]) => path.startsWith('/'))) {
    mkdirSync(join(inside, dirname(path)), { recursive: true });
    copyFileSync(path, join(inside, path));
  }
  const text = { kind: 'text', text: 'AV', size: [20, 8], at: [12, 8] };
  const code = { kind: 'code', text: 'sillon', size: [14, 14], at: [32, 8] };
  writeFileSync(
    join(inside, 'plate.json'),
    JSON.stringify({ sillon: 1, shape: { builtin: 'rectangle', size: [40, 16] }, layers: [text, code] }),
  );
  run('chroot', inside, '/sillon', 'generate', '/plate.json', '--gcode', '/plate.gcode', '--preview', '/plate.webp', '--quiet');
  assert.match(run('chroot', inside, '/sillon', 'check', '/plate.gcode'), /no fault|0 errors|no errors/i);
});

test('the package installs without network, makes a plate and has the hashes that are told', () => {
  writeFileSync(join(folder, 'package.json'), '{ "private": true, "type": "module" }');
  run('npm', 'install', '--offline', '--no-audit', '--no-fund', named(/^sillon-[\d.]+\.tgz$/));
  assert.equal(run('npx', '--no-install', 'sillon', '--version').trim(), `sillon ${version}`);
  writeFileSync(
    join(folder, 'plate.js'),
    `import { createEngine } from 'sillon';
    const engine = await createEngine({ threads: 'off' });
    const { report } = await engine.generateToolpath({ shape: { builtin: 'disc', size: [15, 15] } });
    console.log(report.toolpaths);
    engine.dispose();`,
  );
  assert.equal(run(process.execPath, 'plate.js').trim(), '1');
  const hashes = JSON.parse(readFileSync(named(/-integrity\.json$/), 'utf8'));
  assert.deepEqual(Object.keys(hashes), ['dist/elements/sillon-studio.js', 'dist/elements/sillon-view.js']);
  for (const [name, hash] of Object.entries(hashes)) assert.equal(hashOf(join(folder, 'node_modules/sillon', name)), hash);
  const licences = readFileSync(join(folder, 'node_modules/sillon/THIRD-PARTY-LICENCES'), 'utf8');
  for (const name of ['eigen3', 'cli11', 'musl']) assert.ok(licences.includes(`==== ${name} `), name);
});

test('the zip of the studio is served by its own server, with the headers for threads', async () => {
  unpack(named(/^sillon-studio-[\d.]+\.zip$/));
  const inside = join(folder, `sillon-studio-${version}`);
  for (const name of ['Dockerfile', 'LICENSE', 'README.txt']) assert.ok(existsSync(join(inside, name)), name);
  const licences = readFileSync(join(inside, 'THIRD-PARTY-LICENCES'), 'utf8');
  for (const name of ['==== eigen3 ', '==== musl ', 'lit-html ', 'fflate ']) assert.ok(licences.includes(name), name);
  const hashes = JSON.parse(readFileSync(join(inside, 'integrity.json'), 'utf8'));
  for (const [name, hash] of Object.entries(hashes)) assert.equal(hashOf(join(inside, 'dist', name)), hash);

  const server = spawn(process.execPath, ['serve.js', '--port', '0', '--host', '127.0.0.1', 'dist'], { cwd: inside });
  try {
    const origin = await new Promise((found, failed) => {
      server.on('exit', (code) => failed(new Error(`the server ended with ${code}`)));
      server.stdout.on('data', (text) => found(/http:\S+/.exec(text)[0]));
    });
    const page = await fetch(origin);
    assert.equal(page.headers.get('cross-origin-opener-policy'), 'same-origin');
    assert.match(await page.text(), /<title>Sillon/);
    const modules = readdirSync(join(inside, 'dist'), { recursive: true }).filter((name) => /\.wasm$/.test(name));
    assert.deepEqual(
      modules.map((name) => basename(name).replace(/-[\w-]{8}\.wasm$/, '.wasm')).toSorted(),
      ['harfbuzz.wasm', 'sillon-mt.wasm', 'sillon-st.wasm', 'webp_enc_simd.wasm'],
    );
    for (const name of modules) {
      const { status, headers } = await fetch(`${origin}/${name.replaceAll('\\', '/')}`);
      assert.deepEqual([status, headers.get('content-type')], [200, 'application/wasm'], name);
    }
  } finally {
    server.kill();
  }
});
