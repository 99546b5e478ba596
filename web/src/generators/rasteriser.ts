// The page's side of the worker of directions. One request runs and at most one waits: the newest.
import type { Picture } from 'sillon';
import type { DirectionSource, ModeSource, SourceFile, Stroke } from '../model/plate.js';
import { StudioError } from '../model/problem.js';
import type { DirectionRaster } from '../model/raster.js';
import { filesOf, type Reply, type Request } from './request.js';
import type { Room } from './room.js';
import type { Page } from './texels.js';

export interface Wanted {
  source: DirectionSource;
  modes: ModeSource;
  strokes: readonly Stroke[];
  page: Page;
  /** The shape is the ellipse of the page. */
  round?: boolean;
  /** Of any other shape that is not its page, for codes and letters. */
  room?: Room | undefined;
  /** Texels of the longer side; see rasterise.ts for the usual ones. */
  resolution: number;
}

export interface Rasteriser {
  /** @returns undefined where a later call came before this one was begun.
   * @throws StudioError, and what decoding throws */
  rasterise(wanted: Wanted): Promise<DirectionRaster | undefined>;
}

interface Call {
  wanted: Wanted;
  resolve: (raster: DirectionRaster | undefined) => void;
  reject: (error: unknown) => void;
}

/** @param decode  the engine's decodePicture; each file is decoded once while it is in use.
 * @param start  starts directions.worker.ts */
export function createRasteriser(decode: (file: SourceFile) => Promise<Picture>, start: () => Worker): Rasteriser {
  let worker: Worker | undefined;
  let running: Call | undefined;
  let waiting: Call | undefined;
  // What the worker has.
  let files: string[] = [];
  let strokes: readonly Stroke[] = [];

  const end = (): void => {
    worker?.terminate();
    worker = undefined;
    files = [];
    strokes = [];
  };

  const ask = (request: Request): Promise<Reply> =>
    new Promise((resolve, reject) => {
      worker ??= start();
      worker.onmessage = (event: MessageEvent<Reply>) => {
        resolve(event.data);
      };
      worker.onerror = (event) => {
        end(); // the next call starts another
        reject(new StudioError('Crashed', {}, event.message));
      };
      const transfer = Array.from(request.pictures.values(), ({ samples }) => samples.buffer);
      worker.postMessage(request, transfer);
    });

  const requestFor = async ({
    source,
    modes,
    strokes: wantedStrokes,
    page,
    resolution,
    round = false,
    room,
  }: Wanted): Promise<Request> => {
    const pictures = new Map<string, Picture>();
    for (const one of [source, modes]) {
      const file = 'file' in one ? one.file : undefined;
      if (file === undefined || files.includes(file.id) || pictures.has(file.id)) continue;
      const picture = await decode(file);
      pictures.set(file.id, picture);
    }
    let keptStrokes = 0;
    while (keptStrokes < wantedStrokes.length && wantedStrokes[keptStrokes] === strokes[keptStrokes]) ++keptStrokes;
    return {
      source,
      modes,
      page,
      resolution,
      round,
      room,
      keptStrokes,
      newStrokes: wantedStrokes.slice(keptStrokes),
      pictures,
    };
  };

  const run = async ({ wanted, resolve, reject }: Call): Promise<void> => {
    try {
      const request = await requestFor(wanted);
      const asked = ask(request);
      files = filesOf(wanted.source, wanted.modes);
      strokes = wanted.strokes;
      const reply = await asked;
      if ('problem' in reply) {
        const { code, values, detail } = reply.problem;
        reject(new StudioError(code, values, detail));
      } else {
        resolve(reply.raster);
      }
    } catch (error) {
      reject(error);
    }
  };

  const next = (): void => {
    const call = waiting;
    if (running !== undefined || call === undefined) return;
    waiting = undefined;
    running = call;
    void run(call).finally(() => {
      running = undefined;
      next();
    });
  };

  return {
    rasterise: (wanted) =>
      new Promise((resolve, reject) => {
        waiting?.resolve(undefined);
        waiting = undefined;
        waiting = { wanted, resolve, reject };
        next();
      }),
  };
}
