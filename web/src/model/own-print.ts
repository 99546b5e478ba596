// The printer, filament and thickness that a visitor has named. They are kept as a text on their device, for plates that
// begin and for the next visit.
import type { PrinterValues } from 'sillon';
import { filaments, type FilamentKey } from './filaments.js';
import { newPlateOn, onMachine } from './brought.js';
import { printerDefaults } from './defaults.js';
import type { Plate } from './plate.js';
import { isNobodys, ofFilament, ofPrint, printers, profileOf, sameMachine, withAdvance } from './printers.js';
import { accepts, settings } from './settings.js';
import { withThickness } from './thickness.js';

interface Said {
  /** With what its filament asks for. */
  printer: PrinterValues;
  /** Colour and gloss of the filament; undefined: no filament was said. */
  spool?: FilamentKey;
  /** [mm]; undefined: none was said. */
  thickness?: number;
}

type Values = Readonly<Record<string, unknown>>;

const only = (printer: PrinterValues, keys: readonly string[]): Values =>
  Object.fromEntries(Object.entries(printer).filter(([key]) => keys.includes(key)));

/** A printer of the list is told by its key: its values may be set right in a later version. @param thickness  [mm] */
export function ownPrintText({ printer, pictures, spool }: Plate, thickness: number | undefined): string {
  const profile = profileOf(printer)?.key;
  const look = filaments.find(({ key }) => key === pictures.spool)?.key;
  return JSON.stringify({
    profile,
    printer: only(printer, profile === undefined ? Object.keys(printerDefaults) : ofPrint),
    ...(spool === undefined && { spool: look }), // spools of one's own are kept elsewhere
    thickness,
  });
}

/** The printer of a text; undefined: of another version, where nothing is guessed. */
function printerFrom(profile: unknown, told: Values): PrinterValues | undefined {
  const listed = printers.find(({ key }) => key === profile);
  if (profile !== undefined && listed === undefined) return undefined;
  const values: Values =
    listed === undefined ? told : { ...printerDefaults, ...listed.machine, ...only(told as never, ofPrint) };
  const fits = settings.every((setting) => setting.section !== 'printer' || accepts(setting, values[setting.key]));
  return fits ? (only(values as never, Object.keys(printerDefaults)) as unknown as PrinterValues) : undefined;
}

export class OwnPrint {
  constructor(readonly said: Said) {}

  /** @returns undefined where the text is none of `ownPrintText` */
  static of(text: string): OwnPrint | undefined {
    let told: { profile?: unknown; printer?: Values; spool?: unknown; thickness?: unknown };
    try {
      told = JSON.parse(text) as typeof told;
    } catch {
      return undefined;
    }
    const { profile, printer: values = {}, spool, thickness } = told;
    const printer = printerFrom(profile, values);
    if (printer === undefined) return undefined;
    const look = filaments.find(({ key }) => key === spool)?.key;
    return new OwnPrint({
      printer,
      ...(look !== undefined && { spool: look }),
      ...(typeof thickness === 'number' && { thickness }),
    });
  }

  /** Returns whether this is the machine that the visitor has named. */
  means = (printer: PrinterValues): boolean => sameMachine(this.said.printer, printer);

  /** The plate on the machine that was said, where its own is for none in particular. */
  on = (plate: Plate): Plate => (isNobodys(plate.printer) ? onMachine(plate, this.said.printer) : plate);

  /** A plate that begins. @param printer  of the one that was shown before */
  begin(printer: PrinterValues): Plate {
    const { thickness } = this.said;
    const plate = this.#filled(newPlateOn(isNobodys(printer) ? this.said.printer : printer));
    return thickness === undefined ? plate : withThickness(plate, thickness);
  }

  #filled(plate: Plate): Plate {
    const { printer, spool } = this.said;
    if (spool === undefined) return plate;
    const { setPressureAdvance, pressureAdvance } = plate.printer; // of the machine
    const filament = { ...only(printer, ofFilament), setPressureAdvance, pressureAdvance };
    const changed = { ...plate, pictures: { ...plate.pictures, spool }, printer: { ...plate.printer, ...filament } };
    return withAdvance(changed, plate);
  }
}
