// Does long work on the page's thread, a slice at a time, so that the page stays responsive.

const slice = 8; // [ms] half a frame at 60 Hz

export interface Sliced<Result> {
  /** Does all the remaining work at once. */
  finish(): Result;
  /** Stops the work: its result is no longer wanted. */
  stop(): void;
}

/** Runs work in slices; the first slice runs before the call returns.
 * @param work  yields at each place where it may be interrupted
 * @param done  receives the result; it is called before the return if one slice was enough */
export function inSlices<Result>(work: Generator<undefined, Result>, done: (result: Result) => void): Sliced<Result> {
  let made: { result: Result } | undefined;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const goOn = (span: number): void => {
    const end = performance.now() + span;
    while (made === undefined) {
      const next = work.next();
      if (next.done === true) {
        made = { result: next.value };
        done(next.value);
      } else if (performance.now() >= end) {
        timer = setTimeout(goOn, 0, slice);
        return;
      }
    }
  };
  goOn(slice);
  return {
    finish() {
      clearTimeout(timer);
      if (made === undefined) goOn(Infinity);
      return (made as unknown as { result: Result }).result;
    },
    stop() {
      clearTimeout(timer);
    },
  };
}
