// Made by tools/generate.mjs from the core's facts: ./dev generate.

/** Speed of oriented beads at which an extruder keeps up without pressure advance [mm/s]. */
export const evenSpeed = 20;

export const mostLayers = 32;

/** A bead's neighbour lies to one side of it: the least and the greatest distance across, and the greatest along, in shares of the
 * mean of both widths. */
export const neighbours = { nearest: 0.6, farthest: 1.4, along: 0.6 } as const;

/** In the core's order. */
export const calibrationKinds = ['flow', 'speed', 'fan', 'width', 'directions', 'swatch', 'coupon'] as const;
