// Question and answer types for finding a free place for one more box on a plate. Lengths are mm.
import type { Frame, Point } from './layer-frame.js';

/** An occupied frame. Letters on a circle leave a disc of radius `free` about its middle unoccupied. */
export interface Taken extends Frame {
  free: number;
}

export interface Wanted {
  size: Point;
  /** Least distance between boxes, and from a box to the shape's edge. */
  gap: number;
  /** Width of a strip along the shape's edge that is taken, by a border for example. */
  edge: number;
  /** Smallest share of its size that the box may be reduced to. */
  least: number;
}

export interface FreePlace {
  middle: Point;
  /** Factor on the wanted size; 1: as large as wanted. */
  scale: number;
}
