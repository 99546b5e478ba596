// How long a page's own thread is held, in CPU time: what else works on the machine lengthens clocks, but not this.

/**
 * @param browser  Playwright's
 * @param work  asynchronous
 * @returns the longest task of pages' main threads while `work` goes on [ms of CPU time]
 */
export async function longestTask(browser, page, work) {
  await browser.startTracing(page, { categories: ['-*', 'disabled-by-default-devtools.timeline'] });
  let trace;
  try {
    await work();
  } finally {
    trace = await browser.stopTracing();
  }
  const { traceEvents } = JSON.parse(trace);
  const thread = ({ pid, tid }) => `${pid} ${tid}`;
  const pages = traceEvents.filter(({ name, args }) => name === 'thread_name' && args.name === 'CrRendererMain');
  const mains = new Set(pages.map(thread));
  const tasks = traceEvents.filter((event) => event.name === 'RunTask' && mains.has(thread(event)));
  return Math.max(...tasks.map(({ tdur = 0 }) => tdur / 1000)); // none: of one that goes on at the end
}

/** Holds the page's thread, so that it is seen whether that is seen: even a quarter of a core does 130 ms in it. */
export const holdThread = (page) =>
  page.evaluate(
    () =>
      new Promise((resolve) => {
        setTimeout(() => {
          for (const end = performance.now() + 2000; performance.now() < end;);
          resolve();
        });
      }),
  );
