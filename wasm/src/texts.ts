// Letters and QR codes of a plate, made before its call: the engine asks for them as for files.
import { SillonError, messageOf } from './errors.js';
import { fontFile } from './fonts.js';
import type { Platform } from './platform.js';
import type { EngineFiles, Files } from './protocol.js';

type Tools = typeof import('./text/text.js');

/** The fields of a layer or a shape that are read here. */
interface Lettering {
  kind?: unknown;
  text?: unknown;
  font?: unknown;
  correction?: unknown;
}

/** Others begin at once, so that calls enter the queue in their order. */
export const needsTexts = ({ layers, shape }: Record<string, unknown>): boolean =>
  layers !== undefined || (shape as { builtin?: unknown } | undefined)?.builtin === 'text';

/** Makes the letters of one engine; what they need is loaded with the first of them. */
export class Texts {
  readonly #platform: Platform;
  readonly #files: EngineFiles;
  #tools: Promise<Tools> | undefined;
  readonly #fonts = new Map<string, Promise<Uint8Array>>();

  constructor(platform: Platform, files: EngineFiles) {
    this.#platform = platform;
    this.#files = files;
  }

  /** Adds to the files what texts and codes of the project need.
   * @throws SillonError LoadFailed, InvalidFile */
  async addTo(files: Files, sections: Record<string, unknown>): Promise<void> {
    const { layers, shape } = sections;
    const drawn: Lettering[] = Array.isArray(layers) ? (layers as Lettering[]) : [];
    const cut = shape as (Lettering & { builtin?: unknown }) | undefined;
    for (const layer of cut?.builtin === 'text' ? [...drawn, { ...cut, kind: 'text' }] : drawn) {
      const { kind, text, font = 'Nunito', correction = 'medium' } = layer;
      if (typeof text !== 'string' || text === '') continue;
      if (kind === 'qr') await this.#addCode(files, text, correction);
      if (kind !== 'qr' && typeof font === 'string') await this.#addLines(files, text, font);
    }
  }

  async #addCode(files: Files, text: string, correction: unknown): Promise<void> {
    if (correction !== 'low' && correction !== 'medium' && correction !== 'quartile' && correction !== 'high') return;
    const { qrModules } = await this.#started();
    const value = qrModules(text, correction) ?? new Uint8Array(1); // bytes are no picture: the engine says that it is too long
    files[`qr:${correction}\n${text}`] = { number: 0, value };
  }

  async #addLines(files: Files, text: string, font: string): Promise<void> {
    const { shapeLine } = await this.#started();
    const bytes = await this.#fontOf(files, font);
    for (const line of text.split('\n')) {
      const shaped = JSON.stringify(
        bytes === undefined ? { unknownFont: true } : shapeLine(bytes, line.replace(/\r$/, '')),
      );
      files[`line:${font}\n${line.replace(/\r$/, '')}`] = { number: 0, value: new TextEncoder().encode(shaped) };
    }
  }

  async #fontOf(files: Files, font: string): Promise<Uint8Array | undefined> {
    const address = this.#files.fonts[fontFile(font) ?? ''];
    if (address !== undefined) {
      let bytes = this.#fonts.get(font);
      if (bytes === undefined) this.#fonts.set(font, (bytes = this.#platform.read(address)));
      return bytes;
    }
    const given = files[font]?.value;
    if (given instanceof Blob) return new Uint8Array(await given.arrayBuffer());
    return given instanceof Uint8Array ? given : undefined;
  }

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

  #started(): Promise<Tools> {
    this.#tools ??= this.#start();
    this.#tools.catch(() => (this.#tools = undefined)); // the next call tries again
    return this.#tools;
  }
}
