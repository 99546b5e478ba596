// Makes letters and QR codes of a plate before its call: the engine asks for them as for files.
import { SillonError, messageOf } from './errors.js';
import { usualCorrection, usualFont } from './facts.js';
import { fontFiles } from './fonts.js';
import type { Platform } from './platform.js';
import type { EngineFiles, Files } from './protocol.js';
import { lettersOf, nameOf } from './letter-names.js';
import type { FontFile } from './text/text.js';

type Tools = typeof import('./text/text.js');

/** Fields of a layer or a shape that are read here. */
interface Lettering {
  kind?: unknown;
  text?: unknown;
  font?: unknown;
  weight?: unknown;
  correction?: unknown;
}

const latin = new TextDecoder('latin1');

/** Tells whether bytes are a drawing with <text>. Photographs, which may be large, are excluded by their first
 * bytes. */
const hasText = (bytes: Uint8Array): boolean =>
  bytes[0] === 0x1f || // packed
  (/^[\s\u00EF\u00BB\u00BF]*</.test(latin.decode(bytes.subarray(0, 256))) &&
    /<(?:[\w-]+:)?text[\s>]/.test(latin.decode(bytes)));

/** Lines that drawings ask for. A Blob cannot change, so that each is read once. */
const linesOfBlobs = new WeakMap<Blob, string[]>();

const layersOf = ({ layers }: Record<string, unknown>): Lettering[] =>
  Array.isArray(layers) ? (layers as Lettering[]) : [];

/** Returns the layers of a plate, and its shape if that is letters. */
function lettersIn(sections: Record<string, unknown>): Lettering[] {
  const cut = sections['shape'] as (Lettering & { builtin?: unknown }) | undefined;
  return [...layersOf(sections), ...(cut?.builtin === 'text' ? [{ ...cut, kind: 'text' }] : [])];
}

/** Returns the files of the shape and of layers that may be drawings; other files are pictures. */
function drawingsIn(sections: Record<string, unknown>, files: Files): (Blob | Uint8Array)[] {
  const names = layersOf(sections).flatMap(({ kind }, k) => [
    ...(kind === 'map' ? [] : [`layers[${k}].file`]),
    `layers[${k}].maskFile`,
  ]);
  const values = ['shape.file', ...names].map((name) => files[name]?.value);
  return values.filter((value) => value instanceof Blob || value instanceof Uint8Array);
}

const mayHaveText = (file: Blob | Uint8Array): boolean =>
  file instanceof Blob ? linesOfBlobs.get(file)?.length !== 0 : hasText(file);

/** Tells whether a call must wait for texts. Other calls begin at once, so that they enter the queue in their
 * order. */
export const needsTexts = (sections: Record<string, unknown>, files: Files): boolean =>
  lettersIn(sections).some(({ text }) => typeof text === 'string' && text !== '') ||
  drawingsIn(sections, files).some(mayHaveText);

/** Makes the letters of one engine; the first text loads the libraries. */
export class Texts {
  readonly #platform: Platform;
  readonly #files: EngineFiles;
  readonly #linesOf: (file: Uint8Array) => Promise<string[]>;
  /** Bytes of fonts: of the engine's fonts by name; of others by Blob, which cannot change, or by the entry of one
   * call. HarfBuzz opens the same bytes only once. */
  readonly #fonts = new Map<string, Promise<Uint8Array>>();
  readonly #ownFonts = new WeakMap<object, Promise<Uint8Array>>();

  /** @param linesOf  returns the names of lines that a drawing asks for */
  constructor(platform: Platform, files: EngineFiles, linesOf: (file: Uint8Array) => Promise<string[]>) {
    this.#platform = platform;
    this.#files = files;
    this.#linesOf = linesOf;
  }

  /** Adds to the files what texts and codes of the project need.
   * @throws SillonError LoadFailed, InvalidFile */
  async addTo(files: Files, sections: Record<string, unknown>): Promise<void> {
    for (const layer of lettersIn(sections)) {
      const { kind, text, font = usualFont, weight, correction = usualCorrection } = layer;
      if (typeof text !== 'string' || text === '') continue;
      if (kind === 'code') await this.#addCode(files, text, correction);
      if (kind === 'code' || typeof font !== 'string') continue;
      const key = weight ? `${font}\t${weight as number}` : font;
      for (const line of text.split('\n')) await this.#addLine(files, key, line.replace(/\r$/, ''));
    }
    for (const drawing of drawingsIn(sections, files)) await this.#addLinesOf(files, drawing);
  }

  async #addLinesOf(files: Files, drawing: Blob | Uint8Array): Promise<void> {
    for (const name of await this.#linesIn(drawing)) {
      const { key, text } = lettersOf(name);
      await this.#addLine(files, key, text);
    }
  }

  async #linesIn(drawing: Blob | Uint8Array): Promise<string[]> {
    const known = drawing instanceof Blob ? linesOfBlobs.get(drawing) : undefined;
    if (known !== undefined) return known;
    const bytes = drawing instanceof Blob ? new Uint8Array(await drawing.arrayBuffer()) : drawing;
    const lines = hasText(bytes) ? await this.#linesOf(bytes) : [];
    if (drawing instanceof Blob) linesOfBlobs.set(drawing, lines);
    return lines;
  }

  async #addCode(files: Files, text: string, correction: unknown): Promise<void> {
    if (!/^(low|medium|quartile|high)$/.test(correction as string)) return;
    const { qrModules } = await this.#start();
    // Bytes are no picture; the engine then reports that the text is too long.
    const value = qrModules(text, correction as Parameters<typeof qrModules>[1]) ?? new Uint8Array(1);
    files[nameOf('qr', correction as string, text)] = { number: 0, value };
  }

  /** Adds a shaped line to the files, unless it is there. */
  async #addLine(files: Files, key: string, line: string): Promise<void> {
    const name = nameOf('line', key, line);
    if (name in files) return;
    const [font = '', weight = 0] = key.split('\t');
    const bytes = await this.#fontOf(files, font);
    const shaped = JSON.stringify(
      bytes === undefined ? { unknownFont: true } : await this.#shaped({ name: font, bytes, weight: +weight }, line),
    );
    files[name] = { number: 0, value: new TextEncoder().encode(shaped) };
  }

  /** Shapes a line. Fonts that come with the engine are fetched if the line's own font lacks a letter. */
  async #shaped(own: FontFile, line: string): Promise<object> {
    const { shapeLine, forget } = await this.#start();
    try {
      const shaped = shapeLine(line, own);
      if (shaped.lacks !== true) return shaped;
      const names = [...fontFiles.keys()].filter((name) => name !== own.name);
      const others = names.map(async (name) => ({ name, bytes: (await this.#fontOf({}, name)) ?? new Uint8Array() }));
      return shapeLine(line, own, await Promise.all(others));
    } catch (problem) {
      if (problem instanceof SillonError) throw problem;
      forget();
      throw new SillonError(
        'TooLarge',
        `the letters of "${own.name}" cannot be set (${messageOf(problem)}); take another font, or fewer letters`,
      );
    }
  }

  /** Returns the bytes of a font: a built-in one by its name, or a file of the call; undefined if there is none. */
  async #fontOf(files: Files, font: string): Promise<Uint8Array | undefined> {
    const address = this.#files.fonts[fontFiles.get(font) ?? ''];
    if (address !== undefined) {
      let bytes = this.#fonts.get(font);
      if (bytes === undefined) this.#fonts.set(font, (bytes = this.#platform.read(address)));
      bytes.catch(() => this.#fonts.delete(font)); // lets the next call try again
      return bytes;
    }
    const given = files[font];
    const value = given?.value;
    if (!(value instanceof Blob || value instanceof Uint8Array)) return undefined;
    const key = value instanceof Blob ? value : (given as object);
    let bytes = this.#ownFonts.get(key);
    if (bytes === undefined)
      this.#ownFonts.set(key, (bytes = this.#start().then((tools) => tools.plainFont(value, this.#files.unpack))));
    bytes.catch(() => this.#ownFonts.delete(key)); // lets the next call try again
    return bytes;
  }

  /** Loads and starts the libraries. */
  async #start(): Promise<Tools> {
    const { script, wasm } = this.#files.text;
    try {
      const tools = (await import(/* @vite-ignore */ /* webpackIgnore: true */ script)) as Tools;
      await tools.start(() => this.#platform.read(wasm));
      return tools;
    } catch (problem) {
      if (problem instanceof SillonError) throw problem;
      throw new SillonError('LoadFailed', `${script} could not be started: ${messageOf(problem)}`);
    }
  }
}
