// Builds the studio into dist: static files for any web server, in any folder of it.
import { createHash } from 'node:crypto';
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { brotliCompress, constants } from 'node:zlib';

import { licences } from '../tools/licences.mjs';
import { linksOf, readAddresses } from '../tools/addresses.mjs';
import { contentSecurityPolicy, engineBase, headers, isolation } from './headers.js';
import { chunkOf } from './chunks.js';
import { filesOf } from './serve.js';

const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const engine = at('../wasm/dist/engine');
const isEngineFile = (path) => !path.endsWith('node-worker.js'); // which is for Node alone
const inputs = at('../examples/inputs');
const pictures = at('../docs/pictures');
const photograph = 'coupon-photograph.jpg'; // as the coupon is to be photographed
let dist = at('dist'); // or --outDir

/** The folder of the engine's files, whose name tells their bytes: a page never gets those of another version. */
function engineFolder() {
  const hash = createHash('sha256');
  for (const name of readdirSync(engine).filter(isEngineFile).sort())
    hash.update(name).update(readFileSync(join(engine, name)));
  return `engine/${hash.digest('hex').slice(0, 12)}/`;
}

/** Lays a file beside another that is as small as Brotli makes it, for servers that send such files: the engine is most of a
 * first visit, and loses an eighth more than what a server does while somebody waits. That takes seconds, so it is done once. */
async function squeeze(path) {
  const bytes = readFileSync(path);
  const done = join(at('../build/brotli'), createHash('sha256').update(bytes).digest('hex'));
  if (!existsSync(done)) {
    mkdirSync(at('../build/brotli'), { recursive: true });
    const params = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length };
    writeFileSync(`${done}.new`, await promisify(brotliCompress)(bytes, { params }));
    renameSync(`${done}.new`, done);
  }
  cpSync(done, `${path}.br`);
}

/** The engine's files lie as they are in such a folder, or elsewhere (headers.js): no bundler may touch them. */
const engineFiles = {
  name: 'studio-engine-files',
  enforce: 'pre',
  configResolved({ build: { outDir } }) {
    dist = outDir;
  },
  // The package names them beside itself, too; the studio always says where they are, so they must not be copied twice.
  transform(code, id) {
    if (!/wasm[\\/]dist[\\/]platform-browser\.js$/.test(id)) return undefined;
    return code.replaceAll(
      /new URL\((['"])(\.\/engine\/[\w.-]+)\1, import\.meta\.url\)/g,
      'new URL($1$2$1, location.href)',
    );
  },
  configureServer(server) {
    server.middlewares.use(
      '/engine',
      filesOf(engine, (request, response) => {
        response.writeHead(404).end();
      }),
    );
  },
  async writeBundle() {
    if (engineBase !== undefined) return;
    const folder = join(dist, engineFolder());
    cpSync(engine, folder, { recursive: true, filter: isEngineFile });
    const modules = readdirSync(folder).filter((name) => name.endsWith('.wasm'));
    await Promise.all(modules.map((name) => squeeze(join(folder, name))));
  },
};

/** Pictures of the gallery's plates, which the command line's examples use as well. */
const exampleFiles = {
  name: 'studio-example-files',
  configureServer(server) {
    server.middlewares.use(
      '/examples',
      filesOf(
        inputs,
        filesOf(pictures, (request, response) => {
          response.writeHead(404).end();
        }),
      ),
    );
  },
  writeBundle() {
    const used = /^(photo|relief|mosaic|tiles|logo|strokes|sun|moon)(_\w+)?\.(png|svg)$/;
    for (const name of readdirSync(inputs).filter((name) => used.test(name))) {
      cpSync(join(inputs, name), join(dist, 'examples', name));
    }
    cpSync(join(pictures, photograph), join(dist, 'examples', photograph));
  },
};

/** Where the facts of printers come from stays in the package: the first view need not fetch it. */
const printerTable = {
  name: 'studio-printer-table',
  enforce: 'pre',
  transform(code, id) {
    if (!/data[\\/]printers\.json$/.test(id)) return undefined;
    return JSON.stringify(JSON.parse(code), (key, value) => (key === 'source' || key === 'models' ? undefined : value));
  },
};

/** Shaders and elements' styles are fetched without their comments and indents, which no minifier takes out of strings. */
const strings = {
  name: 'studio-strings',
  enforce: 'pre',
  transform(code, id) {
    if (/src[\\/]views[\\/]shaders\.ts$/.test(id))
      return code.replaceAll(/`[^`]*`/g, (text) => text.replaceAll(/ *\/\/.*$/gm, '').replaceAll(/\n\s+/g, '\n'));
    if (!/web[\\/]src[\\/][\w\\/-]+\.ts$/.test(id)) return undefined;
    return code.replaceAll(/\bcss`[^`]*`/g, (text) => text.replaceAll(/\/\*.*?\*\//gs, '').replaceAll(/\n\s+/g, '\n'));
  },
};

const addresses = readAddresses();
const { version } = JSON.parse(readFileSync(at('package.json'), 'utf8'));
/** SILLON_DOCS: where the documentation lies beside this build, if it does; else it is that of the published page. */
const links = { ...linksOf(addresses), ...(process.env.SILLON_DOCS ? { documentation: process.env.SILLON_DOCS } : {}) };

/** Tags that both pages have in their heads; and where the page is published, its one address and its picture for those that link to it. */
const head = {
  name: 'studio-head',
  transformIndexHtml: {
    order: 'pre',
    handler(html, { filename }) {
      const whole = html.replace('<!-- src/head.html -->', () => readFileSync(at('src/head.html'), 'utf8').trim());
      if (addresses.page === '' || !filename.endsWith('index.html')) return whole;
      const meta = (property, content) => ({ tag: 'meta', attrs: { property, content }, injectTo: 'head' });
      return {
        html: whole,
        tags: [
          { tag: 'link', attrs: { rel: 'canonical', href: addresses.page }, injectTo: 'head' },
          meta('og:url', addresses.page),
          meta('og:image', `${addresses.page}preview.jpg`),
        ],
      };
    },
  },
};

/** The texts lie beside the page wherever it is copied. */
const licenceFile = {
  name: 'studio-licences',
  apply: 'build',
  writeBundle() {
    writeFileSync(join(dist, 'licences.txt'), licences('studio'));
  },
};

/** Files that no visit without a network needs. */
const notKept = new Set(['sw.js', '404.html', 'embed.html', 'preview.jpg']);
/** Files that are kept as they come: a site with more than the studio in it has other licences. */
const mayDiffer = new Set(['licences.txt']);
/** Files that every visit needs; the engine is kept as the one that was used. */
const everyVisit = /^(\.\/|assets\/(ahead|studio|first|engine|rolldown-runtime|tokens|marks\.worker)-.*)$/;

/** The policy, for hosts that send no headers; where the engine is, and what asks for it before all else. Not while developing,
 * where Vite puts styles into the page. */
const headBegins = {
  name: 'studio-head-begins',
  apply: 'build',
  transformIndexHtml: {
    order: 'post', // once the names of scripts are known
    handler(html, { bundle }) {
      const { fileName } = Object.values(bundle).find(({ name }) => name === 'ahead');
      const tag = (tag, attrs) => ({ tag, attrs, injectTo: 'head-prepend' });
      return [
        tag('meta', { 'http-equiv': 'Content-Security-Policy', content: contentSecurityPolicy }),
        tag('meta', { name: 'sillon-engine', content: engineBase ?? engineFolder() }),
        tag('script', { type: 'module', async: true, src: `./${fileName}` }),
      ];
    },
  },
};

/** Tells the service worker which files make a version, once all of them are written. */
const offline = {
  name: 'studio-offline',
  apply: 'build',
  enforce: 'post',
  closeBundle() {
    const names = readdirSync(dist, { recursive: true, withFileTypes: true })
      .filter((entry) => entry.isFile())
      .map((entry) =>
        join(entry.parentPath, entry.name)
          .slice(dist.length + 1)
          .replaceAll('\\', '/'),
      )
      .filter((name) => !notKept.has(name) && !name.endsWith('.br'))
      .sort();
    const hash = (bytes) => createHash('sha256').update(bytes).digest('base64');
    const hashOf = (name) => (mayDiffer.has(name) ? '' : hash(readFileSync(join(dist, name))));
    // The page goes by its folder's address: some hosts send index.html there.
    const files = Object.fromEntries(names.map((name) => [name === 'index.html' ? './' : name, hashOf(name)]));
    const worker = readFileSync(join(dist, 'sw.js'), 'utf8');
    const version = hash(JSON.stringify(files) + worker).slice(0, 12);
    const first = Object.keys(files).filter((name) => everyVisit.test(name));
    writeFileSync(
      join(dist, 'sw.js'),
      `const build = ${JSON.stringify({ version, files, first, isolation })};\n${worker}`,
    );
  },
};

export default {
  root: at('.'),
  base: './',
  define: { publicLinks: JSON.stringify(links), publicVersion: JSON.stringify(version) },
  plugins: [head, engineFiles, exampleFiles, licenceFile, printerTable, strings, headBegins, offline],
  server: { headers: isolation },
  preview: { headers },
  worker: { format: 'iife' }, // sandboxed frames start no modules
  build: {
    outDir: dist,
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0, // data: addresses are not in the policy
    modulePreload: { polyfill: false },
    rolldownOptions: {
      input: {
        main: at('index.html'),
        embed: at('embed.html'),
        ahead: at('src/app/ahead.ts'),
        sw: at('src/service-worker/sw.ts'),
      },
      output: {
        codeSplitting: { groups: [{ name: chunkOf, debugName: 'rooms', includeDependenciesRecursively: false }] },
        entryFileNames: ({ name }) => (name === 'sw' ? 'sw.js' : 'assets/[name]-[hash].js'),
      },
    },
  },
};
