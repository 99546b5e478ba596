// The pages of the site: which there are, where they lie, and what surrounds their text.
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { join, posix } from 'node:path';
import { fileURLToPath } from 'node:url';

import { linksOf, readAddresses } from '../tools/addresses.mjs';
import { escaped } from './markdown.mjs';

export const root = fileURLToPath(new URL('..', import.meta.url));
const at = (path) => join(root, path);

const passedOver = new Set(['node_modules', 'build', 'out', 'dist']);

/** Every file of the source by its path from the root; nothing that is hidden or made. */
export function sources(folder = '') {
  return readdirSync(at(folder), { withFileTypes: true })
    .filter(({ name }) => !name.startsWith('.') && !passedOver.has(name))
    .flatMap((entry) => {
      const path = posix.join(folder, entry.name);
      return entry.isDirectory() ? sources(path) : [path];
    })
    .sort();
}

/** Markdown that people read, by path from the root. */
export const pages = () => sources().filter((path) => path.endsWith('.md'));

export const isPicture = (path) => /\.(png|svg|jpe?g|webp)$/.test(path);

/** Where a file or folder of the source is on the site. */
export function addressOf(path) {
  if (path === 'docs/README.md') return 'docs/index.html';
  if (path.startsWith('docs/') && path.endsWith('.md')) return path.replace(/md$/, 'html');
  if (isPicture(path)) return path.startsWith('docs/') ? path : `docs/source/${path}`;
  if (statSync(at(path)).isDirectory()) return posix.join('docs/source', path, 'index.html');
  return `docs/source/${path.replace(/\.md$/, '')}.html`;
}

/** The file of the source that a link on a page means. */
export const targetOf = (page, href) =>
  posix.join(posix.dirname(page), decodeURIComponent(href.split('#')[0])).replace(/\/$/, '');

/** The shelves of the table of contents, docs/README.md: a heading, and the pages below it. */
function shelves() {
  const shelves = [];
  for (const line of readFileSync(at('docs/README.md'), 'utf8').split('\n')) {
    const heading = /^## (.+)/.exec(line);
    if (heading) shelves.push({ name: heading[1], pages: [] });
    const row = /^\| \[([^\]]+)\]\(([\w./-]+\.md)\)/.exec(line);
    if (row) shelves.at(-1).pages.push({ name: row[1], path: targetOf('docs/README.md', row[2]) });
  }
  return shelves;
}

/** Links to all pages, by shelf. */
function contents(from) {
  const item = ({ name, path }) => {
    const address = addressOf(path);
    const here = address === from ? ' aria-current="page"' : '';
    return `<li><a href="${relative(from, address)}"${here}>${escaped(name)}</a></li>`;
  };
  return shelves()
    .map(({ name, pages }) => `<li><span>${escaped(name)}</span>\n<ul>\n${pages.map(item).join('\n')}\n</ul></li>`)
    .join('\n');
}

/** Links to the page before and the page after, in the order of the table of contents. */
function neighbours(from) {
  const all = shelves().flatMap(({ pages }) => pages);
  const here = all.findIndex(({ path }) => addressOf(path) === from);
  if (here < 0) return '';
  const link = (page, rel, arrow) =>
    page === undefined
      ? ''
      : `<a rel="${rel}" href="${relative(from, addressOf(page.path))}">${arrow(escaped(page.name))}</a>`;
  const previous = link(all[here - 1], 'prev', (name) => `← ${name}`);
  const next = link(all[here + 1], 'next', (name) => `${name} →`);
  return `<nav class="neighbours" aria-label="Previous and next page">${previous}${next}</nav>`;
}

export const relative = (from, to) =>
  posix.relative(posix.dirname(from), to).replace(/(^|\/)index\.html$/, '$1') || './';

const addresses = readAddresses();

/** Preview of a page in places that link to it: its first sentence, its picture, its one address. The last two are told
 * once the page's own address is known. */
function preview(address, title, description, { page }) {
  const tag = (key, name, content) => `<meta ${key}="${name}" content="${escaped(content)}" />`;
  const tags = [
    ...(description === ''
      ? []
      : [tag('name', 'description', description), tag('property', 'og:description', description)]),
    tag('property', 'og:title', `${title} · Sillon`),
    tag('property', 'og:type', 'website'),
  ];
  if (page !== '') {
    const own = page + address.replace(/(^|\/)index\.html$/, '$1');
    tags.push(
      `<link rel="canonical" href="${escaped(own)}" />`,
      tag('property', 'og:url', own),
      tag('property', 'og:image', `${page}preview.jpg`),
      tag('name', 'twitter:card', 'summary_large_image'),
    );
  }
  return tags.join('\n');
}

/** A whole page. @param body  HTML @param script  address of the page's script @param description  a sentence or two
 * @param anywhere  it is shown at any address, so its links are those of the whole site */
export function pageOf(
  address,
  title,
  body,
  { wide = false, script, description = '', anywhere = false, known = addresses } = {},
) {
  const base = anywhere && known.page !== '' ? new URL(known.page).pathname : undefined;
  const link = (to) => (base === undefined ? relative(address, to) : base + to.replace(/(^|\/)index\.html$/, '$1'));
  const section = address.startsWith('gallery/') ? 'gallery/index.html' : 'docs/index.html';
  const current = (to) => (to === section && !anywhere ? ' aria-current="true"' : '');
  const scripts = script === undefined ? '' : " script-src 'self'; connect-src 'self';";
  const { source, report } = linksOf(known);
  const outside = (words, to) => (to === '' ? '' : `\n<a href="${escaped(to)}">${words}</a>`);
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8" />
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src 'self'; style-src 'self';${scripts} base-uri 'none'; form-action 'none'" />
<meta name="viewport" content="width=device-width, initial-scale=1" />
<meta name="color-scheme" content="light dark" />
<title>${escaped(title)} · Sillon</title>
${anywhere ? '<meta name="robots" content="noindex" />' : preview(address, title, description, known)}
<link rel="icon" href="${link('icon.svg')}" />
<link rel="apple-touch-icon" href="${link('apple-touch-icon.png')}" />
<link rel="stylesheet" href="${link('docs/style.css')}" />${script === undefined ? '' : `\n<script type="module" src="${link(script)}"></script>`}
</head>
<body>
<a class="skip" href="#main">Skip to content</a>
<header>
<a class="name" href="${link('index.html')}"><img src="${link('icon.svg')}" alt="" width="28" height="28" />Sillon</a>
<nav aria-label="Site">
<a href="${link('index.html')}">Studio</a>
<a href="${link('docs/index.html')}"${current('docs/index.html')}>Documentation</a>
<a href="${link('gallery/index.html')}"${current('gallery/index.html')}>Gallery</a>
<a href="${link('docs/search.html')}">Search</a>${outside('Source', source)}
</nav>
</header>
<div class="${wide ? 'one' : 'two'}">
<main id="main" tabindex="-1">
${body}
${anywhere ? '' : neighbours(address)}
</main>
${wide ? '' : `<nav class="pages" aria-label="Pages"><ul>\n${contents(address)}\n</ul></nav>`}
</div>
<footer>
<a href="${link('licences.txt')}">Licences</a>${outside('Report a problem', report)}
</footer>
</body>
</html>
`;
}
