// A short list of printers: sizes and limits of the machines as they are sold. What a filament asks for is in filaments.ts.
import type { Printer } from 'sillon';
import { printerDefaults } from './defaults.js';
import type { Plate } from './plate.js';

type Machine = Omit<
  Printer,
  | 'filamentDensity'
  | 'filamentType'
  | 'nozzleTemperature'
  | 'firstLayerNozzleTemperature'
  | 'bedTemperature'
  | 'pressureAdvance'
  | 'setPressureAdvance'
>;

export type PrinterKey =
  | 'generic'
  | 'genericCentre'
  | 'genericKlipper'
  | 'prusaMk4s'
  | 'prusaCoreOne'
  | 'prusaMini'
  | 'prusaMk3s'
  | 'crealityEnder3'
  | 'crealityEnder3V3Se'
  | 'crealityK1'
  | 'crealityCr10sPro'
  | 'sovolSv06'
  | 'elegooNeptune4Pro'
  | 'voron24'
  | 'qidiQ1Pro'
  | 'anycubicKosselPlus';

export interface PrinterChoice {
  key: PrinterKey;
  /** A trade name; '' where the dictionary has one (`printer.KEY`). */
  label: string;
  machine: Machine;
}

const base: Machine = {
  name: printerDefaults.name,
  flavor: printerDefaults.flavor,
  bedMin: printerDefaults.bedMin,
  bedMax: printerDefaults.bedMax,
  maxZ: printerDefaults.maxZ,
  nozzle: printerDefaults.nozzle,
  filamentDiameter: printerDefaults.filamentDiameter,
  speed: printerDefaults.speed,
  firstLayerSpeed: printerDefaults.firstLayerSpeed,
  travelSpeed: printerDefaults.travelSpeed,
  acceleration: printerDefaults.acceleration,
  machineAcceleration: printerDefaults.machineAcceleration,
  cornerSpeed: printerDefaults.cornerSpeed,
  maxFlow: printerDefaults.maxFlow,
  maxSegmentsPerSecond: printerDefaults.maxSegmentsPerSecond,
  retractLength: printerDefaults.retractLength,
  retractSpeed: printerDefaults.retractSpeed,
  lift: printerDefaults.lift,
};

const printer = (key: PrinterKey, label: string, own: Partial<Machine>): PrinterChoice => ({
  key,
  label,
  machine: { ...base, name: label, ...own },
});

// Hairpins print cleanest at 1000 to 2000 mm/s², whatever the machine could do. `machineAcceleration` is put back at the
// end: only where the machine's own is known, else acceleration is left alone.
const calm = 1500;
const klipper = { flavor: 'klipper', maxSegmentsPerSecond: 1000 } as const;

export const printers: readonly PrinterChoice[] = [
  printer('generic', '', { name: 'Generic' }),
  printer('genericCentre', '', { name: 'Generic, origin in the centre', bedMin: [-110, -110], bedMax: [110, 110] }),
  printer('genericKlipper', '', { name: 'Generic Klipper', ...klipper }),
  printer('prusaMk4s', 'Prusa MK4S', {
    bedMax: [250, 210],
    maxZ: 220,
    acceleration: calm,
    machineAcceleration: 4000,
    maxFlow: 15,
    retractLength: 0.7,
  }),
  printer('prusaCoreOne', 'Prusa CORE One', {
    bedMax: [250, 220],
    maxZ: 270,
    acceleration: calm,
    machineAcceleration: 7000,
    maxFlow: 15,
    retractLength: 0.7,
  }),
  printer('prusaMini', 'Prusa MINI+', {
    bedMax: [180, 180],
    maxZ: 180,
    acceleration: calm,
    machineAcceleration: 4000,
    retractLength: 2.5,
  }),
  printer('prusaMk3s', 'Prusa MK3S+', {
    bedMax: [250, 210],
    maxZ: 210,
    machineAcceleration: 1250,
    maxSegmentsPerSecond: 150, // an 8-bit board
  }),
  printer('crealityEnder3', 'Creality Ender-3, Ender-3 V2', {
    // 5 mm along the edges are out of reach or under the clips.
    bedMin: [5, 5],
    bedMax: [215, 215],
    maxZ: 250,
    acceleration: 500,
    maxSegmentsPerSecond: 100,
    retractLength: 5, // through a Bowden tube
  }),
  printer('crealityEnder3V3Se', 'Creality Ender-3 V3 SE', {
    maxZ: 250,
    acceleration: calm,
    machineAcceleration: 2500,
    retractLength: 1.2,
  }),
  printer('crealityK1', 'Creality K1', {
    ...klipper,
    maxZ: 250,
    acceleration: calm,
    machineAcceleration: 5000,
    maxFlow: 20,
    retractLength: 0.6,
  }),
  printer('crealityCr10sPro', 'Creality CR-10S Pro, Klipper', {
    ...klipper,
    bedMax: [300, 300],
    maxZ: 400,
    retractLength: 5,
  }),
  printer('sovolSv06', 'Sovol SV06', { maxZ: 250, machineAcceleration: 1250, retractLength: 0.5 }),
  printer('elegooNeptune4Pro', 'Elegoo Neptune 4 Pro', { ...klipper, bedMax: [225, 225], maxZ: 265, maxFlow: 15 }),
  printer('voron24', 'Voron 2.4, 300 mm', { ...klipper, bedMax: [300, 300], maxZ: 260, retractLength: 0.5 }),
  printer('qidiQ1Pro', 'Qidi Q1 Pro', {
    ...klipper,
    bedMax: [245, 245],
    maxZ: 240,
    acceleration: calm,
    machineAcceleration: 5000,
    maxFlow: 20,
  }),
  printer('anycubicKosselPlus', 'Anycubic Kossel Linear Plus', {
    // The square within the round bed of radius 115 mm; its origin is the middle.
    bedMin: [-81, -81],
    bedMax: [81, 81],
    maxZ: 300,
    maxSegmentsPerSecond: 100,
    retractLength: 5,
  }),
];

/** The plate on another printer; the nozzle and what the filament asks for stay. */
export function withPrinter(plate: Plate, key: PrinterKey): Plate {
  const choice = printers.find((one) => one.key === key);
  if (choice === undefined) throw new Error(`there is no printer ${key}`);
  const { nozzle } = plate.printer;
  return { ...plate, printer: { ...plate.printer, ...structuredClone(choice.machine), nozzle } };
}

/** undefined: of its own making, as from a project file. */
export const printerOf = (plate: Plate): PrinterChoice | undefined =>
  printers.find(({ machine }) => machine.name === plate.printer.name);
