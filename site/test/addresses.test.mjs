// Links to the project's own places: what is made of addresses.json is up to date, and an empty address has no link anywhere.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { checked, derived, linksOf, missing, readAddresses } from '../../tools/addresses.mjs';
import { pageOf, root } from '../pages.mjs';

const empty = { repository: '', page: '', package: '' };
const set = {
  repository: 'https://github.com/someone/grooves',
  page: 'https://someone.example/grooves/',
  package: 'https://www.npmjs.com/package/sillon',
};
const textOf = (path) => readFileSync(join(root, path), 'utf8');
const outside = (text) =>
  text.match(/https?:\/\/(github\.com\/someone|someone\.example|www\.npmjs\.com)[^\s"')<>]*/g) ?? [];

test('what is made of the addresses is up to date', () => {
  for (const [path, make] of Object.entries(derived)) {
    assert.equal(make(textOf(path), readAddresses()), textOf(path), `${path}: ./dev addresses writes it`);
  }
});

for (const [path, make] of Object.entries(derived)) {
  test(`${path} has the links once they are set, and none while they are empty`, () => {
    const bare = make(textOf(path), empty);
    assert.deepEqual(outside(bare), []);
    const linked = make(bare, set);
    assert.ok(outside(linked).length > 0);
    assert.equal(make(linked, set), linked);
    assert.equal(make(linked, empty), bare);
  });
}

test('the README begins with the studio, and tells how to get the package and the source', () => {
  const text = derived['README.md'](textOf('README.md'), set);
  const [first] = text.split('\n').filter((line) => /^[^#*!<]|^\*\*\[/.test(line) || line.startsWith('[**Open'));
  assert.match(first, /^\[\*\*Open the studio\*\*\]\(https:\/\/someone\.example\/grooves\/\)/);
  assert.match(first, /npm install sillon/);
  assert.match(text, /^git clone https:\/\/github\.com\/someone\/grooves && cd grooves$/m);
});

test('the package names its repository and its folder there, which mends the links of its README', () => {
  const { repository, bugs } = JSON.parse(derived['wasm/package.json'](textOf('wasm/package.json'), set));
  assert.deepEqual(repository, { type: 'git', url: `git+${set.repository}.git`, directory: 'wasm' });
  assert.equal(bugs.url, `${set.repository}/issues`);
});

test('pages name the source, their one address and a picture once these are known', () => {
  const bare = pageOf('docs/guide/start.html', 'Start', '', { known: empty, description: 'How to start.' });
  assert.deepEqual(outside(bare), []);
  assert.doesNotMatch(bare, /canonical|>Source<|Report a problem/);
  assert.match(bare, /<meta name="description" content="How to start\." \/>/);
  const page = pageOf('docs/guide/start.html', 'Start', '', { known: set });
  assert.match(page, /<link rel="canonical" href="https:\/\/someone\.example\/grooves\/docs\/guide\/start\.html" \/>/);
  assert.match(page, /content="https:\/\/someone\.example\/grooves\/preview\.jpg"/);
  assert.match(page, /<a href="https:\/\/github\.com\/someone\/grooves">Source<\/a>/);
  assert.match(page, /<a href="https:\/\/github\.com\/someone\/grooves\/issues\/new\/choose">Report a problem<\/a>/);
  const folder = pageOf('docs/index.html', 'Docs', '', { known: set });
  assert.match(folder, /rel="canonical" href="https:\/\/someone\.example\/grooves\/docs\/"/);
});

test('the page for addresses where nothing is leads on from any depth', () => {
  const page = pageOf('404.html', 'Not found', '', { known: set, anywhere: true, wide: true });
  const links = [...page.matchAll(/ href="([^"#]+)"/g)].map(([, href]) => href);
  assert.ok(links.length > 5);
  for (const href of links) assert.match(href, /^(\/grooves\/|https:\/\/github\.com\/)/);
});

test('a wrong address is refused with what it must be', () => {
  for (const [wrong, words] of [
    [
      { ...set, repository: 'https://github.com/someone/grooves.git' },
      /repository .* must be https:\/\/github\.com\/OWNER\/NAME/,
    ],
    [{ ...set, page: 'https://someone.example/grooves' }, /page .* slash at its end/],
    [{ ...set, page: 'javascript:alert(1)/' }, /page .* must be/],
    [{ ...set, package: undefined }, /package .* must be/],
    [{ ...set, pages: '' }, /names "pages"/],
  ]) {
    assert.throws(() => checked(wrong), words);
  }
  assert.deepEqual(missing(empty), ['repository', 'page', 'package']);
  assert.deepEqual(
    Object.values(linksOf(empty)).filter((address) => address !== ''),
    [],
  );
});
