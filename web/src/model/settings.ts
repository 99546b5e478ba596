// The engine's settings as rows of data: the core's table, and what a control needs besides. The panels are drawn from
// them, and links are checked against them.
import type { Layer, PictureParams, PrintParams, PrinterValues, ToolpathParams } from 'sillon';
import presetTable from 'sillon/presets.json' with { type: 'json' };
import { toolpathDefaults } from './defaults.js';
import type { Plate } from './plate.js';
import { table } from './setting-table.js';
import { withAdvance } from './printers.js';

type PrintSettings = Omit<PrintParams, 'date'>;

export interface Sections {
  pictures: PictureParams;
  toolpath: ToolpathParams;
  print: PrintSettings;
  printer: PrinterValues;
}
export type SectionName = keyof Sections;

/** Ids of all settings, except those of pictures, which have controls of their own. */
export type SettingId = {
  [Name in Exclude<SectionName, 'pictures'>]: `${Name}.${keyof Sections[Name] & string}`;
}[Exclude<SectionName, 'pictures'>];

/** Ids of the values of one layer, without its lists. A plate has several layers with each of them
 * (model/layer-settings.ts). */
export type LayerSettingId = `layers.${Exclude<keyof Layer, 'pictures' | 'colours' | 'strokes'>}`;

/** Unit of a value; 'spacing' means multiples of the spacing. */
export type Unit = '' | 'mm' | 'mm/s' | 'mm/s²' | 'mm³/s' | 'g/cm³' | '°' | '°C' | 's' | '1/s' | '%' | 'spacing';

interface Row<Id> {
  id: Id;
  section: Id extends LayerSettingId ? 'layers' : SectionName;
  key: string;
  /** True for settings that are folded away at first. */
  advanced: boolean;
}

export interface NumberSetting<Id = SettingId> extends Row<Id> {
  kind: 'number' | 'integer';
  unit: Unit;
  min: number;
  max: number;
  /** Step of the control; the engine accepts any value in between. */
  step: number;
  /** Range of the slider, where min to max would be too wide. */
  usual: [number, number];
  /** True where the value may be null, whose meaning the dictionary gives in `null.ID`. */
  nullable: boolean;
  default: number | null;
}

export interface ChoiceSetting<Id = SettingId> extends Row<Id> {
  kind: 'choice';
  choices: readonly string[];
  default: string;
}

export interface FlagSetting<Id = SettingId> extends Row<Id> {
  kind: 'flag';
  default: boolean;
}

export interface TextSetting<Id = SettingId> extends Row<Id> {
  kind: 'text';
  /** Most bytes of the text in UTF-8. */
  maxBytes: number;
  /** True for a text of several lines. */
  long: boolean;
  default: string;
}

export interface PairSetting<Id = SettingId> extends Row<Id> {
  kind: 'pair';
  integer: boolean;
  unit: Unit;
  min: number;
  max: number;
  step: number;
  nullable: boolean;
  default: [number, number] | null;
}

export type Setting<Id = SettingId> =
  NumberSetting<Id> | ChoiceSetting<Id> | FlagSetting<Id> | TextSetting<Id> | PairSetting<Id>;
export type LayerSetting = Setting<LayerSettingId>;
export type AnySetting = Setting | LayerSetting;
export type SettingValue = Setting['default'];

type Table = typeof table;
type TypeOf<Id extends SettingId> = Id extends `${infer Section extends SectionName}.${infer Key}`
  ? Table[Section][Key & keyof Table[Section]] extends { type: infer Type }
    ? Type
    : never
  : never;
type IdOf<Type> = { [Id in SettingId]: TypeOf<Id> extends Type ? Id : never }[SettingId];

/** Facts about a number that the table lacks: the step of its control and the range of its slider. */
export interface Span {
  step: number;
  usual?: [number, number];
}

const controls: Record<IdOf<'number' | 'integer' | 'pair' | 'integer pair'>, Span> = {
  'toolpath.spacing': { step: 0.01, usual: [0.2, 1.2] },
  'toolpath.perimeters': { step: 1, usual: [0, 10] },
  'toolpath.seed': { step: 1, usual: [0, 99] },
  'toolpath.jitter': { step: 0.005 },
  'toolpath.sweepsPerLevel': { step: 1, usual: [1, 64] },
  'toolpath.repulsionRounds': { step: 1, usual: [0, 12] },
  'toolpath.relaxationRounds': { step: 1, usual: [0, 12] },
  'toolpath.relaxationStrength': { step: 0.01 },
  'toolpath.relaxationSmoothing': { step: 0.05 },
  'toolpath.stitchAlignment': { step: 0.1, usual: [0, 3] },
  'toolpath.directionTolerance': { step: 1 },
  'toolpath.kernelRadius': { step: 0.05 },
  'toolpath.borderWeight': { step: 0.5, usual: [0, 10] },
  'toolpath.widthBalance': { step: 0.05 },
  'toolpath.beadOverlap': { step: 0.0001, usual: [0, 0.05] },
  'toolpath.minWidth': { step: 0.05 },
  'toolpath.maxWidth': { step: 0.05 },
  'toolpath.bridge': { step: 0.05, usual: [0, 5] },
  'toolpath.spacingVariation': { step: 0.05 },
  'toolpath.simplifyTolerance': { step: 0.0005, usual: [0, 0.05] },
  'print.layers': { step: 1, usual: [1, 10] },
  'print.base': { step: 1, usual: [0, 10] },
  'print.layerHeight': { step: 0.01, usual: [0.05, 0.6] },
  'print.basePerimeters': { step: 1, usual: [0, 4] },
  'print.rim': { step: 1, usual: [0, 15] },
  'print.rimWidth': { step: 0.1, usual: [0.4, 10] },
  'print.brim': { step: 1, usual: [0, 15] },
  'print.rotate': { step: 1, usual: [-180, 180] },
  'print.startHeight': { step: 0.05, usual: [0, 20] },
  'print.firstLayerHeight': { step: 0.01, usual: [0, 0.6] },
  'print.flow': { step: 0.01, usual: [0.8, 1.1] },
  'print.baseFlow': { step: 0.01, usual: [0.8, 1.1] },
  'print.bedFlow': { step: 0.01, usual: [0.8, 1.1] },
  'print.elephantFoot': { step: 0.01 },
  'print.coast': { step: 0.05 },
  'print.scarf': { step: 1 },
  'print.copyGap': { step: 1, usual: [1, 30] },
  'print.purgeLength': { step: 1, usual: [0, 30] },
  'print.skirt': { step: 1, usual: [0, 5] },
  'printer.nozzle': { step: 0.05, usual: [0.2, 1.2] },
  'printer.nozzleTemperature': { step: 1, usual: [190, 260] },
  'printer.bedTemperature': { step: 1, usual: [0, 100] },
  'printer.speed': { step: 1, usual: [10, 150] },
  'printer.maxZ': { step: 1, usual: [50, 500] },
  'printer.zOffset': { step: 0.01, usual: [-0.3, 0.3] },
  'printer.maxNozzleTemperature': { step: 1, usual: [230, 300] },
  'printer.maxBedTemperature': { step: 1, usual: [60, 120] },
  'printer.filamentDiameter': { step: 0.01, usual: [1.5, 3] },
  'printer.filamentDensity': { step: 0.01, usual: [0.8, 2] },
  'printer.filamentFlow': { step: 0.01, usual: [0.8, 1.1] },
  'printer.firstLayerNozzleTemperature': { step: 1, usual: [190, 260] },
  'printer.firstLayerSpeed': { step: 1, usual: [5, 60] },
  'printer.baseSpeed': { step: 1, usual: [0, 150] },
  'printer.showSpeed': { step: 1, usual: [0, 100] },
  'printer.firstLayerAcceleration': { step: 50, usual: [0, 5000] },
  'printer.firstLayerFan': { step: 5 },
  'printer.baseFan': { step: 1 },
  'printer.showFan': { step: 1 },
  'printer.minLayerTime': { step: 1, usual: [0, 30] },
  'printer.travelSpeed': { step: 1, usual: [50, 500] },
  'printer.machineSpeed': { step: 10, usual: [0, 500] },
  'printer.acceleration': { step: 50, usual: [200, 10000] },
  'printer.machineAcceleration': { step: 50, usual: [0, 20000] },
  'printer.cornerSpeed': { step: 0.1, usual: [1, 20] },
  'printer.machineCornerSpeed': { step: 0.1, usual: [0, 20] },
  'printer.curveAcceleration': { step: 50, usual: [0, 5000] },
  'printer.maxFlow': { step: 0.5, usual: [2, 40] },
  'printer.maxSegmentsPerSecond': { step: 10, usual: [50, 2000] },
  'printer.pressureAdvance': { step: 0.005, usual: [0, 0.2] },
  'printer.retractLength': { step: 0.1, usual: [0, 8] },
  'printer.retractSpeed': { step: 1, usual: [10, 80] },
  'printer.lift': { step: 0.1, usual: [0, 2] },
  'print.copies': { step: 1 },
  'print.place': { step: 1 },
  'printer.bedMin': { step: 1 },
  'printer.bedMax': { step: 1 },
  'printer.excludedMin': { step: 1 },
  'printer.excludedMax': { step: 1 },
};

export interface TableRow {
  type: string;
  level: string;
  default: unknown;
  unit?: Unit;
  low?: number;
  high?: number;
  choices?: readonly string[];
  nullable?: boolean;
  maxBytes?: number;
  /** Kinds of layers that have the value; all where left out. */
  kinds?: readonly string[];
}

/** Turns a row of the table into a setting. @param control  step and range, for a number */
export function settingFrom<Id extends SettingId | LayerSettingId>(
  section: Row<Id>['section'],
  key: string,
  entry: TableRow,
  control: Span,
): Setting<Id> {
  const id = `${section}.${key}` as Id;
  const { type, unit = '', low: min = 0, high: max = 0, choices = [], nullable = false, maxBytes = 0 } = entry;
  const row = { id, section, key, advanced: entry.level !== 'basic' };
  switch (type) {
    case 'choice':
      return { ...row, kind: type, choices, default: entry.default as string };
    case 'flag':
      return { ...row, kind: type, default: entry.default as boolean };
    case 'text':
    case 'block':
      return {
        ...row,
        kind: 'text',
        maxBytes,
        long: type === 'block',
        default: entry.default as string,
      };
  }
  const { step, usual = [min, max] } = control;
  const span = { ...row, unit, min, max, step, nullable };
  if (type === 'number' || type === 'integer') {
    return { ...span, kind: type, usual, default: entry.default as number | null };
  }
  return { ...span, kind: 'pair', integer: type === 'integer pair', default: entry.default as [number, number] | null };
}

const sections = Object.entries(table) as [SectionName, Record<string, TableRow>][];
const controlOf = (id: string): Span => (controls as Record<string, Span>)[id] ?? { step: 0.01 };
const rows = sections.flatMap(([section, entries]) =>
  Object.entries(entries).map(([key, entry]) => ({
    level: entry.level,
    setting: settingFrom<SettingId>(section, key, entry, controlOf(`${section}.${key}`)),
  })),
);

const everySetting: readonly Setting[] = rows.map(({ setting }) => setting);

/** Settings that have controls made from these rows; pictures have their own. */
export const settings: readonly Setting[] = everySetting.filter(({ section }) => section !== 'pictures');

/** Constants of the method, which only files and presets can change. */
export const expertSettings: ReadonlySet<SettingId> = new Set(
  rows
    .filter(({ level, setting }) => level === 'expert' && setting.section !== 'pictures')
    .map(({ setting }) => setting.id),
);

const byId = new Map(everySetting.map((setting) => [setting.id, setting]));

export function settingOf(id: SettingId): Setting {
  const setting = byId.get(id);
  if (setting === undefined) throw new Error(`there is no setting ${id}`);
  return setting;
}

export const valueOf = (plate: Plate, { section, key }: Setting): SettingValue =>
  (plate[section] as unknown as Record<string, SettingValue>)[key] as SettingValue;

/** The plate with another value, already checked by `accepts`; the same plate where nothing changes. */
export function withValue(plate: Plate, setting: Setting, value: SettingValue): Plate {
  const { section, key } = setting;
  if (Object.is(valueOf(plate, setting), value)) return plate;
  return { ...plate, [section]: { ...plate[section], [key]: value } };
}

const within = (value: unknown, { min, max }: { min: number; max: number }): value is number =>
  typeof value === 'number' && value >= min && value <= max;

// A text is one line, as in the engine. Characters that are special in G-code comments are left to the engine.
// eslint-disable-next-line no-control-regex
const controlCharacter = /[\u0000-\u001f\u007f]/;

/** Tells whether a value is of the setting's kind and in its range. */
export function accepts(setting: AnySetting, value: unknown): value is SettingValue {
  switch (setting.kind) {
    case 'number':
      return (value === null && setting.nullable) || within(value, setting);
    case 'integer':
      return Number.isInteger(value) && within(value, setting);
    case 'choice':
      return setting.choices.includes(value as string);
    case 'flag':
      return typeof value === 'boolean';
    case 'text':
      return (
        typeof value === 'string' &&
        new TextEncoder().encode(value).length <= setting.maxBytes &&
        !controlCharacter.test(setting.long ? value.replace(/[\t\n]/g, '') : value)
      );
    case 'pair':
      if (value === null) return setting.nullable;
      return (
        Array.isArray(value) &&
        value.length === 2 &&
        value.every((one) => within(one, setting) && (!setting.integer || Number.isInteger(one)))
      );
  }
}

type Preset = Partial<ToolpathParams>;
/** The method as published in 2023 serves comparisons on the command line and is no quality to choose here. */
type Offered = Exclude<keyof typeof presetTable.presets, 'paper-2023'>;
const presets = Object.fromEntries(
  Object.entries(presetTable.presets).filter(([name]) => name !== 'paper-2023'),
) as Record<Offered, Preset>;

/** Defaults of every parameter that any preset changes. The border and the seed are left out: they are the visitor's
 * own choice, and only presets that name them change them. */
const neutral: Preset = Object.fromEntries(
  Object.values(presetTable.presets as Record<string, Preset>)
    .flatMap((preset) => Object.keys(preset) as (keyof ToolpathParams)[])
    .filter((key) => !['perimeterMode', 'perimeters', 'seed'].includes(key))
    .map((key) => [key, toolpathDefaults[key]]),
);

/** Qualities to choose from, taken from the engine's presets. Measured on the examples, draft halves the points,
 * while fine leaves fewer U-turns and next to no kinks for up to twice the time. */
export const qualities = Object.fromEntries(
  Object.entries(presets).map(([name, preset]) => [name, { ...neutral, ...preset }]),
) as Record<keyof typeof presets, Preset>;

export type Quality = keyof typeof qualities;

export const withQuality = (plate: Plate, quality: Quality): Plate => ({
  ...plate,
  toolpath: { ...plate.toolpath, ...qualities[quality] },
});

/** The quality whose parameters these are; undefined where they were set by hand. */
export function qualityOf(toolpath: ToolpathParams): Quality | undefined {
  const names = Object.keys(qualities) as Quality[];
  return names.find((name) =>
    Object.entries(qualities[name]).every(([key, value]) => toolpath[key as keyof ToolpathParams] === value),
  );
}

/** Values that suit a nozzle. Beads can be between 0.6 and 1.6 nozzles wide, and the path's own widths vary around
 * the spacing. */
export interface NozzleAdvice {
  nozzle: number;
  /** Closest, usual and widest spacing [mm]. */
  spacing: [number, number, number];
  layerHeight: number;
}

export const nozzleAdvice: readonly NozzleAdvice[] = [
  { nozzle: 0.2, spacing: [0.18, 0.2, 0.25], layerHeight: 0.1 },
  { nozzle: 0.25, spacing: [0.22, 0.25, 0.32], layerHeight: 0.12 },
  { nozzle: 0.4, spacing: [0.35, 0.4, 0.5], layerHeight: 0.2 },
  { nozzle: 0.6, spacing: [0.55, 0.6, 0.75], layerHeight: 0.3 },
  { nozzle: 0.8, spacing: [0.7, 0.8, 1], layerHeight: 0.4 },
  { nozzle: 1, spacing: [0.9, 1, 1.25], layerHeight: 0.5 },
];

const cents = (value: number): number => Math.round(value * 100) / 100;

/** Advice for the nearest listed nozzle, scaled to this one. */
export function adviceFor(nozzle: number): NozzleAdvice {
  const away = (advice: NozzleAdvice): number => Math.abs(Math.log(advice.nozzle / nozzle));
  const nearest = nozzleAdvice.reduce((best, advice) => (away(advice) < away(best) ? advice : best));
  const scale = nozzle / nearest.nozzle;
  const [closest, usual, widest] = nearest.spacing;
  return {
    nozzle,
    spacing: [cents(closest * scale), cents(usual * scale), cents(widest * scale)],
    layerHeight: Math.max(0.05, cents(nearest.layerHeight * scale)),
  };
}

/** The plate with another nozzle, and the spacing and layer height that suit it. */
export function withNozzle(plate: Plate, nozzle: number): Plate {
  const { spacing, layerHeight } = adviceFor(nozzle);
  const changed = {
    ...plate,
    toolpath: { ...plate.toolpath, spacing: spacing[1] },
    print: { ...plate.print, layerHeight, firstLayerHeight: 0 },
    printer: { ...plate.printer, nozzle },
  };
  return withAdvance(changed, plate);
}
