// Sources and strokes to a raster. Pictures come decoded; nothing here waits or draws.
import type { Picture } from 'sillon';
import type { DirectionSource, ModeSource, Stroke } from '../model/plate.js';
import { storeDegrees } from './angle.js';
import { coloursAngles } from './colours.js';
import { edgesAngles } from './edges.js';
import { levelsAngles } from './levels.js';
import { mapAngles, mapSize } from './map.js';
import { modesOn } from './modes.js';
import { noiseAngles } from './noise.js';
import { qrAngles } from './qr.js';
import { radialAngles } from './radial.js';
import type { DirectionRaster } from '../model/raster.js';
import type { Room } from './room.js';
import { spiralAngles } from './spiral.js';
import { withStrokes } from './strokes.js';
import { textAngles } from './text.js';
import { sizeFor, type Page, type Size } from './texels.js';
import { toneAngles } from './tone.js';
import { wavesAngles } from './waves.js';

export interface Pictures {
  /** The source's file decoded, the letters of a text, or the modules of a QR code. */
  source?: Picture;
  modes?: Picture;
}

function anglesOfSource(
  source: DirectionSource,
  size: Size,
  page: Page,
  picture: Picture | undefined,
  round: boolean,
  room: Room | undefined,
): Uint16Array {
  const shown = (): Picture => {
    if (picture === undefined) throw new Error(`directions of kind "${source.kind}" need a picture`);
    return picture;
  };
  switch (source.kind) {
    case 'lamp': // the engine solves for it
      return new Uint16Array(size.width * size.height).fill(storeDegrees(0));
    case 'angle':
      return new Uint16Array(size.width * size.height).fill(storeDegrees(source.angle));
    case 'map':
      return mapAngles(source.encoding, size, shown());
    case 'tone':
      return toneAngles(source, size, shown());
    case 'edges':
      return edgesAngles(source, size, page, shown());
    case 'levels':
      return levelsAngles(source, size, shown());
    case 'colours':
      return coloursAngles(source, size, shown());
    case 'text':
      return textAngles(source, size, shown());
    case 'qr':
      return qrAngles(source, size, page, shown(), round, room);
    case 'radial':
      return radialAngles(source, size, page);
    case 'spiral':
      return spiralAngles(source, size, page);
    case 'waves':
      return wavesAngles(source, size, page);
    case 'noise':
      return noiseAngles(source, size, page);
  }
}

/** What strokes are laid over, and what the eraser brings back. @param round  the shape is the ellipse of the page
 * @param room  of any other shape that is not its page */
export function rasteriseSource(
  source: DirectionSource,
  modes: ModeSource,
  page: Page,
  resolution: number,
  pictures: Pictures,
  round = false,
  room?: Room,
): DirectionRaster {
  const own = source.kind === 'map' ? pictures.source : undefined;
  const { width, height } = own === undefined ? sizeFor(page, resolution) : mapSize(own, page, resolution);
  const size = { width, height };
  const angle = anglesOfSource(source, size, page, pictures.source, round, room);
  return { ...size, angle, mode: modesOn(modes.mode, size, pictures.modes) };
}

/** @param resolution  texels of the longer side */
export function rasterise(
  source: DirectionSource,
  modes: ModeSource,
  strokes: readonly Stroke[],
  page: Page,
  resolution: number,
  pictures: Pictures,
): DirectionRaster {
  return withStrokes(rasteriseSource(source, modes, page, resolution, pictures), strokes, page);
}
