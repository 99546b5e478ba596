// A short video of a canvas.
import { problemOf, StudioError } from '../model/problem.js';
import type { Light } from '../model/view.js';
import type { Studio } from '../studio/studio.js';
import { between } from '../views/light.js';

const types = ['video/mp4;codecs=avc1.42E01E', 'video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'];
const framesPerSecond = 30;
const bitsPerSecond = 12_000_000;
const lookEvery = 1000; // [ms]
const mostLooks = 3; // one alone may come before the frame of a slow page

/** Resolves after so many seconds of frames. Browsers draw none in hidden tabs, nor in frames that are scrolled away.
 * @throws StudioError OutOfSight */
function play(seconds: number, pose: (share: number) => void, signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    signal.throwIfAborted();
    let begin: number | undefined;
    let waiting = 0;
    const end = (settle: () => void): void => {
      cancelAnimationFrame(next);
      clearInterval(watch);
      signal.removeEventListener('abort', abort);
      settle();
    };
    const step = (now: number): void => {
      waiting = 0;
      begin ??= now;
      const share = (now - begin) / (1000 * seconds);
      if (share >= 1) {
        end(resolve);
        return;
      }
      pose(share);
      next = requestAnimationFrame(step);
    };
    const abort = (): void => {
      end(() => {
        reject(signal.reason as Error);
      });
    };
    let next = requestAnimationFrame(step);
    const watch = setInterval(() => {
      if (++waiting < mostLooks) return;
      end(() => {
        reject(new StudioError('OutOfSight'));
      });
    }, lookEvery);
    signal.addEventListener('abort', abort);
  });
}

/** @param pose  called for each frame with the share of the time that has passed.
 * @throws StudioError NoVideo, OutOfSight; the signal's reason */
export async function recordCanvas(
  canvas: HTMLCanvasElement,
  seconds: number,
  pose: (share: number) => void,
  signal?: AbortSignal,
): Promise<Blob> {
  if (typeof MediaRecorder === 'undefined' || typeof canvas.captureStream !== 'function')
    throw new StudioError('NoVideo');
  const type = types.find((one) => MediaRecorder.isTypeSupported(one));
  if (type === undefined) throw new StudioError('NoVideo');
  const stream = canvas.captureStream(framesPerSecond);
  const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: bitsPerSecond });
  const pieces: Blob[] = [];
  recorder.addEventListener('dataavailable', ({ data }) => {
    pieces.push(data);
  });
  const failed = new AbortController();
  recorder.addEventListener('error', (event) => {
    failed.abort(new StudioError('NoVideo', {}, problemOf(event.error).detail));
  });
  const stopped = new Promise<void>((resolve) => {
    recorder.addEventListener('stop', () => {
      resolve();
    });
  });
  try {
    recorder.start();
    await play(seconds, pose, signal === undefined ? failed.signal : AbortSignal.any([signal, failed.signal]));
    if (recorder.state !== 'inactive') recorder.stop();
    await stopped;
  } finally {
    for (const track of stream.getTracks()) track.stop();
  }
  return new Blob(pieces, { type });
}

/** One turn of the light, or from one picture to the other and back. */
export async function recordTurn(
  studio: Studio,
  canvas: HTMLCanvasElement,
  seconds: number,
  signal?: AbortSignal,
): Promise<Blob> {
  const { store } = studio;
  const before = store.state.light;
  store.set({ recording: true, view: 'appearance' });
  try {
    const [first, second] = studio.lamps();
    const lightAt = (share: number): Light =>
      first !== undefined && second !== undefined
        ? between(first, second, (1 - Math.cos(2 * Math.PI * share)) / 2)
        : { ...before, azimuth: (before.azimuth + 360 * share) % 360 };
    const pose = (share: number): void => {
      store.set({ light: lightAt(share) });
    };
    return await recordCanvas(canvas, seconds, pose, signal);
  } finally {
    store.set({ recording: false, light: before });
  }
}
