// A stopwatch on the first print: what somebody with a printer and no idea clicks, reads and waits for, from the address of
// the studio to a file; and the same for templates of the examples that become somebody's own. Prints; asserts nothing.
//   ./dev bench first
import { start } from './test/browser/support/studio.js';
import { composingTasks, walkToComposed } from './test/browser/support/compose-walk.js';
import { walkToFirstPrint } from './test/browser/support/first-walk.js';

const wordsPerMinute = 150; // read with care; adults read 200 to 250 in a language of their own
const secondsPerClick = 4; // to find what is to be clicked, and to click it

/** Runs in the page: words that are seen within an element, and within the shadow roots in it. */
function visibleWords(element) {
  const textOf = (node) => {
    if (node.nodeType === Node.TEXT_NODE) return node.parentElement?.checkVisibility() === false ? '' : node.data;
    if (node.nodeType === Node.ELEMENT_NODE && (!node.checkVisibility() || /^(SCRIPT|STYLE)$/.test(node.tagName)))
      return '';
    return [...(node.shadowRoot ?? node).childNodes, ...(node.assignedNodes?.() ?? [])].map(textOf).join(' ');
  };
  return textOf(element)
    .split(/\s+/)
    .filter((word) => /\p{L}/u.test(word)).length;
}

const bench = await start();
console.log('first print   clicks   words to read   waited [s]   in all, reading and clicking included [min]');
for (const first of ['coupon', 'coaster']) {
  let words = 0;
  const read = async (place) => {
    words += await place.evaluate(visibleWords);
  };
  const begun = performance.now();
  const visit = await bench.open();
  const { clicks } = await walkToFirstPrint(visit, first, read);
  const waited = (performance.now() - begun) / 1000;
  const minutes = words / wordsPerMinute + (clicks * secondsPerClick + waited) / 60;
  console.log(
    `${first.padEnd(11)} ${String(clicks).padStart(8)} ${String(words).padStart(15)} ${waited.toFixed(1).padStart(12)} ${minutes.toFixed(1).padStart(10)}`,
  );
  await visit.close();
}

console.log('\ncomposing     clicks   fields   keys   files   from the address to the file [s]');
for (const task of composingTasks) {
  const begun = performance.now();
  const visit = await bench.open({ fresh: true });
  const { clicks, fields, keys, files, download } = await walkToComposed(visit, task);
  await download.path();
  const waited = (performance.now() - begun) / 1000;
  const counts = [clicks, fields, keys, files].map((count, k) => String(count).padStart([6, 8, 6, 7][k])).join(' ');
  console.log(`${task.padEnd(13)} ${counts} ${waited.toFixed(1).padStart(10)}`);
  await visit.close();
}
await bench.close();
