// Draws beads on a 2D canvas as lines of a few colours: one path per colour is fast however many beads there are.
import type { Toolpath } from 'sillon';
import type { Tones } from './lit.js';

const count = 32;

type Context = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

/** Strokes all beads of a toolpath, each in the nearest of 32 tones.
 * @param context  transformed to millimetres of the page, y up
 * @param scale  pixels per mm */
export function strokeBeads(
  context: Context,
  { cycles, spacing }: Pick<Toolpath, 'cycles' | 'spacing'>,
  scale: number,
  { of, colour }: Tones,
): void {
  const paths = Array.from({ length: count }, () => new Path2D());
  for (const { points } of cycles) {
    let [x, y] = [points[0] ?? 0, points[1] ?? 0];
    for (let k = 2; k + 1 < points.length; k += 2) {
      const [nextX, nextY] = [points[k] as number, points[k + 1] as number];
      const [dx, dy] = [nextX - x, nextY - y];
      const length = Math.hypot(dx, dy);
      // A segment shorter than a pixel is joined to the next one.
      if (length === 0 || (length * scale < 0.7 && k + 3 < points.length)) continue;
      const tone = of(dx / length, dy / length, (x + nextX) / 2, (y + nextY) / 2);
      const path = paths[Math.max(0, Math.min(count - 1, Math.floor(tone * count)))] as Path2D;
      path.moveTo(x, y);
      path.lineTo(nextX, nextY);
      [x, y] = [nextX, nextY];
    }
  }
  context.lineCap = 'round';
  const told = spacing * scale > 2.5; // from this scale on, furrows tell one bead from the next
  for (const [width, shade] of told
    ? ([
        [1.1, 0.78],
        [0.6, 1],
      ] as const)
    : ([[1.15, 1]] as const)) {
    context.lineWidth = Math.max(0.9 / scale, width * spacing);
    for (const [k, path] of paths.entries()) {
      context.strokeStyle = `rgb(${colour((k + 0.5) / count)
        .map((one) => Math.round(one * shade))
        .join(' ')})`;
      context.stroke(path);
    }
  }
}
