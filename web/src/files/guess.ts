// Guesses the roles of pictures from their names and from a few figures about their pixels.
import type { Picture } from 'sillon';
import { mostPictures } from '../model/lamp.js';
import { groundFill, type Fill } from '../model/fills.js';
import type { Plate } from '../model/plate.js';
import { pictureRoles, type Role } from '../model/file-role.js';

export interface PictureFacts {
  width: number;
  height: number;
  /** True where samples have more than 8 bits, as programs write them and cameras do not. */
  deep: boolean;
  coloured: boolean;
  /** True where nearly all pixels have one of the four greys of modes, and some have a middle one. */
  modeGreys: boolean;
  /** True where red and green are a point on the unit circle, and blue carries nothing. */
  unitVectors: boolean;
  /** True where two tones explain nearly all of the picture. */
  twoTones: boolean;
  /** True where one tone fills the picture, so that nothing would be seen. */
  oneTone: boolean;
  /** True for white artwork on a transparent ground, which cannot be seen on white paper. */
  whiteOnClear: boolean;
}

// These samples suffice for all figures, so larger pictures are thinned to about as many.
const enoughSamples = 1 << 16;
const oneToneSpan = 8; // spread of tones, of 255, below which nothing would be seen

interface Sampled {
  /** Bytes of red, green and blue of each sample. */
  rgb: Uint8Array;
  /** Tone of each sample on white paper. */
  tones: Uint8Array;
  /** Opacity of each sample. */
  covers: Uint8Array;
  deep: boolean;
}

/** Samples every `step`th pixel of every `step`th row. */
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
      if (scale < 1 && (samples[k] as number) % 257 !== 0) deep = true; // samples of 8 bits come as multiples of 257
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

/** Share of each of the 256 tones. */
function histogram(tones: Uint8Array): Float64Array {
  const counts = new Float64Array(256);
  for (const tone of tones) counts[tone] = (counts[tone] as number) + 1 / tones.length;
  return counts;
}

/** Tells whether two tones explain the picture. Otsu's threshold splits the tones in two classes; the variance left
 * within both is what two tones cannot explain. */
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
  // A variance below 100 (10 tones) is too little contrast to tell two tones.
  return variance > 100 && between > 0.95 * variance;
}

/** Tells whether 99 % of the samples lie within a few steps of each other. */
function isOneTone(counts: Float64Array): boolean {
  let low = 0;
  let high = 255;
  for (let below = 0; low < 255 && (below += counts[low] as number) < 0.005; ++low);
  for (let above = 0; high > 0 && (above += counts[high] as number) < 0.005; --high);
  return high - low < oneToneSpan;
}

/** Tells whether nearly all tones are those of modes (0, 85, 170, 255), with some of the middle two. */
function areModeGreys(counts: Float64Array): boolean {
  const near = (tone: number): number => (counts[tone - 1] ?? 0) + (counts[tone] as number) + (counts[tone + 1] ?? 0);
  const middle = near(85) + near(170);
  return middle > 0.002 && middle + near(0) + near(255) > 0.998;
}

/** Tells whether red and green are points on the unit circle and blue hardly varies. */
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
    if (length < 0.1) continue; // too close to the middle to show a direction
    ++telling;
    if (Math.abs(length - 1) < 0.08) ++unit;
  }
  // Blue carries nothing if it varies by less than 5 of 255.
  return telling > 0.05 * count && unit > 0.95 * telling && blueSquare - blue * blue < 25;
}

/** The figures about a picture from which its role is guessed. */
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

/** Words in file names that name a role. */
const words: readonly [RegExp, Role][] = [
  [/^(?:tangents?|normals?|vectors?|flow)$/, 'tangent'],
  [/^(?:rotations?|rot)$/, 'rotation'],
  [/^(?:angles?|directions?|orientations?|lines?|theta)$/, 'angle'],
  [/^(?:modes?|zones?)$/, 'modes'],
  [/^(?:masks?|shapes?|outlines?|silhouettes?)$/, 'mask'],
];

/** The role that a file's name suggests. "Leaf-lineAngle_02.png" suggests 'angle'; only whole words count, so
 * "modern" does not suggest 'modes'. */
function saidBy(name: string): Role | undefined {
  const parts = name
    .replace(/\.[^.]*$/, '')
    .replace(/(\p{Ll})(\p{Lu})/gu, '$1 $2')
    .toLowerCase()
    .split(/[^a-z]+/)
    .reverse(); // the last word is the noun, so it counts first
  for (const part of parts) {
    const found = words.find(([word]) => word.test(part));
    if (found !== undefined) return found[1];
  }
  return undefined;
}

export interface Guessed {
  name: string;
  /** Figures about the picture; undefined for an SVG. */
  facts: PictureFacts | undefined;
  /** Number of flat colours in an SVG. */
  colours?: number;
}

/** Guesses the role of one file on its own. Its name decides if the colours allow that role: tangents need colour,
 * masks allow any, the others need grey. Otherwise the pixels decide. */
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

/** Fills that nobody has chosen with care, so that a drawing's own directions may replace them. */
const plain: readonly (Fill | undefined)[] = [undefined, 'direction', 'radial', 'spiral', 'waves', 'noise', 'colours'];

/** Returns the part of a plate that a role fills. Only lamps can share a part. */
const partOf = (role: Role): string =>
  role === 'shape' || role === 'mask' || role === 'colours' ? 'shape' : role === 'modes' ? 'modes' : 'directions';

/** Guesses one role for each file. A file that would fill a part a second time gets 'none'.
 * @param plate  the plate that will use the files */
export function guessRoles(files: readonly Guessed[], plate: Plate): Role[] {
  const roles = files.map(roleOf);
  const filled = (part: string): number => roles.filter((role) => partOf(role) === part).length;
  // Modes are only drawn to go with a map of angles, so a grey picture beside them is that map.
  files.forEach(({ facts }, k) => {
    const grey = facts?.coloured === false && (roles[k] === 'lamp' || roles[k] === 'levels');
    if (grey && roles.includes('modes')) roles[k] = 'angle';
  });
  // A black-and-white picture is the outline where another picture has the directions, or where the plate's map still
  // lacks a shape.
  const black = roles.indexOf('levels');
  const awaited = groundFill(plate) === 'map' && plate.shape.kind !== 'file';
  if (black >= 0 && (filled('directions') > 1 || awaited) && filled('shape') === 0) roles[black] = 'mask';
  // A drawing of several colours gives each a direction, unless another file has the directions.
  const alone = filled('directions') === 0 && plain.includes(groundFill(plate)) && plate.layers.length < 2;
  const shape = roles.indexOf('shape');
  if (alone && shape >= 0 && (files[shape]?.colours ?? 0) > 1) roles[shape] = 'colours';
  // Pictures that come together share the plate: the first is 'lamp', the next ones are 'more', up to the limit. A
  // black-and-white picture beside a lamp counts as one of them. A single picture replaces those on the plate.
  const blank = (k: number): boolean => files.length > 1 && files[k]?.facts?.oneTone === true;
  const lampGiven = roles.some((role, k) => role === 'lamp' && !blank(k));
  let pictures = 0;
  const taken = new Set<string>();
  return roles.map((role, k) => {
    const part = partOf(role);
    const isLamp = role === 'lamp' || (role === 'levels' && lampGiven);
    // A picture of one tone would not be seen beside others.
    if (isLamp && blank(k)) return 'none';
    if (isLamp && pictures > 0 && pictures < mostPictures) {
      ++pictures;
      return 'more';
    }
    if (taken.has(part)) return 'none';
    taken.add(part);
    if (!isLamp) return role;
    ++pictures;
    return 'lamp';
  });
}

/** Roles that a visitor can choose for a file. */
export const allowedRoles = (isPicture: boolean): readonly Role[] =>
  isPicture ? pictureRoles : ['shape', 'colours', 'none'];
