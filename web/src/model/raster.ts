// What sources and strokes become: a direction and a mode per texel, ready for the engine and for the canvas.

/** Stretched over the page, row 0 on top. */
export interface DirectionRaster {
  width: number;
  height: number;
  /** angle / 65535 * 180 - 90 degrees, counter-clockwise from the right; as the engine's 'angle' pictures. */
  angle: Uint16Array;
  /** 0 parallel, 1 orthogonal, 2 smoothest, 3 constrained. */
  mode: Uint8Array;
}

/** Texels of the longer side, for plates that are printed and for what must keep up with a hand. */
export const fineResolution = 1024;
export const coarseResolution = 256;
