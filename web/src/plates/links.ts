// A plate as an address of the studio, with a text about the parts that an address cannot carry.
import { missingText, untoldText } from '../i18n/say-link.js';
import type { Plate } from '../model/plate.js';
import type { Untold } from '../model/untold.js';
import { readLink, writeLink } from '../files/link.js';
import type { ProjectEngine } from '../files/plate-project.js';

/** Makes a link to the plate. @returns the address, and a text for the sender */
export async function linkOf(plate: Plate): Promise<{ url: string; told: string }> {
  const { hash, untold } = await writeLink(plate, async (file, most) =>
    (await import('../files/shrink.js')).shrunk(file, most),
  );
  // The address is the studio's, even where this page is the one for frames.
  return { url: new URL(`./${hash}`, document.baseURI).href, told: untoldText(untold) };
}

/** Reads the plate of a link. @returns the plate, and a text for whoever opens it; undefined where the address has
 * no plate */
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
