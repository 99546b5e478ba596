// Letters and QR codes for the command line, which asks for them while it runs (cli/assemble.cpp).
import { readFileSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { fontFiles } from './fonts.js';

const engine = (name: string): string => fileURLToPath(new URL(`./engine/${name}`, import.meta.url));

type Tools = typeof import('./text/text.js');

export async function offerTexts(): Promise<void> {
  const script = new URL('./engine/text.js', import.meta.url).href;
  const { start, shapeLine, qrModules } = (await import(script)) as Tools;
  await start(() => readFile(engine('harfbuzz.wasm')));

  const fontOf = (name: string): Uint8Array => {
    const file = fontFiles.get(name);
    try {
      return readFileSync(file === undefined ? name : engine(file));
    } catch {
      return new Uint8Array(); // no font, as the program then says
    }
  };
  /** @param name  as core/src/text asks for it */
  const made = (name: string): string => {
    const [, kind, key = '', text = ''] = /^(line|qr):([^\n]*)\n([^]*)$/.exec(name) ?? [];
    if (kind === 'line') return JSON.stringify(shapeLine(fontOf(key), text));
    const code = qrModules(text, key as Parameters<typeof qrModules>[1]);
    return code === undefined
      ? ''
      : `${code.width} ${Array.from(code.samples, (module) => (module === 0 ? '#' : '.')).join('')}`;
  };
  Object.assign(globalThis, { sillonMadeElsewhere: made });
}
