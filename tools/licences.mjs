// Prints the licences of all that becomes part of a product, with their texts, from where the packages put them:
//   node tools/licences.mjs native|npm|studio|site
//   node tools/licences.mjs native|npm|studio|site --sbom   the same parts as a list for machines, CycloneDX, without their texts
// A part without a text ends it with an error, and with it the build.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('..', import.meta.url));
const at = (path) => join(root, path);
const read = (path) => readFileSync(path, 'utf8').trim();

/** Debian's files name the longest texts by where Debian keeps them, which others do not have: they follow. */
function withCommon(text) {
  const named = [...new Set([...text.matchAll(/\/usr\/share\/common-licenses\/([\w.-]*\w)/g)].map(([path]) => path))];
  return [text, ...named.filter((path) => existsSync(path)).map((path) => `---- ${path}\n\n${read(path)}`)].join(
    '\n\n',
  );
}

/** The first of these that is there. A star stands for the end of one folder's name. */
const first = (paths) =>
  paths
    .flatMap((path) => {
      const [folder, rest] = path.split('*');
      if (rest === undefined) return [path];
      const [parent, begin] = [folder.slice(0, folder.lastIndexOf('/')), folder.slice(folder.lastIndexOf('/') + 1)];
      const names = existsSync(parent) ? readdirSync(parent).sort() : [];
      return names.filter((name) => name.startsWith(begin)).map((name) => `${parent}/${name}${rest}`);
    })
    .find((path) => existsSync(path));

/** @param from  { version, purl }, where it is known of which version it is */
function part(name, licence, text, from = {}) {
  if (text === undefined || text.trim() === '')
    throw new Error(`no text of the licence of ${name} was found; it must go with what is built`);
  return { name, licence, text, ...from };
}

/** MIT, as our own licence words it. */
const mit = (holder) => read(at('LICENSE')).replace(/^Copyright .*$/m, holder);

/** A value that a build folder was configured with. */
function cached(folder, name) {
  const cache = existsSync(at(`${folder}/CMakeCache.txt`)) ? read(at(`${folder}/CMakeCache.txt`)) : '';
  return new RegExp(`^${name}:\\w+=(.*)$`, 'm').exec(cache)?.[1];
}

// --- Libraries of the core and of the command line -------------------------------------------------------------------------

/** Debian packages by vcpkg port, from the list that ./dev installs. */
function debianPackages() {
  const [, list] = /^needs="\n([^"]*)"/m.exec(read(at('dev')));
  return new Map(
    list
      .trim()
      .split('\n')
      .map((row) => row.split(/\s+/))
      .map(([debian, , port]) => [port, debian]),
  );
}

/** By library, as our own list has it. */
const licenceOf = (name) => new RegExp(`^\\| ${name} \\| ([^|]+) \\|`, 'm').exec(read(at('THIRD-PARTY.md')))?.[1] ?? '';

/** HarfBuzz as ./dev builds it in, out of its sources; undefined: the system's. */
function harfbuzz() {
  const folder = cached('build/release', 'SILLON_HARFBUZZ');
  if (!folder) return undefined;
  const [, version] = /HB_VERSION_STRING "(.*)"/.exec(read(`${folder}/src/hb-version.h`));
  const purl = `pkg:generic/harfbuzz@${version}`;
  return part('harfbuzz', licenceOf('harfbuzz'), read(`${folder}/COPYING`), { version, purl });
}

/** What shapes texts and makes codes and moving pictures natively; JavaScript packages of their own do it elsewhere. */
const nativeLibraries = ['brotli', 'harfbuzz', 'icu', 'libwebp', 'nayuki-qr-code-generator'];

function libraries({ program, native = false }) {
  const { dependencies, features } = JSON.parse(read(at('vcpkg.json')));
  const debian = debianPackages();
  const ports = [...(program ? features.cli.dependencies : []), ...dependencies]
    .map((asked) => asked.name ?? asked)
    .filter((port) => native || !nativeLibraries.includes(port));
  return ports.map((port) => {
    const built = port === 'harfbuzz' ? harfbuzz() : undefined;
    if (built) return built;
    const file = first([
      at(`build/release/vcpkg_installed/*/share/${port}/copyright`),
      `/usr/share/doc/${debian.get(port)}/copyright`,
    ]);
    return part(port, licenceOf(port), file && withCommon(read(file)));
  });
}

// --- What the compiler for WebAssembly puts in -----------------------------------------------------------------------------

function emscripten() {
  const toolchain = cached('build/wasm', 'CMAKE_TOOLCHAIN_FILE') ?? '';
  const folder = /(.*)\/cmake\/Modules\/Platform\/Emscripten\.cmake$/.exec(toolchain)?.[1];
  if (folder === undefined)
    throw new Error('build/wasm does not tell which Emscripten it is built by; ./dev build wasm makes it');
  const own = first([`${folder}/LICENSE`]);
  const llvm = first([`${folder}/system/lib/libcxx/LICENSE.TXT`]);
  return [
    part('Emscripten', 'MIT', own ? read(own) : mit('Copyright (c) 2010-2022 The Emscripten Authors')),
    part('musl', 'MIT', read(`${folder}/system/lib/libc/musl/COPYRIGHT`)),
    part('libc++, libc++abi, compiler-rt', 'Apache-2.0 WITH LLVM-exception', llvm ? read(llvm) : debianLlvm()),
  ];
}

/** The paragraph of Debian's file that has the exceptions; the rest is about other parts of LLVM. */
function debianLlvm() {
  const file = first(['/usr/share/doc/libllvm*/copyright']);
  const paragraph =
    file &&
    read(file)
      .split(/\n\s*\n/)
      .find((text) => text.includes('LLVM Exceptions to the Apache 2.0 License'));
  return paragraph && withCommon(paragraph.slice(paragraph.indexOf('License:')));
}

// --- npm packages ----------------------------------------------------------------------------------------------------------

/** Packages that hold no text, but say under which licence they are: its text from a package of the same authors. */
const elsewhere = {
  '@lit-labs/ssr-dom-shim': () => read(at('node_modules/lit/LICENSE')),
};

/** Files with the licences of libraries inside a package, which its own does not hold. */
const within = {
  '@jsquash/webp': ['codec/LICENSE.codec.md'],
};

/** Holders of MIT licences of libraries inside a package, which names none of them. */
const holders = {
  'woff2-encoder': [
    'Copyright (c) 2013-2017 by the WOFF2 Authors.',
    'Copyright (c) 2009, 2010, 2013-2016 by the Brotli Authors.',
  ],
};

function npmPackages(more = []) {
  const { packages } = JSON.parse(read(at('package-lock.json')));
  return Object.entries(packages)
    .filter(([path, { dev, link }]) => /^node_modules/.test(path) && !link && (!dev || more.includes(path.slice(13))))
    .map(([path, { version, license }]) => {
      const name = path.slice('node_modules/'.length);
      const file = readdirSync(at(path)).find((entry) => /^licen[cs]e/i.test(entry));
      const purl = `pkg:npm/${name.replace('@', '%40')}@${version}`;
      const own = file ? read(at(join(path, file))) : elsewhere[name]?.();
      const inside = (within[name] ?? []).map((one) => read(at(join(path, one))));
      const known = (holders[name] ?? []).map(mit);
      return part(name, license, [own, ...inside, ...known].filter(Boolean).join('\n\n'), { version, purl });
    });
}

/** They stand beside the fonts. */
const fonts = () =>
  readdirSync(at('core/data/fonts'))
    .filter((name) => name.endsWith('-LICENSE.txt'))
    .sort()
    .map((name) => {
      const text = read(at(`core/data/fonts/${name}`));
      const licence = text.includes('Open Font License') ? 'OFL-1.1' : 'Apache-2.0';
      return part(`font ${name.replace('-LICENSE.txt', '')}`, licence, text);
    });

/** In dist/engine/text.js and unpack.js, which hold them though they are no dependencies of the package. */
const textPackages = ['bidi-js', 'fflate', 'harfbuzzjs', 'nayuki-qr-code-generator', 'woff2-encoder'];
const onlyNamed = (names) => npmPackages(names).filter(({ name }) => names.includes(name));

// --- Products --------------------------------------------------------------------------------------------------------------

const studio = () => [...libraries({ program: false }), ...emscripten(), ...npmPackages(textPackages), ...fonts()];
const products = {
  native: () => [...libraries({ program: true, native: true }), ...fonts()],
  npm: () => [...libraries({ program: true }), ...emscripten(), ...onlyNamed(textPackages), ...fonts()],
  studio,
  site: () => [...studio(), ...onlyNamed(['minisearch'])],
};

/** @returns one text */
export function licences(product) {
  const parts = products[product]();
  const named = ({ name, version, licence }) => `${[name, version].filter(Boolean).join(' ')} (${licence})`;
  const own = `Sillon: MIT\n\n${read(at('LICENSE'))}\n\nIt holds parts of:\n${parts.map((of) => `  ${named(of)}`).join('\n')}\n`;
  return [own, ...parts.map((of) => `==== ${named(of)}\n\n${of.text}\n`)].join('\n');
}

/** @returns what software that compares parts with known weaknesses reads */
export function sbom(product) {
  const { version } = JSON.parse(read(at('wasm/package.json')));
  const components = products[product]().map(({ name, licence, text: _, ...from }) => ({
    type: 'library',
    name,
    ...from,
    licenses: [{ license: { name: licence } }],
  }));
  const main = { type: 'application', name: 'sillon', version, licenses: [{ license: { id: 'MIT' } }] };
  return `${JSON.stringify({ bomFormat: 'CycloneDX', specVersion: '1.5', version: 1, metadata: { component: main }, components }, null, 2)}\n`;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [product, mode] = process.argv.slice(2);
  if (!(product in products)) throw new Error(`usage: node tools/licences.mjs ${Object.keys(products).join('|')}`);
  process.stdout.write(mode === '--sbom' ? sbom(product) : licences(product));
}
