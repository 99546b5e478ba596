// Strokes of brushes that are ahead of the beads: shown at once, until the plate that follows them is there.
import { pageOf, type Plate } from '../model/plate.js';
import { sameSource } from '../model/result.js';
import { drawStrokes } from './print-drawing.js';

type Draw = (context: CanvasRenderingContext2D, styles: CSSStyleDeclaration) => void;

/** @param made  the plate whose beads are shown
 * @returns what draws them, given a context that is transformed to millimetres of the page; undefined: nothing is ahead */
export function strokesAhead(plate: Plate, made: Plate): Draw | undefined {
  // A lamp's pictures are solved for without strokes; those of another plate are no news.
  if (plate.directions.kind === 'lamp' || !sameSource(made, plate)) return undefined;
  let same = 0;
  while (same < made.strokes.length && made.strokes[same] === plate.strokes[same]) ++same;
  const ahead = plate.strokes.slice(same);
  if (ahead.length === 0) return undefined;
  const sides = pageOf(plate);
  const inMm = ahead.map(({ points, radius }) => ({
    points: points.map((value, k) => value * sides[(k % 2) as 0 | 1]),
    radius: radius * sides[0],
  }));
  return (context, styles) => {
    drawStrokes(context, inMm, styles.getPropertyValue('--accent'));
  };
}
