// Measures how well a finished plate shows what its directions ask for. The brightness of its beads under its own light
// is compared with that of beads with exactly these directions, in cells two beads wide, since an eye at arm's length
// cannot see single beads.
import type { Cycle } from 'sillon';
import type { Seen } from '../model/doubts.js';
import { homeLight } from '../model/lamp.js';
import type { DirectionRaster } from '../model/raster.js';
import type { PlateResult } from '../model/state.js';
import type { Light } from '../model/view.js';
import { brightnessOf } from '../views/plate-thumbnail.js';
import { pageOf } from '../model/plate.js';
import { resampled } from './resample.js';

const beadsPerCell = 2;
/** Share of a cell's room that beads must fill; a cell with less is no part of the plate. */
const leastCover = 0.5;
/** Share of the range of wanted brightness at either end that counts as bright, or as dark. */
const end = 0.25;

interface Cells {
  width: number;
  height: number;
  /** Width and height of a cell [mm]. */
  side: readonly [number, number];
}

/** A function that gives the brightness, 0..1, of a bead's direction under the light. Beads across the light are
 * brightest, whatever the filament. */
const shinesUnder =
  ({ azimuth }: Light) =>
  (alongX: number, alongY: number): number => {
    const turn = (azimuth * Math.PI) / 180;
    const across = alongY * Math.cos(turn) - alongX * Math.sin(turn);
    return 0.16 + 0.84 * across ** 4;
  };

/** Length of the beads in each cell [mm], and that length times their brightness. Row 0 is at the top. */
function beadsIn(cycles: readonly Cycle[], { width, height, side }: Cells, light: Light) {
  const lengths = new Float32Array(width * height);
  const bright = new Float32Array(width * height);
  const step = Math.min(...side) / 2;
  const shine = shinesUnder(light);
  for (const { points } of cycles) {
    for (let k = 2; k + 1 < points.length; k += 2) {
      const [x, y] = [points[k - 2] as number, points[k - 1] as number];
      const [dx, dy] = [(points[k] as number) - x, (points[k + 1] as number) - y];
      const length = Math.hypot(dx, dy);
      const shines = length > 0 ? shine(dx / length, dy / length) : 0;
      const parts = Math.max(1, Math.ceil(length / step));
      for (let part = 0; part < parts; ++part) {
        const share = (part + 0.5) / parts;
        const column = Math.floor((x + share * dx) / side[0]);
        const row = height - 1 - Math.floor((y + share * dy) / side[1]);
        if (column < 0 || column >= width || row < 0 || row >= height) continue;
        const cell = row * width + column;
        lengths[cell] = (lengths[cell] as number) + length / parts;
        bright[cell] = (bright[cell] as number) + (shines * length) / parts;
      }
    }
  }
  return { lengths, bright };
}

/** Cells that are filled with beads and have only filled neighbours. Along the rim, beads cannot choose their
 * direction. */
function inner(lengths: Float32Array, { width, height, side }: Cells, spacing: number): number[] {
  const full = (side[0] * side[1]) / spacing;
  const filled = (column: number, row: number): boolean =>
    column >= 0 &&
    row >= 0 &&
    column < width &&
    row < height &&
    (lengths[row * width + column] as number) > leastCover * full;
  const around = [-1, 0, 1];
  return Array.from(lengths.keys()).filter((k) => {
    const [column, row] = [k % width, Math.floor(k / width)];
    return around.every((dx) => around.every((dy) => filled(column + dx, row + dy)));
  });
}

const mean = (values: readonly number[]): number =>
  values.reduce((sum, value) => sum + value, 0) / Math.max(1, values.length);

function variance(values: Float32Array): number {
  let [sum, squares] = [0, 0];
  for (const value of values) [sum, squares] = [sum + value, squares + value * value];
  return Math.max(0, squares / values.length - (sum / values.length) ** 2);
}

/** Pearson's correlation of wanted and seen brightness, and the contrast between the places wanted bright and dark. */
function compared(wanted: readonly number[], seen: readonly number[]): Pick<Seen, 'r' | 'contrast'> {
  const [ma, mb] = [mean(wanted), mean(seen)];
  let [aa, bb, ab] = [0, 0, 0];
  wanted.forEach((value, k) => {
    const [x, y] = [value - ma, (seen[k] as number) - mb];
    [aa, bb, ab] = [aa + x * x, bb + y * y, ab + x * y];
  });
  const low = wanted.reduce((least, value) => Math.min(least, value), Infinity);
  const high = wanted.reduce((greatest, value) => Math.max(greatest, value), -Infinity);
  const where = (test: (share: number) => boolean): number =>
    mean(seen.filter((_, k) => test(((wanted[k] as number) - low) / Math.max(1e-6, high - low))));
  const contrast =
    where((share) => share >= 1 - end) /
    Math.max(
      1e-6,
      where((share) => share <= end),
    );
  return { r: aa * bb > 0 ? ab / Math.sqrt(aa * bb) : 0, contrast };
}

/** Compares a finished plate with its directions. @param raster  the plate's directions */
export function seenOf({ plate, toolpath }: Pick<PlateResult, 'plate' | 'toolpath'>, raster: DirectionRaster): Seen {
  const { spacing } = plate.toolpath;
  const page = pageOf(plate);
  const [width, height] = page.map((side) => Math.max(1, Math.round(side / (beadsPerCell * spacing)))) as [
    number,
    number,
  ];
  const cells: Cells = { width, height, side: [page[0] / width, page[1] / height] };
  const light = homeLight(plate, toolpath.look);
  const { lengths, bright } = beadsIn(toolpath.cycles, cells, light);
  const asked = brightnessOf(raster, shinesUnder(light));
  const wanted = resampled(asked, raster, cells);
  const all = variance(asked);
  const told = inner(lengths, cells, spacing);
  const alike = compared(
    told.map((k) => wanted[k] as number),
    told.map((k) => (bright[k] as number) / (lengths[k] as number)),
  );
  return { ...alike, kept: all > 1e-6 ? Math.min(1, variance(wanted) / all) : 1 };
}
