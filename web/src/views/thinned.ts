// Thins a cycle to the points that a screen can tell apart: where one pixel is wider than the gap between two points,
// most of the drawing time goes into corners of beads that nobody sees.

/** Tangent of the largest angle between a piece and its first
 * step (15°): more, and the outer edges of beads show corners. */
const turns = Math.tan(Math.PI / 12);

/**
 * Chooses the points of a closed cycle to draw, so that no bead moves by more than a tolerance.
 *
 * @param points  x and y of each point [mm]
 * @param widths  width of the bead at each point [mm]
 * @param tolerance  largest distance that a bead's middle and edges may move [mm]; 0: all points are drawn
 * @param begin, end  range of points to thin: long cycles are thinned part by part
 * @returns indices of the points to draw, rising from `begin`
 */
export function pointsToDraw(
  points: Float32Array,
  widths: Float32Array,
  tolerance: number,
  begin = 0,
  end = widths.length,
): Uint32Array {
  const count = widths.length;
  if (tolerance === 0) return Uint32Array.from({ length: end - begin }, (_, k) => begin + k);
  const kept = new Uint32Array(end - begin);
  let found = 0;
  const x = (k: number): number => points[2 * (k % count)] ?? 0;
  const y = (k: number): number => points[2 * (k % count) + 1] ?? 0;
  for (let from = begin; from < end;) {
    kept[found++] = from;
    let to = from + 1;
    const [x0, y0, width] = [x(from), y(from), widths[from] ?? 0];
    const step = Math.hypot(x(to) - x0, y(to) - y0);
    const [alongX, alongY] = [(x(to) - x0) / step, (y(to) - y0) / step];
    // Bounds of the slope, against the first step, of a line from the first point that passes all others within the
    // tolerance: `least` and `most` for the bead's middle, `leastWiden` and `mostWiden` for its edges.
    let [least, most, leastWiden, mostWiden] = [-turns, turns, -Infinity, Infinity];
    for (let k = to, before = 0; k <= end; ++k) {
      const [dx, dy] = [x(k) - x0, y(k) - y0];
      const ahead = dx * alongX + dy * alongY;
      const aside = dy * alongX - dx * alongY;
      const wider = ((widths[k % count] ?? 0) - width) / 2;
      const may =
        ahead > before &&
        least * ahead <= aside &&
        aside <= most * ahead &&
        leastWiden * ahead <= wider &&
        wider <= mostWiden * ahead;
      if (!may) break;
      to = k;
      before = ahead;
      least = Math.max(least, (aside - tolerance) / ahead);
      most = Math.min(most, (aside + tolerance) / ahead);
      leastWiden = Math.max(leastWiden, (wider - tolerance) / ahead);
      mostWiden = Math.min(mostWiden, (wider + tolerance) / ahead);
    }
    from = to;
  }
  return kept.subarray(0, found);
}
