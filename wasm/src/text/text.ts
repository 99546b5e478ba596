// Shapes letters and makes QR codes by the libraries that the native program has. Built into one file of its own
// (dist/engine/text.js), which only plates with texts or codes load.
import * as hb from 'harfbuzzjs';
import generator from 'nayuki-qr-code-generator';
import { textRuns } from './text-runs.js';

export { textRuns };

// Its types are those of a CommonJS module, which it is not.
const { QrCode } = generator as unknown as typeof generator.default;

/** The limits of core/src/text/letters.hpp. */
const usualCapHeight = 0.7;
const mostPathBytes = 4 * 2 ** 20;

let started: Promise<void> | undefined;

/** Engines share this module: a second start would leave what was made before in another memory.
 * @param wasm  gives harfbuzz.wasm */
export async function start(wasm: () => Promise<Uint8Array>): Promise<void> {
  // `start` is added by vite.text.config.js, instead of a start by the import.
  const { start: begin } = hb as unknown as { start: (wasm: Uint8Array) => Promise<void> };
  started ??= wasm().then(begin);
  started.catch(() => (started = undefined)); // the next call tries again
  await started;
}

function pathWriter(): hb.DrawFuncs {
  const funcs = new hb.DrawFuncs();
  const writer =
    (command: string) =>
    (...values: unknown[]): void => {
      const path = values.at(-2) as string[];
      const numbers = values.slice(0, -2) as number[];
      path.push(command + numbers.map((number) => `${number} `).join(''));
    };
  funcs.setMoveToFunc(writer('M'));
  funcs.setLineToFunc(writer('L'));
  funcs.setQuadraticToFunc(writer('Q'));
  funcs.setCubicToFunc(writer('C'));
  funcs.setClosePathFunc(writer('Z'));
  return funcs;
}
let writer: hb.DrawFuncs | undefined;

/** Height of H. */
function capHeightOf(font: hb.Font, em: number): number {
  const glyph = font.nominalGlyph(0x48);
  const height = glyph === undefined || glyph === 0 ? 0 : -(font.glyphExtents(glyph)?.height ?? 0);
  return height > 0 ? height : usualCapHeight * em;
}

/** The heights that set the base lines of drawings. */
function heightsOf(font: hb.Font) {
  const { ascender, descender } = font.hExtents();
  return { xHeight: font.getMetricPosition(hb.MetricsTag.X_HEIGHT) ?? 0, ascent: ascender, descent: -descender };
}

/** The shaped line that core/src/text/shape_line_elsewhere.cpp reads. */
export function shapeLine(file: Uint8Array, line: string): object {
  const face = new hb.Face(new hb.Blob(file));
  // No font has no glyphs; HarfBuzz makes an empty face of anything.
  if (face.referenceTable('maxp') === undefined || face.referenceTable('cmap') === undefined) return { noFont: true };
  const font = new hb.Font(face);
  const letters = line.replace(/[\p{Cc}\u2028\u2029]/gu, ' ');
  const buffer = new hb.Buffer();
  const known = new Map<number, number>();
  const placed: number[][] = [];
  const outlines: string[] = [];
  let length = 0;
  for (const { begin, end, toLeft } of textRuns(letters)) {
    buffer.reset();
    // The shaper looks at five letters on either side; the whole line would be copied for each run.
    const before = Math.max(0, begin - 10);
    buffer.addText(letters.slice(before, end + 10), begin - before, end - begin);
    buffer.setDirection(toLeft ? hb.Direction.RTL : hb.Direction.LTR);
    buffer.setLanguage('und');
    buffer.guessSegmentProperties();
    hb.shape(font, buffer);
    const places = buffer.getGlyphPositions();
    for (const [k, { codepoint: glyph, cluster }] of buffer.getGlyphInfos().entries()) {
      if (glyph === 0) return { missing: String.fromCodePoint(letters.codePointAt(before + cluster) ?? 0) };
      let outline = known.get(glyph);
      if (outline === undefined) {
        outline = outlines.length;
        known.set(glyph, outline);
        const path: string[] = [];
        writer ??= pathWriter();
        font.drawGlyph(glyph, writer, path);
        outlines.push(path.join(''));
        length += outlines[outline]?.length ?? 0;
        if (length > mostPathBytes) return { tooDetailed: true };
      }
      const place = places[k];
      placed.push([outline, place?.xOffset ?? 0, place?.yOffset ?? 0, place?.xAdvance ?? 0]);
    }
  }
  return { em: face.upem, capHeight: capHeightOf(font, face.upem), ...heightsOf(font), letters: placed, outlines };
}

const levels = {
  low: QrCode.Ecc.LOW,
  medium: QrCode.Ecc.MEDIUM,
  quartile: QrCode.Ecc.QUARTILE,
  high: QrCode.Ecc.HIGH,
};

/** The modules, one grey texel each; undefined: no code holds the text. */
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
