// Jobs for the engine, small and large, and what can be seen of the threads it works with.

/** Milliseconds of work. */
export const small = [{ shape: { builtin: 'disc', size: [10, 10] } }, {}, { measure: false }];

/** Many seconds of work. */
export const large = [
  { shape: { builtin: 'rounded', size: [150, 150] }, layers: [{ kind: 'direction', angle: 30 }] },
  { spacing: 0.16 },
];

/** More work than anybody waits for: what is answered after it, by the same worker, shows that it has ended. */
export const endless = [large[0], { ...large[1], sweepsPerLevel: 1000 }];

/** A picture whose directions turn from left to right. */
export function turning(width, height, Samples = Uint8Array, scale = 1) {
  const samples = Samples.from({ length: width * height }, (_, k) => Math.round(((k % width) * 255) / width) * scale);
  return { width, height, channels: 1, samples };
}

export const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Resolves at the first call of `resolve` by a job's progress, so that the job is known to run. */
export function atWork() {
  let onProgress;
  const running = new Promise((resolve) => {
    onProgress = ({ fraction }) => fraction > 0 && resolve();
  });
  return { running, onProgress };
}

/** Counts the workers that this thread starts, and those that have ended. */
export function countWorkers() {
  const count = { started: 0, ended: 0 };
  const onWorker = (worker) => {
    ++count.started;
    worker.on('exit', () => ++count.ended);
  };
  process.on('worker', onWorker);
  return { count, stop: () => process.off('worker', onWorker) };
}

/** Waits for what must come soon; the test's own time limit is the only clock. */
export async function until(condition) {
  while (!condition()) await wait(5);
}

/** Every ArrayBuffer in plain data. */
export function buffersIn(value) {
  if (ArrayBuffer.isView(value)) return [value.buffer];
  if (typeof value !== 'object' || value === null) return [];
  return Object.values(value).flatMap(buffersIn);
}
