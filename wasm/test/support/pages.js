// Pages of tests: what a site serves beside the package, and what its visitor sees.
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { publishedScenes, root } from './projects.js';
import { serve } from './server.js';

export const engineFolder = join(root, 'wasm/dist/engine');

/** A site with the package, the test page and the example projects. @param more  folders of its own */
export const serveSite = (headers, more = {}) =>
  serve(
    {
      '/sillon/dist/': join(root, 'wasm/dist'),
      '/support/': fileURLToPath(new URL('./', import.meta.url)),
      '/pages/': fileURLToPath(new URL('../browser/pages/', import.meta.url)),
      '/examples/': join(root, 'examples'),
      '/scenes/': publishedScenes,
      ...more,
    },
    headers,
  );

/** Does one of the tasks of browser/pages/page.js. @param frame  a page, or a frame in it */
export async function attempt(frame, task, args) {
  return frame.evaluate(
    async ([task, args]) => {
      // The page's module may not have run yet.
      for (let wait = 0; globalThis.attempt === undefined && wait < 500; ++wait) {
        await new Promise((resolve) => setTimeout(resolve, 10));
      }
      return globalThis.attempt(task, args);
    },
    [task, args],
  );
}

/** As `attempt`, in a page of its own. @returns the value. @throws what the task threw */
export async function inPage(browser, url, task, args) {
  const page = await browser.newPage();
  try {
    await page.goto(url);
    const { value, error } = await attempt(page, task, args);
    if (error) throw Object.assign(new Error(error.message), error);
    return value;
  } finally {
    await page.close();
  }
}
