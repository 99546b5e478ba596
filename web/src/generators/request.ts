// What the page asks of the worker of directions, and which files that takes.
import type { Picture } from 'sillon';
import type { DirectionSource, ModeSource, Stroke } from '../model/plate.js';
import type { Problem } from '../model/problem.js';
import type { DirectionRaster } from '../model/raster.js';
import type { Room } from './room.js';
import type { Page } from './texels.js';

export interface Request {
  source: DirectionSource;
  modes: ModeSource;
  page: Page;
  /** The shape is the ellipse of the page: codes and letters stay within. */
  round: boolean;
  /** Of any other shape that is not its page. */
  room?: Room | undefined;
  resolution: number;
  /** How many of the last request's strokes stay, and what follows them. */
  keptStrokes: number;
  newStrokes: readonly Stroke[];
  /** Decoded files by id, as far as the last request did not bring them. */
  pictures: ReadonlyMap<string, Picture>;
}

export type Reply = { raster: DirectionRaster } | { problem: Problem };

export const fileOf = (source: DirectionSource | ModeSource): string | undefined =>
  'file' in source ? source.file?.id : undefined;

/** Ids of the files that a raster is made from. */
export const filesOf = (source: DirectionSource, modes: ModeSource): string[] =>
  [fileOf(source), fileOf(modes)].filter((id) => id !== undefined);
