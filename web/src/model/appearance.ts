// Made by tools/generate.mjs from the core's appearance model and spools: ./dev generate.

/** Slope of a bead's round top at its edge; share of the brightest light that every direction sends; slopes of lamps; contrast
 * below which pictures are seen but faintly; nozzles of the measured spools [mm]. */
export const appearance = {
  profileSlope: 0.3,
  diffuse: 0.05,
  weakContrast: 5,
  fineNozzle: 0.4,
  wideNozzle: 0.8,
  bulb: 0.02,
  softbox: 0.1,
  window: 0.4,
} as const;

/** Colour of the body, sRGB 0..255; RMS slopes along and across the bead [degrees], by nozzle. */
export const spools = {
  bluePla: {
    colour: [24, 78, 168],
    fine: { nozzleSide: [2.36, 17.32], bedSide: [2.56, 13.54] },
    wide: { nozzleSide: [2.31, 17.69], bedSide: [2.43, 20.9] },
  },
  clearPetg: {
    colour: [206, 212, 214],
    fine: { nozzleSide: [0.88, 11.63], bedSide: [2.36, 11.78] },
    wide: { nozzleSide: [0.25, 14.2], bedSide: [1.9, 18.26] },
  },
  goldPla: {
    colour: [201, 148, 46],
    fine: { nozzleSide: [8.93, 15.6], bedSide: [2.43, 9.72] },
    wide: { nozzleSide: [6.36, 16.66], bedSide: [2.19, 19.34] },
  },
  greyPla: {
    colour: [112, 115, 120],
    fine: { nozzleSide: [4.46, 15.81], bedSide: [2.57, 12.46] },
    wide: { nozzleSide: [4.38, 11.92], bedSide: [2.38, 19.16] },
  },
  redPetg: {
    colour: [176, 24, 30],
    fine: { nozzleSide: [6.2, 12.98], bedSide: [2.34, 18.82] },
    wide: { nozzleSide: [1.36, 4.6], bedSide: [2.23, 21.29] },
  },
} as const;

/** Values of a printer that filaments ask for. */
export const filamentProfiles = {
  petg: {
    filamentType: 'PETG',
    filamentDensity: 1.27,
    nozzleTemperature: 235,
    firstLayerNozzleTemperature: 240,
    bedTemperature: 80,
  },
  pla: {
    filamentType: 'PLA',
    filamentDensity: 1.24,
    nozzleTemperature: 210,
    firstLayerNozzleTemperature: 215,
    bedTemperature: 60,
  },
  'pla-silk': {
    filamentType: 'PLA',
    filamentDensity: 1.24,
    nozzleTemperature: 220,
    firstLayerNozzleTemperature: 225,
    bedTemperature: 60,
  },
} as const;
