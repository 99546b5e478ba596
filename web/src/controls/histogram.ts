// Measures the length of path of each width.
import type { Toolpath } from 'sillon';

export interface Histogram {
  /** Length of path [mm] per class of width. */
  bars: number[];
  /** Widths at both ends [mm]. */
  low: number;
  high: number;
}

const known = new WeakMap<Toolpath['cycles'], Histogram>();

/** Returns the histogram from 0.3 to 2 spacings; widths beyond count at the ends. */
export function widthHistogram({ cycles, spacing }: Toolpath, classes = 50): Histogram {
  const before = known.get(cycles);
  if (before !== undefined) return before;
  const low = 0.3 * spacing;
  const high = 2 * spacing;
  const bars = new Array<number>(classes).fill(0);
  for (const { points, widths } of cycles) {
    const count = widths.length;
    for (let i = 0; i < count; ++i) {
      const j = i + 1 === count ? 0 : i + 1;
      const dx = (points[2 * j] as number) - (points[2 * i] as number);
      const dy = (points[2 * j + 1] as number) - (points[2 * i + 1] as number);
      const width = ((widths[i] as number) + (widths[j] as number)) / 2;
      const at = Math.floor(((width - low) / (high - low)) * classes);
      const bar = Math.min(classes - 1, Math.max(0, at));
      bars[bar] = (bars[bar] as number) + Math.hypot(dx, dy);
    }
  }
  const histogram = { bars, low, high };
  known.set(cycles, histogram);
  return histogram;
}
