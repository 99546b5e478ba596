// Views of a plate, and the light and looks that they draw with.
export type ViewName = 'directions' | 'toolpath' | 'appearance' | 'quality';
export type ColourBy = 'direction' | 'width' | 'speed' | 'order' | 'delay' | 'lean';

/** Delay between neighbouring beads from which on all have the same colour [s]. */
export const mostDelay = 120;

/** Direction of the light or the camera above the plate: azimuth and elevation in degrees. */
export interface Light {
  azimuth: number;
  elevation: number;
}

/** A filament's look: linear RGB of its body, and RMS slopes along and across the bead in degrees, as in the paper's
 * Table 1. */
export interface FilamentLook {
  colour: [number, number, number];
  along: number;
  across: number;
}

/** Draws a plate as seen from straight above, without its beads. @param width, height  [pixels] */
export type Shimmer = (light: Light, width: number, height: number) => CanvasImageSource;

/** A place worth a look, found by the quality view; coordinates in mm. */
export interface Mark {
  x: number;
  y: number;
  kind: 'turn' | 'gap' | 'narrow' | 'wide' | 'lost' | 'kept';
}
