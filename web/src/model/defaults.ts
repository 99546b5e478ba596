// Values of a plate before anybody changes it.
import type { PictureParams, PrintParams, PrinterValues, ToolpathParams } from 'sillon';
import type { ShapeSettings, ShapeSource, SourceFile } from './plate.js';
import { shapeTable, table } from './setting-table.js';

/** Defaults of a section, read from the core's table of settings. */
export const defaultsOf = <Section>(rows: Record<string, { default: unknown }>): Readonly<Section> =>
  Object.fromEntries(Object.entries(rows).map(([key, row]) => [key, row.default])) as Readonly<Section>;

export const toolpathDefaults = defaultsOf<ToolpathParams>(table.toolpath);
export const printDefaults = defaultsOf<Omit<PrintParams, 'date'>>(table.print);
export const printerDefaults = defaultsOf<PrinterValues>(table.printer);
export const pictureDefaults = defaultsOf<PictureParams>(table.pictures);

type Unitless = ShapeSettings['unitless'];

/** The usual treatment of paint in a drawing. Drawings with unitless millimetres are the published scenes, whose
 * outlines alone count. */
export const usualPaint = (unitless: Unitless): ShapeSettings['paint'] => (unitless === 'mm' ? 'ignore' : 'shown');

/** First settings of any shape. */
const shapeSettings = (unitless: Unitless = 'px'): ShapeSettings => ({
  radius: shapeTable.radius.default,
  corners: shapeTable.corners.default,
  points: shapeTable.points.default,
  inner: shapeTable.inner.default,
  offset: shapeTable.offset.default,
  holes: [],
  text: '',
  font: shapeTable.font.default,
  weight: shapeTable.weight.default,
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
