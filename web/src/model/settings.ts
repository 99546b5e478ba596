// The engine's settings as rows of data, from which the panels are drawn and links are checked. Defaults and ranges are
// those of docs/reference/project.md; a test compares.
import type { PrintParams, PrinterValues, ToolpathParams } from 'sillon';
import table from 'sillon/presets.json' with { type: 'json' };
import { printDefaults, printerDefaults, toolpathDefaults } from './defaults.js';
import type { Plate } from './plate.js';

type PrintSettings = Omit<PrintParams, 'date'>;

export interface Sections {
  toolpath: ToolpathParams;
  print: PrintSettings;
  printer: PrinterValues;
}
export type SectionName = keyof Sections;

export type SettingId =
  `toolpath.${keyof ToolpathParams}` | `print.${keyof PrintSettings}` | `printer.${keyof PrinterValues}`;

/** 'spacing': multiples of the spacing. */
export type Unit = '' | 'mm' | 'mm/s' | 'mm/s²' | 'mm³/s' | 'g/cm³' | '°' | '°C' | 's' | '1/s' | '%' | 'spacing';

interface Row {
  id: SettingId;
  section: SectionName;
  key: string;
  /** Folded away at first. */
  advanced: boolean;
}

export interface NumberSetting extends Row {
  kind: 'number' | 'integer';
  unit: Unit;
  min: number;
  max: number;
  /** Of a control; the engine takes any value between. */
  step: number;
  /** What a slider spans where min to max is too much. */
  usual: [number, number];
  /** The value may be null, which has a meaning of its own, in the dictionary: `null.ID`. */
  nullable: boolean;
  default: number | null;
}

export interface ChoiceSetting extends Row {
  kind: 'choice';
  choices: readonly string[];
  default: string;
}

export interface FlagSetting extends Row {
  kind: 'flag';
  default: boolean;
}

export interface TextSetting extends Row {
  kind: 'text';
  maxLength: number;
  /** Several lines. */
  long: boolean;
  default: string;
}

export interface PairSetting extends Row {
  kind: 'pair';
  integer: boolean;
  unit: Unit;
  min: number;
  max: number;
  step: number;
  nullable: boolean;
  default: [number, number] | null;
}

export type Setting = NumberSetting | ChoiceSetting | FlagSetting | TextSetting | PairSetting;
export type SettingValue = Setting['default'];

const defaults = { toolpath: toolpathDefaults, print: printDefaults, printer: printerDefaults };

type KeyOf<Section extends SectionName, Value> = {
  [Key in keyof Sections[Section] & string]: Sections[Section][Key] extends Value ? Key : never;
}[keyof Sections[Section] & string];

function row<Section extends SectionName>(
  section: Section,
  key: keyof Sections[Section] & string,
  advanced: boolean,
): Row {
  return { id: `${section}.${key}` as SettingId, section, key, advanced };
}

function fallback(section: SectionName, key: string): unknown {
  return (defaults[section] as unknown as Record<string, unknown>)[key];
}

interface Span {
  unit?: Unit;
  min: number;
  max: number;
  step: number;
  usual?: [number, number];
  integer?: boolean;
  nullable?: boolean;
}

const advanced = true;
const basic = false;

function number<Section extends SectionName>(
  section: Section,
  key: KeyOf<Section, number | null>,
  isAdvanced: boolean,
  { unit = '', min, max, step, usual = [min, max], integer = false, nullable = false }: Span,
): NumberSetting {
  return {
    ...row(section, key, isAdvanced),
    kind: integer ? 'integer' : 'number',
    unit,
    min,
    max,
    step,
    usual,
    nullable,
    default: fallback(section, key) as number | null,
  };
}

function choice<Section extends SectionName, Key extends KeyOf<Section, string>>(
  section: Section,
  key: Key,
  isAdvanced: boolean,
  choices: readonly (Sections[Section][Key] & string)[],
): ChoiceSetting {
  return { ...row(section, key, isAdvanced), kind: 'choice', choices, default: fallback(section, key) as string };
}

function flag<Section extends SectionName>(
  section: Section,
  key: KeyOf<Section, boolean>,
  isAdvanced: boolean,
): FlagSetting {
  return { ...row(section, key, isAdvanced), kind: 'flag', default: fallback(section, key) as boolean };
}

function pair<Section extends SectionName>(
  section: Section,
  key: KeyOf<Section, [number, number] | null>,
  isAdvanced: boolean,
  { unit = '', min, max, step, integer = false, nullable = false }: Span,
): PairSetting {
  return {
    ...row(section, key, isAdvanced),
    kind: 'pair',
    integer,
    unit,
    min,
    max,
    step,
    nullable,
    default: fallback(section, key) as [number, number] | null,
  };
}

const text = (key: KeyOf<'printer', string>, isAdvanced: boolean, maxLength = 64): TextSetting => ({
  ...row('printer', key, isAdvanced),
  kind: 'text',
  maxLength,
  long: maxLength > 1024,
  default: fallback('printer', key) as string,
});

const integer = true;
const nullable = true;

export const settings: readonly Setting[] = [
  number('toolpath', 'spacing', basic, { unit: 'mm', min: 0.05, max: 20, step: 0.01, usual: [0.2, 1.2] }),
  choice('toolpath', 'perimeterMode', basic, ['none', 'soft', 'count']),
  number('toolpath', 'perimeters', basic, { min: 0, max: 100, step: 1, usual: [0, 10], integer }),
  number('toolpath', 'seed', basic, { min: 0, max: Number.MAX_SAFE_INTEGER, step: 1, usual: [0, 99], integer }),
  number('toolpath', 'jitter', advanced, { unit: 'spacing', min: 0, max: 0.25, step: 0.005 }),
  choice('toolpath', 'phaseTransport', advanced, ['midpoint', 'neighbour']),
  number('toolpath', 'sweepsPerLevel', advanced, { min: 1, max: 1000, step: 1, usual: [1, 64], integer }),
  number('toolpath', 'relaxationRounds', advanced, { min: 0, max: 100, step: 1, usual: [0, 12], integer }),
  number('toolpath', 'relaxationStrength', advanced, { min: 0, max: 0.5, step: 0.01 }),
  number('toolpath', 'relaxationSmoothing', advanced, { min: 0, max: 1, step: 0.05 }),
  number('toolpath', 'stitchAlignment', advanced, { min: 0, max: 10, step: 0.1, usual: [0, 3] }),
  number('toolpath', 'directionTolerance', advanced, { unit: '°', min: 0, max: 30, step: 1 }),
  number('toolpath', 'kernelRadius', advanced, { unit: 'spacing', min: 0.45, max: 1.5, step: 0.05 }),
  number('toolpath', 'borderWeight', advanced, { min: 0, max: 100, step: 0.5, usual: [0, 10] }),
  number('toolpath', 'widthBalance', advanced, { min: 0, max: 1, step: 0.05 }),
  number('toolpath', 'beadOverlap', advanced, { unit: 'spacing', min: 0, max: 1, step: 0.0001, usual: [0, 0.05] }),
  number('toolpath', 'minWidth', advanced, { unit: 'spacing', min: 0.1, max: 1, step: 0.05 }),
  number('toolpath', 'maxWidth', advanced, { unit: 'spacing', min: 1, max: 4, step: 0.05 }),
  number('toolpath', 'bridge', advanced, { unit: 'mm', min: 0, max: 100, step: 0.05, usual: [0, 5], nullable }),
  number('toolpath', 'spacingVariation', advanced, { min: 0, max: 0.5, step: 0.05 }),
  choice('toolpath', 'mapFilter', advanced, ['average', 'nearest']),
  number('toolpath', 'simplifyTolerance', advanced, { unit: 'mm', min: 0, max: 1, step: 0.0005, usual: [0, 0.05] }),

  number('print', 'layers', basic, { min: 1, max: 1000, step: 1, usual: [1, 10], integer }),
  number('print', 'base', basic, { min: 0, max: 1000, step: 1, usual: [0, 10], integer }),
  number('print', 'layerHeight', basic, { unit: 'mm', min: 0.05, max: 1.6, step: 0.01, usual: [0.05, 0.6] }),
  choice('print', 'basePattern', advanced, ['hatched', 'concentric', 'same']),
  number('print', 'basePerimeters', advanced, { min: 0, max: 10, step: 1, usual: [0, 4], integer }),
  choice('print', 'showSide', basic, ['up', 'bed', 'both']),
  number('print', 'brim', basic, { min: 0, max: 50, step: 1, usual: [0, 15], integer }),
  pair('print', 'copies', basic, { min: 1, max: 20, step: 1, integer }),
  flag('print', 'mirror', basic),
  number('print', 'rotate', basic, { unit: '°', min: -360, max: 360, step: 1, usual: [-180, 180] }),
  pair('print', 'place', basic, { unit: 'mm', min: -10000, max: 10000, step: 1, nullable }),
  number('print', 'startHeight', advanced, { unit: 'mm', min: 0, max: 5000, step: 0.05, usual: [0, 20] }),
  number('print', 'firstLayerHeight', advanced, { unit: 'mm', min: 0, max: 1.6, step: 0.01, usual: [0, 0.6] }),
  number('print', 'flow', advanced, { min: 0.01, max: 2, step: 0.01, usual: [0.8, 1.1] }),
  number('print', 'baseFlow', advanced, { min: 0.01, max: 2, step: 0.01, usual: [0.8, 1.1] }),
  number('print', 'bedFlow', advanced, { min: 0.01, max: 2, step: 0.01, usual: [0.8, 1.1] }),
  number('print', 'elephantFoot', advanced, { unit: 'mm', min: 0, max: 0.5, step: 0.01 }),
  flag('print', 'constantFlow', advanced),
  flag('print', 'strict', advanced),
  number('print', 'coast', advanced, { unit: 'mm', min: 0, max: 1, step: 0.05 }),
  number('print', 'scarf', advanced, { unit: 'mm', min: 0, max: 20, step: 1 }),
  number('print', 'copyGap', advanced, { unit: 'mm', min: 1, max: 100, step: 1, usual: [1, 30] }),
  number('print', 'purgeLength', advanced, { unit: 'mm', min: 0, max: 100, step: 1, usual: [0, 30] }),
  number('print', 'skirt', advanced, { min: 0, max: 20, step: 1, usual: [0, 5], integer }),

  number('printer', 'nozzle', basic, { unit: 'mm', min: 0.05, max: 2, step: 0.05, usual: [0.2, 1.2] }),
  number('printer', 'nozzleTemperature', basic, { unit: '°C', min: 0, max: 500, step: 1, usual: [190, 260] }),
  number('printer', 'bedTemperature', basic, { unit: '°C', min: 0, max: 200, step: 1, usual: [0, 100] }),
  number('printer', 'speed', basic, { unit: 'mm/s', min: 5, max: 1000, step: 1, usual: [10, 150] }),
  text('name', advanced),
  choice('printer', 'flavor', advanced, ['marlin', 'klipper', 'reprap', 'prusa', 'bambu']),
  pair('printer', 'bedMin', advanced, { unit: 'mm', min: -5000, max: 5000, step: 1 }),
  pair('printer', 'bedMax', advanced, { unit: 'mm', min: -5000, max: 5000, step: 1 }),
  flag('printer', 'roundBed', advanced),
  pair('printer', 'excludedMin', advanced, { unit: 'mm', min: -5000, max: 5000, step: 1 }),
  pair('printer', 'excludedMax', advanced, { unit: 'mm', min: -5000, max: 5000, step: 1 }),
  number('printer', 'maxZ', advanced, { unit: 'mm', min: 0.05, max: 5000, step: 1, usual: [50, 500] }),
  text('filamentType', advanced),
  number('printer', 'filamentDiameter', advanced, { unit: 'mm', min: 0.5, max: 5, step: 0.01, usual: [1.5, 3] }),
  number('printer', 'filamentDensity', advanced, { unit: 'g/cm³', min: 0.1, max: 25, step: 0.01, usual: [0.8, 2] }),
  number('printer', 'firstLayerNozzleTemperature', advanced, {
    unit: '°C',
    min: 0,
    max: 500,
    step: 1,
    usual: [190, 260],
  }),
  flag('printer', 'anyTemperature', advanced),
  number('printer', 'firstLayerSpeed', advanced, { unit: 'mm/s', min: 5, max: 1000, step: 1, usual: [5, 60] }),
  number('printer', 'baseSpeed', advanced, { unit: 'mm/s', min: 0, max: 1000, step: 1, usual: [0, 150] }),
  number('printer', 'showSpeed', advanced, { unit: 'mm/s', min: 0, max: 1000, step: 1, usual: [0, 100] }),
  number('printer', 'firstLayerAcceleration', advanced, {
    unit: 'mm/s²',
    min: 0,
    max: 100000,
    step: 50,
    usual: [0, 5000],
  }),
  number('printer', 'firstLayerFan', advanced, { unit: '%', min: 0, max: 100, step: 5 }),
  number('printer', 'baseFan', advanced, { unit: '%', min: -1, max: 100, step: 1 }),
  number('printer', 'showFan', advanced, { unit: '%', min: -1, max: 100, step: 1 }),
  number('printer', 'minLayerTime', advanced, { unit: 's', min: 0, max: 300, step: 1, usual: [0, 30] }),
  number('printer', 'travelSpeed', advanced, { unit: 'mm/s', min: 5, max: 1000, step: 1, usual: [50, 500] }),
  number('printer', 'machineSpeed', advanced, { unit: 'mm/s', min: 0, max: 1000, step: 10, usual: [0, 500] }),
  number('printer', 'acceleration', advanced, { unit: 'mm/s²', min: 1, max: 100000, step: 50, usual: [200, 10000] }),
  number('printer', 'machineAcceleration', advanced, {
    unit: 'mm/s²',
    min: 0,
    max: 100000,
    step: 50,
    usual: [0, 20000],
  }),
  number('printer', 'cornerSpeed', advanced, { unit: 'mm/s', min: 0.1, max: 100, step: 0.1, usual: [1, 20] }),
  number('printer', 'machineCornerSpeed', advanced, { unit: 'mm/s', min: 0, max: 100, step: 0.1, usual: [0, 20] }),
  number('printer', 'curveAcceleration', advanced, {
    unit: 'mm/s²',
    min: 0,
    max: 100000,
    step: 50,
    usual: [0, 5000],
  }),
  number('printer', 'maxFlow', advanced, { unit: 'mm³/s', min: 0.1, max: 1000, step: 0.5, usual: [2, 40] }),
  number('printer', 'maxSegmentsPerSecond', advanced, {
    unit: '1/s',
    min: 1,
    max: 100000,
    step: 10,
    usual: [50, 2000],
  }),
  number('printer', 'pressureAdvance', advanced, { unit: 's', min: 0, max: 2, step: 0.005, usual: [0, 0.2] }),
  flag('printer', 'setPressureAdvance', advanced),
  number('printer', 'retractLength', advanced, { unit: 'mm', min: 0, max: 20, step: 0.1, usual: [0, 8] }),
  number('printer', 'retractSpeed', advanced, { unit: 'mm/s', min: 1, max: 200, step: 1, usual: [10, 80] }),
  number('printer', 'lift', advanced, { unit: 'mm', min: 0, max: 20, step: 0.1, usual: [0, 2] }),
  flag('printer', 'absoluteE', advanced),
  text('startGcode', advanced, 65536),
  text('endGcode', advanced, 65536),
  text('screenSizes', advanced, 200),
];

/** Constants of the method, in files and presets only; those that `sillon settings --json` calls expert. */
export const expertSettings: ReadonlySet<SettingId> = new Set([
  'toolpath.jitter',
  'toolpath.phaseTransport',
  'toolpath.sweepsPerLevel',
  'toolpath.kernelRadius',
  'toolpath.borderWeight',
  'toolpath.stitchAlignment',
  'toolpath.relaxationRounds',
  'toolpath.relaxationStrength',
  'toolpath.relaxationSmoothing',
  'toolpath.widthBalance',
  'toolpath.beadOverlap',
  'toolpath.simplifyTolerance',
]);

const byId = new Map(settings.map((setting) => [setting.id, setting]));

export function settingOf(id: SettingId): Setting {
  const setting = byId.get(id);
  if (setting === undefined) throw new Error(`there is no setting ${id}`);
  return setting;
}

export const valueOf = (plate: Plate, { section, key }: Setting): SettingValue =>
  (plate[section] as unknown as Record<string, SettingValue>)[key] as SettingValue;

/** The plate with another value, which `accepts` has let through; the same plate where nothing changes. */
export function withValue(plate: Plate, setting: Setting, value: SettingValue): Plate {
  const { section, key } = setting;
  if (Object.is(valueOf(plate, setting), value)) return plate;
  return { ...plate, [section]: { ...plate[section], [key]: value } };
}

const within = (value: unknown, { min, max }: { min: number; max: number }): value is number =>
  typeof value === 'number' && value >= min && value <= max;

// As the engine: one line, and what G-code comments may hold is its business.
// eslint-disable-next-line no-control-regex
const controlCharacter = /[\u0000-\u001f\u007f]/;

/** Whether a value is of the setting's kind and in its range. */
export function accepts(setting: Setting, value: unknown): value is SettingValue {
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
        value.length <= setting.maxLength &&
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
const presets = table.presets as Record<keyof typeof table.presets, Preset>;

/** What any preset changes, as it is without one. The border and the seed are the person's own choice, which only
 * presets that name them change. */
const neutral: Preset = Object.fromEntries(
  Object.values(presets)
    .flatMap((preset) => Object.keys(preset) as KeyOf<'toolpath', unknown>[])
    .filter((key) => !['perimeterMode', 'perimeters', 'seed'].includes(key))
    .map((key) => [key, toolpathDefaults[key]]),
);

/** Ways to make a plate, from the engine's own table. Measured on the examples: draft halves the points, fine leaves
 * fewer hairpins and next to no kinks for up to twice the time, strict follows the directions best and leaves gaps and
 * kinks as they come. */
export const qualities = Object.fromEntries(
  Object.entries(presets).map(([name, preset]) => [name, { ...neutral, ...preset }]),
) as Record<keyof typeof presets, Preset>;

export type Quality = keyof typeof qualities;

export const withQuality = (plate: Plate, quality: Quality): Plate => ({
  ...plate,
  toolpath: { ...plate.toolpath, ...qualities[quality] },
});

/** undefined: set by hand. */
export function qualityOf(toolpath: ToolpathParams): Quality | undefined {
  const names = Object.keys(qualities) as Quality[];
  return names.find((name) =>
    Object.entries(qualities[name]).every(([key, value]) => toolpath[key as keyof ToolpathParams] === value),
  );
}

/** What suits a nozzle: beads between 0.6 and 1.6 nozzles wide can be laid, and the path's own widths vary around the
 * spacing. */
export interface NozzleAdvice {
  nozzle: number;
  /** Closest, usual, widest. */
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

/** Of the nozzle nearest to this one, scaled to it. */
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

/** Another nozzle, with the spacing and the layers that suit it. */
export function withNozzle(plate: Plate, nozzle: number): Plate {
  const { spacing, layerHeight } = adviceFor(nozzle);
  return {
    ...plate,
    toolpath: { ...plate.toolpath, spacing: spacing[1] },
    print: { ...plate.print, layerHeight, firstLayerHeight: 0 },
    printer: { ...plate.printer, nozzle },
  };
}
