// The search page: looks the typed words up in search.json, and lists the sections that hold them.
import MiniSearch from './minisearch.js';

const input = document.querySelector('input[type=search]');
const state = document.querySelector('#state');
const list = document.querySelector('#results');

const text = await (await fetch('./search.json')).text();
const index = MiniSearch.loadJSON(text, { fields: ['title', 'text'], storeFields: ['title', 'text', 'address'] });

/** Some words around the first that was found. */
function excerpt(words, terms) {
  const lower = words.toLowerCase();
  const first = Math.max(0, Math.min(...terms.map((term) => lower.indexOf(term)).filter((place) => place >= 0)));
  const from = Number.isFinite(first) ? Math.max(0, lower.lastIndexOf(' ', Math.max(0, first - 60))) : 0;
  return `${from > 0 ? '…' : ''}${words.slice(from, from + 220).trim()}…`;
}

function item({ title, text, address, terms }) {
  const li = document.createElement('li');
  const link = document.createElement('a');
  link.href = address;
  link.textContent = title;
  const words = document.createElement('p');
  words.textContent = excerpt(text, terms);
  li.append(link, words);
  return li;
}

function show() {
  const words = input.value.trim();
  history.replaceState(null, '', words === '' ? '?' : `?q=${encodeURIComponent(words)}`);
  const options = { prefix: true, fuzzy: 0.15, boost: { title: 3 }, combineWith: 'AND' };
  const found = words === '' ? [] : index.search(words, options).slice(0, 20);
  list.replaceChildren(...found.map(item));
  if (words === '') state.textContent = 'Type what you are looking for.';
  else state.textContent = found.length === 0 ? `Nothing was found for “${words}”.` : `Results for “${words}”`;
}

input.value ||= new URLSearchParams(location.search).get('q') ?? '';
input.addEventListener('input', show);
input.focus();
show();
