// Cuts closed lines to the parts visible from above, where something may lie over them.
import type { Cycle } from 'sillon';

export type IsSeen = (x: number, y: number) => boolean;

/** Returns the visible stretches of a closed line; a fully visible
 * one ends at its beginning. @param points  x0, y0, x1, ... */
export function seenRuns(points: ArrayLike<number>, isSeen: IsSeen): number[][] {
  const runs: number[][] = [];
  let run: number[] = [];
  for (let k = 0; k <= points.length; k += 2) {
    const [x, y] = [points[k % points.length] as number, points[(k + 1) % points.length] as number];
    if (isSeen(x, y)) run.push(x, y);
    else if (run.length > 0) {
      runs.push(run);
      run = [];
    }
  }
  return run.length > 0 ? [...runs, run] : runs;
}

type Place = [x: number, y: number, width: number];

/** Closes a line by going there and back: the renderer draws closed lines only. @param line  x0, y0, width0, x1, ... */
function thereAndBack(line: readonly number[]): Cycle {
  const count = line.length / 3;
  const places = Array.from({ length: Math.max(1, 2 * count - 2) }, (_, k) => 3 * (k < count ? k : 2 * count - 2 - k));
  return {
    points: Float32Array.from(places.flatMap((k) => line.slice(k, k + 2))),
    widths: Float32Array.from(places, (k) => line[k + 2] as number),
  };
}

/** Returns the visible stretches of a cycle, each as a cycle; a fully visible cycle is returned as it is.
 * @param step  distance between tested places: the cycle may pass under something between two points */
export function seenCycles({ points, widths }: Cycle, step: number, isSeen: IsSeen): Cycle[] {
  const runs: number[][] = [];
  let run: number[] = [];
  let hidden = 0;
  let last: Place = [0, 0, 0];
  /** Takes the next place. @param stays  the place is a point of the line, not a test between two points */
  const pass = (place: Place, stays: boolean): void => {
    if (isSeen(place[0], place[1])) {
      if (stays || run.length === 0) run.push(...place);
    } else {
      ++hidden;
      if (run.length > 0) runs.push([...run, ...last]);
      run = [];
    }
    last = place;
  };
  const at = (k: number): Place => {
    const from = k % widths.length;
    return [points[2 * from] as number, points[2 * from + 1] as number, widths[from] as number];
  };
  for (let k = 0; k < widths.length; ++k) {
    const [from, to] = [at(k), at(k + 1)];
    const pieces = Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / step);
    pass(from, true);
    for (let piece = 1; piece < pieces; ++piece) {
      const share = piece / pieces;
      pass(from.map((value, n) => value + share * ((to[n] as number) - value)) as Place, false);
    }
  }
  if (hidden === 0) return [{ points, widths }];
  if (run.length > 0) runs.push(run);
  return runs.map(thereAndBack);
}
