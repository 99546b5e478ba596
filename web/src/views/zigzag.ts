// Makes a plain 45° zigzag of the same shape, as a slicer would fill it, to compare with.
import type { Shape, Toolpath } from 'sillon';

/** Returns lines at 45°, one spacing apart, clipped to the
 * shape by the even-odd rule; each line is a cycle of its own. */
export function zigzag(shape: Shape, spacing: number): Toolpath {
  const [width, height] = shape.page;
  const half = Math.SQRT1_2;
  const rings = shape.paths.flatMap((path) => path.rings);
  const rows = new Map<number, number[]>();
  // Crossings are found in turned coordinates: u = (x + y) / √2 along the lines, v = (y - x) / √2 across them.
  for (const ring of rings) {
    const count = ring.length / 2;
    for (let k = 0; k < count; ++k) {
      const j = (k + 1) % count;
      const [ax, ay, bx, by] = [ring[2 * k] ?? 0, ring[2 * k + 1] ?? 0, ring[2 * j] ?? 0, ring[2 * j + 1] ?? 0];
      const [au, av, bu, bv] = [(ax + ay) * half, (ay - ax) * half, (bx + by) * half, (by - bx) * half];
      const from = Math.ceil(Math.min(av, bv) / spacing - 0.5);
      const to = Math.ceil(Math.max(av, bv) / spacing - 0.5) - 1;
      for (let row = from; row <= to; ++row) {
        const v = (row + 0.5) * spacing;
        const u = au + ((bu - au) * (v - av)) / (bv - av);
        rows.set(row, [...(rows.get(row) ?? []), u]);
      }
    }
  }
  const cycles: Toolpath['cycles'] = [];
  const place = (u: number, v: number): [number, number] => [(u - v) * half, (u + v) * half];
  for (const [row, crossings] of [...rows].sort((a, b) => a[0] - b[0])) {
    const v = (row + 0.5) * spacing;
    crossings.sort((a, b) => a - b);
    for (let k = 0; k + 1 < crossings.length; k += 2) {
      const begin = (crossings[k] ?? 0) + spacing / 2;
      const end = (crossings[k + 1] ?? 0) - spacing / 2;
      if (end <= begin) continue;
      const points = new Float32Array([...place(begin, v), ...place(end, v)]);
      cycles.push({ points, widths: new Float32Array([spacing, spacing]) });
    }
  }
  return { spacing, cycles, shape: { page: [width, height], paths: shape.paths }, notes: [] };
}
