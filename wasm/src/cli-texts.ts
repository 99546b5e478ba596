// Thread that makes letters and QR codes for the command line, which asks for them while it runs (cli/assemble.cpp).
import { readFileSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { workerData, type MessagePort } from 'node:worker_threads';
import { messageOf } from './errors.js';
import { fontFiles } from './fonts.js';
import { lettersOf } from './letter-names.js';
import type { FontFile, Shaped } from './text/text.js';

const engine = (name: string): string => fileURLToPath(new URL(`./engine/${name}`, import.meta.url));

type Tools = typeof import('./text/text.js');

/** Port and flag that this thread shares with the one that asks. */
export interface Asking {
  port: MessagePort;
  /** 1 when the answer has arrived. */
  answered: Int32Array;
}
export type Answer = { made: string } | { problem: string };

const script = (name: string): string => new URL(`./engine/${name}`, import.meta.url).href;

/** Starts HarfBuzz and returns a function that makes the letters or the code for a name. */
async function maker(): Promise<(name: string) => Promise<string>> {
  const { start, plainFont, shapeLine, qrModules } = (await import(script('text.js'))) as Tools;
  await start(() => readFile(engine('harfbuzz.wasm')));

  const fonts = new Map<string, FontFile>();
  const fontOf = async (name: string): Promise<FontFile> => {
    let font = fonts.get(name);
    if (font !== undefined) return font;
    const file = fontFiles.get(name);
    try {
      const bytes = readFileSync(file === undefined ? name : engine(file));
      font = { name, bytes: await plainFont(bytes, script('unpack.js')) };
    } catch {
      font = { name, bytes: new Uint8Array() }; // no font; the program then reports it
    }
    fonts.set(name, font);
    return font;
  };
  const shaped = async (key: string, line: string): Promise<Shaped> => {
    const [font = '', weight = 0] = key.split('\t');
    const file = { ...(await fontOf(font)), weight: +weight };
    const own = shapeLine(line, file);
    if (own.lacks !== true) return own;
    const others = [...fontFiles.keys()].filter((name) => name !== font);
    return shapeLine(line, file, await Promise.all(others.map(fontOf)));
  };
  /** @param name  name under which core/src/text asks */
  return async (name) => {
    const { kind, key, text } = lettersOf(name);
    if (kind === 'line') return JSON.stringify(await shaped(key, text));
    const code = qrModules(text, key as Parameters<typeof qrModules>[1]);
    return code === undefined
      ? ''
      : `${code.width} ${Array.from(code.samples, (module) => (module === 0 ? '#' : '.')).join('')}`;
  };
}

const { port, answered } = workerData as Asking;
let make: ReturnType<typeof maker> | undefined;

async function answer(name: string): Promise<Answer> {
  try {
    return { made: await (await (make ??= maker()))(name) };
  } catch (problem) {
    return { problem: messageOf(problem) };
  }
}

port.on('message', (name: string) => {
  void answer(name).then((answer) => {
    port.postMessage(answer);
    Atomics.store(answered, 0, 1);
    Atomics.notify(answered, 0);
  });
});
