// The printers that come with the engine, from the same table; what a filament asks for is in filaments.ts.
import type { PrinterValues } from 'sillon';
import table from '../../../core/data/printers.json' with { type: 'json' };
import { printerDefaults } from './defaults.js';
import type { Plate } from './plate.js';

const ofFilament = [
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
}

const makers: Readonly<Record<string, string>> = {
  anycubic: 'Anycubic',
  creality: 'Creality',
  elegoo: 'Elegoo',
  prusa: 'Prusa',
  qidi: 'QIDI',
  sovol: 'Sovol',
};

const usual = Object.fromEntries(
  Object.entries(printerDefaults).filter(([key]) => !(ofFilament as readonly string[]).includes(key)),
) as unknown as Machine;

function choice(key: PrinterKey, values: Partial<Machine>): PrinterChoice {
  const machine = { ...usual, ...values };
  const maker = makers[key.split('-')[0] ?? ''];
  return { key, label: maker === undefined ? machine.name : `${maker} ${machine.name}`, machine };
}

const isGeneric = ({ key }: PrinterChoice): boolean => key.startsWith('generic');

/** Generic ones first, then by name. Bambu's need a start block of the owner's own: those come from a file. */
export const printers: readonly PrinterChoice[] = Object.entries(
  table.printers as unknown as Record<string, Partial<Machine>>,
)
  .map(([key, values]) => choice(key, values))
  .filter(({ machine }) => machine.flavor !== 'bambu')
  .sort((a, b) => Number(isGeneric(b)) - Number(isGeneric(a)) || a.label.localeCompare(b.label, 'en'));

/** The plate on another printer; the nozzle and what the filament asks for stay. */
export function withPrinter(plate: Plate, key: PrinterKey): Plate {
  const chosen = printers.find((one) => one.key === key);
  if (chosen === undefined) throw new Error(`there is no printer ${key}`);
  const { nozzle } = plate.printer;
  return { ...plate, printer: { ...plate.printer, ...structuredClone(chosen.machine), nozzle } };
}

/** undefined: of its own making, as from a project file. */
export const printerOf = (plate: Plate): PrinterChoice | undefined =>
  printers.find(({ machine }) => machine.name === plate.printer.name);
