// Lays out the points of a path for the renderer's shaders, in slices, so that a long path does not block the page.
import type { Toolpath } from 'sillon';
import { pointsToDraw } from './thinned.js';

/** Floats per point, which is one texel: x, y, width, share
 * of the print. Segments read their neighbours' points, too. */
const stride = 4;

/** Texels per row of points; every WebGL2 supports this width. */
export const columns = 2048;

/** Consecutive segments and the box around them [mm]; runs off the screen are not drawn. */
interface Run {
  first: number;
  segments: number;
  box: [number, number, number, number];
}

export interface BeadData {
  rows: number;
  points: Float32Array;
  /** Two values per point: the delay of its neighbours, and its lean; a single pair if they are not shown. */
  delays: Float32Array;
  runs: Run[];
}

/** Segments per run, which is one draw call. */
export const segmentsPerRun = 4096;

/** Points per slice: some milliseconds on a slow machine. */
const pointsPerSlice = 8192;

/** Thins and lays out the points of all cycles; yields after each slice.
 * @param tolerance  see pointsToDraw
 * @param delays  see `Delayed`; left out: they are not shown */
export function* beadData(
  { cycles }: Pick<Toolpath, 'cycles'>,
  tolerance: number,
  delays?: readonly Float32Array[],
): Generator<undefined, BeadData> {
  const drawn: Uint32Array[] = [];
  for (const { points, widths } of cycles) {
    const kept: Uint32Array[] = [];
    for (let begin = 0; begin < widths.length; begin += pointsPerSlice) {
      kept.push(pointsToDraw(points, widths, tolerance, begin, Math.min(begin + pointsPerSlice, widths.length)));
      yield;
    }
    const all = new Uint32Array(kept.reduce((sum, { length }) => sum + length, 0));
    let at = 0;
    for (const part of kept) {
      all.set(part, at);
      at += part.length;
    }
    drawn.push(all);
  }
  const total = drawn.reduce((sum, { length }) => sum + length + 3, 0);
  const rows = Math.ceil(total / columns);
  const data = new Float32Array(rows * columns * stride);
  const late = new Float32Array(delays === undefined ? 2 : 2 * rows * columns);
  const all = cycles.reduce((sum, { widths }) => sum + widths.length, 0);
  const runs: Run[] = [];
  let at = 0;
  let done = 0;
  for (const [cycle, { points, widths }] of cycles.entries()) {
    const kept = drawn[cycle] ?? new Uint32Array();
    const count = kept.length;
    const start = at;
    // One extra point before the first and two after the last give every segment its neighbours.
    for (let k = -1; k < count + 2; ++k, ++at) {
      const from = kept[(k + count) % count] ?? 0;
      data[at * stride] = points[2 * from] ?? 0;
      data[at * stride + 1] = points[2 * from + 1] ?? 0;
      data[at * stride + 2] = widths[from] ?? 0;
      data[at * stride + 3] = (done + (k < count ? from : widths.length)) / all;
      if (delays !== undefined) late.set(delays[cycle]?.subarray(2 * from, 2 * from + 2) ?? [], 2 * at);
      if (k % pointsPerSlice === pointsPerSlice - 1) yield;
    }
    data[start * stride + 3] = done / all;
    for (let first = start; first < start + count; first += segmentsPerRun) {
      const segments = Math.min(segmentsPerRun, start + count - first);
      runs.push({ first, segments, box: boxOf(data, first + 1, segments + 1) });
    }
    done += widths.length;
  }
  return { rows, points: data, delays: late, runs };
}

/** Returns the box around some points and their beads [mm]. @param data  points as shaders read them */
function boxOf(data: Float32Array, first: number, count: number): Run['box'] {
  const box: Run['box'] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let at = first * stride; at < (first + count) * stride; at += stride) {
    const [x, y, radius] = [data[at] ?? 0, data[at + 1] ?? 0, (data[at + 2] ?? 0) / 2];
    box[0] = Math.min(box[0], x - radius);
    box[1] = Math.min(box[1], y - radius);
    box[2] = Math.max(box[2], x + radius);
    box[3] = Math.max(box[3], y + radius);
  }
  return box;
}
