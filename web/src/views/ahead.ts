// Strokes of brushes that are ahead of the beads: shown at once, until the plate that follows them is there.
import type { Plate } from '../model/plate.js';
import { drawStrokes, usualRadius } from './print-drawing.js';

type Draw = (context: CanvasRenderingContext2D, styles: CSSStyleDeclaration) => void;

/** @param made  the plate whose beads are shown
 * @returns what draws them, given a context that is transformed to millimetres of the page; undefined: nothing is ahead */
export function strokesAhead(plate: Plate, made: Plate): Draw | undefined {
  const top = plate.layers.at(-1);
  if (top?.kind !== 'strokes' || made.shape !== plate.shape) return undefined;
  const known = made.layers.find(({ id }) => id === top.id)?.strokes ?? [];
  const ahead = top.strokes.filter((stroke, k) => known[k] !== stroke);
  if (ahead.length === 0) return undefined;
  const drawn = ahead.map(({ points, radius = usualRadius }) => ({ points, radius }));
  return (context, styles) => {
    drawStrokes(context, drawn, styles.getPropertyValue('--accent'));
  };
}
