// Rasterises the inside of a plate's shape, for codes and letters that must not be cut off.
import type { Engine } from 'sillon';
import { shapeInput } from '../model/input.js';
import type { Plate } from '../model/plate.js';
import type { Room } from './room.js';
import { sizeFor } from '../model/raster.js';

const longest = 320; // texels of the longer side; the size of a box of letters is then exact to a third of a percent

let last: { shape: Plate['shape']; width: number; height: number; room: Room } | undefined;
let key = 0;

/** The room inside a plate's shape; the last one is kept. @throws errors of reading the shape */
export async function shapeRoom(plate: Plate, engine: Engine): Promise<Room> {
  const { shape, width, height } = plate;
  if (last?.shape === shape && last.width === width && last.height === height) return last.room;
  const { page, paths } = await engine.readShape(shapeInput(plate, ({ bytes }) => bytes));
  const size = sizeFor(page, longest);
  const context = new OffscreenCanvas(size.width, size.height).getContext('2d', { willReadFrequently: true });
  if (context === null) throw new Error('this browser has no canvas to draw shapes on');
  context.setTransform(size.width / page[0], 0, 0, -size.height / page[1], 0, size.height);
  for (const { fillRule, rings } of paths) {
    const path = new Path2D();
    for (const ring of rings) {
      for (let k = 0; k + 1 < ring.length; k += 2) path.lineTo(ring[k] as number, ring[k + 1] as number);
      path.closePath();
    }
    context.fill(path, fillRule);
  }
  const { data } = context.getImageData(0, 0, size.width, size.height);
  const inside = Uint8Array.from({ length: size.width * size.height }, (_, k) =>
    (data[4 * k + 3] as number) > 250 ? 1 : 0,
  );
  const room = { ...size, key: ++key, inside };
  last = { shape, width, height, room };
  return room;
}
