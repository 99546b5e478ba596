// A small web server for tests: folders under paths, every response with the same headers.
import { realpathSync, statSync } from 'node:fs';
import { open } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, sep } from 'node:path';
import { pipeline } from 'node:stream';

const types = {
  '.css': 'text/css',
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.json': 'application/json',
  '.png': 'image/png',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

const isolated = {
  'Document-Isolation-Policy': 'isolate-and-credentialless',
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
  'Cross-Origin-Resource-Policy': 'cross-origin',
};
const shared = { 'Access-Control-Allow-Origin': '*' };
/** What wasm/README.md names, and nothing else. @param more  another origin */
const strict = (more = '') => ({
  'Content-Security-Policy':
    `default-src 'none'; script-src 'self' 'wasm-unsafe-eval'${more}; worker-src 'self' blob:; ` +
    `connect-src 'self'${more}; base-uri 'none'`,
});

export const headerSets = {
  plain: {},
  isolated,
  strict: { ...isolated, ...strict() },
  strictElsewhere: { ...isolated, ...strict(' http://localhost:*') },
  /** For pages of any other origin. */
  plainShared: shared,
  isolatedShared: { ...isolated, ...shared },
};

/** The file that a request means, or undefined: outside of the folders, or not there. */
function fileFor(path, folders) {
  const prefix = Object.keys(folders)
    .filter((start) => path.startsWith(start))
    .sort((a, b) => b.length - a.length)[0];
  if (prefix === undefined || path.includes('\0')) return undefined;
  const rest = path.slice(prefix.length);
  try {
    const folder = realpathSync(folders[prefix]);
    const file = realpathSync(join(folder, rest === '' || rest.endsWith('/') ? `${rest}index.html` : rest));
    return file.startsWith(folder + sep) && statSync(file).isFile() ? file : undefined;
  } catch {
    return undefined;
  }
}

function decodedPath(url) {
  try {
    return decodeURIComponent(url.split('?')[0]);
  } catch {
    return '';
  }
}

/**
 * @param {Record<string, string>} folders  by the start of the path, with final slash
 * @param {Record<string, string>} headers
 * @param {number} missingStatus  of the web page that answers for what is not there: 404, or 200 as many servers of
 *   single-page applications do
 */
export async function serve(folders, headers = {}, missingStatus = 404) {
  const held = new Map();
  const server = createServer(async (request, response) => {
    const path = decodedPath(request.url);
    await held.get(path);
    const file = fileFor(path, folders);
    const common = { 'Cache-Control': 'no-cache', ...headers };
    if (file === undefined) {
      response.writeHead(missingStatus, { ...common, 'Content-Type': types['.html'] });
      response.end('<!doctype html><title>Not found</title><h1>Not found</h1>');
      return;
    }
    const type = types[extname(file)] ?? 'application/octet-stream';
    // The length of the file that is sent, though another takes its place meanwhile.
    const opened = await open(file);
    const { size } = await opened.stat();
    response.writeHead(200, { ...common, 'Content-Type': type, 'Content-Length': size });
    pipeline(opened.createReadStream(), response, () => {}); // who asked may have gone
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address();
  return {
    origin: `http://localhost:${port}`,
    /** Answers nobody who asks for a path until the function that it returns is called. */
    hold(path) {
      let release;
      held.set(path, new Promise((resolve) => (release = resolve)));
      return release;
    },
    close() {
      server.close();
      server.closeAllConnections();
    },
  };
}
