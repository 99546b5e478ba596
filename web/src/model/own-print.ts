// The printer, filament and thickness that a visitor has chosen. They are kept as text on the visitor's device, for new
// plates and for the next visit.
import type { PrinterValues } from 'sillon';
import { filaments, type FilamentKey } from './filaments.js';
import { newPlateOn, onMachine } from './brought.js';
import { printerDefaults } from './defaults.js';
import type { Plate } from './plate.js';
import { isNobodys, ofFilament, ofPrint, printers, profileOf, sameMachine, withAdvance } from './printers.js';
import { accepts, settings } from './settings.js';
import { withThickness } from './thickness.js';

interface Said {
  /** The chosen printer, with its filament's values. */
  printer: PrinterValues;
  /** Colour and gloss of the filament; undefined: no filament was chosen. */
  spool?: FilamentKey;
  /** Thickness [mm]; undefined: none was chosen. */
  thickness?: number;
}

type Values = Readonly<Record<string, unknown>>;

const only = (printer: PrinterValues, keys: readonly string[]): Values =>
  Object.fromEntries(Object.entries(printer).filter(([key]) => keys.includes(key)));

/** The text to keep. A listed printer is stored by its key only, since a later version may correct its values.
 * @param thickness  [mm] */
export function ownPrintText({ printer, pictures, spool }: Plate, thickness: number | undefined): string {
  const profile = profileOf(printer)?.key;
  const look = filaments.find(({ key }) => key === pictures.spool)?.key;
  return JSON.stringify({
    profile,
    printer: only(printer, profile === undefined ? Object.keys(printerDefaults) : ofPrint),
    ...(spool === undefined && { spool: look }), // the visitor's own spools are kept elsewhere
    thickness,
  });
}

/** The printer of a text; undefined where another version wrote it, since its values are never guessed. */
function printerFrom(profile: unknown, told: Values): PrinterValues | undefined {
  const listed = printers.find(({ key }) => key === profile);
  if (profile !== undefined && listed === undefined) return undefined;
  const values: Values =
    listed === undefined ? told : { ...printerDefaults, ...listed.machine, ...only(told as never, ofPrint) };
  const fits = settings.every((setting) => setting.section !== 'printer' || accepts(setting, values[setting.key]));
  return fits ? (only(values as never, Object.keys(printerDefaults)) as unknown as PrinterValues) : undefined;
}

/** The print that a visitor has chosen, as it applies to plates. */
export class OwnPrint {
  constructor(readonly said: Said) {}

  /** Reads the text of `ownPrintText`. @returns undefined for any other text */
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

  /** Tells whether this is the machine that the visitor has chosen. */
  means = (printer: PrinterValues): boolean => sameMachine(this.said.printer, printer);

  /** Puts a plate that is for no particular machine on the chosen one. */
  on = (plate: Plate): Plate => (isNobodys(plate.printer) ? onMachine(plate, this.said.printer) : plate);

  /** A new plate on the visitor's printer. @param printer  printer of the plate that was shown before */
  begin(printer: PrinterValues): Plate {
    const { thickness } = this.said;
    const plate = this.#filled(newPlateOn(isNobodys(printer) ? this.said.printer : printer));
    return thickness === undefined ? plate : withThickness(plate, thickness);
  }

  /** The plate with the chosen filament, where there is one. */
  #filled(plate: Plate): Plate {
    const { printer, spool } = this.said;
    if (spool === undefined) return plate;
    const { setPressureAdvance, pressureAdvance } = plate.printer; // pressure advance belongs to the machine
    const filament = { ...only(printer, ofFilament), setPressureAdvance, pressureAdvance };
    const changed = { ...plate, pictures: { ...plate.pictures, spool }, printer: { ...plate.printer, ...filament } };
    return withAdvance(changed, plate);
  }
}
