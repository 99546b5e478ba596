// Long work beside a page that goes on: a slice of it at a time.

const slice = 8; // [ms] half a frame

export interface Sliced<Result> {
  /** Does all that is left, at once. */
  finish(): Result;
  /** Nobody wants it any more. */
  stop(): void;
}

/** @param work  yields where it may be interrupted. Its first slice is done at once.
 * @param done  is told the result, before this returns where one slice was enough */
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
