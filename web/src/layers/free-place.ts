// Finds a free place on a plate for a box among the boxes that are there.
import type { FreePlace, Taken, Wanted } from '../model/free-place.js';
import { boundsOf, contains, type Point } from '../model/layer-frame.js';
import { pageOf, type Plate } from '../model/plate.js';
import { adder, placeIn, type Room } from './room.js';
import { sizeFor } from '../model/raster.js';

const cutOff = 4; // cost of a texel outside the shape, in texels of another box that is covered

/** The inside of the shape without a strip along its edges. @param reach  width of the strip in texels */
function without(room: Room, reach: number): Uint8Array {
  const { width, height, inside } = room;
  if (reach <= 0) return inside;
  const sum = adder(inside, room);
  const side = 2 * reach + 1;
  return inside.map((_, k) => {
    const [column, row] = [(k % width) - reach, Math.floor(k / width) - reach];
    const there = column >= 0 && row >= 0 && column + side <= width && row + side <= height;
    return there && sum(column, row, side, side) === side * side ? 1 : 0;
  });
}

/** Finds the free place nearest to the page's middle, the lower of two equal ones. The box is reduced as far as needed.
 * If even the smallest size does not fit, the place is chosen where the least of it is cut off or covers other boxes.
 * @param page [mm] */
export function freePlace(room: Room, page: Point, taken: readonly Taken[], wanted: Wanted): FreePlace {
  const { width, height } = room;
  const { size, gap, edge, least } = wanted;
  const texel = page[0] / width;
  const inside = without(room, Math.ceil(edge / texel));
  // Rows count from below, like places on the page, so that the lower of two equal places comes first.
  const cost = new Uint8Array(width * height);
  for (let row = 0; row < height; ++row) {
    for (let column = 0; column < width; ++column) {
      if (inside[(height - 1 - row) * width + column] === 0) cost[row * width + column] = cutOff;
    }
  }
  for (const frame of taken) {
    const { low, high } = boundsOf(frame);
    const [left, right] = [low[0], high[0]].map((x) => Math.round(x / texel)) as [number, number];
    const [bottom, top] = [low[1], high[1]].map((y) => Math.round((y * height) / page[1])) as [number, number];
    for (let row = Math.max(0, bottom - 1); row < Math.min(height, top + 1); ++row) {
      for (let column = Math.max(0, left - 1); column < Math.min(width, right + 1); ++column) {
        const place: Point = [(column + 0.5) * texel, ((row + 0.5) * page[1]) / height];
        const away = Math.hypot(place[0] - frame.middle[0], place[1] - frame.middle[1]);
        if (away >= frame.free && contains(frame, place)) ++(cost[row * width + column] as number);
      }
    }
  }
  const free = cost.map((value) => (value === 0 ? 1 : 0));
  const [wide, tall] = [(size[0] + 2 * gap) / page[0], (size[1] + 2 * gap) / page[1]];
  const found = placeIn(wide, tall, { ...room, inside: free });
  const middle = (x: number, y: number): Point => [x * page[0], y * page[1]];
  const fits = free[Math.floor(found.y * height) * width + Math.floor(found.x * width)] === 1;
  if (fits && found.scale >= least) return { middle: middle(found.x, found.y), scale: found.scale };

  const columns = Math.min(width, Math.ceil((least * size[0]) / texel));
  const rows = Math.min(height, Math.ceil((least * size[1] * height) / page[1]));
  const sum = adder(cost, room);
  let best: FreePlace = { middle: middle(0.5, 0.5), scale: least };
  let fewest = Infinity;
  let nearest = Infinity;
  for (let row = 0; row + rows <= height; ++row) {
    for (let column = 0; column + columns <= width; ++column) {
      const bad = sum(column, row, columns, rows);
      if (bad > fewest) continue;
      const [x, y] = [(column + columns / 2) / width, (row + rows / 2) / height];
      const away = Math.hypot(x - 0.5, ((y - 0.5) * height) / width);
      if (bad === fewest && away >= nearest) continue;
      [fewest, nearest] = [bad, away];
      best = { middle: middle(x, y), scale: least };
    }
  }
  return best;
}

const patience = 1000; // [ms] to wait for the shape, since the engine may be busy with a plate
const roughSide = 160;

/** A guess at the shape's room: the whole page for shapes that are as wide everywhere, otherwise the ellipse in it. */
function roughRoom(plate: Plate): Room {
  const size = sizeFor(pageOf(plate), roughSide);
  const { width, height } = size;
  const whole = ['rectangle', 'rounded', 'tag'].includes(plate.shape.kind);
  const inside = Uint8Array.from({ length: width * height }, (_, k) => {
    const [x, y] = [((k % width) + 0.5) / width - 0.5, (Math.floor(k / width) + 0.5) / height - 0.5];
    return whole || Math.hypot(x, y) < 0.5 ? 1 : 0;
  });
  return { ...size, key: 0, inside };
}

/** Finds a free place on the plate. @param room  the shape's room; guessed where it fails or takes too long */
export async function freePlaceOn(
  plate: Plate,
  room: Promise<Room>,
  taken: readonly Taken[],
  wanted: Wanted,
): Promise<FreePlace> {
  const late = new Promise<undefined>((resolve) => setTimeout(resolve, patience));
  const found = await Promise.race([room.catch(() => undefined), late]);
  return freePlace(found ?? roughRoom(plate), pageOf(plate), taken, wanted);
}
