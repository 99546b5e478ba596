// How a plate is looked at.
export type ViewName = 'directions' | 'toolpath' | 'appearance' | 'quality';
export type ColourBy = 'direction' | 'width' | 'speed' | 'order' | 'delay' | 'lean';

/** Delays between neighbouring beads from here on have one colour [s]. */
export const mostDelay = 120;

/** Light and camera look at the plate from above; azimuth and elevation in degrees. */
export interface Light {
  azimuth: number;
  elevation: number;
}

/** A filament's look: linear RGB of its body, RMS slopes along and across the bead (degrees in the paper's Table 1). */
export interface FilamentLook {
  colour: [number, number, number];
  along: number;
  across: number;
}

/** A plate as it looks from straight above, without its beads. @param width, height  [pixels] */
export type Shimmer = (light: Light, width: number, height: number) => CanvasImageSource;

/** A place worth a look, found by the quality view [mm]. */
export interface Mark {
  x: number;
  y: number;
  kind: 'turn' | 'gap' | 'narrow' | 'wide' | 'lost' | 'kept';
}
