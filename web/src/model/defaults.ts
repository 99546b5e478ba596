// What a plate is before anybody changes it.
import type { PictureParams, PrintParams, PrinterValues, ToolpathParams } from 'sillon';
import type {
  DirectionSource,
  FlatColour,
  LampPicture,
  Plate,
  ShapeSettings,
  ShapeSource,
  SourceFile,
} from './plate.js';
import { shapeTable, table } from './setting-table.js';

/** What the core's table of settings says. */
export const defaultsOf = <Section>(rows: Record<string, { default: unknown }>): Readonly<Section> =>
  Object.fromEntries(Object.entries(rows).map(([key, row]) => [key, row.default])) as Readonly<Section>;

export const toolpathDefaults = defaultsOf<ToolpathParams>(table.toolpath);
export const printDefaults = defaultsOf<Omit<PrintParams, 'date'>>(table.print);
export const printerDefaults = defaultsOf<PrinterValues>(table.printer);
export const pictureDefaults = defaultsOf<PictureParams>(table.pictures);

type Generated = { [Kind in DirectionSource['kind']]: Extract<DirectionSource, { kind: Kind }> };

/** Each kind of directions as it is first chosen. */
const directions: { [Kind in keyof Generated]: Omit<Generated[Kind], 'file' | 'pictures' | 'colours'> } = {
  angle: { kind: 'angle', angle: 0 },
  lamp: { kind: 'lamp' },
  map: { kind: 'map', encoding: 'angle' },
  // Under the light from 60° that the appearance begins with, bright is bright.
  tone: { kind: 'tone', from: 60, to: 150, invert: false, contrast: 1, smoothing: 0.004 },
  edges: { kind: 'edges', smoothing: 0.01, across: false },
  levels: { kind: 'levels', dark: 0, light: 90, threshold: 0.5, invert: false },
  colours: { kind: 'colours' },
  text: { kind: 'text', text: 'Sillon', font: 'sans-serif', bold: true, size: 0.3, letters: 90, ground: 0 },
  qr: { kind: 'qr', text: 'SILLON', dark: 0, light: 90, margin: 2 },
  radial: { kind: 'radial', centre: [0.5, 0.5], angle: 0 },
  spiral: { kind: 'spiral', centre: [0.5, 0.5], turns: 3, angle: 0 },
  waves: { kind: 'waves', angle: 0, amplitude: 40, length: 0.35 },
  noise: { kind: 'noise', seed: 1, scale: 0.2, amplitude: 90, angle: 0 },
};

export type FileKind = 'map' | 'tone' | 'edges' | 'levels';
export type GeneratorKind = Exclude<DirectionSource['kind'], FileKind | 'lamp' | 'colours'>;

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

export const newColours = (file: SourceFile, colours: readonly FlatColour[]): Generated['colours'] => ({
  ...directions.colours,
  file,
  colours,
});

type Unitless = ShapeSettings['unitless'];

/** Millimetres without a unit are the published scenes', which outline what they mean. */
export const usualPaint = (unitless: Unitless): ShapeSettings['paint'] => (unitless === 'mm' ? 'ignore' : 'shown');

const shapeSettings = (unitless: Unitless = 'px'): ShapeSettings => ({
  radius: shapeTable.radius.default,
  corners: shapeTable.corners.default,
  points: shapeTable.points.default,
  inner: shapeTable.inner.default,
  offset: shapeTable.offset.default,
  holes: [],
  text: '',
  font: shapeTable.font.default,
  unitless,
  paint: usualPaint(unitless),
  keepThin: false,
});

export const newShape = (kind: Exclude<ShapeSource['kind'], 'file'>): ShapeSource => ({
  kind,
  ...shapeSettings(),
  ...(kind === 'text' && { text: 'Sillon' }),
});

export const newFileShape = (file: SourceFile, unitless?: Unitless): ShapeSource => ({
  kind: 'file',
  file,
  ...shapeSettings(unitless),
});

/** The plate that a first visit shows. */
export const newPlate = (): Plate => ({
  name: '',
  shape: newShape('disc'),
  width: 70,
  height: 70,
  directions: newGenerator('waves'),
  modes: { mode: 'constrained' },
  layers: [],
  pictures: { ...pictureDefaults, spool: 'goldPla' },
  strokes: [],
  toolpath: { ...toolpathDefaults },
  print: structuredClone(printDefaults),
  printer: structuredClone(printerDefaults),
});
