// The rows of each kind of directions as data, from which the panel is drawn.
import type { DirectionSource, Plate } from '../model/plate.js';
import { table } from '../model/setting-table.js';

const { pictures } = table;

interface Row {
  key: string;
  /** In the dictionary. */
  label: string;
  get(plate: Plate): unknown;
  with(plate: Plate, value: unknown): Plate;
}
type NumberRow = Row & {
  control: 'number';
  min: number;
  max: number;
  step: number;
  usual: readonly [number, number];
  unit: string;
  integer: boolean;
};
type AngleRow = Row & { control: 'angle'; min: number; max: number };
type FlagRow = Row & { control: 'flag' };
type TextRow = Row & { control: 'text'; max: number; long: boolean };
type ChoiceRow = Row & { control: 'choice'; choices: readonly { value: string; label: string }[] };

export type SourceRow = NumberRow | AngleRow | FlagRow | TextRow | ChoiceRow;

type Part = 'directions' | 'pictures';

/** A field of the directions, or one of the two numbers in it, as a row shows it: times `scale`. */
function place(key: string, scale = 1, index?: number, part: Part = 'directions'): Omit<Row, 'label'> {
  const partOf = (plate: Plate) => plate[part] as unknown as Record<string, unknown>;
  return {
    key: index === undefined ? key : `${key}-${index}`,
    get(plate) {
      const whole = partOf(plate)[key];
      const value = index === undefined ? whole : (whole as number[])[index];
      return typeof value === 'number' ? Math.round(value * scale * 1e6) / 1e6 : value;
    },
    with(plate, value) {
      const next = typeof value === 'number' ? value / scale : value;
      const before = partOf(plate);
      const whole = index === undefined ? next : (before[key] as number[]).map((one, k) => (k === index ? next : one));
      return { ...plate, [part]: { ...before, [key]: whole } };
    },
  };
}

const angle = (key: string, label = 'field.angle'): AngleRow => ({
  ...place(key),
  control: 'angle',
  label,
  min: -360,
  max: 360,
});

interface Span {
  min: number;
  max: number;
  step: number;
  usual?: readonly [number, number];
  unit?: string;
  scale?: number;
  index?: number;
  integer?: boolean;
  part?: Part;
}

const number = (key: string, label: string, span: Span): NumberRow => ({
  ...place(key, span.scale, span.index, span.part),
  control: 'number',
  label,
  min: span.min,
  max: span.max,
  step: span.step,
  usual: span.usual ?? [span.min, span.max],
  unit: span.unit ?? '',
  integer: span.integer ?? false,
});

const percent = (key: string, label: string, max: number, min = 0, index?: number): NumberRow =>
  number(key, label, { min, max, step: 1, unit: '%', scale: 100, ...(index === undefined ? {} : { index }) });

const flag = (key: string, label: string): FlagRow => ({ ...place(key), control: 'flag', label });
const text = (label: string, max: number, long: boolean): TextRow => ({
  ...place('text'),
  control: 'text',
  label,
  max,
  long,
});
const choice = (key: string, label: string, choices: readonly (readonly [string, string])[]): ChoiceRow => ({
  ...place(key),
  control: 'choice',
  label,
  choices: choices.map(([value, name]) => ({ value, label: name })),
});

const centre = [percent('centre', 'field.centreX', 100, 0, 0), percent('centre', 'field.centreY', 100, 0, 1)];
const smoothing = number('smoothing', 'field.smoothing', {
  min: 0,
  max: 20,
  step: 0.1,
  usual: [0, 5],
  unit: '%',
  scale: 100,
});

const rows: Record<DirectionSource['kind'], readonly SourceRow[]> = {
  lamp: [
    number('smoothness', 'field.calm', {
      min: pictures.smoothness.low,
      max: pictures.smoothness.high,
      step: 0.01,
      usual: [0.01, 0.5],
      part: 'pictures',
    }),
    number('localContrast', 'field.localContrast', {
      min: 0,
      max: 100 * pictures.localContrast.high,
      step: 1,
      unit: '%',
      scale: 100,
      part: 'pictures',
    }),
  ],
  angle: [angle('angle')],
  map: [
    choice('encoding', 'field.encoding', [
      ['angle', 'field.encoding.angle'],
      ['rotation', 'field.encoding.rotation'],
      ['tangent', 'field.encoding.tangent'],
    ]),
  ],
  tone: [
    angle('from', 'field.from'),
    angle('to', 'field.to'),
    number('contrast', 'field.contrast', { min: 0.1, max: 5, step: 0.05, usual: [0.1, 3] }),
    smoothing,
    flag('invert', 'field.invert'),
  ],
  edges: [smoothing, flag('across', 'field.across')],
  levels: [
    angle('dark', 'field.dark'),
    angle('light', 'field.light'),
    percent('threshold', 'field.threshold', 100),
    flag('invert', 'field.invert'),
  ],
  colours: [], // a list of their own
  text: [
    text('field.text', 200, true),
    percent('size', 'field.textSize', 100, 2),
    choice('font', 'field.font', [
      ['sans-serif', 'field.font.sans'],
      ['serif', 'field.font.serif'],
      ['monospace', 'field.font.mono'],
    ]),
    flag('bold', 'field.bold'),
    angle('letters', 'field.letters'),
    angle('ground', 'field.ground'),
  ],
  qr: [
    text('field.qrText', 500, true),
    angle('dark', 'field.dark'),
    angle('light', 'field.light'),
    number('margin', 'field.margin', { min: 0, max: 10, step: 1, integer: true }),
  ],
  radial: [angle('angle', 'field.rayAngle'), ...centre],
  spiral: [
    number('turns', 'field.turns', { min: -50, max: 50, step: 0.5, usual: [-10, 10] }),
    angle('angle'),
    ...centre,
  ],
  waves: [
    angle('angle'),
    number('amplitude', 'field.amplitude', { min: 0, max: 180, step: 1, usual: [0, 90], unit: '°' }),
    percent('length', 'field.waveLength', 500, 2),
  ],
  noise: [
    percent('scale', 'field.scale', 200, 2),
    number('amplitude', 'field.amplitude', { min: 0, max: 360, step: 1, usual: [0, 180], unit: '°' }),
    angle('angle'),
    number('seed', 'field.seed', { min: 0, max: 1e9, step: 1, usual: [0, 99], integer: true }),
  ],
};

export const sourceRows = ({ kind }: DirectionSource): readonly SourceRow[] => rows[kind];
