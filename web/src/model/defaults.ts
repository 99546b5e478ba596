// What a plate is before anybody changes it.
import type { PrintParams, PrinterValues, ToolpathParams } from 'sillon';
import type { DirectionSource, LampPicture, Plate, ShapeSource, SourceFile } from './plate.js';

/** As docs/reference/project.md has them; a test compares. */
export const toolpathDefaults: Readonly<ToolpathParams> = {
  spacing: 0.4,
  spacingVariation: 0.3,
  perimeterMode: 'count',
  perimeters: 1,
  bridge: null,
  mapFilter: 'average',
  seed: 0,
  jitter: 0.025,
  phaseTransport: 'midpoint',
  sweepsPerLevel: 8,
  directionTolerance: 0,
  kernelRadius: 1,
  borderWeight: 1,
  stitchAlignment: 1.1,
  relaxationRounds: 2,
  relaxationStrength: 0.08,
  relaxationSmoothing: 0.65,
  widthBalance: 1,
  beadOverlap: 0.0021,
  minWidth: 0.5,
  maxWidth: 2,
  simplifyTolerance: 0.0013,
};

export const printDefaults: Readonly<Omit<PrintParams, 'date'>> = {
  layers: 1,
  base: 2,
  basePattern: 'hatched',
  showSide: 'up',
  skirt: 1,
  brim: 0,
  elephantFoot: 0.1,
  constantFlow: false,
  strict: false,
  coast: 0,
  scarf: 0,
  copies: [1, 1],
  copyGap: 10,
  layerHeight: 0.2,
  startHeight: 0,
  firstLayerHeight: 0,
  flow: 0.95,
  baseFlow: 1,
  bedFlow: 1,
  basePerimeters: 1,
  purgeLength: 10,
  rotate: 0,
  mirror: false,
  place: null,
};

export const printerDefaults: Readonly<PrinterValues> = {
  name: 'Generic',
  flavor: 'marlin',
  bedMin: [0, 0],
  bedMax: [220, 220],
  roundBed: false,
  excludedMin: [0, 0],
  excludedMax: [0, 0],
  maxZ: 200,
  nozzle: 0.4,
  filamentDiameter: 1.75,
  filamentDensity: 1.24,
  filamentType: 'PLA',
  nozzleTemperature: 215,
  firstLayerNozzleTemperature: 220,
  bedTemperature: 60,
  speed: 50,
  firstLayerSpeed: 20,
  baseSpeed: 0,
  showSpeed: 0,
  firstLayerAcceleration: 0,
  firstLayerFan: 0,
  baseFan: -1,
  showFan: -1,
  minLayerTime: 8,
  travelSpeed: 120,
  acceleration: 1000,
  machineAcceleration: 0,
  machineSpeed: 0,
  anyTemperature: false,
  cornerSpeed: 5,
  machineCornerSpeed: 0,
  curveAcceleration: 1000,
  maxFlow: 10,
  maxSegmentsPerSecond: 300,
  pressureAdvance: 0.04,
  setPressureAdvance: false,
  retractLength: 0.8,
  retractSpeed: 35,
  lift: 0.4,
  absoluteE: false,
  startGcode: '',
  endGcode: '',
  screenSizes: '32x32, 300x300',
};

type Generated = { [Kind in DirectionSource['kind']]: Extract<DirectionSource, { kind: Kind }> };

/** Each kind of directions as it is first chosen. */
const directions: { [Kind in keyof Generated]: Omit<Generated[Kind], 'file' | 'pictures'> } = {
  angle: { kind: 'angle', angle: 0 },
  lamp: { kind: 'lamp', lampSize: 0.1, smoothness: 0.05, localContrast: 0 },
  map: { kind: 'map', encoding: 'angle' },
  // Under the light from 60° that the appearance begins with, bright is bright.
  tone: { kind: 'tone', from: 60, to: 150, invert: false, contrast: 1, smoothing: 0.004 },
  edges: { kind: 'edges', smoothing: 0.01, across: false },
  levels: { kind: 'levels', dark: 0, light: 90, threshold: 0.5, invert: false },
  text: { kind: 'text', text: 'Sillon', font: 'sans-serif', bold: true, size: 0.3, letters: 90, ground: 0 },
  qr: { kind: 'qr', text: 'SILLON', dark: 0, light: 90, margin: 2 },
  radial: { kind: 'radial', centre: [0.5, 0.5], angle: 0 },
  spiral: { kind: 'spiral', centre: [0.5, 0.5], turns: 3, angle: 0 },
  waves: { kind: 'waves', angle: 0, amplitude: 40, length: 0.35 },
  noise: { kind: 'noise', seed: 1, scale: 0.2, amplitude: 90, angle: 0 },
};

export type FileKind = 'map' | 'tone' | 'edges' | 'levels';
export type GeneratorKind = Exclude<DirectionSource['kind'], FileKind | 'lamp'>;

export const generatorKinds = ['angle', 'radial', 'spiral', 'waves', 'noise', 'text', 'qr'] as const;
export const fileKinds = ['tone', 'edges', 'levels', 'map'] as const;

export const newGenerator = <Kind extends GeneratorKind>(kind: Kind): Generated[Kind] =>
  structuredClone(directions[kind]) as unknown as Generated[Kind];

export const newFileDirections = <Kind extends FileKind>(kind: Kind, file: SourceFile): Generated[Kind] =>
  ({ ...directions[kind], file }) as unknown as Generated[Kind];

export const newLampDirections = (pictures: readonly LampPicture[]): Generated['lamp'] => ({
  ...directions.lamp,
  pictures,
});

export const newShape = (kind: Exclude<ShapeSource['kind'], 'file'>): ShapeSource =>
  kind === 'rounded' ? { kind, radius: 6 } : { kind };

/** The plate that a first visit shows. */
export const newPlate = (): Plate => ({
  name: '',
  shape: newShape('disc'),
  width: 70,
  height: 70,
  directions: newGenerator('waves'),
  modes: { base: 'constrained' },
  strokes: [],
  toolpath: { ...toolpathDefaults },
  print: structuredClone(printDefaults),
  printer: structuredClone(printerDefaults),
  filament: 'goldPla',
});
