// A short video of a canvas.
import { StudioError } from '../model/problem.js';

const types = ['video/mp4;codecs=avc1.42E01E', 'video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'];
const framesPerSecond = 30;
const bitsPerSecond = 12_000_000;

/** @param pose  called for each frame with the share of the time that has passed. */
export async function recordCanvas(
  canvas: HTMLCanvasElement,
  seconds: number,
  pose: (share: number) => void,
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
  const stopped = new Promise<void>((resolve, reject) => {
    recorder.addEventListener('stop', () => {
      resolve();
    });
    recorder.addEventListener('error', () => {
      reject(new StudioError('NoVideo'));
    });
  });
  recorder.start();
  await new Promise<void>((resolve) => {
    let begin = 0;
    const step = (now: number): void => {
      if (begin === 0) begin = now;
      const share = (now - begin) / (1000 * seconds);
      if (share >= 1) {
        resolve();
        return;
      }
      pose(share);
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  });
  recorder.stop();
  await stopped;
  for (const track of stream.getTracks()) track.stop();
  return new Blob(pieces, { type });
}
