// The hooks of a file of browser tests: one bench (browser, servers) for all of them, and what a test has opened is closed
// after it, or left to the next test.
import { after, afterEach, before } from 'node:test';

/**
 * @param skip  of the tests: nothing is started then
 * @param start  gives the bench; what its `open` gives has a `context`
 * @returns the bench, from the first test on
 */
export function sharedBench(skip, start) {
  const shared = {};
  const opened = [];
  let bench;
  before(async () => {
    if (skip) return;
    bench = await start();
    Object.assign(shared, bench, {
      async open(options) {
        const visit = await bench.open(options);
        opened.push(visit);
        return visit;
      },
      /** Pages that another test has opened are this test’s now. */
      take(visit) {
        opened.push(visit);
        return visit;
      },
    });
  });
  after(() => bench?.close());
  afterEach(async ({ passed }) => {
    for (const visit of opened.splice(0)) await (bench.leave?.(visit, passed) ?? visit.context.close());
  });
  return shared;
}
