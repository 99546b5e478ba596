// Makes every link to the project's own places out of addresses.json, the only file that holds them: `repository` (the source,
// on GitHub), `page` (the published studio, with docs/ and gallery/ below it) and `package` (on npm). An address that is empty
// hides its links.
//   node tools/addresses.mjs                writes what is made of them and of the version, and names what is still to be set
//   node tools/addresses.mjs --check        names the files that are out of date, and ends with 1 if there are any
//   node tools/addresses.mjs --release URL  also ends with 1 while an address is missing that a release of URL needs
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('..', import.meta.url));

const forms = {
  repository: [/^https:\/\/github\.com\/[\w.-]+\/[\w.-]*[^/.](?<!\.git)$/, 'https://github.com/OWNER/NAME'],
  page: [/^https:\/\/[\w.-]+(:\d+)?\/([\w.~%-]+\/)*$/, 'an https address with a slash at its end'],
  package: [/^https:\/\/www\.npmjs\.com\/package\/[\w@./-]+$/, 'https://www.npmjs.com/package/NAME'],
};
export const names = Object.keys(forms);

/** @throws where one of them is neither empty nor an address */
export function checked(addresses) {
  for (const name of Object.keys(addresses)) {
    if (!(name in forms)) throw new Error(`addresses.json names "${name}"; it may hold ${names.join(', ')}`);
  }
  for (const [name, [form, words]] of Object.entries(forms)) {
    const value = addresses[name];
    if (typeof value !== 'string' || (value !== '' && !form.test(value))) {
      throw new Error(
        `${name} in addresses.json is ${JSON.stringify(value)}; it must be ${words}, or empty while there is none`,
      );
    }
  }
  return addresses;
}

export const readAddresses = () => checked(JSON.parse(readFileSync(join(root, 'addresses.json'), 'utf8')));

export const missing = (addresses) => names.filter((name) => addresses[name] === '');

/** Links by what they lead to; an empty one is not there. */
export function linksOf({ repository, page, package: npm }) {
  const below = (address, path) => (address === '' ? '' : address + path);
  return {
    studio: page,
    documentation: below(page, 'docs/'),
    source: repository,
    report: below(repository, '/issues/new/choose'),
    downloads: below(repository, '/releases/latest'),
    package: npm,
  };
}

// --- What is made of them ------------------------------------------------------------------------------------------------

/** Replaces what stands between <!-- NAME --> and <!-- end -->, each on a line of its own. */
function between(text, name, inside) {
  const begin = `<!-- ${name} -->\n`;
  const from = text.indexOf(begin);
  const to = text.indexOf('<!-- end -->', from);
  if (from < 0 || to < 0) throw new Error(`there is no place for ${name}, from <!-- ${name} --> to <!-- end -->`);
  return text.slice(0, from + begin.length) + inside + text.slice(to);
}

function readme(text, addresses) {
  const { studio, downloads, source } = linksOf(addresses);
  const link = (words, address) => (address === '' ? [] : [`[${words}](${address})`]);
  const first = [
    ...link('**Open the studio**', studio),
    ...link('Gallery', studio === '' ? '' : `${studio}gallery/`),
    ...link('Tests', source === '' ? '' : `${source}/actions/workflows/ci.yml`),
    ...link('Downloads', downloads),
    ...(addresses.package === '' ? [] : [`[\`npm install sillon\`](${addresses.package})`]),
  ];
  const clone =
    source === ''
      ? ''
      : `\nTo have the source:\n\n\`\`\`sh\ngit clone ${source} && cd ${source.split('/').pop()}\n\`\`\`\n\n`;
  return between(between(text, 'links', first.length === 0 ? '' : `\n${first.join(' · ')}\n\n`), 'clone', clone);
}

function start(text, addresses) {
  const { studio } = linksOf(addresses);
  const sentence = `\n[Open the studio](${studio}); nothing needs to be installed. Or, in the source folder:\n\n`;
  return between(text, 'studio', studio === '' ? '\nIn the source folder:\n\n' : sentence);
}

function packageJson(text, addresses) {
  const { source } = linksOf(addresses);
  const { repository: _r, homepage: _h, bugs: _b, ...rest } = JSON.parse(text);
  const made = Object.entries(rest).flatMap(([key, value]) =>
    key !== 'license' || source === ''
      ? [[key, value]]
      : [
          [key, value],
          ['repository', { type: 'git', url: `git+${source}.git`, directory: 'wasm' }],
          ['homepage', addresses.page === '' ? `${source}#readme` : addresses.page],
          ['bugs', { url: `${source}/issues` }],
        ],
  );
  return `${JSON.stringify(Object.fromEntries(made), null, 2)}\n`;
}

const version = () => /^project\(sillon VERSION ([\d.]+)/m.exec(readFileSync(join(root, 'CMakeLists.txt'), 'utf8'))[1];

/** The lines for the program itself, before those of its authors. */
function citation(text, { repository, page }) {
  const lines = [
    `version: ${version()}`,
    ...(repository === '' ? [] : [`repository-code: ${repository}`]),
    ...(page === '' ? [] : [`url: ${page}`]),
  ];
  const rest = text.split('\n').filter((line) => !/^(version|repository-code|url): /.test(line));
  rest.splice(rest.indexOf('authors:'), 0, ...lines);
  return rest.join('\n');
}

/** By file: its text, and the addresses, to its text with them. */
export const derived = {
  'README.md': readme,
  'docs/guide/start.md': start,
  'wasm/package.json': packageJson,
  'CITATION.cff': citation,
};

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [mode, repository] = process.argv.slice(2);
  const addresses = readAddresses();
  for (const [path, make] of Object.entries(derived)) {
    const text = readFileSync(join(root, path), 'utf8');
    const made = make(text, addresses);
    if (made === text) continue;
    if (mode === undefined) writeFileSync(join(root, path), made);
    else process.exitCode = 1;
    console.log(mode === undefined ? `${path} written` : `${path} is out of date; ./dev addresses writes it`);
  }
  for (const name of missing(addresses))
    console.log(`addresses.json: ${name} is still to be set; it must be ${forms[name][1]}`);
  if (mode === '--release') {
    if (repository === undefined) throw new Error('usage: node tools/addresses.mjs --release URL');
    if (addresses.repository !== repository) {
      console.log(`repository in addresses.json is "${addresses.repository}"; this release is of ${repository}`);
      process.exitCode = 1;
    }
    if (missing(addresses).length > 0) process.exitCode = 1;
  }
}
