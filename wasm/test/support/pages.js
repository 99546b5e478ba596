// Pages of tests: what a site serves beside the package, and what its visitor sees.
import { statSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { root } from './projects.js';
import { serve } from './server.js';

export const engineFolder = join(root, 'wasm/dist/engine');

/** Emscripten before 3.1.58 gives threads a script of their own. */
export const threadsHaveScript = statSync(join(engineFolder, 'sillon-mt.worker.js')).size > 0;

/** A site with the package, a test page at `page` and the example projects. @param more  folders of its own */
export async function serveSite(headers, more = {}, missingStatus = 404) {
  const folders = {
    '/sillon/dist/': join(root, 'wasm/dist'),
    '/support/': fileURLToPath(new URL('./', import.meta.url)),
    '/pages/': fileURLToPath(new URL('../browser/pages/', import.meta.url)),
    '/examples/': join(root, 'examples'),
    ...more,
  };
  const site = await serve(folders, headers, missingStatus);
  return { ...site, page: `${site.origin}/pages/index.html` };
}
