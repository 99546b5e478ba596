// The pages of the site: which there are, where they lie, and what surrounds their text.
import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { join, posix } from 'node:path';
import { fileURLToPath } from 'node:url';

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
  if (posix.dirname(path) === 'docs' && path.endsWith('.md')) return path.replace(/md$/, 'html');
  if (isPicture(path)) return path.startsWith('docs/') ? path : `docs/source/${path}`;
  if (statSync(at(path)).isDirectory()) return posix.join('docs/source', path, 'index.html');
  return `docs/source/${path.replace(/\.md$/, '')}.html`;
}

/** The file of the source that a link on a page means. */
export const targetOf = (page, href) =>
  posix.join(posix.dirname(page), decodeURIComponent(href.split('#')[0])).replace(/\/$/, '');

/** The pages beside a page, in the order of the table of contents. */
function contents(from) {
  const links = [...readFileSync(at('docs/README.md'), 'utf8').matchAll(/\[([^\]]+)\]\(([\w./-]+\.md)\)/g)];
  return links
    .map(([, name, href]) => ({ name, path: targetOf('docs/README.md', href) }))
    .filter(({ path }, k, all) => existsSync(at(path)) && all.findIndex((one) => one.path === path) === k)
    .map(({ name, path }) => {
      const address = addressOf(path);
      const here = address === from ? ' aria-current="page"' : '';
      return `<li><a href="${relative(from, address)}"${here}>${escaped(name[0].toUpperCase() + name.slice(1))}</a></li>`;
    })
    .join('\n');
}

export const relative = (from, to) =>
  posix.relative(posix.dirname(from), to).replace(/(^|\/)index\.html$/, '$1') || './';

/** A whole page. @param body  HTML */
export function pageOf(address, title, body, { wide = false } = {}) {
  const link = (to) => relative(address, to);
  const section = address.startsWith('gallery/') ? 'gallery/index.html' : 'docs/index.html';
  const current = (to) => (to === section ? ' aria-current="true"' : '');
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8" />
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src 'self'; style-src 'self'; base-uri 'none'; form-action 'none'" />
<meta name="viewport" content="width=device-width, initial-scale=1" />
<meta name="color-scheme" content="light dark" />
<title>${escaped(title)} · Sillon</title>
<link rel="icon" href="${link('icon.svg')}" />
<link rel="stylesheet" href="${link('docs/style.css')}" />
</head>
<body>
<a class="skip" href="#main">To the text</a>
<header>
<a class="name" href="${link('index.html')}"><img src="${link('icon.svg')}" alt="" width="28" height="28" />Sillon</a>
<nav aria-label="Site">
<a href="${link('index.html')}">Studio</a>
<a href="${link('docs/index.html')}"${current('docs/index.html')}>Documentation</a>
<a href="${link('gallery/index.html')}"${current('gallery/index.html')}>Gallery</a>
</nav>
</header>
<div class="${wide ? 'one' : 'two'}">
<main id="main" tabindex="-1">
${body}
</main>
${wide ? '' : `<nav class="pages" aria-label="Pages"><ul>\n${contents(address)}\n</ul></nav>`}
</div>
</body>
</html>
`;
}
