// The points of a cycle that a screen can tell apart: where one pixel is wider than what lies between two of them, most of
// drawing goes into corners of beads that nobody sees.

/** Slope of a piece to its first step that turns too far to be drawn as one: outer edges of beads would show corners. */
const turns = Math.tan(Math.PI / 12);

/**
 * @param points  x and y of each, of a closed cycle [mm]
 * @param tolerance  how far a bead's middle and its edges may lie from where they are [mm]; 0: all points are drawn
 * @param begin, end  of the part that is looked at: long cycles are thinned part by part
 * @returns which points to draw, rising from `begin`
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
    // Slopes, to the first step, of lines from the first point that pass all others so near: of middles, and of edges.
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
