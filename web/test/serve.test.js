// The studio's own server, and the headers that hosts are asked to send.
import assert from 'node:assert/strict';
import {
  appendFileSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  readdirSync,
  readlinkSync,
  rmSync,
  symlinkSync,
  truncateSync,
  utimesSync,
  writeFileSync,
} from 'node:fs';
import { Agent, get, request } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { spawnSync } from 'node:child_process';
import { after, before, test } from 'node:test';
import { setTimeout as wait } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync } from 'node:zlib';

import { contentSecurityPolicy, headers, isolation } from '../headers.js';
import { serve } from '../serve.js';

const program = fileURLToPath(new URL('../serve.js', import.meta.url));
let folder, site;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'sillon-serve-'));
  writeFileSync(join(folder, 'secret.txt'), 'secret');
  const dist = join(folder, 'dist');
  mkdirSync(join(dist, 'assets'), { recursive: true });
  mkdirSync(join(dist, 'engine/0123456789ab'), { recursive: true });
  mkdirSync(join(dist, 'empty'));
  writeFileSync(join(dist, 'index.html'), '<!doctype html>page');
  writeFileSync(join(dist, 'assets/a-1.js'), 'export {}');
  writeFileSync(join(dist, '404.html'), '<!doctype html>lost');
  writeFileSync(join(dist, 'engine/e.wasm'), '\0asm');
  writeFileSync(join(dist, 'engine/0123456789ab/e.wasm'), '\0asm');
  writeFileSync(join(dist, 'Fichier é.svg'), '<svg/>');
  symlinkSync(join(folder, 'secret.txt'), join(dist, 'link.txt'));
  site = await serve(dist, 0);
});

after(() => {
  site.close();
  rmSync(folder, { recursive: true });
});

/** As it is written: fetch would tidy the path first. */
function raw(path, method = 'GET', asked = {}) {
  return new Promise((done, failed) => {
    const { hostname, port } = new URL(site.origin);
    request({ hostname, port, path, method, headers: asked }, (response) => {
      let body = '';
      response.setEncoding('utf8');
      response.on('data', (text) => (body += text));
      response.on('end', () => done({ status: response.statusCode, headers: response.headers, body }));
    })
      .on('error', failed)
      .end();
  });
}

test('files come with their types', async () => {
  const types = {
    '/': 'text/html; charset=utf-8',
    '/index.html': 'text/html; charset=utf-8',
    '/?threads=off': 'text/html; charset=utf-8',
    '/assets/a-1.js': 'text/javascript; charset=utf-8',
    '/engine/e.wasm': 'application/wasm',
    '/Fichier%20%C3%A9.svg': 'image/svg+xml',
  };
  for (const [path, type] of Object.entries(types)) {
    const { status, headers } = await raw(path);
    assert.equal(status, 200, path);
    assert.equal(headers['content-type'], type, path);
    assert.equal(headers['x-content-type-options'], 'nosniff');
  }
  assert.equal((await raw('/')).body, '<!doctype html>page');
});

test('every response, an error too, has the headers for threads and the policy', async () => {
  for (const path of ['/', '/assets/a-1.js', '/engine/e.wasm', '/missing']) {
    const { headers } = await raw(path);
    for (const [name, value] of Object.entries(isolation)) assert.equal(headers[name.toLowerCase()], value, path);
    assert.equal(headers['content-security-policy'], contentSecurityPolicy);
  }
  assert.doesNotMatch(contentSecurityPolicy, /'unsafe-(?:inline|eval)'|https?:|\*/);
});

test('only files with a hash in their names are kept without asking', async () => {
  for (const path of ['/assets/a-1.js', '/engine/0123456789ab/e.wasm'])
    assert.match((await raw(path)).headers['cache-control'], /immutable/);
  for (const path of ['/', '/engine/e.wasm']) assert.equal((await raw(path)).headers['cache-control'], 'no-cache');
});

test('a folder without its slash leads to the one with it, never to another site', async () => {
  mkdirSync(join(folder, 'dist/inner'));
  writeFileSync(join(folder, 'dist/inner/index.html'), 'inner');
  for (const [path, to] of [
    ['/inner', './inner/'],
    ['/inner?lang=de', './inner/?lang=de'],
    ['//inner', './inner/'],
    ['/empty/../inner', './inner/'],
  ]) {
    const { status, headers } = await raw(path);
    assert.deepEqual([status, headers.location], [301, to], path);
  }
  assert.equal((await raw('/empty')).status, 404);
});

test('who follows a wrong address gets a page that leads on, and programs a word', async () => {
  const { status, headers, body } = await raw('/missing/page', 'GET', { Accept: 'text/html,*/*' });
  assert.deepEqual([status, body], [404, '<!doctype html>lost']);
  assert.equal(headers['content-type'], 'text/html; charset=utf-8');
  assert.deepEqual([(await raw('/missing.js')).status, (await raw('/missing.js')).body], [404, 'Not found\n']);
});

test('a file that the build has compressed comes as that, unless it is older than the file', async () => {
  const path = join(folder, 'dist/packed.js');
  writeFileSync(path, 'old');
  writeFileSync(`${path}.br`, brotliCompressSync('as the build has it'));
  const plain = async () => (await fetch(`${site.origin}/packed.js`, { headers: { 'Accept-Encoding': 'br' } })).text();
  assert.equal(await plain(), 'as the build has it');
  assert.equal((await raw('/packed.js')).body, 'old');
  const later = new Date(Date.now() + 10_000);
  writeFileSync(path, 'newer');
  utimesSync(path, later, later);
  assert.equal(await plain(), 'newer');
});

test('a file that is known already is not sent again, until it changes', async () => {
  const path = join(folder, 'dist/changing.js');
  writeFileSync(path, 'export const a = 1;');
  const first = await raw('/changing.js');
  const known = { 'If-None-Match': `"other", ${first.headers.etag}` };
  for (const method of ['GET', 'HEAD']) {
    const again = await raw('/changing.js', method, known);
    assert.deepEqual([again.status, again.body], [304, '']);
    assert.equal(again.headers.etag, first.headers.etag);
    for (const [name, value] of Object.entries(isolation)) assert.equal(again.headers[name.toLowerCase()], value);
  }
  assert.equal((await raw('/changing.js', 'GET', { 'If-None-Match': '"other"' })).status, 200);
  writeFileSync(path, 'export const a = 12;');
  const changed = await raw('/changing.js', 'GET', known);
  assert.deepEqual([changed.status, changed.body], [200, 'export const a = 12;']);
});

test('a file that grows or shrinks while it is sent spoils no other answer', async () => {
  const path = join(folder, 'dist/growing.png');
  const size = 16 << 20; // more than all buffers in between hold
  const agent = new Agent({ keepAlive: true, maxSockets: 1 });
  const fetched = (onBegin) =>
    new Promise((done, failed) => {
      const { hostname, port } = new URL(site.origin);
      request({ hostname, port, path: '/growing.png', agent }, (response) => {
        onBegin();
        let bytes = 0;
        response.on('data', (part) => (bytes += part.length));
        response.on('end', () => done(bytes));
        response.on('error', () => done('aborted'));
      })
        .on('error', failed)
        .end();
    });
  try {
    writeFileSync(path, Buffer.alloc(size));
    assert.equal(await fetched(() => appendFileSync(path, 'more')), size);
    assert.equal(await fetched(() => {}), size + 4);
    assert.equal(await fetched(() => truncateSync(path, 10)), 'aborted');
    assert.equal(await fetched(() => {}), 10);
  } finally {
    agent.destroy();
  }
});

const descriptors = '/proc/self/fd';
test(
  'downloads that visitors break off leave no file open',
  { skip: !existsSync(descriptors) && `no ${descriptors}` },
  async () => {
    const path = join(folder, 'dist/long.png');
    writeFileSync(path, Buffer.alloc(16 << 20)); // more than all buffers in between hold
    // In one go: between listing and reading the listed descriptor of the list itself is closed again.
    const open = () =>
      readdirSync(descriptors).filter((name) => {
        try {
          return readlinkSync(join(descriptors, name)) === path;
        } catch {
          return false;
        }
      }).length;
    const broken = () =>
      new Promise((done, failed) => {
        get(`${site.origin}/long.png`, (response) => {
          response.once('data', () => response.destroy());
          response.once('close', done);
        }).on('error', failed);
      });
    let most = 0;
    for (let k = 0; k < 150; k += 10) {
      await Promise.all(Array.from({ length: 10 }, broken));
      most = Math.max(most, open());
    }
    for (let k = 0; k < 1000 && open() > 0; k++) await wait(10);
    assert.equal(open(), 0, `of 150 downloads; ${most} at a time`);
  },
);

test('who takes Brotli gets it, of what it makes smaller; the same bytes come out', async () => {
  const text = `export const words = '${'groove '.repeat(1000)}';`;
  writeFileSync(join(folder, 'dist/long.js'), text);
  writeFileSync(join(folder, 'dist/picture.png'), text);
  const plain = await raw('/long.js');
  assert.deepEqual([plain.headers['content-encoding'], plain.body], [undefined, text]);
  const fetched = await fetch(`${site.origin}/long.js`, { headers: { 'Accept-Encoding': 'gzip, br' } });
  assert.equal(fetched.headers.get('content-encoding'), 'br');
  assert.ok(Number(fetched.headers.get('content-length')) < text.length / 10);
  assert.equal(await fetched.text(), text);
  for (const [path, accepted] of [
    ['/picture.png', 'br'],
    ['/long.js', 'gzip'],
    ['/long.js', 'br;q=0'],
  ]) {
    const { headers, body } = await raw(path, 'GET', { 'Accept-Encoding': accepted });
    assert.deepEqual([headers['content-encoding'], body], [undefined, text], `${path} ${accepted}`);
  }
  const head = await raw('/long.js', 'HEAD', { 'Accept-Encoding': 'br' });
  assert.deepEqual([head.headers['content-encoding'], head.body], ['br', '']);
});

test('nothing outside of the folder is served', async () => {
  const paths = [
    '/../secret.txt',
    '/..%2fsecret.txt',
    '/%2e%2e/secret.txt',
    '/assets/../../secret.txt',
    '/..%5csecret.txt',
    '//etc/passwd',
    '/link.txt',
    '/%00',
    '/index.html%00.js',
    '/%',
    '/assets',
    '/assets/',
    'http://localhost/../secret.txt',
    '*',
  ];
  for (const path of paths) {
    const { status, body } = await raw(path);
    assert.equal(status, 404, path);
    assert.doesNotMatch(body, /secret|root:/, path);
  }
});

test('HEAD has no body, other methods are refused', async () => {
  const head = await raw('/', 'HEAD');
  assert.deepEqual([head.status, head.body, head.headers['content-length']], [200, '', '19']);
  for (const method of ['POST', 'PUT', 'DELETE', 'OPTIONS']) assert.equal((await raw('/', method)).status, 405);
});

test('wrong arguments are named, with what to do', () => {
  const run = (...list) => spawnSync(process.execPath, [program, ...list], { encoding: 'utf8', timeout: 120_000 });
  const { port } = new URL(site.origin);
  const cases = [
    [['--port', 'x'], /--port is x; it must be 0 to 65535/],
    [['--port', '65536'], /65536/],
    [['--port', '-1'], /port/],
    [['--prot', '1'], /prot/],
    [['a', 'b'], /only one folder/],
    [[folder], /holds no index\.html/],
    [['--host', 'no-such.invalid', '--port', '0', join(folder, 'dist')], /--host is no-such\.invalid; it must be/],
    [['--port', port, join(folder, 'dist')], new RegExp(`port ${port} is in use; another: --port ${Number(port) + 1}`)],
  ];
  for (const [list, message] of cases) {
    const { status, stderr } = run(...list);
    assert.equal(status, 1, list.join(' '));
    assert.match(stderr, message);
    assert.doesNotMatch(stderr, /at .*\.js:\d/, 'a stack trace is no message');
  }
});

test('the settings that hosts are told to copy are those of our own server', () => {
  const page = readFileSync(fileURLToPath(new URL('../../docs/guide/embedding.md', import.meta.url)), 'utf8');
  const blocks = [...page.matchAll(/```\w*\n([^]*?)```/g)]
    .map(([, block]) => block)
    .filter((block) => block.includes('Document-Isolation-Policy'));
  assert.equal(blocks.length, 4); // the list, nginx, Apache, _headers
  const shared = { ...isolation, 'Access-Control-Allow-Origin': headers['Access-Control-Allow-Origin'] };
  for (const block of blocks) {
    for (const [name, value] of Object.entries(shared)) {
      assert.match(block, new RegExp(`${name}:? ${value.replace('*', '\\*')}(?: always;)?$`, 'm'), name);
    }
    assert.equal(block.match(/(?:Cross-Origin|Document|Access)-[\w-]+/g).length, Object.keys(shared).length);
  }
});
