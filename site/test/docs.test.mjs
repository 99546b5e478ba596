// The documentation is true as far as a machine can tell: links and anchors exist, commands exist, cheap ones run.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { promisify } from 'node:util';

import { contentsOf } from '../markdown.mjs';
import { pages, root, targetOf } from '../pages.mjs';

const all = new Map(pages().map((page) => [page, contentsOf(readFileSync(join(root, page), 'utf8'))]));
const commands = [...all].flatMap(([page, { commands }]) => commands.map((line) => ({ page, line })));

const run = async (line, cwd = root) => {
  const { stdout, stderr } = await promisify(execFile)('bash', ['-euo', 'pipefail', '-c', line], {
    cwd,
    timeout: 600e3,
  });
  return stdout + stderr;
};

/** Each page gets a folder with the parts of the source that its commands name, as a stranger finds them. */
const folders = [];
const freshFolder = () => {
  const folder = mkdtempSync(join(tmpdir(), 'sillon-docs-'));
  for (const name of ['build', 'examples', 'docs']) symlinkSync(join(root, name), join(folder, name));
  folders.push(folder);
  return folder;
};
after(() => folders.forEach((folder) => rmSync(folder, { recursive: true })));

test('every page is found, and holds something', () => {
  for (const page of ['README.md', 'docs/README.md', 'docs/guide/start.md', 'wasm/README.md', 'examples/README.md']) {
    assert.ok(all.has(page), page);
  }
  assert.ok([...all.values()].reduce((sum, { links }) => sum + links.length, 0) > 100);
  assert.ok(commands.length > 30);
});

test('every link leads to a file, and every anchor to a heading', () => {
  const broken = [];
  for (const [page, { links, anchors }] of all) {
    for (const href of links.filter((href) => !/^https?:/.test(href))) {
      const [path, anchor] = href.split('#');
      const target = path === '' ? page : targetOf(page, href);
      const there = path === '' ? anchors : all.get(target)?.anchors;
      if (!existsSync(join(root, target))) broken.push(`${page}: ${href} is not there`);
      else if (anchor !== undefined && !there?.has(anchor)) broken.push(`${page}: ${href} has no such heading`);
    }
  }
  assert.deepEqual(broken, []);
});

test('every page of docs is in the table of contents', () => {
  const listed = new Set(all.get('docs/README.md').links.map((href) => targetOf('docs/README.md', href)));
  const missing = [...all.keys()].filter(
    (page) => page.startsWith('docs/') && page !== 'docs/README.md' && !listed.has(page),
  );
  assert.deepEqual(missing, []);
});

test('the table of rooms is the one that the walls are checked by', () => {
  const text = readFileSync(join(root, 'tests/check_includes.sh'), 'utf8');
  const rows = /rooms="\n([^"]*)"/.exec(text)[1].trim().split('\n');
  const walls = new Map(rows.map((row) => row.split(':').map((side) => side.trim())));
  const page = readFileSync(join(root, 'docs/internals/rooms.md'), 'utf8');
  const table = [...page.matchAll(/^\| `(\w+)` \|[^|]*\|[^|]*\|([^|]*)\|$/gm)];
  assert.deepEqual(new Map(table.map(([, room, may]) => [room, may.trim().replaceAll(',', '')])), walls);
});

test('every ./dev command that a page names exists, with its part', async () => {
  const help = await run('./dev help');
  const parts = new Set(help.match(/\b[a-z]+\b/g));
  const known = new Set(['help', ...[...help.matchAll(/^\.\/dev ([a-z]+)/gm)].map(([, command]) => command)]);
  assert.ok(known.has('build') && known.has('test'));
  const wrong = [];
  for (const [page, { commands, names }] of all) {
    for (const line of [...commands, ...names]) {
      const [, command, part] = /^\.\/dev ?(\w*) ?([a-z]*)/.exec(line) ?? [];
      if (command === undefined || command === '') continue;
      const partIsKnown = !['build', 'test', 'serve'].includes(command) || part === '' || parts.has(part);
      if (!known.has(command) || !partIsKnown) wrong.push(`${page}: ${line}`);
    }
  }
  assert.deepEqual(wrong, []);
});

test('every option of sillon that a page gives exists', async () => {
  const help = new Map();
  const general = await run('build/release/sillon --help');
  const list = general.slice(general.indexOf('Commands:'), general.indexOf('Options:'));
  for (const [, command] of list.matchAll(/^ {2}([a-z]+)/gm)) {
    help.set(command, new Set((await run(`build/release/sillon ${command} --help-all`)).match(/--[a-z-]+/g)));
  }
  assert.ok(help.size > 10);
  const wrong = [];
  let seen = 0;
  for (const { page, line } of commands) {
    for (const [, command, rest] of line.matchAll(/(?:^|\/|&& )sillon (\w+)([^|>&]*)/g)) {
      seen += 1;
      if (!help.has(command)) wrong.push(`${page}: sillon ${command}`);
      for (const option of rest.match(/(?<=\s)--[a-z-]+/g) ?? []) {
        if (help.has(command) && !help.get(command).has(option)) wrong.push(`${page}: sillon ${command} ${option}`);
      }
    }
  }
  assert.ok(seen > 15);
  assert.deepEqual(wrong, []);
});

test('every script that a page runs exists', () => {
  const scripts = commands.flatMap(({ page, line }) => {
    const script = /^(?:[A-Z_]+=\S* )?(?:node ((?!--)\S+)|(examples\/\S+))/.exec(line);
    return script === null ? [] : [{ page, path: script[1] ?? script[2] }];
  });
  assert.ok(scripts.length > 3);
  for (const { page, path } of scripts) assert.ok(existsSync(join(root, path)), `${page}: ${path}`);
});

test('the C++ of README compiles without warnings, and writes the G-code of a disc', async () => {
  const [code, ...others] = [...readFileSync(join(root, 'README.md'), 'utf8').matchAll(/```cpp\n(.*?)```/gs)];
  assert.deepEqual(others, []);
  const folder = freshFolder();
  writeFileSync(join(folder, 'disc.cpp'), code[1]);
  const library = `${root}build/release/core/libsillon.a`;
  const flags = `-std=c++20 -Wall -Wextra -Werror -I '${root}core/include' -pthread`;
  await run(`c++ ${flags} disc.cpp '${library}' -o disc`, folder);
  assert.match(await run('./disc', folder), /^; generated by Sillon[^]*\n; plate = 40\.0x40\.0 mm/);
});

const json = (path) => JSON.parse(readFileSync(join(root, path), 'utf8'));

test('every library that becomes part of a product is listed with its licence', () => {
  const text = readFileSync(join(root, 'THIRD-PARTY.md'), 'utf8');
  const listed = new Map(
    [...text.matchAll(/^\| ([\w@/-]+) \| ([^|]+) \|/gm)].slice(1).map(([, name, licence]) => [name, licence]),
  );
  const { dependencies, features } = json('vcpkg.json');
  // The tests become part of nothing.
  const native = [...dependencies, ...features.cli.dependencies].map((asked) => asked.name ?? asked);
  const inTextJs = ['bidi-js', 'harfbuzzjs', 'woff2-encoder'].map((name) => `node_modules/${name}`);
  const bundled = Object.entries(json('package-lock.json').packages)
    .filter(([path, { dev, link }]) => inTextJs.includes(path) || (path.startsWith('node_modules/') && !dev && !link))
    .map(([path, { license }]) => [path.replace(/^.*node_modules\//, ''), license]);
  assert.deepEqual([...listed.keys()].sort(), [...native, ...bundled.map(([name]) => name)].sort());
  for (const [name, licence] of bundled) assert.equal(listed.get(name), licence, name);
});

test('the program and the packages have one version', async () => {
  const version = (await run('./dev version')).trim();
  assert.match(version, /^\d+\.\d+\.\d+$/);
  for (const path of ['vcpkg.json', 'wasm/package.json', 'web/package.json'])
    assert.equal(json(path).version, version, path);
});

for (const page of all.keys()) {
  const lines = all.get(page).commands.filter((line) => /^(build\/release\/sillon|mkdir) /.test(line));
  if (lines.length === 0) continue;
  test(`what ${page} runs of sillon does run`, async () => {
    const folder = freshFolder();
    for (const line of lines) await assert.doesNotReject(run(line, folder), line);
  });
}
