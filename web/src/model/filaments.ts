// A short list of filaments: how they are printed, and how they look. Roughness is what Table 1 of the paper reports: RMS
// slopes [degrees] along and across the bead, on the side that the nozzle passed over and on the one that lay on the bed.
import type { Plate } from './plate.js';

/** Along, across. */
export type Slopes = readonly [number, number];

interface Roughness {
  nozzleSide: Slopes;
  bedSide: Slopes;
}

export type FilamentKey = 'clearPetg' | 'redPetg' | 'goldPla' | 'bluePla' | 'greyPla';

/** Its name is in the dictionary: `filament.KEY`. */
export interface Filament {
  key: FilamentKey;
  type: 'PLA' | 'PETG';
  /** [g/cm³] */
  density: number;
  /** [°C] */
  nozzleTemperature: number;
  bedTemperature: number;
  /** Of the body, sRGB 0..255; for swatches as well. */
  colour: readonly [number, number, number];
  /** Measured with nozzles of 0.4 and 0.8 mm. */
  roughness: { fine: Roughness; wide: Roughness };
}

const fineNozzle = 0.4;
const wideNozzle = 0.8;

const pla = { type: 'PLA', density: 1.24, nozzleTemperature: 210, bedTemperature: 60 } as const;
const petg = { type: 'PETG', density: 1.27, nozzleTemperature: 235, bedTemperature: 80 } as const;

export const filaments: readonly Filament[] = [
  {
    key: 'goldPla',
    ...pla,
    colour: [201, 148, 46],
    roughness: {
      fine: { nozzleSide: [8.93, 15.6], bedSide: [2.43, 9.72] },
      wide: { nozzleSide: [6.36, 16.66], bedSide: [2.19, 19.34] },
    },
  },
  {
    key: 'bluePla',
    ...pla,
    colour: [24, 78, 168],
    roughness: {
      fine: { nozzleSide: [2.36, 17.32], bedSide: [2.56, 13.54] },
      wide: { nozzleSide: [2.31, 17.69], bedSide: [2.43, 20.9] },
    },
  },
  {
    key: 'greyPla',
    ...pla,
    colour: [112, 115, 120],
    roughness: {
      fine: { nozzleSide: [4.46, 15.81], bedSide: [2.57, 12.46] },
      wide: { nozzleSide: [4.38, 11.92], bedSide: [2.38, 19.16] },
    },
  },
  {
    key: 'redPetg',
    ...petg,
    colour: [176, 24, 30],
    roughness: {
      fine: { nozzleSide: [6.2, 12.98], bedSide: [2.34, 18.82] },
      wide: { nozzleSide: [1.36, 4.6], bedSide: [2.23, 21.29] },
    },
  },
  {
    key: 'clearPetg',
    ...petg,
    colour: [206, 212, 214],
    roughness: {
      fine: { nozzleSide: [0.88, 11.63], bedSide: [2.36, 11.78] },
      wide: { nozzleSide: [0.25, 14.2], bedSide: [1.9, 18.26] },
    },
  },
];

/** The first of the list for a key that is not in it: plates come from files, too. */
export const filamentOf = (key: string): Filament =>
  filaments.find((filament) => filament.key === key) ?? (filaments[0] as Filament);

/** The plate of another filament: its look, temperatures and weight. */
export function withFilament(plate: Plate, key: FilamentKey): Plate {
  const { type, density, nozzleTemperature, bedTemperature } = filamentOf(key);
  return {
    ...plate,
    filament: key,
    printer: {
      ...plate.printer,
      filamentType: type,
      filamentDensity: density,
      nozzleTemperature,
      firstLayerNozzleTemperature: nozzleTemperature + 5,
      bedTemperature,
    },
  };
}

const toLinear = (value: number): number => {
  const share = value / 255;
  return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
};

/** What the views draw with: linear colour, and the slopes for this nozzle, between those measured. A mirrored plate is
 * made to be seen from below. */
export function lookOf(plate: Plate): { colour: [number, number, number]; along: number; across: number } {
  const { colour } = filamentOf(plate.filament);
  const [along, across] = slopesOf(plate);
  return { colour: [toLinear(colour[0]), toLinear(colour[1]), toLinear(colour[2])], along, across };
}

/** The same for files: sRGB 0..255. */
export function viewLook(plate: Plate): { colour: [number, number, number]; slopes: [number, number] } {
  return { colour: [...filamentOf(plate.filament).colour], slopes: slopesOf(plate) };
}

/** Along and across the bead, on the side that is seen, for the nozzle [degrees]. */
function slopesOf({ filament, print, printer }: Plate): [number, number] {
  const { roughness } = filamentOf(filament);
  const side = print.mirror ? 'bedSide' : 'nozzleSide';
  const share = Math.min(1, Math.max(0, (printer.nozzle - fineNozzle) / (wideNozzle - fineNozzle)));
  const between = (k: 0 | 1): number => roughness.fine[side][k] * (1 - share) + roughness.wide[side][k] * share;
  return [between(0), between(1)];
}
