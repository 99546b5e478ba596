// What a first visit has to fetch before the page can be used: at most 90 KB of JS and CSS, compressed, without the engine.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { brotliDecompressSync, gzipSync } from 'node:zlib';

const dist = fileURLToPath(new URL('../dist', import.meta.url));
const budget = 90 * 1000;

function page() {
  assert.ok(existsSync(join(dist, 'index.html')), 'there is no web/dist; ./dev build makes it');
  return readFileSync(join(dist, 'index.html'), 'utf8');
}

/** Scripts and styles that the page names, and all that those import without being asked. */
function firstView() {
  const named = [...page().matchAll(/<(?:script|link)\b[^>]*?\b(?:src|href)="([^"]+\.(?:js|css))"/g)];
  const waiting = named.map(([, name]) => join(dist, name));
  const found = new Set();
  while (waiting.length > 0) {
    const file = waiting.pop();
    if (found.has(file)) continue;
    assert.ok(existsSync(file), `${file} is missing`);
    found.add(file);
    if (!file.endsWith('.js')) continue;
    // import ... from "x", import "x", export ... from "x"; not import("x").
    for (const [, name] of readFileSync(file, 'utf8').matchAll(/(?:\bfrom|\bimport)\s*["'`](\.{1,2}\/[^"'`]+)["'`]/g)) {
      waiting.push(join(dirname(file), name));
    }
  }
  return [...found];
}

test('the first view fits its budget', (t) => {
  const sizes = firstView().map((file) => [file.slice(dist.length + 1), gzipSync(readFileSync(file)).length]);
  for (const [name, size] of sizes) t.diagnostic(`${name} ${size}`);
  assert.ok(
    sizes.some(([name]) => name.endsWith('.js')) && sizes.some(([name]) => name.endsWith('.css')),
    'the page names no script or no style: this test reads it wrongly',
  );
  const total = sizes.reduce((sum, [, size]) => sum + size, 0);
  t.diagnostic(`total ${total} of ${budget}`);
  assert.ok(total <= budget, `${total} bytes; the budget is ${budget}`);
});

test('the guide tells how large the scripts of the elements are', () => {
  const guide = readFileSync(fileURLToPath(new URL('../../docs/guide/embedding.md', import.meta.url)), 'utf8');
  for (const name of ['sillon-studio', 'sillon-view']) {
    const told = new RegExp(`\\(#${name}\\).* (\\d+) KB of script`).exec(guide)?.[1];
    const size = gzipSync(readFileSync(join(dist, `embed/${name}.js`)), { level: 9 }).length;
    assert.equal(told, (size / 1024).toFixed(), name);
  }
});

test('neither the engine nor another language is part of the first view', () => {
  const text = firstView()
    .map((file) => readFileSync(file, 'utf8'))
    .join('\n');
  assert.doesNotMatch(text, /Déposez une image/);
  assert.doesNotMatch(text, /Foto oder Logo/);
  assert.doesNotMatch(text, /instantiateWasm/);
});

test('the engine lies there once, and as it was built', () => {
  const names = readdirSync(dist, { recursive: true }).map((name) => name.replaceAll('\\', '/'));
  const [encoder, ...wasm] = names.filter((name) => name.endsWith('.wasm')).sort();
  assert.match(encoder, /^assets\/webp_enc_simd-[\w-]+\.wasm$/); // of moving pictures
  const [, folder] = /<meta name="sillon-engine" content="(engine\/[\da-f]{12}\/)"/.exec(page());
  assert.deepEqual(
    wasm,
    ['harfbuzz', 'sillon-mt', 'sillon-st'].map((name) => `${folder}${name}.wasm`),
  );
  const built = fileURLToPath(new URL('../../wasm/dist/engine/', import.meta.url));
  for (const name of names.filter((name) => /^engine\/.*\.\w+$/.test(name))) {
    const original = readFileSync(join(built, name.slice(folder.length).replace(/\.br$/, '')));
    const bytes = readFileSync(join(dist, name));
    const lies = name.endsWith('.br') ? brotliDecompressSync(bytes) : bytes;
    assert.ok(lies.equals(original), `${name} is not the engine's; build again`);
  }
});

test('the page holds no inline scripts or styles, and names no other site', () => {
  const html = page();
  assert.doesNotMatch(html, /<style|\sstyle=|\son\w+=/i);
  for (const [tag] of html.matchAll(/<script\b[^>]*>/g)) assert.match(tag, /\ssrc="\.\//);
  const fetched = html.replaceAll(/<link rel="canonical"[^>]*>/g, ''); // its own address, which nothing is fetched from
  assert.doesNotMatch(fetched, /(?:src|href)="(?:https?:)?\/\//);
  assert.match(html, /http-equiv="Content-Security-Policy"/);
});
