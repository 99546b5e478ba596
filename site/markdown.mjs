// Markdown to HTML, and what a page holds: headings, links, commands. Pages mean the same here as where the files are read
// as they are.
import { lexer, Marked, Renderer, walkTokens } from 'marked';

const escapes = { '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' };
export const escaped = (text) => text.replace(/[&<>"]/g, (character) => escapes[character]);

const plain = (html) =>
  html
    .replace(/<[^>]*>/g, '')
    .replace(/&(amp|lt|gt|quot|#39);/g, (entity) => ({ '&#39;': "'" })[entity] ?? unescaped(entity));
const unescaped = (entity) => Object.keys(escapes).find((key) => escapes[key] === entity);

/** The anchor of a heading, as code hosts make it. */
const slug = (text) =>
  text
    .toLowerCase()
    .trim()
    .replace(/[^\p{L}\p{N}\s_-]/gu, '')
    .replace(/\s/g, '-');

/** Anchors of one page: a second heading of the same words gets a number. */
function anchors() {
  const seen = new Map();
  return (text) => {
    const name = slug(text);
    const count = seen.get(name) ?? 0;
    seen.set(name, count + 1);
    return count === 0 ? name : `${name}-${count}`;
  };
}

/** @param text  of the page
 * @param addressOf  gives the address of a link or picture, or undefined to leave its words alone
 * @returns {{ title: string, html: string }} */
export function render(text, addressOf) {
  const anchor = anchors();
  let title = '';
  const renderer = {
    heading({ tokens, depth }) {
      const html = this.parser.parseInline(tokens);
      if (title === '') title = plain(html);
      return `<h${depth} id="${escaped(anchor(plain(html)))}">${html}</h${depth}>\n`;
    },
    link({ href, tokens }) {
      const html = this.parser.parseInline(tokens);
      const address = addressOf(href);
      return address === undefined ? html : `<a href="${escaped(address)}">${html}</a>`;
    },
    image({ href, text }) {
      return `<img src="${escaped(addressOf(href))}" alt="${escaped(text)}" loading="lazy" />`;
    },
    // What is wider than a phone scrolls by itself, also by keys.
    table(token) {
      return `<div class="wide" tabindex="0" role="group" aria-label="Table">${Renderer.prototype.table.call(this, token)}</div>\n`;
    },
    code({ text }) {
      return `<pre tabindex="0"><code>${escaped(text)}\n</code></pre>\n`;
    },
    // No page needs HTML of its own: it is shown as it is written, and its comments are not shown.
    html: ({ text }) => (/^<!--.*-->\s*$/s.test(text) ? '' : escaped(text)),
  };
  const html = new Marked({ renderer }).parse(text);
  return { title, html };
}

/** @returns {{ anchors: Set<string>, links: string[], commands: string[], names: string[] }} anchors of headings, addresses of
 * links and pictures, lines of shell blocks with continuations joined, and the words set as code. */
export function contentsOf(text) {
  const anchor = anchors();
  const found = { anchors: new Set(), links: [], commands: [], names: [] };
  const html = new Marked();
  walkTokens.call(html, lexer(text), (token) => {
    if (token.type === 'heading') found.anchors.add(anchor(plain(html.parseInline(token.text))));
    if (token.type === 'link' || token.type === 'image') found.links.push(token.href);
    if (token.type === 'codespan') found.names.push(token.text);
    if (token.type === 'code' && token.lang === 'sh') {
      found.commands.push(...token.text.replaceAll('\\\n', ' ').split('\n'));
    }
  });
  found.commands = found.commands.map((line) => line.replace(/\s#.*$/, '').trim()).filter((line) => line !== '');
  return found;
}

const longestDescription = 200; // characters; search engines and messengers show no more

/** The first paragraph of a page as plain words, cut after a sentence or a word. */
export function descriptionOf(text) {
  const paragraph = lexer(text).find(
    ({ type, tokens }) => type === 'paragraph' && tokens.every((token) => token.type !== 'image'),
  );
  if (paragraph === undefined) return '';
  const words = plain(new Marked().parser([paragraph]))
    .replace(/\s+/g, ' ')
    .trim();
  if (words.length <= longestDescription) return words;
  const short = words.slice(0, longestDescription);
  const end = short.lastIndexOf('. ');
  return end > 60 ? short.slice(0, end + 1) : `${short.slice(0, short.lastIndexOf(' '))} …`;
}

/** @returns {{ heading: string, anchor: string, text: string }[]} the page cut at its headings, as plain words */
export function sectionsOf(text) {
  const anchor = anchors();
  const sections = [];
  const html = new Marked();
  let title = '';
  for (const token of lexer(text)) {
    if (token.type === 'heading') {
      const words = plain(html.parseInline(token.text));
      title ||= words;
      const heading = words === title ? title : `${title}: ${words}`;
      sections.push({ heading, anchor: anchor(words), text: '' });
    } else if (sections.length > 0) {
      const words = plain(html.parser([token]))
        .replace(/\s+/g, ' ')
        .trim();
      if (words !== '') sections.at(-1).text += `${words} `;
    }
  }
  return sections;
}
