// Fills the outline of a shape on 2D canvases.
import type { Shape } from 'sillon';

const outlines = new WeakMap<Shape, { path: Path2D; fillRule: CanvasFillRule }[]>();

/** Returns the rings of a shape as paths, in millimetres; each shape is converted once. */
function outlineOf(shape: Shape): { path: Path2D; fillRule: CanvasFillRule }[] {
  const known = outlines.get(shape);
  if (known !== undefined) return known;
  const made = shape.paths.map(({ rings, fillRule }) => {
    const path = new Path2D();
    for (const ring of rings) {
      for (let k = 0; k + 1 < ring.length; k += 2) {
        if (k === 0) path.moveTo(ring[0] ?? 0, ring[1] ?? 0);
        else path.lineTo(ring[k] ?? 0, ring[k + 1] ?? 0);
      }
      path.closePath();
    }
    return { path, fillRule };
  });
  outlines.set(shape, made);
  return made;
}

/** Fills a shape by the fill rules of its paths. @param context  transformed to millimetres of the page */
export function fillShape(context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D, shape: Shape): void {
  for (const { path, fillRule } of outlineOf(shape)) context.fill(path, fillRule);
}
