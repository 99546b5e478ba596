// Pages of another site around the studio.
import { fileURLToPath } from 'node:url';

import { startChromium } from '../../../../wasm/test/support/browsers.js';
import { serve as servePlain } from '../../../../wasm/test/support/server.js';
import { serve } from '../../../serve.js';
import { smallPlate } from './small.js';
import { patience } from './waits.js';

const dist = fileURLToPath(new URL('../../../dist', import.meta.url));
const pages = fileURLToPath(new URL('../pages/', import.meta.url));
const examples = fileURLToPath(new URL('../../../../examples/', import.meta.url));

/** One browser, the studio, and a site of hosts. @param name  of the browser, as startChromium has them */
export async function startHosts(name) {
  const browser = await startChromium([], name);
  const studio = await serve(dist, 0);
  const host = await servePlain({ '/': pages, '/examples/': examples });
  return {
    browser,
    studio: `${studio.origin}/`,
    host: `${host.origin.replace('localhost', '127.0.0.1')}/`,
    /** A page of the hosts' site, or another. @param prepare  is given the page before it goes there
     * @param kept  for other tests, which `take` it @param small  frames begin with a small plate, but for those whose address names files */
    async open({ path = 'host.html', site = '127.0.0.1', small = true, prepare, kept = false, ...options } = {}) {
      const context = await browser.newContext({ reducedMotion: 'reduce', locale: 'en-US', ...options });
      const begin = (hash) => {
        const { pathname, search } = globalThis.location;
        if (pathname.endsWith('/embed.html') && !/[?&](?:src|project|shape|image)=/.test(search))
          globalThis.history.replaceState(null, '', pathname + search + hash);
      };
      if (small) await context.addInitScript(begin, smallPlate);
      const page = await context.newPage();
      page.setDefaultTimeout(patience);
      const problems = [];
      page.on('pageerror', (error) => problems.push(String(error)));
      await prepare?.(page);
      await page.goto(this.host.replace('127.0.0.1', site) + path);
      await page.waitForFunction(() => globalThis.attempt !== undefined);
      return { page, context, problems, kept };
    },
    /** After a visit. @param well  else it is closed, though other tests would take it */
    async leave({ context, kept }, well) {
      if (!kept || !well) await context.close();
    },
    async close() {
      await browser.close();
      studio.close();
      host.close();
    },
  };
}

/** A small plate. */
export const project = {
  sillon: 1,
  shape: { builtin: 'disc', size: [16, 16] },
  layers: [{ kind: 'direction', angle: 40 }],
  print: { layers: 1, base: 0 },
};
