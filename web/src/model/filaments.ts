// The filaments on offer, their looks and their temperatures, from the core's tables of spools and filaments.
import type { PrinterValues } from 'sillon';
import { appearance, filamentProfiles, spools } from './appearance.js';
import type { Machine, OwnSpool, Plate } from './plate.js';
import { filamentFamily, withAdvance } from './printers.js';
import { without } from './without.js';

/** RMS slopes of a bead's surface along and across it [degrees]. */
export type Slopes = readonly [number, number];

interface SideSlopes {
  nozzleSide: Slopes;
  bedSide: Slopes;
}

/** Slopes measured with nozzles of `appearance.fineNozzle` and `appearance.wideNozzle`. */
interface Roughness {
  fine: SideSlopes;
  wide: SideSlopes;
}

export type FilamentKey = keyof typeof spools;

/** A filament of the list; the dictionary names it in `filament.KEY`. */
export interface Filament {
  key: FilamentKey;
  printed: (typeof filamentProfiles)[keyof typeof filamentProfiles];
  /** Colour of the body, sRGB 0..255; also used for swatches. */
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

/** The filament with this key. Plates come from files, so an unknown key gives the first of the list. */
export const filamentOf = (key: string): Filament =>
  filaments.find((filament) => filament.key === key) ?? (filaments[0] as Filament);

const ownRoughness = ({ fine, wide }: OwnSpool): Roughness => ({ fine, wide: wide ?? fine });

/** Colour and gloss of the plate: those of the visitor's own spool where there is one, else the filament's. */
const looksOf = ({ pictures, spool }: Plate): Pick<Filament, 'colour' | 'roughness'> =>
  spool === undefined ? filamentOf(pictures.spool) : { colour: spool.colour, roughness: ownRoughness(spool) };

/** Gives the plate the look of the visitor's own spool; undefined: the filament's look again. */
export function withSpool(plate: Plate, spool: OwnSpool | undefined): Plate {
  const changed = { ...without(plate, 'spool'), pictures: { ...plate.pictures, slopes: null } };
  return spool === undefined ? changed : { ...changed, spool };
}

export type Heat = Pick<PrinterValues, 'nozzleTemperature' | 'firstLayerNozzleTemperature' | 'bedTemperature'>;

export const heatOf = ({ nozzleTemperature, firstLayerNozzleTemperature, bedTemperature }: Heat): Heat => ({
  nozzleTemperature,
  firstLayerNozzleTemperature,
  bedTemperature,
});

/** Temperatures at which a filament is usually printed. */
export const heatFor = ({ printed }: Filament): Heat => heatOf(printed);

/** The plate in another filament, with that filament's look, temperatures and density. */
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

/** The first listed filament of the same family as a printer's `filamentType`. */
export const filamentLike = (type: string): Filament | undefined =>
  filaments.find(({ printed }) => printed.filamentType === filamentFamily(type));

/** Puts the plate on a printer that has its own filament. Where the plate looks like another family, it gets the
 * look of the first listed filament of the printer's family. */
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

/** Look for the views: linear colour, and slopes interpolated for the plate's nozzle [degrees]. */
export function lookOf(plate: Plate): { colour: [number, number, number]; along: number; across: number } {
  const { colour } = looksOf(plate);
  const [along, across] = slopesOf(plate);
  return { colour: [toLinear(colour[0]), toLinear(colour[1]), toLinear(colour[2])], along, across };
}

/** Look for files: colour as sRGB 0..255, slopes as in `lookOf`. */
export function viewLook(plate: Plate): { colour: [number, number, number]; slopes: [number, number] } {
  return { colour: [...looksOf(plate).colour], slopes: slopesOf(plate) };
}

/** Slopes along and across the bead, on the side that is seen, for the plate's nozzle [degrees]. */
export function slopesOf(plate: Plate): [number, number] {
  const { pictures, print, printer } = plate;
  if (pictures.slopes !== null) return pictures.slopes;
  return slopesFor(looksOf(plate).roughness, printer.nozzle, print.showSide === 'bed' ? 'bedSide' : 'nozzleSide');
}

/** Slopes that a project must state; null where they are those of a spool that every program knows. */
export const givenSlopes = (plate: Plate): [number, number] | null =>
  plate.spool === undefined ? plate.pictures.slopes : slopesOf(plate);

/** Slopes of the visitor's own spool, as in `slopesOf`. @param nozzle [mm] */
export const spoolSlopes = (spool: OwnSpool, nozzle: number, side: keyof SideSlopes): [number, number] =>
  slopesFor(ownRoughness(spool), nozzle, side);

/** Interpolates linearly between the two measured nozzles, and clamps outside them. @param nozzle [mm] */
function slopesFor({ fine, wide }: Roughness, nozzle: number, side: keyof SideSlopes): [number, number] {
  const { fineNozzle, wideNozzle } = appearance;
  const share = Math.min(1, Math.max(0, (nozzle - fineNozzle) / (wideNozzle - fineNozzle)));
  const between = (k: 0 | 1): number => fine[side][k] * (1 - share) + wide[side][k] * share;
  return [between(0), between(1)];
}
