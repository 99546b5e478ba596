// How smooth a page stays that shows many <sillon-view>s on a machine without graphics hardware, and what memory they take.
// Prints; asserts nothing.   ./dev bench views [COUNT..]
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import { startChromium } from '../wasm/test/support/browsers.js';
import { serve as servePlain } from '../wasm/test/support/server.js';
import { serve } from './serve.js';
import { roundView } from './test/browser/support/view-png.js';

const counts = process.argv.length > 2 ? process.argv.slice(2).map(Number) : [0, 1, 6, 24, 100];
const seconds = 8;
const tile = 190; // [px] 24 fill a window of 1184 x 800

/** Memory of this program's children and theirs, shared pages counted once [MB]; NaN where /proc does not tell. */
function memory() {
  try {
    const parents = new Map(
      readdirSync('/proc')
        .filter((name) => /^\d+$/.test(name))
        .map((pid) => [pid, readFileSync(`/proc/${pid}/stat`, 'utf8').replace(/^.*\) . (\d+).*$/s, '$1')]),
    );
    const ours = (pid) => pid !== undefined && (pid === String(process.pid) || ours(parents.get(pid)));
    const kilobytes = (pid) => Number(/^Pss:\s+(\d+)/m.exec(readFileSync(`/proc/${pid}/smaps_rollup`, 'utf8'))[1]);
    const children = [...parents.keys()].filter((pid) => pid !== String(process.pid) && ours(pid));
    return children.reduce((sum, pid) => sum + kilobytes(pid), 0) / 1024;
  } catch {
    return NaN;
  }
}

const folder = mkdtempSync(join(tmpdir(), 'sillon-views-'));
writeFileSync(join(folder, 'page.html'), '<!doctype html><title>A shop</title><link rel="icon" href="data:," />');
writeFileSync(join(folder, 'plate.png'), roundView(400));
const studio = await serve(fileURLToPath(new URL('dist', import.meta.url)), 0);
const site = await servePlain({ '/': `${folder}/` });

console.log(
  `views   frames/s   longest [ms]   views drawn/s   memory [MB]   (each ${tile} px, file of 400 x 400 texels)`,
);
for (const count of counts) {
  const browser = await startChromium();
  const page = await browser.newPage({ viewport: { width: 1184, height: 800 } });
  await page.goto(`${site.origin}/page.html`);
  const found = await page.evaluate(
    async ({ script, count, tile, seconds }) => {
      let drawn = 0;
      const draw = WebGL2RenderingContext.prototype.drawArrays;
      WebGL2RenderingContext.prototype.drawArrays = function (...words) {
        ++drawn;
        draw.apply(this, words);
      };
      await import(script);
      for (let k = 0; k < count; ++k) {
        const view = document.createElement('sillon-view');
        view.style.cssText = `display: inline-block; width: ${tile}px; margin: 2px`;
        view.setAttribute('src', `plate.png?${k}`);
        document.body.append(view);
      }
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      const rest = performance.now() + 4000; // files come, first pictures are drawn
      while (performance.now() < rest) await frame();
      const begin = await frame();
      const before = drawn;
      let [last, frames, longest] = [begin, 0, 0];
      while (last < begin + 1000 * seconds) {
        const now = await frame();
        longest = Math.max(longest, now - last);
        last = now;
        ++frames;
      }
      const span = (last - begin) / 1000;
      return { fps: frames / span, longest, drawn: (drawn - before) / span };
    },
    { script: `${studio.origin}/embed/sillon-view.js`, count, tile, seconds },
  );
  const shown = [found.fps.toFixed(1), found.longest.toFixed(0), found.drawn.toFixed(0), memory().toFixed(0)];
  console.log(
    `${String(count).padStart(5)}   ${shown[0].padStart(8)}   ${shown[1].padStart(12)}   ${shown[2].padStart(13)}   ${shown[3].padStart(11)}`,
  );
  await browser.close();
}
studio.close();
site.close();
rmSync(folder, { recursive: true });
