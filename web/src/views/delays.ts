// Delays between neighbouring beads, and the sides to which they lean.
import type { PrinterValues, Toolpath } from 'sillon';
import { evenSpeed, neighbours } from '../model/facts.js';

/** Sides on which a bead is laid against earlier beads: it leans on them, or is squeezed between them. */
export const leans = { onNone: 0, toTheLeft: 1, toTheRight: -1, squeezed: 2 } as const;

/** A toolpath in short pieces, with the delay of each [s] and its lean, alternately. */
export interface Delayed {
  toolpath: Toolpath;
  /** One array per cycle, two values per point: delay and lean of the piece that begins there. */
  delays: Float32Array[];
}

/** Tells whether the last pressure-advance command of a block
 * sets more than 0, as `setsPressureAdvance` of the core does. */
function setsPressureAdvance(block: string): boolean {
  const commands = block.matchAll(
    /^[ \t]*(?:M900[^;\n]*? K|M572[^;\n]*? S|SET_PRESSURE_ADVANCE[^;\n]*? ADVANCE=)([^ ;\n]*)/gm,
  );
  return /[1-9]/.test([...commands].at(-1)?.[1] ?? '');
}

/** Returns the speed of oriented beads in the core's G-code [mm/s]. */
export function shownSpeed({ flavor, setPressureAdvance, startGcode, showSpeed, speed }: PrinterValues): number {
  if (showSpeed > 0) return showSpeed;
  const own = flavor === 'klipper' || flavor === 'reprap';
  return own || setPressureAdvance || setsPressureAdvance(startGcode) ? speed : Math.min(speed, evenSpeed);
}

type Cycle = Toolpath['cycles'][number];

/** Part of a bead, no longer than it is wide. */
interface Piece {
  /** Middle [mm]. */
  x: number;
  y: number;
  /** Direction, a unit vector. */
  along: [number, number];
  width: number;
  /** Time at which its middle is laid [s]. */
  time: number;
}

/**
 * Returns the time between a bead and its neighbour, on the worse of its two sides,
 * and the side to which it leans, by the core's measure (neighbour_delay.cpp), if
 * all beads are laid at one speed. Beads without a neighbour have no delay.
 * @param speed  speed of the beads [mm/s]
 */
export function delaysOf({ cycles, ...rest }: Toolpath, speed: number): Delayed {
  const cut: Cycle[] = [];
  const pieces: Piece[] = [];
  let begin = 0; // [s]
  for (const { points, widths } of cycles) {
    const places: number[] = [];
    const wide: number[] = [];
    widths.forEach((from, k) => {
      const next = (k + 1) % widths.length;
      const [x, y, to] = [points[2 * k] ?? 0, points[2 * k + 1] ?? 0, widths[next] ?? 0];
      const [dx, dy] = [(points[2 * next] ?? 0) - x, (points[2 * next + 1] ?? 0) - y];
      const length = Math.hypot(dx, dy);
      const width = (from + to) / 2;
      const count = width > 0 ? Math.max(1, Math.floor(length / width)) : 1;
      const along: Piece['along'] = [dx / (length || 1), dy / (length || 1)];
      for (let part = 0; part < count; ++part) {
        const [share, middle] = [part / count, (part + 0.5) / count];
        places.push(x + dx * share, y + dy * share);
        wide.push(from + (to - from) * share);
        pieces.push({ x: x + dx * middle, y: y + dy * middle, along, width, time: begin + (middle * length) / speed });
      }
      begin += length / speed;
    });
    cut.push({ points: Float32Array.from(places), widths: Float32Array.from(wide) });
  }
  const waits = waitsOf(pieces);
  let first = 0;
  const delays = cut.map(({ widths }) => waits.subarray(first, (first += 2 * widths.length)));
  return { toolpath: { ...rest, cycles: cut }, delays };
}

/** Returns delay [s] and lean of each piece, alternately; neighbours are found by a grid of cells. */
function waitsOf(pieces: readonly Piece[]): Float32Array {
  const reach = neighbours.farthest * pieces.reduce((widest, { width }) => Math.max(widest, width), 0);
  const cells = new Map<number, Piece[]>(); // cells are as wide as the largest distance between neighbours
  const cellAt = ({ x, y }: Piece): number => Math.floor(y / reach) * 1e6 + Math.floor(x / reach);
  for (const piece of pieces) {
    const there = cells.get(cellAt(piece));
    if (there === undefined) cells.set(cellAt(piece), [piece]);
    else there.push(piece);
  }
  const waits = new Float32Array(2 * pieces.length);
  for (const [k, piece] of pieces.entries()) {
    const sides: [number, number] = [Infinity, Infinity]; // [s] to the left and right; below 0: the neighbour is there already
    for (const row of [-1e6, 0, 1e6]) {
      for (const column of [-1, 0, 1]) {
        for (const other of cells.get(cellAt(piece) + row + column) ?? []) {
          const [dx, dy] = [other.x - piece.x, other.y - piece.y];
          const [alongX, alongY] = piece.along;
          const mean = (piece.width + other.width) / 2;
          if (Math.abs(dx * alongX + dy * alongY) > neighbours.along * mean) continue;
          const across = alongX * dy - alongY * dx;
          if (Math.abs(across) < neighbours.nearest * mean || Math.abs(across) > neighbours.farthest * mean) continue;
          const side = across > 0 ? 0 : 1;
          const later = other.time - piece.time;
          if (Math.abs(later) < Math.abs(sides[side])) sides[side] = later;
        }
      }
    }
    const [left, right] = [sides[0] < 0, sides[1] < 0];
    waits[2 * k] = Math.max(...sides.filter((delay) => delay < Infinity).map(Math.abs), 0);
    waits[2 * k + 1] =
      left && right ? leans.squeezed : Number(left) * leans.toTheLeft + Number(right) * leans.toTheRight;
  }
  return waits;
}
