// Maps the faces of a sliced print to its page: their outlines,
// the parts of them visible from above, and the new beads.
import type { Cycle, PrintRelief, Toolpath } from 'sillon';
import type { Face } from '../model/rebrush.js';
import { seenCycles, seenRuns, type IsSeen } from './seen-lines.js';

const above = 0.1; // [mm] height by which something above a face hides it

/** Part of the bed that is shown [mm]. */
export interface Page {
  /** Lower left corner, on the bed. */
  corner: readonly [number, number];
  size: [number, number];
}

export interface Outline {
  index: number;
  parts: { path: Path2D; rule: CanvasFillRule }[];
  /** Parts of the outline that the rest of the print does not hide. */
  seen: Path2D;
}

/** Returns the page around the relief or, without one, around the faces. */
export function pageOf(relief: PrintRelief | undefined, faces: readonly Face[]): Page {
  if (relief !== undefined) {
    return { corner: relief.corner, size: [relief.columns * relief.cell, relief.rows * relief.cell] };
  }
  if (faces.length === 0) return { corner: [0, 0], size: [1, 1] };
  const least = (k: 0 | 1): number => Math.min(...faces.map(({ corner }) => corner[k]));
  const most = (k: 0 | 1): number => Math.max(...faces.map(({ corner, region }) => corner[k] + region.page[k]));
  const corner = [least(0), least(1)] as const;
  return { corner, size: [most(0) - corner[0], most(1) - corner[1]] };
}

/** Adds an open line to a path. @param points  x0, y0, x1, ... */
export function addLine(path: Path2D, points: ArrayLike<number>): void {
  for (let k = 0; k + 1 < points.length; k += 2) {
    const [x, y] = [points[k] as number, points[k + 1] as number];
    if (k === 0) path.moveTo(x, y);
    else path.lineTo(x, y);
  }
}

/** Moves points from a face's own page to that of the print. */
function shifted<Points extends Float32Array | Float64Array>(points: Points, { corner }: Face, page: Page): Points {
  const [dx, dy] = [corner[0] - page.corner[0], corner[1] - page.corner[1]];
  return points.map((value, k) => value + (k % 2 === 0 ? dx : dy)) as Points;
}

/** Returns a test for places of this face: true if nothing of the print lies above. Bottoms show through the print. */
function seenFrom({ z, side }: Face, relief: PrintRelief | undefined): IsSeen {
  if (relief === undefined || side === 'bottom') return () => true;
  return (x, y) => {
    const [column, row] = [Math.floor(x / relief.cell), relief.rows - 1 - Math.floor(y / relief.cell)];
    if (column < 0 || row < 0 || column >= relief.columns || row >= relief.rows) return true;
    return (relief.heights[row * relief.columns + column] as number) < z + above;
  };
}

/** Returns outlines, the lowest first: upper faces are drawn later, and a click means the uppermost. */
export function outlinesOf(faces: readonly Face[], relief: PrintRelief | undefined, page: Page): Outline[] {
  return [...faces]
    .sort((a, b) => a.z - b.z || b.areaMm2 - a.areaMm2)
    .map((face) => {
      const seen = new Path2D();
      const isSeen = seenFrom(face, relief);
      const parts = face.region.paths.map(({ fillRule, rings }) => {
        const path = new Path2D();
        for (const ring of rings) {
          const points = shifted(ring, face, page);
          addLine(path, points);
          path.closePath();
          for (const run of seenRuns(points, isSeen)) addLine(seen, run);
        }
        return { path, rule: fillRule };
      });
      return { index: face.index, parts, seen };
    });
}

/** Returns the new beads of faces, the lowest first, without the parts under the rest of the print. */
export function joinedBeads(
  faces: readonly Face[],
  laid: ReadonlyMap<number, readonly Cycle[]>,
  relief: PrintRelief | undefined,
  page: Page,
): Toolpath | undefined {
  const step = 2 * (relief?.cell ?? 1);
  const cycles = [...faces]
    .sort((a, b) => a.z - b.z || b.areaMm2 - a.areaMm2)
    .flatMap((face) => {
      const isSeen = seenFrom(face, relief);
      return (laid.get(face.index) ?? []).flatMap(({ points, widths }) =>
        seenCycles({ points: shifted(points, face, page), widths }, step, isSeen),
      );
    });
  if (cycles.length === 0) return undefined;
  return { spacing: faces[0]?.spacing ?? 0.4, cycles, shape: { page: page.size, paths: [] }, notes: [] };
}
