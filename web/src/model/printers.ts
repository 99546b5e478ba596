// The printers that come with the engine, from the same table; what a filament asks for is in filaments.ts.
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
/** As in the table: `sillon printers` lists them. */
export type PrinterKey = string;

export interface PrinterChoice {
  key: PrinterKey;
  /** Maker and model; the dictionary may have a better one (`printer.KEY`). */
  label: string;
  machine: Machine;
  /** Pressure advance as the maker's own slicer sets it, by filament family and nozzle. */
  advance: Advance;
}

type Advance = Record<string, Record<string, number>>;

const usual = Object.fromEntries(
  Object.entries(printerDefaults).filter(([key]) => !(ofFilament as readonly string[]).includes(key)),
) as unknown as Machine;

/** A row of the table: what differs from the usual printer, and whose it is. */
interface Row extends Partial<Machine> {
  maker?: string;
  models?: string[];
  source?: string;
  advance?: Advance;
}

function choice(
  key: PrinterKey,
  { maker = '', models: _models, source: _source, advance = {}, ...values }: Row,
): PrinterChoice {
  const machine = { ...usual, ...values };
  return { key, advance, label: machine.name.startsWith(maker) ? machine.name : `${maker} ${machine.name}`, machine };
}

/** Stands for no machine in particular. */
export const isGeneric = ({ key }: PrinterChoice): boolean => key.startsWith('generic');

/** Generic ones first, then by name. */
const all: readonly PrinterChoice[] = Object.entries(table.printers as unknown as Record<string, Row>)
  .map(([key, values]) => choice(key, values))
  .sort((a, b) => Number(isGeneric(b)) - Number(isGeneric(a)) || a.label.localeCompare(b.label, 'en'));

/** Bambu's need a start block of the owner's own, which comes from a file that their slicer made. */
const needsFile = ({ machine }: PrinterChoice): boolean => machine.flavor === 'bambu';

export const printers = all.filter((one) => !needsFile(one));
export const printersByFile = all.filter(needsFile);

/** As the core's `filamentFamily`: "PLA" for "PLA Silk" and "pla-cf". */
export const filamentFamily = (type: string): string => /^[A-Za-z]*/.exec(type)?.[0].toUpperCase() ?? '';

/** Pressure advance as the printer's maker sets it for the filament and the nozzle; off where none is known. */
function makersAdvance(printer: PrinterValues): Pick<PrinterValues, 'pressureAdvance' | 'setPressureAdvance'> {
  const value = profileOf(printer)?.advance[filamentFamily(printer.filamentType)]?.[printer.nozzle];
  return { setPressureAdvance: value !== undefined, pressureAdvance: value ?? printerDefaults.pressureAdvance };
}

/** As `followAdvance` of the core: after a change of filament or nozzle, unless it was the visitor’s own. */
export function withAdvance(plate: Plate, before: Plate): Plate {
  const { setPressureAdvance, pressureAdvance } = makersAdvance(before.printer);
  const own =
    setPressureAdvance !== before.printer.setPressureAdvance || pressureAdvance !== before.printer.pressureAdvance;
  return own ? plate : { ...plate, printer: { ...plate.printer, ...makersAdvance(plate.printer) } };
}

/** The plate on another printer; the nozzle and what the filament asks for stay. */
export function withPrinter(plate: Plate, key: PrinterKey): Plate {
  const chosen = printers.find((one) => one.key === key);
  if (chosen === undefined) throw new Error(`there is no printer ${key}`);
  const { nozzle } = plate.printer;
  const printer = { ...without(plate.printer, 'profile'), ...structuredClone(chosen.machine), nozzle };
  return { ...plate, printer: { ...printer, ...makersAdvance(printer) } };
}

/** Chosen for a print, not what a machine is. */
export const ofPrint: readonly string[] = ['nozzle', 'speed', 'firstLayerSpeed', ...ofFilament];

/** By all values of the machine: a name is quickly written. */
export const sameMachine = (a: Machine, b: Machine): boolean =>
  Object.keys(usual).every(
    (key) =>
      ofPrint.includes(key) || JSON.stringify(a[key as keyof Machine]) === JSON.stringify(b[key as keyof Machine]),
  );

/** undefined: of its own making, as from a project file. */
export const profileOf = (printer: Machine): PrinterChoice | undefined =>
  printers.find(({ machine }) => sameMachine(machine, printer));

/** Returns whether these are the values of no machine in particular. */
export function isNobodys(printer: Machine): boolean {
  const profile = profileOf(printer);
  return profile !== undefined && isGeneric(profile);
}
