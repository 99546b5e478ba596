// What tests wait for: never for a time, which is too short somewhere, but for what is to come.
import assert from 'node:assert/strict';

/** For what must come [ms]: far more than a slow machine that is busy with other things takes. */
export const patience = 180_000;

/** For a page, or all of a context: what waits for `delay` waits for `longer` [ms], so that a busy machine is in time. */
export const stretchWaits = (pages, delay, longer) =>
  pages.addInitScript(
    ([delay, longer]) => {
      const { setTimeout } = globalThis;
      globalThis.setTimeout = (run, wait, ...more) => setTimeout(run, wait === delay ? longer : wait, ...more);
    },
    [delay, longer],
  );

/** What is told of the plate of a frame or page that the studio kept last, or null: as it stands in the browser's storage now.
 * @param host  a site's origin and the name that it gave the work; '': the studio's own */
export const keptPlate = (frame, host = '') =>
  frame.evaluate(async (name) => {
    const answered = (request) =>
      new Promise((resolve, reject) => {
        request.onsuccess = () => resolve(request.result);
        request.onerror = () => reject(request.error);
      });
    if (!(await indexedDB.databases()).some((one) => one.name === name)) return null;
    const database = await answered(indexedDB.open(name));
    try {
      const work = database.transaction('work').objectStore('work');
      const ids = (await answered(work.getAllKeys())).flatMap((key) => /^about\/(.+)$/.exec(key)?.[1] ?? []);
      const abouts = await Promise.all(ids.map((id) => answered(work.get(`about/${id}`))));
      const last = ids.toSorted((a, b) => abouts[ids.indexOf(b)].changed - abouts[ids.indexOf(a)].changed)[0];
      if (last === undefined) return null;
      const { project, brought } = (await answered(work.get(`plate/${last}`))).plate;
      return { name: project.studio.name, printer: project.printer, brought };
    } finally {
      database.close();
    }
  }, `sillon-studio ${host}`.trim());

/** Waits until a function of the test gives something that is true. @param what  in words @returns that */
export async function until(condition, what = condition) {
  const end = Date.now() + patience;
  for (;;) {
    const found = await condition();
    if (found) return found;
    assert.ok(Date.now() < end, `never came: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Waits until the page has drawn what it knows: nothing that moves, and the same elements over three frames. */
export const settled = (page) =>
  page.evaluate(async () => {
    const count = (root) =>
      [...root.querySelectorAll('*')].reduce(
        (sum, { shadowRoot }) => sum + 1 + (shadowRoot ? count(shadowRoot) : 0),
        0,
      );
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    for (let same = 0, last = -1; same < 3;) {
      await frame();
      const now = document.getAnimations().some(({ playState }) => playState === 'running') ? -1 : count(document);
      same = now === last && now >= 0 ? same + 1 : 0;
      last = now;
    }
  });
