// The printers that come with the engine, read from its table. filaments.ts has the values that filaments ask for.
import type { PrinterValues } from 'sillon';
import table from 'sillon/printers.json' with { type: 'json' };
import { printerDefaults } from './defaults.js';
import type { Plate } from './plate.js';
import { without } from './without.js';

export const ofFilament = [
  'filamentDensity',
  'filamentType',
  'nozzleTemperature',
  'firstLayerNozzleTemperature',
  'bedTemperature',
  'pressureAdvance',
  'setPressureAdvance',
] as const;

export type Machine = Omit<PrinterValues, (typeof ofFilament)[number]>;
/** Key of a printer in the table, as listed by `sillon printers`. */
export type PrinterKey = string;

export interface PrinterChoice {
  key: PrinterKey;
  /** Maker and model. The dictionary may have a better name in `printer.KEY`. */
  label: string;
  machine: Machine;
  /** Pressure advance [s] that the maker's own slicer sets, by filament family and nozzle. */
  advance: Advance;
}

type Advance = Record<string, Record<string, number>>;

const usual = Object.fromEntries(
  Object.entries(printerDefaults).filter(([key]) => !(ofFilament as readonly string[]).includes(key)),
) as unknown as Machine;

/** A row of the table: the values that differ from the usual printer, its maker and its source. */
interface Row extends Partial<Machine> {
  maker?: string;
  models?: string[];
  source?: string;
  advance?: Advance;
}

/** A row of the table as a choice, whose label begins with the maker. */
function choice(
  key: PrinterKey,
  { maker = '', models: _models, source: _source, advance = {}, ...values }: Row,
): PrinterChoice {
  const machine = { ...usual, ...values };
  return { key, advance, label: machine.name.startsWith(maker) ? machine.name : `${maker} ${machine.name}`, machine };
}

/** Tells whether a profile stands for no particular machine. */
export const isGeneric = ({ key }: PrinterChoice): boolean => key.startsWith('generic');

/** All profiles: generic ones first, then by name. */
const all: readonly PrinterChoice[] = Object.entries(table.printers as unknown as Record<string, Row>)
  .map(([key, values]) => choice(key, values))
  .sort((a, b) => Number(isGeneric(b)) - Number(isGeneric(a)) || a.label.localeCompare(b.label, 'en'));

/** Tells whether a printer needs its owner's start block. Bambu's do, and read it from a file that their slicer
 * made. */
const needsFile = ({ machine }: PrinterChoice): boolean => machine.flavor === 'bambu';

export const printers = all.filter((one) => !needsFile(one));
export const printersByFile = all.filter(needsFile);

/** Family of a filament type, as in the core's `filamentFamily`: "PLA" for "PLA Silk" and "pla-cf". */
export const filamentFamily = (type: string): string => /^[A-Za-z]*/.exec(type)?.[0].toUpperCase() ?? '';

/** The maker's pressure advance for the filament and the nozzle; off where none is known. */
function makersAdvance(printer: PrinterValues): Pick<PrinterValues, 'pressureAdvance' | 'setPressureAdvance'> {
  const value = profileOf(printer)?.advance[filamentFamily(printer.filamentType)]?.[printer.nozzle];
  return { setPressureAdvance: value !== undefined, pressureAdvance: value ?? printerDefaults.pressureAdvance };
}

/** Follows a change of filament or nozzle with the maker's pressure advance, unless the visitor had set another. As
 * in the core's `followAdvance`. */
export function withAdvance(plate: Plate, before: Plate): Plate {
  const { setPressureAdvance, pressureAdvance } = makersAdvance(before.printer);
  const own =
    setPressureAdvance !== before.printer.setPressureAdvance || pressureAdvance !== before.printer.pressureAdvance;
  return own ? plate : { ...plate, printer: { ...plate.printer, ...makersAdvance(plate.printer) } };
}

/** Puts the plate on another printer; its nozzle and its filament's values stay. */
export function withPrinter(plate: Plate, key: PrinterKey): Plate {
  const chosen = printers.find((one) => one.key === key);
  if (chosen === undefined) throw new Error(`there is no printer ${key}`);
  const { nozzle } = plate.printer;
  const printer = { ...without(plate.printer, 'profile'), ...structuredClone(chosen.machine), nozzle };
  return { ...plate, printer: { ...printer, ...makersAdvance(printer) } };
}

/** Values that are chosen for each print and do not identify a machine. */
export const ofPrint: readonly string[] = ['nozzle', 'speed', 'firstLayerSpeed', ...ofFilament];

/** Tells whether all values of the machine agree. The name alone would prove nothing. */
export const sameMachine = (a: Machine, b: Machine): boolean =>
  Object.keys(usual).every(
    (key) =>
      ofPrint.includes(key) || JSON.stringify(a[key as keyof Machine]) === JSON.stringify(b[key as keyof Machine]),
  );

/** The profile of a printer; undefined where it has none, for example from a project file. */
export const profileOf = (printer: Machine): PrinterChoice | undefined =>
  printers.find(({ machine }) => sameMachine(machine, printer));

/** Tells whether these are the values of a generic profile. */
export function isNobodys(printer: Machine): boolean {
  const profile = profileOf(printer);
  return profile !== undefined && isGeneric(profile);
}
