// A plate as an address of the studio, with words for what an address cannot carry.
import { missingText, untoldText } from '../i18n/say-link.js';
import type { Plate } from '../model/plate.js';
import type { Untold } from '../model/untold.js';
import { readLink, writeLink } from '../files/link.js';
import type { ProjectEngine } from '../files/plate-project.js';

/** @returns the address, and words for who sends it */
export async function linkOf(plate: Plate): Promise<{ url: string; told: string }> {
  const { hash, untold } = await writeLink(plate, async (file, most) =>
    (await import('../files/shrink.js')).shrunk(file, most),
  );
  // Of the studio, also where this is its page for frames.
  return { url: new URL(`./${hash}`, document.baseURI).href, told: untoldText(untold) };
}

/** @returns the plate, and words for who opens it; undefined: the address names none */
export async function plateOfLink(
  hash: string,
  engine: () => Promise<ProjectEngine>,
): Promise<{ plate: Plate; told: string } | undefined> {
  let missing: Untold[] = [];
  const plate = await readLink(
    hash,
    async (name, bytes) => (await import('../files/source-file.js')).sourceFile(name, bytes),
    engine,
    (parts) => {
      missing = parts;
    },
  );
  return plate === undefined ? undefined : { plate, told: missingText(missing) };
}
