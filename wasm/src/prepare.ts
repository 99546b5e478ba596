// Prepares an upload for a shop in one call that is limited in time and memory.
import type * as api from '../sillon.js';
import { SillonError } from './errors.js';
import * as input from './input.js';

/** Rejects with the signal's reason, whatever the work is waiting for. */
function until<T>(work: Promise<T>, signal: AbortSignal): Promise<T> {
  return new Promise((resolve, reject) => {
    const stop = (): void => {
      // eslint-disable-next-line @typescript-eslint/prefer-promise-reject-errors -- a signal's reason may be anything
      reject(signal.reason);
    };
    if (signal.aborted) stop();
    signal.addEventListener('abort', stop);
    void work.then(resolve, reject).finally(() => {
      signal.removeEventListener('abort', stop);
    });
  });
}

/** Returns the poster's width. @param side  longer side of the poster [pixels] */
const widthOf = ([width, height]: [number, number], side: number): number =>
  Math.max(16, Math.round(width >= height ? side : (side * width) / height));

export async function prepare(
  createEngine: typeof api.createEngine,
  upload: api.PlateInput,
  options: api.PrepareOptions | undefined,
): Promise<api.PreparedPlate> {
  const {
    plate,
    toolpath: params,
    printer,
    print,
    filament,
    posterSide,
    signal,
    seconds,
    engine: start,
  } = input.prepareOptions(upload, options);
  const stop = new AbortController();
  const forward = (): void => {
    stop.abort(signal?.reason);
  };
  if (signal?.aborted === true) forward();
  signal?.addEventListener('abort', forward);
  const timer = setTimeout(() => {
    stop.abort(new SillonError('TooLarge', `the plate took more than ${seconds} s`));
  }, 1000 * seconds);
  const run = { signal: stop.signal };
  const starting = createEngine(start);
  try {
    const engine = await until(starting, stop.signal);
    const { toolpath, report } = await engine.generateToolpath(plate, params, run);
    const { page } = toolpath.shape;
    const { blob: gcode, summary } = await engine.writeGcode(toolpath, printer, print, run);
    const { findings } = await engine.checkGcode(gcode, printer, run);
    const view = await engine.writeView(toolpath, filament, run);
    const { colour, slopes } = filament;
    const look = { panels: 'look', width: widthOf(page, posterSide), colour, slopes } as const;
    const poster = await engine.renderPreview(toolpath, look, run);
    const { filamentGrams: grams, seconds: printing } = summary;
    return { poster, view, gcode, findings, grams, minutes: printing / 60, page, summary, report };
  } finally {
    clearTimeout(timer);
    signal?.removeEventListener('abort', forward);
    starting.then(
      (engine) => {
        engine.dispose();
      },
      () => undefined,
    );
  }
}
