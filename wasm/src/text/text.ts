// Shapes letters and makes QR codes with the libraries of the native program. Built into one file of its own
// (dist/engine/text.js), which only plates with texts or codes load.
import * as hb from 'harfbuzzjs';
import generator from 'nayuki-qr-code-generator';
import { letterLimits } from '../facts.js';
import { textRuns, type TextRun } from './text-runs.js';

export { textRuns };

// The package has types of a CommonJS module, although it is none.
const { QrCode } = generator as unknown as typeof generator.default;

const { usualCapHeight, mostPathBytes, mostLackedTold } = letterLimits;

let started: Promise<void> | undefined;

/** Starts HarfBuzz, once: engines share this module, and a second start would leave existing objects in another
 * memory.
 * @param wasm  returns harfbuzz.wasm */
export async function start(wasm: () => Promise<Uint8Array>): Promise<void> {
  // vite.text.config.js adds `start`, so that the import itself starts nothing.
  const { start: begin } = hb as unknown as { start: (wasm: Uint8Array) => Promise<void> };
  started ??= wasm().then(begin);
  started.catch(() => (started = undefined)); // lets the next call try again
  await started;
}

/** Map from the points of a glyph to those of the letter of which it is a part: xx, yx, xy, yy, dx, dy. */
type Affine = [number, number, number, number, number, number];

const times = ([xx, yx, xy, yy, dx, dy]: Affine, [b, c, d, e, f, g]: Affine): Affine => [
  xx * b + xy * c,
  yx * b + yy * c,
  xx * d + xy * e,
  yx * d + yy * e,
  xx * f + xy * g + dx,
  yx * f + yy * g + dy,
];

interface Pen {
  path: string[];
  scale: number;
  /** Transforms of the nested parts, innermost last. */
  places: Affine[];
  /** Total length of `path` [bytes]. */
  size: number;
}

/** Makes the functions by which HarfBuzz writes an outline as path data. */
function pathWriter(): hb.DrawFuncs {
  const funcs = new hb.DrawFuncs();
  const writer =
    (command: string) =>
    (...values: unknown[]): void => {
      const pen = values.at(-2) as Pen;
      const [xx, yx, xy, yy, dx, dy] = pen.places.at(-1) as Affine;
      let written = command;
      for (let k = 0; k + 2 < values.length; k += 2) {
        const [x, y] = [values[k] as number, values[k + 1] as number];
        written += `${(xx * x + xy * y + dx) * pen.scale} ${(yx * x + yy * y + dy) * pen.scale} `;
      }
      pen.path.push(written);
      pen.size += written.length;
    };
  funcs.setMoveToFunc(writer('M'));
  funcs.setLineToFunc(writer('L'));
  funcs.setQuadraticToFunc(writer('Q'));
  funcs.setCubicToFunc(writer('C'));
  funcs.setClosePathFunc(writer('Z'));
  return funcs;
}

/** Collects the parts that fonts in colour lay over one another; their union counts, because all get the same
 * plastic. */
function partsWriter(writer: hb.DrawFuncs): hb.PaintFuncs {
  const funcs = new hb.PaintFuncs();
  funcs.setPushTransformFunc((xx, yx, xy, yy, dx, dy, pen) => {
    const { places } = pen as Pen;
    places.push(times(places.at(-1) as Affine, [xx, yx, xy, yy, dx, dy]));
  });
  funcs.setPopTransformFunc((pen) => {
    const { places } = pen as Pen;
    if (places.length > 1) places.pop();
  });
  funcs.setPushClipGlyphFunc((glyph, font, pen) => {
    if ((pen as Pen).size <= mostPathBytes) font.drawGlyph(glyph, writer, pen);
  });
  return funcs;
}

/** Returns the height of H. */
function capHeightOf(font: hb.Font, em: number): number {
  const glyph = font.nominalGlyph(0x48);
  const height = glyph === undefined || glyph === 0 ? 0 : -(font.glyphExtents(glyph)?.height ?? 0);
  return height > 0 ? height : usualCapHeight * em;
}

/** Returns the heights from which the base lines of drawings follow. */
function heightsOf(font: hb.Font) {
  const { ascender, descender } = font.hExtents();
  return { xHeight: font.getMetricPosition(hb.MetricsTag.X_HEIGHT) ?? 0, ascent: ascender, descent: -descender };
}

interface OpenFont {
  font: hb.Font;
  em: number;
  capHeight: number;
  /** Outlines that were drawn for lines of this font, by glyph. Drawing them takes most of the time of short lines. */
  paths: Map<number, string>;
  /** Bytes of outlines that may still be kept. */
  room: number;
}

function drawn({ font }: OpenFont, glyph: number, scale: number): string {
  const pen: Pen = { path: [], scale, places: [[1, 0, 0, 1, 0, 0]], size: 0 };
  const writer = (held.writer ??= pathWriter());
  if (!font.paintGlyphOrFail(glyph, (held.parts ??= partsWriter(writer)), pen)) font.drawGlyph(glyph, writer, pen);
  return pen.path.join('');
}

/** Returns a glyph's outline at the font's own scale, and keeps it if there is room. */
function keptPath(open: OpenFont, glyph: number): string {
  const known = open.paths.get(glyph);
  if (known !== undefined) return known;
  const path = drawn(open, glyph, 1);
  if (path.length <= open.room) {
    open.paths.set(glyph, path);
    open.room -= path.length;
  }
  return path;
}

/** Objects in HarfBuzz's memory. JavaScript's collector frees them, and a whole memory that forget() has left. All lines
 * share one buffer, and each file is opened once for each weight. */
let held = { fonts: new WeakMap<Uint8Array, Map<number, OpenFont | undefined>>() } as {
  fonts: WeakMap<Uint8Array, Map<number, OpenFont | undefined>>;
  buffer?: hb.Buffer;
  writer?: hb.DrawFuncs;
  parts?: hb.PaintFuncs;
};

/** Leaves a memory that is broken or full; the next start makes another. */
export function forget(): void {
  started = undefined;
  held = { fonts: new WeakMap() };
}

/** Opens a font at a weight, or returns the one that is open; undefined if the file is no font. */
function opened(file: Uint8Array, weight: number): OpenFont | undefined {
  const known = held.fonts.get(file) ?? new Map<number, OpenFont | undefined>();
  held.fonts.set(file, known);
  if (known.has(weight)) return known.get(weight);
  const face = new hb.Face(new hb.Blob(file));
  // HarfBuzz makes an empty face of any bytes; a file without these tables is no font.
  const none = face.referenceTable('maxp') === undefined || face.referenceTable('cmap') === undefined;
  const font = new hb.Font(face);
  if (weight > 0) font.setVariations([new hb.Variation('wght', weight)]);
  const capHeight = capHeightOf(font, face.upem);
  const open = none ? undefined : { font, em: face.upem, capHeight, paths: new Map(), room: mostPathBytes };
  known.set(weight, open);
  return open;
}

interface Glyph {
  id: number;
  letter: number;
  offset: [number, number];
  advance: number;
}

interface Cluster {
  glyphs: Glyph[];
  begin: number;
  end: number;
}

/** Groups glyphs by their letters. @param glyphs  glyphs of a run, from left to right */
function clustersOf(glyphs: Glyph[], run: TextRun): Cluster[] {
  const clusters: Cluster[] = [];
  for (const glyph of glyphs) {
    const before = clusters.at(-1);
    if (before?.begin === glyph.letter) {
      before.glyphs.push(glyph);
      continue;
    }
    // The letters of a cluster end where those of the next cluster begin.
    const end = run.toLeft && before !== undefined ? before.begin : run.end;
    if (!run.toLeft && before !== undefined) before.end = glyph.letter;
    clusters.push({ glyphs: [glyph], begin: glyph.letter, end });
  }
  return clusters;
}

const unseen = /[\p{Zs}\p{Cf}\p{Variation_Selector}]/u;
const inkless = /[\p{Zs}\p{Cf}\p{M}\u115F\u1160\u2800\u3164\uFFA0\u{1D159}]/u;

/** Thrown if the outlines have too many curves. */
class TooDetailed extends Error {}

/** Sets a line, like LineSetter of core/src/text/shape_line_here.cpp. */
class LineSetter {
  readonly letters: number[][] = [];
  readonly outlines: string[] = [];
  readonly lacked: [letter: string, font: string, picture: boolean][] = [];
  lacks = false;
  readonly #line: string;
  readonly #fonts: { name: string; open: OpenFont; outlines: Map<number, number> }[];
  #length = 0;

  constructor(line: string, fonts: { name: string; open: OpenFont }[]) {
    this.#line = line.replace(/[\p{Cc}\u2028\u2029]/gu, ' ');
    this.#fonts = fonts.map((font) => ({ ...font, outlines: new Map() }));
  }

  set(): void {
    for (const run of textRuns(this.#line)) this.#setRun(run, 0);
  }

  /** Shapes a run with font k; glyphs come from left to right. */
  #shape(k: number, { begin, end, toLeft }: TextRun): Glyph[] {
    const font = this.#fonts[k]?.open.font;
    if (font === undefined) return [];
    const buffer = (held.buffer ??= new hb.Buffer());
    buffer.reset();
    // The shaper looks at five letters on either side. Passing the whole line would copy it for each run.
    const before = Math.max(0, begin - 10);
    buffer.addText(this.#line.slice(before, end + 10), begin - before, end - begin);
    buffer.setDirection(toLeft ? hb.Direction.RTL : hb.Direction.LTR);
    buffer.setLanguage('und');
    buffer.setFlags(hb.BufferFlag.REMOVE_DEFAULT_IGNORABLES);
    buffer.guessSegmentProperties();
    hb.shape(font, buffer);
    const places = buffer.getGlyphPositions();
    const scale = this.#scaleOf(k);
    return buffer.getGlyphInfos().map(({ codepoint, cluster }, g) => {
      const { xOffset = 0, yOffset = 0, xAdvance = 0 } = places[g] ?? {};
      return {
        id: codepoint,
        letter: before + cluster,
        offset: [xOffset * scale, yOffset * scale],
        advance: xAdvance * scale,
      };
    });
  }

  #scaleOf(k: number): number {
    const [own, font] = [this.#fonts[0]?.open, this.#fonts[k]?.open];
    return k === 0 || own === undefined || font === undefined ? 1 : own.capHeight / font.capHeight;
  }

  /** Returns the index of a glyph's outline, which is drawn if it is new. */
  #outlineOf(k: number, glyph: number): number {
    const font = this.#fonts[k];
    const known = font?.outlines.get(glyph);
    if (font === undefined || known !== undefined) return known ?? 0;
    const path = k === 0 ? keptPath(font.open, glyph) : drawn(font.open, glyph, this.#scaleOf(k));
    font.outlines.set(glyph, this.outlines.length);
    this.#length += path.length;
    if (this.#length > mostPathBytes) throw new TooDetailed();
    return this.outlines.push(path) - 1;
  }

  /** Sets a run. Letters that font k lacks come from the fonts behind it. */
  #setRun(run: TextRun, k: number): void {
    const clusters = clustersOf(this.#shape(k, run), run);
    for (let c = 0; c < clusters.length;) {
      const lacking: TextRun = { begin: run.end, end: run.begin, toLeft: run.toLeft };
      const from = c;
      let drawn: Cluster | undefined;
      for (; c < clusters.length; ++c) {
        const cluster = clusters[c] as Cluster;
        if (this.#draws(k, cluster)) {
          drawn = cluster;
          break;
        }
        lacking.begin = Math.min(lacking.begin, cluster.begin);
        lacking.end = Math.max(lacking.end, cluster.end);
      }
      const left = clusters.slice(from, c);
      if (left.length > 0 && k + 1 < this.#fonts.length) {
        this.#setRun(lacking, k + 1);
      } else {
        this.lacks ||= left.length > 0;
        for (const cluster of left) this.#tell(cluster, '');
      }
      if (drawn === undefined) return;
      if (k > 0) this.#tell(drawn, this.#fonts[k]?.name ?? '');
      for (const { id, offset, advance } of drawn.glyphs) {
        this.letters.push([this.#outlineOf(k, id), ...offset, advance]);
      }
      ++c;
    }
  }

  /** Tells whether font k has the letters of a cluster, with outlines where they need them. */
  #draws(k: number, { glyphs, begin, end }: Cluster): boolean {
    let ink = false;
    for (const { id } of glyphs) {
      if (id === 0) return false;
      const outline = this.outlines[this.#outlineOf(k, id)];
      ink ||= outline !== '';
    }
    return ink || Array.from(this.#line.slice(begin, end)).every((letter) => inkless.test(letter));
  }

  /** Reports a letter that comes from another font, or from none. Spaces are not reported. */
  #tell({ begin, end }: Cluster, font: string): void {
    const own = this.#fonts[0]?.open.font;
    const letters = Array.from(this.#line.slice(begin, end));
    const absent = letters.find(
      (letter) => !unseen.test(letter) && (own?.nominalGlyph(letter.codePointAt(0) ?? 0) ?? 0) === 0,
    );
    const letter = absent ?? letters.find((letter) => !inkless.test(letter));
    if (letter === undefined) return;
    const same = this.lacked.filter(([, other]) => (other === '') === (font === ''));
    if (same.length < mostLackedTold && !same.some(([known, other]) => known === letter && other === font))
      this.lacked.push([letter, font, absent === undefined]);
  }
}

type Unpacking = typeof import('./unpack.js');

/** Returns the bytes of a font; of a web font, wOFF or wOF2, the unpacked bytes: none if it is damaged.
 * @param script  address of unpack.js, which only web fonts load */
export async function plainFont(file: Blob | Uint8Array, script: string): Promise<Uint8Array> {
  const bytes = file instanceof Blob ? new Uint8Array(await file.arrayBuffer()) : file.subarray();
  if (!/^wOF[F2]/.test(String.fromCharCode(...bytes.subarray(0, 4)))) return bytes;
  const { unpackedFont } = (await import(/* @vite-ignore */ script)) as Unpacking;
  return unpackedFont(bytes);
}

export interface FontFile {
  name: string;
  bytes: Uint8Array;
  /** Weight of a variable font; 0: the font's own. */
  weight?: number;
}

/** A shaped line as core/src/text/shape_line_elsewhere.cpp reads it, with further fields. */
export interface Shaped {
  /** True if some letter, or a space, is in none of the fonts. */
  lacks?: boolean;
  [more: string]: unknown;
}

/** Shapes a line.
 * @param others  fonts for letters that the line's own font lacks */
export function shapeLine(line: string, own: FontFile, others: readonly FontFile[] = []): Shaped {
  const fonts = [own, ...others].flatMap(({ name, bytes, weight = 0 }) => {
    const open = opened(bytes, weight);
    return open === undefined ? [] : [{ name, open }];
  });
  const first = fonts[0];
  if (first?.name !== own.name) return { noFont: true };
  const setter = new LineSetter(line, fonts);
  try {
    setter.set();
  } catch (problem) {
    if (problem instanceof TooDetailed) return { tooDetailed: true };
    throw problem;
  }
  const { letters, outlines, lacked, lacks } = setter;
  const { em, capHeight } = first.open;
  return { em, capHeight, ...heightsOf(first.open.font), letters, outlines, lacked, lacks };
}
const levels = {
  low: QrCode.Ecc.LOW,
  medium: QrCode.Ecc.MEDIUM,
  quartile: QrCode.Ecc.QUARTILE,
  high: QrCode.Ecc.HIGH,
};

/** Returns the modules of a QR code, one grey texel each; undefined if no code can hold the text. */
export function qrModules(text: string, correction: keyof typeof levels) {
  let code;
  try {
    code = QrCode.encodeText(text, levels[correction]);
  } catch {
    return undefined;
  }
  const side = code.size;
  const samples = Uint8Array.from({ length: side * side }, (_, k) =>
    code.getModule(k % side, Math.floor(k / side)) ? 0 : 255,
  );
  return { width: side, height: side, channels: 1 as const, samples };
}
