// Serves web/dist, or another folder of static files, on this machine: node web/serve.js [--port N]
// [--host NAME] [FOLDER]
import { createReadStream, realpathSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, resolve, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

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
  '.zip': 'application/zip',
};

/** @returns {{ file: string, size: number } | undefined} the file that an address means; nothing outside of the folder. */
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
    return file.startsWith(root + sep) && status.isFile() ? { file, size: status.size } : undefined;
  } catch {
    return undefined; // not there
  }
}

/** Answers requests for files; `missing` answers what is not there. */
export function filesOf(folder, missing) {
  return (request, response) => {
    const found = request.method === 'GET' || request.method === 'HEAD' ? find(folder, request.url ?? '/') : undefined;
    if (found === undefined) {
      missing(request, response);
      return;
    }
    const { file, size } = found;
    response.writeHead(200, {
      ...headers,
      'Content-Type': types[extname(file).toLowerCase()] ?? 'application/octet-stream',
      'Content-Length': size,
      // Names of assets hold their hash; all else is asked for anew.
      'Cache-Control': /[\\/]assets[\\/][^\\/]*$/.test(file) ? 'max-age=31536000, immutable' : 'no-cache',
    });
    if (request.method === 'HEAD') response.end();
    else
      createReadStream(file)
        .on('error', () => response.destroy())
        .pipe(response);
  };
}

function notThere(request, response) {
  const known = request.method === 'GET' || request.method === 'HEAD';
  response.writeHead(known ? 404 : 405, { ...headers, 'Content-Type': 'text/plain; charset=utf-8' });
  response.end(known ? 'Not found\n' : 'Only GET and HEAD\n');
}

/** @returns {Promise<{ origin: string, close(): void }>} */
export function serve(folder, port, host = 'localhost') {
  const server = createServer(filesOf(folder, notThere));
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
  if (find(folder, '/') === undefined) fail(`${folder} holds no index.html; ./dev build makes web/dist`);
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
