// Serves web/dist, or another folder of static files, on this machine: node web/serve.js [--port N]
// [--host NAME] [FOLDER]
import { createReadStream, existsSync, realpathSync, statSync } from 'node:fs';
import { readFile, stat } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, resolve, sep } from 'node:path';
import { pipeline } from 'node:stream';
import { fileURLToPath } from 'node:url';
import { parseArgs, promisify } from 'node:util';
import { brotliCompress, constants } from 'node:zlib';

import { headers } from './headers.js';

const types = {
  '.css': 'text/css; charset=utf-8',
  '.html': 'text/html; charset=utf-8',
  '.jpg': 'image/jpeg',
  '.js': 'text/javascript; charset=utf-8',
  '.json': 'application/json',
  '.png': 'image/png',
  '.svg': 'image/svg+xml',
  '.txt': 'text/plain; charset=utf-8',
  '.wasm': 'application/wasm',
  '.webmanifest': 'application/manifest+json',
  '.webp': 'image/webp',
  '.zip': 'application/zip',
};

const compressible = new Set(['.css', '.html', '.js', '.json', '.svg', '.txt', '.wasm', '.webmanifest']);
const largest = 8 * 2 ** 20; // [bytes] of a file that is compressed
const mostKept = 64 * 2 ** 20; // [bytes] of compressed files

/** @returns {{ file: string, size: number, tag: string } | 'folder' | undefined} the file that an address means, and the tag of
 * what it holds now; nothing outside of the folder. folder: the address of one with a page lacks its slash. */
function find(folder, url) {
  let path;
  try {
    path = decodeURIComponent(url.split(/[?#]/)[0]);
  } catch {
    return undefined;
  }
  if (!path.startsWith('/') || path.includes('\0')) return undefined;
  try {
    const root = realpathSync(folder);
    const file = realpathSync(join(root, path.endsWith('/') ? `${path}index.html` : path));
    const status = statSync(file);
    if (!file.startsWith(root + sep)) return undefined;
    if (status.isDirectory() && existsSync(join(file, 'index.html'))) return 'folder';
    if (!status.isFile()) return undefined;
    const tag = `W/"${status.size.toString(36)}-${Math.round(status.mtimeMs * 1000).toString(36)}"`;
    return { file, size: status.size, tag };
  } catch {
    return undefined; // not there
  }
}

const squeeze = promisify(brotliCompress);

/** The file as the build has compressed it; undefined: not, or not this one. */
async function squeezedBefore(file) {
  const [own, packed] = await Promise.all([stat(file), stat(`${file}.br`)]);
  return packed.mtimeMs >= own.mtimeMs ? readFile(`${file}.br`) : undefined;
}

/** Compresses each file once, and keeps the last ones. */
function compressor() {
  const kept = new Map(); // of tag and file
  let bytes = 0;
  return async ({ file, size, tag }) => {
    const key = `${tag} ${file}`;
    const known = kept.get(key);
    if (known !== undefined) return known;
    // 5 of 11: nearly as small, and the first visitor does not wait for it.
    const params = { [constants.BROTLI_PARAM_QUALITY]: 5, [constants.BROTLI_PARAM_SIZE_HINT]: size };
    const packed =
      (await squeezedBefore(file).catch(() => undefined)) ?? (await squeeze(await readFile(file), { params }));
    if (!kept.has(key)) bytes += packed.length;
    kept.set(key, packed);
    for (const [oldest, { length }] of kept) {
      if (bytes <= mostKept) break;
      kept.delete(oldest);
      bytes -= length;
    }
    return packed;
  };
}

/** As many bytes as were announced, also of a file that changes meanwhile: one more would be taken for the next answer, and one
 * less closes the connection. The file is closed whoever ends it, the visitor too. */
function sendFile(file, size, response) {
  const stream = createReadStream(file, { end: size - 1 });
  const whole = async function* (source) {
    yield* source;
    if (stream.bytesRead < size) throw new Error(`${file} became shorter`);
  };
  pipeline(stream, whole, response, () => {}); // it has closed all three, and there is nobody left to tell
}

/** Answers requests for files; `missing` answers what is not there. */
export function filesOf(folder, missing) {
  const compressed = compressor();
  return async (request, response) => {
    const found = request.method === 'GET' || request.method === 'HEAD' ? find(folder, request.url ?? '/') : undefined;
    if (found === undefined) {
      missing(request, response);
      return;
    }
    if (found === 'folder') {
      const [, name, rest] = /([^/?#]*)([?#].*)?$/.exec(request.url);
      response.writeHead(301, { ...headers, Location: `./${name}/${rest ?? ''}` });
      response.end();
      return;
    }
    const { file, size, tag } = found;
    const ending = extname(file).toLowerCase();
    const about = {
      ...headers,
      ETag: tag,
      Vary: 'Accept-Encoding',
      // Names of assets, and of the engine's folder, hold a hash; all else is asked for anew.
      'Cache-Control': /[\\/](?:assets|engine[\\/][\da-f]{12})[\\/][^\\/]*$/.test(file)
        ? 'max-age=31536000, immutable'
        : 'no-cache',
    };
    if (request.headers['if-none-match']?.split(/, */).includes(tag)) {
      response.writeHead(304, about);
      response.end();
      return;
    }
    about['Content-Type'] = types[ending] ?? 'application/octet-stream';
    const accepts = /\bbr\b(?!\s*;\s*q=0(?:\.0*)?\s*(?:,|$))/.test(request.headers['accept-encoding'] ?? '');
    const packed =
      accepts && compressible.has(ending) && size <= largest
        ? await compressed(found).catch(() => undefined)
        : undefined;
    if (packed === undefined) {
      response.writeHead(200, { ...about, 'Content-Length': size });
    } else {
      response.writeHead(200, { ...about, 'Content-Encoding': 'br', 'Content-Length': packed.length });
    }
    if (request.method === 'HEAD' || size === 0) response.end();
    else if (packed !== undefined) response.end(packed);
    else sendFile(file, size, response);
  };
}

/** Answers what is not there: people with a page that leads on, if the folder has one. */
const notThereIn = (folder) => async (request, response) => {
  const known = request.method === 'GET' || request.method === 'HEAD';
  const read = known && /\btext\/html\b/.test(request.headers.accept ?? '');
  const page = read ? await readFile(join(folder, '404.html')).catch(() => undefined) : undefined;
  const type = types[page === undefined ? '.txt' : '.html'];
  response.writeHead(known ? 404 : 405, { ...headers, 'Content-Type': type });
  if (request.method === 'HEAD') response.end();
  else response.end(page ?? (known ? 'Not found\n' : 'Only GET and HEAD\n'));
};

/** @returns {Promise<{ origin: string, close(): void }>} */
export function serve(folder, port, host = 'localhost') {
  const server = createServer(filesOf(folder, notThereIn(folder)));
  return new Promise((done, failed) => {
    server.on('error', failed);
    server.listen(port, host, () => {
      done({
        origin: `http://${host.includes(':') ? `[${host}]` : host}:${server.address().port}`,
        close() {
          server.close();
          server.closeAllConnections();
        },
      });
    });
  });
}

function fail(message) {
  console.error(`serve: ${message}`);
  process.exit(1);
}

function argumentsOf(list) {
  try {
    const options = { port: { type: 'string', default: '8080' }, host: { type: 'string', default: 'localhost' } };
    return parseArgs({ args: list, options, allowPositionals: true });
  } catch (error) {
    return fail(error.message);
  }
}

async function main() {
  const { values, positionals } = argumentsOf(process.argv.slice(2));
  const port = Number(values.port);
  if (!/^\d+$/.test(values.port) || port > 65535) fail(`--port is ${values.port}; it must be 0 to 65535`);
  if (positionals.length > 1) fail('only one folder can be served');
  const folder = resolve(positionals[0] ?? fileURLToPath(new URL('dist', import.meta.url)));
  if (typeof find(folder, '/') !== 'object') fail(`${folder} holds no index.html; ./dev build makes web/dist`);
  try {
    const { origin } = await serve(folder, port, values.host);
    console.log(`Sillon Studio: ${origin}  (Ctrl+C ends it)`);
  } catch (error) {
    if (['ENOTFOUND', 'EADDRNOTAVAIL', 'EAI_AGAIN'].includes(error.code))
      fail(`--host is ${values.host}; it must be a name or an address of this machine, such as 0.0.0.0 for all`);
    if (error.code === 'EADDRINUSE') fail(`port ${port} is in use; another: --port ${port + 1}`);
    fail(error.message);
  }
}

if (process.argv[1] !== undefined && realpathSync(process.argv[1]) === fileURLToPath(import.meta.url)) await main();
