// Long work on the page's thread, in pieces: between them the page may draw and answer.

const longest = 16; // [ms] without a pause

/** @returns a function to be awaited between pieces. */
export function breathing(): () => Promise<void> {
  let begin = performance.now();
  return async () => {
    if (performance.now() - begin < longest) return;
    await new Promise((resolve) => setTimeout(resolve, 0));
    begin = performance.now();
  };
}
