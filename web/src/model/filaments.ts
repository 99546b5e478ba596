// A short list of filaments: how they look and how they are printed, by the core's tables of spools and of filaments.
import { appearance, filamentProfiles, spools } from './appearance.js';
import type { Machine, OwnSpool, Plate } from './plate.js';
import { filamentFamily, withAdvance } from './printers.js';
import { without } from './without.js';

/** Along, across. */
export type Slopes = readonly [number, number];

interface SideSlopes {
  nozzleSide: Slopes;
  bedSide: Slopes;
}

/** Measured with nozzles of `appearance.fineNozzle` and `wideNozzle`. */
interface Roughness {
  fine: SideSlopes;
  wide: SideSlopes;
}

export type FilamentKey = keyof typeof spools;

/** Its name is in the dictionary: `filament.KEY`. */
export interface Filament {
  key: FilamentKey;
  printed: (typeof filamentProfiles)[keyof typeof filamentProfiles];
  /** Of the body, sRGB 0..255; for swatches as well. */
  colour: readonly [number, number, number];
  roughness: Roughness;
}

const withLook = (key: FilamentKey, profile: keyof typeof filamentProfiles): Filament => {
  const { colour, fine, wide } = spools[key];
  return { key, printed: filamentProfiles[profile], colour, roughness: { fine, wide } };
};

export const filaments: readonly Filament[] = [
  withLook('goldPla', 'pla'),
  withLook('bluePla', 'pla'),
  withLook('greyPla', 'pla'),
  withLook('redPetg', 'petg'),
  withLook('clearPetg', 'petg'),
];

/** The first of the list for a key that is not in it: plates come from files, too. */
export const filamentOf = (key: string): Filament =>
  filaments.find((filament) => filament.key === key) ?? (filaments[0] as Filament);

const ownRoughness = ({ fine, wide }: OwnSpool): Roughness => ({ fine, wide: wide ?? fine });

/** Colour and gloss: of the visitor's own spool, where there is one. */
const looksOf = ({ pictures, spool }: Plate): Pick<Filament, 'colour' | 'roughness'> =>
  spool === undefined ? filamentOf(pictures.spool) : { colour: spool.colour, roughness: ownRoughness(spool) };

/** Looks like a spool of one's own; undefined: as the filament again. */
export function withSpool(plate: Plate, spool: OwnSpool | undefined): Plate {
  const changed = { ...without(plate, 'spool'), pictures: { ...plate.pictures, slopes: null } };
  return spool === undefined ? changed : { ...changed, spool };
}

/** Temperatures at which a filament is usually printed. */
export const heatFor = ({ printed }: Filament) => {
  const { nozzleTemperature, firstLayerNozzleTemperature, bedTemperature } = printed;
  return { nozzleTemperature, firstLayerNozzleTemperature, bedTemperature };
};

/** The plate of another filament: its look, temperatures and weight. */
export function withFilament(plate: Plate, key: FilamentKey): Plate {
  const filament = filamentOf(key);
  const plainly = withSpool(plate, undefined);
  const changed = {
    ...plainly,
    pictures: { ...plainly.pictures, spool: key },
    printer: { ...without(plate.printer, 'filament'), ...filament.printed },
  };
  return withAdvance(changed, plate);
}

export const filamentLike = (type: string): Filament | undefined =>
  filaments.find(({ printed }) => printed.filamentType === filamentFamily(type));

/** The plate on a printer that has its own filament: where that is of another family, the plate looks as one of the list does
 * that is of this one. */
export function withFilamentOf(plate: Plate, printer: Machine): Plate {
  const family = filamentFamily(printer.filamentType);
  const changed = { ...plate, printer };
  const looks =
    plate.spool === undefined ? filamentOf(plate.pictures.spool).printed.filamentType : plate.printer.filamentType;
  if (filamentFamily(looks) === family) return changed;
  const plainly = withSpool(changed, undefined);
  const { key } = filamentLike(family) ?? { key: plainly.pictures.spool };
  return { ...plainly, pictures: { ...plainly.pictures, spool: key } };
}

const toLinear = (value: number): number => {
  const share = value / 255;
  return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
};

/** What the views draw with: linear colour, and the slopes for this nozzle, between those measured. */
export function lookOf(plate: Plate): { colour: [number, number, number]; along: number; across: number } {
  const { colour } = looksOf(plate);
  const [along, across] = slopesOf(plate);
  return { colour: [toLinear(colour[0]), toLinear(colour[1]), toLinear(colour[2])], along, across };
}

/** The same for files: sRGB 0..255. */
export function viewLook(plate: Plate): { colour: [number, number, number]; slopes: [number, number] } {
  return { colour: [...looksOf(plate).colour], slopes: slopesOf(plate) };
}

/** Along and across the bead, on the side that is seen, for the nozzle [degrees]. */
export function slopesOf(plate: Plate): [number, number] {
  const { pictures, print, printer } = plate;
  if (pictures.slopes !== null) return pictures.slopes;
  return slopesFor(looksOf(plate).roughness, printer.nozzle, print.showSide === 'bed' ? 'bedSide' : 'nozzleSide');
}

/** Slopes that a project has to tell; null: they are those of a spool that every program knows. */
export const givenSlopes = (plate: Plate): [number, number] | null =>
  plate.spool === undefined ? plate.pictures.slopes : slopesOf(plate);

/** Of a spool of one's own, as `slopesOf`. @param nozzle [mm] */
export const spoolSlopes = (spool: OwnSpool, nozzle: number, side: keyof SideSlopes): [number, number] =>
  slopesFor(ownRoughness(spool), nozzle, side);

/** @param nozzle [mm], between those that were measured */
function slopesFor({ fine, wide }: Roughness, nozzle: number, side: keyof SideSlopes): [number, number] {
  const { fineNozzle, wideNozzle } = appearance;
  const share = Math.min(1, Math.max(0, (nozzle - fineNozzle) / (wideNozzle - fineNozzle)));
  const between = (k: 0 | 1): number => fine[side][k] * (1 - share) + wide[side][k] * share;
  return [between(0), between(1)];
}
