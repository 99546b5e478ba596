// A design from elsewhere (a link, a project, a page around this one) may bring a printer of its own: temperatures,
// limits and G-code that moves and heats a machine. None of it is used before the visitor has agreed.
import type { PrinterValues } from 'sillon';
import { filamentProfiles } from './appearance.js';
import { printerDefaults } from './defaults.js';
import { filamentOf, heatOf, withFilament, withFilamentOf, type Heat } from './filaments.js';
import type { Plate } from './plate.js';
import { newPlate } from './new-plate.js';
import { isGeneric, ofFilament, profileOf, sameMachine, withAdvance } from './printers.js';
import { withNozzle } from './settings.js';
import { without } from './without.js';

const known = Object.values(filamentProfiles);
const usual = {
  nozzle: Math.max(...known.map(({ firstLayerNozzleTemperature }) => firstLayerNozzleTemperature)),
  bed: Math.max(...known.map(({ bedTemperature }) => bedTemperature)),
};

/** Temperatures above those of every listed filament [°C]; 0 where they are not above. */
export function unusualHeat(heat: Heat): { nozzle: number; bed: number } {
  const nozzle = Math.max(heat.nozzleTemperature, heat.firstLayerNozzleTemperature);
  return { nozzle: nozzle > usual.nozzle ? nozzle : 0, bed: heat.bedTemperature > usual.bed ? heat.bedTemperature : 0 };
}

const isHot = (heat: Heat): boolean => {
  const { nozzle, bed } = unusualHeat(heat);
  return nozzle > 0 || bed > 0;
};

/** Tells whether a stranger's printer may be used unasked: it is one of the profiles or the visitor's own, and no
 * hotter than usual. */
function harmless(printer: PrinterValues, own: PrinterValues): boolean {
  const sameHeat = ofFilament.every((key) => printer[key] === own[key]);
  const known = profileOf(printer) !== undefined || sameMachine(printer, own);
  return known && (!isHot(printer) || sameHeat);
}

/** The values of a printer that its filament asks for. */
const filamentIn = (printer: PrinterValues): Pick<PrinterValues, (typeof ofFilament)[number]> =>
  Object.fromEntries(ofFilament.map((key) => [key, printer[key]])) as Pick<PrinterValues, (typeof ofFilament)[number]>;

/** Tells whether the printer is a particular machine, and no generic profile. */
const namesPrinter = (printer: PrinterValues): boolean => {
  const profile = profileOf(printer);
  return profile === undefined || !isGeneric(profile);
};

/** The plate on the visitor's machine, with the plate's filament and nozzle. */
export function onMachine(plate: Plate, own: PrinterValues): Plate {
  const { pressureAdvance, setPressureAdvance } = own; // pressure advance belongs to that machine
  const filament = filamentIn(plate.printer);
  const printer = { ...structuredClone(own), ...filament, pressureAdvance, setPressureAdvance };
  return withAdvance({ ...plate, printer: { ...printer, nozzle: plate.printer.nozzle } }, { ...plate, printer: own });
}

/** Puts a design from elsewhere on the visitor's own printer and keeps what it brings in `brought`. The design's
 * nozzle stays, and so do its filament's values unless they are hotter than usual. A printer that the design names
 * among the profiles stays, too; a generic one stays only where the visitor has not chosen any. */
export function onOwnPrinter(plate: Plate, own: PrinterValues): Plate {
  const { printer } = plate;
  if (harmless(printer, own)) {
    const stays = namesPrinter(printer) || sameMachine(own, printerDefaults);
    return withoutBrought(stays ? plate : onMachine(plate, own));
  }
  const kept = filamentIn(isHot(printer) ? own : printer);
  return {
    ...withFilamentOf(plate, { ...structuredClone(own), ...kept, nozzle: printer.nozzle }),
    brought: printer,
  };
}

/** A new plate on the visitor's own printer, with the beads that suit its nozzle. */
export function newPlateOn(own: PrinterValues): Plate {
  const plate = newPlate();
  return withNozzle(onMachine({ ...plate, printer: { ...plate.printer, nozzle: own.nozzle } }, own), own.nozzle);
}

/** Accepts the printer that a design has brought. */
export const useBrought = (plate: Plate): Plate =>
  plate.brought === undefined ? plate : withoutBrought(withFilamentOf(plate, plate.brought));

/** Refuses the printer that a design has brought. */
export const withoutBrought = (plate: Plate): Plate => ('brought' in plate ? without(plate, 'brought') : plate);

/** Number of lines that are sent to the machine, so neither empty nor only a comment. */
export const countLines = (block: string): number =>
  block.split('\n').filter((line) => !/^\s*(;.*)?$/.test(line)).length;

/** Returns the text that the visitor must see before downloading the first file for a printer: blocks of G-code that
 * no profile has, and temperatures without limits. Equal texts need no second look; an empty text needs none at all. */
export function toReview(printer: PrinterValues): string {
  const { startGcode, endGcode, generalHeatLimits } = printer;
  const profile = profileOf(printer);
  const blocks = profile === undefined && (startGcode !== '' || endGcode !== '') ? [startGcode, endGcode] : [];
  const heat = generalHeatLimits ? Object.values(heatOf(printer)) : [];
  return blocks.length + heat.length === 0 ? '' : JSON.stringify([...blocks, ...heat]);
}

/** The plate's printer without what `toReview` shows: no blocks, no lifted heat limits, and a usual filament where
 * it was hot. */
export const withoutBlocks = (plate: Plate): Plate => {
  const printed = isHot(plate.printer) ? withFilament(plate, filamentOf(plate.pictures.spool).key) : plate;
  return { ...printed, printer: { ...printed.printer, startGcode: '', endGcode: '', generalHeatLimits: false } };
};
