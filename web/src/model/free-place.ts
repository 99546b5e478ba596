// Question and answer about a free place for one more box on a plate. Lengths are mm.
import type { Frame, Point } from './layer-frame.js';

/** A frame that is in use, but for a disc about its middle: what letters on a circle leave free. */
export interface Taken extends Frame {
  free: number;
}

export interface Wanted {
  size: Point;
  /** Between boxes, and to the shape's edge. */
  gap: number;
  /** Along the shape's edge, as of a border. */
  edge: number;
  /** The box may be made smaller down to this share of its size. */
  least: number;
}

export interface FreePlace {
  middle: Point;
  /** 1: as large as it was wanted. */
  scale: number;
}
