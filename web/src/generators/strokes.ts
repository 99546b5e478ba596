// Gestures of brushes, replayed in order over the source. One more stroke on a raster touches only the texels under it.
import type { Stroke } from '../model/plate.js';
import { doubleVectors, storeDouble } from './angle.js';
import { modeNumber } from './modes.js';
import type { DirectionRaster } from '../model/raster.js';
import { inWidths, type Page } from './texels.js';

const step = 0.5; // of the radius: points closer together change nothing that could be seen
const constrained = modeNumber('constrained');

interface Point {
  x: number;
  y: number;
}

/** Points in page widths, about a step apart; hands shake in between. */
function sparse(stroke: Stroke, page: Page): Point[] {
  const out: Point[] = [];
  for (let k = 0; k + 1 < stroke.points.length; k += 2) {
    const [x, y] = inWidths([stroke.points[k] as number, stroke.points[k + 1] as number], page);
    const last = out.at(-1);
    const ends = k + 3 >= stroke.points.length;
    const moved = last === undefined ? Infinity : Math.hypot(x - last.x, y - last.y);
    if (moved >= step * stroke.radius || (ends && moved > 0)) out.push({ x, y });
  }
  return out;
}

interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** Texels [left, right) x [top, bottom) within `radius` of two points. */
function boxAround(a: Point, b: Point, radius: number, { width, height }: DirectionRaster, tall: number): Box {
  const row = (y: number): number => (1 - y / tall) * height;
  return {
    left: Math.max(0, Math.floor((Math.min(a.x, b.x) - radius) * width)),
    right: Math.min(width, Math.ceil((Math.max(a.x, b.x) + radius) * width)),
    top: Math.max(0, Math.floor(row(Math.max(a.y, b.y) + radius))),
    bottom: Math.min(height, Math.ceil(row(Math.min(a.y, b.y) - radius))),
  };
}

/** What a stroke does under its box: how strongly, and which way it went (double-angle vector, of any length). */
interface Trace extends Box {
  strength: Float32Array;
  x: Float32Array;
  y: Float32Array;
}

function trace(stroke: Stroke, raster: DirectionRaster, page: Page): Trace | undefined {
  const points = sparse(stroke, page);
  const first = points[0];
  if (first === undefined || !(stroke.radius > 0)) return undefined;
  const tall = page[1] / page[0];
  const { width, height } = raster;
  const segments =
    points.length === 1 ? [[first, first] as const] : points.slice(1).map((b, k) => [points[k] as Point, b] as const);
  const boxes = segments.map(([a, b]) => boxAround(a, b, stroke.radius, raster, tall));
  const left = Math.min(...boxes.map((box) => box.left));
  const top = Math.min(...boxes.map((box) => box.top));
  const right = Math.max(left, ...boxes.map((box) => box.right));
  const bottom = Math.max(top, ...boxes.map((box) => box.bottom));
  const columns = right - left;
  const length = columns * (bottom - top);
  const out = {
    left,
    top,
    right,
    bottom,
    strength: new Float32Array(length),
    x: new Float32Array(length),
    y: new Float32Array(length),
  };

  const { radius } = stroke;
  const hard = radius * (1 - Math.min(1, Math.max(0, stroke.softness)));
  const rim = Math.max(radius - hard, 1e-9);
  segments.forEach(([a, b], index) => {
    const dx = b.x - a.x;
    const dy = b.y - a.y;
    const square = dx * dx + dy * dy;
    const doubleX = square > 0 ? (dx * dx - dy * dy) / square : 0;
    const doubleY = square > 0 ? (2 * dx * dy) / square : 0;
    const box = boxes[index] as Box;
    for (let row = box.top; row < box.bottom; ++row) {
      const y = (1 - (row + 0.5) / height) * tall;
      let k = (row - top) * columns + box.left - left;
      for (let column = box.left; column < box.right; ++column, ++k) {
        const x = (column + 0.5) / width;
        let along = ((x - a.x) * dx + (y - a.y) * dy) / (square || 1);
        along = along < 0 ? 0 : along > 1 ? 1 : along;
        const awayX = x - a.x - along * dx;
        const awayY = y - a.y - along * dy;
        const awaySquare = awayX * awayX + awayY * awayY;
        if (awaySquare >= radius * radius) continue;
        const away = Math.sqrt(awaySquare);
        const inner = Math.min(1, (radius - away) / rim);
        const strength = inner * inner * (3 - 2 * inner);
        if (strength > (out.strength[k] as number)) out.strength[k] = strength;
        // The nearest piece of the stroke leads; its neighbours round the corners off.
        const share = (1 - away / radius) * (1 - away / radius);
        out.x[k] = (out.x[k] as number) + share * doubleX;
        out.y[k] = (out.y[k] as number) + share * doubleY;
      }
    }
  });
  return out;
}

function forEachTexel(
  { left, top, right, bottom }: Box,
  width: number,
  visit: (texel: number, k: number) => void,
): void {
  for (let row = top, k = 0; row < bottom; ++row) {
    for (let texel = row * width + left; texel < row * width + right; ++texel, ++k) visit(texel, k);
  }
}

/** Turns beads to the way the brush went, and makes them constrained. Where they were not, there is no direction to blend
 * with: there the brush counts whole, or not at all. */
function comb(raster: DirectionRaster, traced: Trace): void {
  const vectors = doubleVectors();
  forEachTexel(traced, raster.width, (texel, k) => {
    const strength = traced.strength[k] as number;
    const x = traced.x[k] as number;
    const y = traced.y[k] as number;
    const length = Math.sqrt(x * x + y * y);
    if (strength === 0 || length === 0) return;
    const held = raster.mode[texel] === constrained;
    if (!held && strength < 0.5) return;
    const share = held ? strength : 1;
    const before = raster.angle[texel] as number;
    raster.angle[texel] = storeDouble(
      (share * x) / length + (1 - share) * (vectors.x[before] as number),
      (share * y) / length + (1 - share) * (vectors.y[before] as number),
    );
    raster.mode[texel] = constrained;
  });
}

function paintMode(raster: DirectionRaster, traced: Trace, mode: number): void {
  forEachTexel(traced, raster.width, (texel, k) => {
    if ((traced.strength[k] as number) >= 0.5) raster.mode[texel] = mode;
  });
}

function erase(raster: DirectionRaster, source: DirectionRaster, traced: Trace): void {
  const vectors = doubleVectors();
  forEachTexel(traced, raster.width, (texel, k) => {
    const strength = traced.strength[k] as number;
    if (strength === 0) return;
    const now = raster.angle[texel] as number;
    const before = source.angle[texel] as number;
    if (strength >= 0.5) raster.mode[texel] = source.mode[texel] as number;
    if (now === before) return;
    raster.angle[texel] =
      strength >= 1
        ? before
        : storeDouble(
            strength * (vectors.x[before] as number) + (1 - strength) * (vectors.x[now] as number),
            strength * (vectors.y[before] as number) + (1 - strength) * (vectors.y[now] as number),
          );
  });
}

/** Changes the raster in place. @param source  what the eraser brings back */
export function applyStroke(raster: DirectionRaster, source: DirectionRaster, stroke: Stroke, page: Page): void {
  const traced = trace(stroke, raster, page);
  if (traced === undefined) return;
  if (stroke.tool === 'comb') comb(raster, traced);
  else if (stroke.tool === 'erase') erase(raster, source, traced);
  else if (stroke.mode !== undefined) paintMode(raster, traced, modeNumber(stroke.mode));
}

export const copyOf = (raster: DirectionRaster): DirectionRaster => ({
  ...raster,
  angle: raster.angle.slice(),
  mode: raster.mode.slice(),
});

/** A raster with all strokes; the source itself where there are none. */
export function withStrokes(source: DirectionRaster, strokes: readonly Stroke[], page: Page): DirectionRaster {
  if (strokes.length === 0) return source;
  const raster = copyOf(source);
  for (const stroke of strokes) applyStroke(raster, source, stroke, page);
  return raster;
}

/** A raster with all strokes but the last, which may still grow. */
export interface Replay {
  source: DirectionRaster;
  page: Page;
  settled: DirectionRaster;
  strokes: readonly Stroke[];
}

/** As withStrokes, from the last replay where its strokes are the first of these (by identity). */
export function replayed(
  before: Replay | undefined,
  source: DirectionRaster,
  strokes: readonly Stroke[],
  page: Page,
): { raster: DirectionRaster; replay: Replay } {
  const goesOn =
    before?.source === source &&
    before.page[0] === page[0] &&
    before.page[1] === page[1] &&
    before.strokes.length < Math.max(1, strokes.length) &&
    before.strokes.every((stroke, k) => stroke === strokes[k]);
  const settledStrokes = strokes.slice(0, -1);
  const start = goesOn ? before.settled : source;
  const missing = settledStrokes.slice(goesOn ? before.strokes.length : 0);
  let settled = start;
  if (missing.length > 0) {
    settled = copyOf(start);
    for (const stroke of missing) applyStroke(settled, source, stroke, page);
  }
  const raster = copyOf(settled);
  for (const stroke of strokes.slice(-1)) applyStroke(raster, source, stroke, page);
  return { raster, replay: { source, page, settled, strokes: settledStrokes } };
}
