// What a picture is probably for, by its name and by a few figures of its pixels.
import type { Picture } from 'sillon';
import { mostPictures } from '../model/lamp.js';
import { groundFill, type Fill } from '../model/fills.js';
import type { Plate } from '../model/plate.js';
import type { Role } from '../model/file-role.js';

export interface PictureFacts {
  width: number;
  height: number;
  /** Samples that 8 bits could not tell: as programs write them, not cameras. */
  deep: boolean;
  coloured: boolean;
  /** Nothing but the four greys of modes, and one of the middle ones among them. */
  modeGreys: boolean;
  /** Red and green are a point of the unit circle, blue tells nothing. */
  unitVectors: boolean;
  /** Next to nothing but two tones. */
  twoTones: boolean;
  /** Nothing that could be seen: one tone all over. */
  oneTone: boolean;
  /** Nothing that could be seen on white paper, as it is drawn in white on a transparent ground. */
  whiteOnClear: boolean;
}

const enoughSamples = 1 << 16;
const oneToneSpan = 8; // of 255

interface Sampled {
  /** Bytes: red, green, blue of each sample. */
  rgb: Uint8Array;
  /** On white paper. */
  tones: Uint8Array;
  /** Opacity of each. */
  covers: Uint8Array;
  deep: boolean;
}

/** Every `step`th pixel of every `step`th row. */
function sampled({ width, height, channels, samples }: Picture): Sampled {
  const step = Math.max(1, Math.ceil(Math.sqrt((width * height) / enoughSamples)));
  const scale = samples instanceof Uint16Array ? 1 / 257 : 1;
  const count = Math.ceil(width / step) * Math.ceil(height / step);
  const rgb = new Uint8Array(3 * count);
  const tones = new Uint8Array(count);
  const covers = new Uint8Array(count).fill(255);
  let n = 0;
  let deep = false;
  for (let y = 0; y < height; y += step) {
    for (let x = 0; x < width; x += step, ++n) {
      const k = (y * width + x) * channels;
      if (scale < 1 && (samples[k] as number) % 257 !== 0) deep = true; // 8 bits are told as multiples
      const byte = (channel: number): number => Math.round((samples[k + channel] as number) * scale);
      const grey = channels < 3;
      const [r, g, b] = [byte(0), byte(grey ? 0 : 1), byte(grey ? 0 : 2)];
      rgb.set([r, g, b], 3 * n);
      if (channels % 2 === 0) covers[n] = byte(channels - 1);
      const cover = (covers[n] as number) / 255;
      tones[n] = Math.round((0.2126 * r + 0.7152 * g + 0.0722 * b) * cover + 255 * (1 - cover));
    }
  }
  return { rgb, tones, covers, deep };
}

function histogram(tones: Uint8Array): Float64Array {
  const counts = new Float64Array(256);
  for (const tone of tones) counts[tone] = (counts[tone] as number) + 1 / tones.length;
  return counts;
}

/** Otsu's threshold parts the tones in two; what variance is then left within both is what two tones cannot tell. */
function areTwoTones(counts: Float64Array): boolean {
  let mean = 0;
  let square = 0;
  counts.forEach((share, tone) => {
    mean += share * tone;
    square += share * tone * tone;
  });
  const variance = square - mean * mean;
  let between = 0;
  let low = 0;
  let lowSum = 0;
  for (let tone = 0; tone < 255; ++tone) {
    low += counts[tone] as number;
    lowSum += (counts[tone] as number) * tone;
    if (low < 0.005 || low > 0.995) continue;
    between = Math.max(between, (mean * low - lowSum) ** 2 / (low * (1 - low)));
  }
  return variance > 100 && between > 0.95 * variance;
}

/** 99 % of the samples within a few steps of each other. */
function isOneTone(counts: Float64Array): boolean {
  let low = 0;
  let high = 255;
  for (let below = 0; low < 255 && (below += counts[low] as number) < 0.005; ++low);
  for (let above = 0; high > 0 && (above += counts[high] as number) < 0.005; --high);
  return high - low < oneToneSpan;
}

function areModeGreys(counts: Float64Array): boolean {
  const near = (tone: number): number => (counts[tone - 1] ?? 0) + (counts[tone] as number) + (counts[tone + 1] ?? 0);
  const middle = near(85) + near(170);
  return middle > 0.002 && middle + near(0) + near(255) > 0.998;
}

function areUnitVectors(rgb: Uint8Array): boolean {
  let telling = 0;
  let unit = 0;
  let blue = 0;
  let blueSquare = 0;
  const count = rgb.length / 3;
  for (let k = 0; k < rgb.length; k += 3) {
    const x = ((rgb[k] as number) - 127.5) / 127.5;
    const y = ((rgb[k + 1] as number) - 127.5) / 127.5;
    const z = rgb[k + 2] as number;
    const length = Math.hypot(x, y);
    blue += z / count;
    blueSquare += (z * z) / count;
    if (length < 0.1) continue; // says nothing
    ++telling;
    if (Math.abs(length - 1) < 0.08) ++unit;
  }
  return telling > 0.05 * count && unit > 0.95 * telling && blueSquare - blue * blue < 25;
}

export function factsOf(picture: Picture): PictureFacts {
  const { width, height } = picture;
  const { rgb, tones, covers, deep } = sampled(picture);
  let colourful = 0;
  for (let k = 0; k < rgb.length; k += 3) {
    const [r = 0, g = 0, b = 0] = rgb.subarray(k, k + 3);
    if (Math.max(r, g, b) - Math.min(r, g, b) > 6) ++colourful;
  }
  const coloured = colourful > 0.01 * (rgb.length / 3);
  const counts = histogram(tones);
  const oneTone = isOneTone(counts);
  return {
    width,
    height,
    deep,
    coloured,
    modeGreys: !coloured && areModeGreys(counts),
    unitVectors: coloured && areUnitVectors(rgb),
    twoTones: areTwoTones(counts),
    oneTone,
    whiteOnClear: oneTone && !isOneTone(histogram(covers)),
  };
}

/** A word of the name that tells, and the roles that it stands for. */
const words: readonly [RegExp, Role][] = [
  [/^(?:tangents?|normals?|vectors?|flow)$/, 'tangent'],
  [/^(?:rotations?|rot)$/, 'rotation'],
  [/^(?:angles?|directions?|orientations?|lines?|theta)$/, 'angle'],
  [/^(?:modes?|zones?)$/, 'modes'],
  [/^(?:masks?|shapes?|outlines?|silhouettes?)$/, 'mask'],
];

/** "Leaf-lineAngle_02.png" says angle, and no modern house a mode. */
function saidBy(name: string): Role | undefined {
  const parts = name
    .replace(/\.[^.]*$/, '')
    .replace(/(\p{Ll})(\p{Lu})/gu, '$1 $2')
    .toLowerCase()
    .split(/[^a-z]+/)
    .reverse(); // the last word is the noun
  for (const part of parts) {
    const found = words.find(([word]) => word.test(part));
    if (found !== undefined) return found[1];
  }
  return undefined;
}

export interface Guessed {
  name: string;
  /** undefined: SVG. */
  facts: PictureFacts | undefined;
  /** Of an SVG: how many flat colours it has. */
  colours?: number;
}

function roleOf({ name, facts }: Guessed): Role {
  if (facts === undefined) return 'shape';
  const said = saidBy(name);
  const possible = said === 'tangent' ? facts.coloured : said === 'mask' || !facts.coloured;
  if (said !== undefined && possible) return said;
  if (facts.modeGreys) return 'modes';
  if (facts.unitVectors) return 'tangent';
  if (facts.deep && !facts.coloured) return 'angle';
  return facts.twoTones ? 'levels' : 'lamp';
}

/** Directions that nobody chose with care: a drawing's own may take their place. */
const plain: readonly (Fill | undefined)[] = [undefined, 'direction', 'radial', 'spiral', 'waves', 'noise', 'colours'];

/** Which part of a plate a role fills; each can be filled once. */
const partOf = (role: Role): string =>
  role === 'shape' || role === 'mask' || role === 'colours' ? 'shape' : role === 'modes' ? 'modes' : 'directions';

/** One role for each file; what would fill a part a second time gets none. @param plate  that they will be put into */
export function guessRoles(files: readonly Guessed[], plate: Plate): Role[] {
  const roles = files.map(roleOf);
  const filled = (part: string): number => roles.filter((role) => partOf(role) === part).length;
  // Nobody draws modes but over angles.
  files.forEach(({ facts }, k) => {
    const grey = facts?.coloured === false && (roles[k] === 'lamp' || roles[k] === 'levels');
    if (grey && roles.includes('modes')) roles[k] = 'angle';
  });
  // Beside another picture of directions, black and white is the outline; and so where a map waits for one.
  const black = roles.indexOf('levels');
  const awaited = groundFill(plate) === 'map' && plate.shape.kind !== 'file';
  if (black >= 0 && (filled('directions') > 1 || awaited) && filled('shape') === 0) roles[black] = 'mask';
  // A drawing of several colours has a direction for each, unless something else tells directions.
  const alone = filled('directions') === 0 && plain.includes(groundFill(plate)) && plate.layers.length < 2;
  const shape = roles.indexOf('shape');
  if (alone && shape >= 0 && (files[shape]?.colours ?? 0) > 1) roles[shape] = 'colours';
  // Pictures that come together get a lamp each, as long as there is room; one alone takes the place of those on the plate.
  let pictures = 0;
  const taken = new Set<string>();
  return roles.map((role, k) => {
    const part = partOf(role);
    const seen = role === 'lamp' || (role === 'levels' && pictures > 0);
    // Nothing of it would be seen beside others.
    if (files.length > 1 && files[k]?.facts?.oneTone && seen) return 'none';
    if (seen && pictures > 0 && pictures < mostPictures) {
      ++pictures;
      taken.add(part);
      return 'more';
    }
    if (taken.has(part)) return 'none';
    taken.add(part);
    if (seen) ++pictures;
    return role;
  });
}

const pictureRoles = [
  'lamp',
  'more',
  'mask',
  'tone',
  'edges',
  'levels',
  'colours',
  'angle',
  'rotation',
  'tangent',
  'modes',
  'none',
] as const;

export const allowedRoles = (isPicture: boolean): readonly Role[] =>
  isPicture ? pictureRoles : ['shape', 'colours', 'none'];
