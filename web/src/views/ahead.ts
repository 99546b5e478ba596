// Brush strokes that are newer than the beads: they show at once, until the plate that contains them is made.
import type { Plate } from '../model/plate.js';
import { drawStrokes, usualRadius } from './print-drawing.js';

type Draw = (context: CanvasRenderingContext2D, styles: CSSStyleDeclaration) => void;

/** Finds the strokes that the shown beads do not follow yet.
 * @param made  the plate whose beads are shown
 * @returns a function that draws these strokes on a context in millimetres of the page; undefined: there are none */
export function strokesAhead(plate: Plate, made: Plate): Draw | undefined {
  const top = plate.layers.at(-1);
  if (top?.kind !== 'strokes' || made.shape !== plate.shape) return undefined;
  const known = made.layers.find(({ id }) => id === top.id)?.strokes ?? [];
  const ahead = top.strokes.filter((stroke, k) => known[k] !== stroke);
  if (ahead.length === 0) return undefined;
  const drawn = ahead.map(({ points, radius = usualRadius }) => ({ points, radius }));
  return (context, styles) => drawStrokes(context, drawn, styles.getPropertyValue('--accent'));
}
