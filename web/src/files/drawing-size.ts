// Refuses drawings that would take too long, before the engine reads them: its time grows faster than their size.
import { StudioError } from '../model/problem.js';

/** Most elements of a drawing. A plate of 80 mm has room for forty thousand squares as wide as a bead, so more
 * elements cannot be told apart. As many overlapping outlines of twenty points take the native program 16 s. */
const mostElements = 50_000;
const mostText = 10e6; // [bytes] without embedded pictures; about a million points

const lessThan = 0x3c;

/** Number of tags that open an element. */
function elementsIn(bytes: Uint8Array): number {
  let found = 0;
  for (let k = bytes.indexOf(lessThan); k >= 0; k = bytes.indexOf(lessThan, k + 1)) {
    const letter = (bytes[k + 1] ?? 0) | 0x20;
    if (letter >= 0x61 && letter <= 0x7a) ++found;
  }
  return found;
}

/** Length of a drawing's text without embedded pictures. */
const textIn = (bytes: Uint8Array): number =>
  new TextDecoder('latin1').decode(bytes).replaceAll(/data:[^"']*/g, '').length;

/** Checks the size of a drawing. @throws StudioError InvalidFile where it has too many elements or too much text */
export function checkDrawing(name: string, bytes: Uint8Array): void {
  const elements = elementsIn(bytes);
  if (elements > mostElements) {
    const detail = `${name} has ${elements} elements; at most ${mostElements}`;
    throw new StudioError('InvalidFile', { name, elements, most: mostElements }, detail);
  }
  const text = bytes.length > mostText ? textIn(bytes) : 0;
  if (text > mostText) {
    const [megabytes, most] = [Math.ceil(text / 1e6), mostText / 1e6];
    throw new StudioError(
      'InvalidFile',
      { name, megabytes, most },
      `${name} has ${megabytes} MB of outlines; at most ${most} MB`,
    );
  }
}
