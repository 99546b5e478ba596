// What the worker of directions does with requests: it keeps pictures, the source's raster and the last replay.
import type { Picture } from 'sillon';
import type { Stroke } from '../model/plate.js';
import { problemOf } from '../model/problem.js';
import { qrPicture } from './qr.js';
import { rasteriseSource, type Pictures } from './rasterise.js';
import type { DirectionRaster } from '../model/raster.js';
import { fileOf, filesOf, type Reply, type Request } from './request.js';
import { replayed, type Replay } from './strokes.js';
import { drawText } from './text.js';
import { sizeFor } from './texels.js';

/** @param draw  the letters of a text */
export function createServer(draw: typeof drawText): (request: Request) => Promise<Reply> {
  let pictures = new Map<string, Picture>();
  let strokes: Stroke[] = [];
  let sourceKey = '';
  let sourceRaster: DirectionRaster | undefined;
  let replay: Replay | undefined;

  const picturesFor = async ({ source, modes, page, resolution, round, room }: Request): Promise<Pictures> => {
    const named = (id: string | undefined): Picture | undefined => (id === undefined ? undefined : pictures.get(id));
    const shown: Pictures = {};
    const ofModes = named(fileOf(modes));
    if (ofModes !== undefined) shown.modes = ofModes;
    const ofSource =
      source.kind === 'text'
        ? draw(source, sizeFor(page, resolution), round, room)
        : source.kind === 'qr'
          ? await qrPicture(source.text)
          : named(fileOf(source));
    if (ofSource !== undefined) shown.source = ofSource;
    return shown;
  };

  return async (request) => {
    try {
      const { source, modes, page, resolution, round, room } = request;
      const known = new Map([...pictures, ...request.pictures]);
      pictures = new Map(
        filesOf(source, modes).flatMap((id) => {
          const picture = known.get(id);
          return picture === undefined ? [] : [[id, picture]];
        }),
      );
      strokes = [...strokes.slice(0, request.keptStrokes), ...request.newStrokes];
      const key = JSON.stringify([source, modes, page, resolution, round, room?.key]);
      if (sourceRaster === undefined || key !== sourceKey) {
        sourceRaster = undefined;
        sourceRaster = rasteriseSource(source, modes, page, resolution, await picturesFor(request), round, room);
        sourceKey = key;
      }
      const done = replayed(replay, sourceRaster, strokes, page);
      replay = done.replay;
      return { raster: done.raster };
    } catch (error) {
      return { problem: problemOf(error) };
    }
  };
}
