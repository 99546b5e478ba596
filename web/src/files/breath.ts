// Splits long work on the page's thread into pieces, so that the page can draw and answer between them.

const longest = 16; // [ms] without a pause; larger: the page stutters; smaller: the work takes longer

/** Starts a piece of long work. @returns a function to await between pieces, which pauses when one has taken too
 * long */
export function breathing(): () => Promise<void> {
  let begin = performance.now();
  return async () => {
    if (performance.now() - begin < longest) return;
    await new Promise((resolve) => setTimeout(resolve, 0));
    begin = performance.now();
  };
}
