// The whole site as static files: the studio at its root, the documentation in docs/, the examples in gallery/.
//   node site/build.mjs FOLDER [EXAMPLE ...]
// Every link of a page leads to a page: to another one, or to the file of the source that it names.
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename, dirname, extname, join, posix, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

import MiniSearch from 'minisearch';

import { licences } from '../tools/licences.mjs';
import { drawGallery } from './gallery.mjs';
import { contentsOf, descriptionOf, escaped, render, sectionsOf } from './markdown.mjs';
import { addressOf, isPicture, pageOf, pages, relative, root, sources, targetOf } from './pages.mjs';

const at = (path) => join(root, path);

function write(folder, address, content) {
  const path = join(folder, address);
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, content);
}

function folderPage(path, files) {
  const inside = files.filter((file) => posix.dirname(file) === path && !isPicture(file));
  const items = inside.map((file) => `- [${basename(file)}](${basename(file)})`).join('\n');
  return `# ${path}\n\n${items}\n`;
}

/** Pages, and all that they lead to. */
function writeDocs(folder) {
  const files = sources();
  const waiting = pages().filter((path) => path.startsWith('docs/') || !path.includes('/'));
  const done = new Set();
  for (let path = waiting.pop(); path !== undefined; path = waiting.pop()) {
    if (done.has(path)) continue;
    done.add(path);
    const address = addressOf(path);
    if (isPicture(path)) {
      mkdirSync(dirname(join(folder, address)), { recursive: true });
      cpSync(at(path), join(folder, address));
      continue;
    }
    const isFolder = statSync(at(path)).isDirectory();
    if (!isFolder && extname(path) !== '.md') {
      const code = `<h1>${escaped(path)}</h1>\n<pre tabindex="0"><code>${escaped(readFileSync(at(path), 'utf8'))}</code></pre>`;
      write(folder, address, pageOf(address, path, code, { description: `${path}, a file of Sillon's source.` }));
      continue;
    }
    const text = isFolder ? folderPage(path, files) : readFileSync(at(path), 'utf8');
    const base = isFolder ? `${path}/index.md` : path;
    const { title, html } = render(text, (href) => {
      if (/^(https?:|#)/.test(href)) return href;
      const target = targetOf(base, href);
      if (!existsSync(at(target))) {
        throw new Error(`${path} leads to ${href}, which is not there`);
      }
      waiting.push(target);
      const anchor = href.includes('#') ? `#${href.split('#')[1]}` : '';
      return relative(address, addressOf(target)) + anchor;
    });
    write(
      folder,
      address,
      pageOf(address, title, html, {
        description: isFolder ? `${path}, a folder of Sillon's source.` : descriptionOf(text),
      }),
    );
  }
}

/** @param examples  names of projects in examples/ */
export async function buildSite(folder, examples) {
  if (existsSync(join(folder, '.git'))) throw new Error(`${folder} is no folder for a site`);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  if (existsSync(at('web/dist/index.html'))) cpSync(at('web/dist'), folder, { recursive: true });
  writeDocs(folder);
  write(folder, 'licences.txt', licences('site'));
  write(folder, '404.html', notFound());
  cpSync(at('site/style.css'), join(folder, 'docs/style.css'));
  for (const name of ['icon.svg', 'apple-touch-icon.png', 'preview.jpg'])
    cpSync(at(`web/public/${name}`), join(folder, name));
  await drawGallery(folder, examples);
  writeSearch(folder);
}

/** The page that hosts show at addresses where nothing is. */
function notFound() {
  const body = `<h1>There is nothing at this address</h1>
<p>The page may have moved. The menu above leads to the studio, the documentation and the gallery, and its search finds every page.</p>`;
  return pageOf('404.html', 'Not found', body, { wide: true, anywhere: true });
}

/** The search page, and the index it looks into: the sections of all pages of docs. */
function writeSearch(folder) {
  const address = 'docs/search.html';
  const body = `<h1>Search</h1>
<input type="search" aria-label="Search the documentation" autocomplete="off" />
<p id="state" role="status">Search needs JavaScript.</p>
<ol id="results"></ol>`;
  write(
    folder,
    address,
    pageOf(address, 'Search', body, {
      script: 'docs/search.js',
      description: 'Search in the documentation of Sillon.',
    }),
  );
  const index = new MiniSearch({ fields: ['title', 'text'], storeFields: ['title', 'text', 'address'] });
  for (const page of pages().filter((path) => path.startsWith('docs/'))) {
    const to = relative(address, addressOf(page));
    for (const { heading, anchor, text } of sectionsOf(readFileSync(at(page), 'utf8'))) {
      index.add({ id: `${page}#${anchor}`, title: heading, text, address: `${to}#${anchor}` });
    }
  }
  write(folder, 'docs/search.json', JSON.stringify(index));
  cpSync(at('site/search.js'), join(folder, 'docs/search.js'));
  cpSync(at('node_modules/minisearch/dist/es/index.js'), join(folder, 'docs/minisearch.js'));
}

/** All examples, in the order of their own page. */
export const exampleNames = () => [
  ...new Set(
    contentsOf(readFileSync(at('examples/README.md'), 'utf8'))
      .names.filter((name) => /^[\w-]+\.json$/.test(name))
      .map((name) => name.slice(0, -5)),
  ),
];

if (process.argv[1] !== undefined && resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
  const [folder, ...examples] = process.argv.slice(2);
  if (folder === undefined) throw new Error('usage: node site/build.mjs FOLDER [EXAMPLE ...]');
  await buildSite(resolve(folder), examples.length > 0 ? examples : exampleNames());
  console.log(`${folder}: the studio, docs/ and gallery/`);
}
