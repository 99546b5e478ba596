// Recognises prints that a slicer made, and names re-brushed ones.

const ending = /\.(?:gcode\.3mf|3mf|(?:gcode|gco|g)(?:\.gz)?|bgcode|bgc)$/i;

const startsWith = (bytes: Uint8Array, ...magic: readonly number[]): boolean =>
  magic.every((byte, k) => bytes[k] === byte);

/** Tells whether a file is probably a sliced print: its name says so, and its first bytes do not contradict. The
 * engine decides about its contents. @param head  the first bytes of the file */
export function seemsSliced(name: string, head: Uint8Array): boolean {
  if (!ending.test(name)) return startsWith(head, 0x47, 0x43, 0x44, 0x45); // GCDE: binary G-code under any name
  if (/\.3mf$/i.test(name)) return startsWith(head, 0x50, 0x4b);
  return !startsWith(head, 0x89, 0x50, 0x4e, 0x47) && !startsWith(head, 0xff, 0xd8, 0xff);
}

const directoryLength = 1 << 17; // bytes, enough for a directory of a thousand files

/** Distinguishes sliced prints from bodies that still have to be sliced; empty for any other file, a folder, or a
 * deleted file. */
export async function printOf(file: File): Promise<'sliced' | 'body' | ''> {
  if (/\.stl$/i.test(file.name)) return 'body';
  try {
    if (!seemsSliced(file.name, new Uint8Array(await file.slice(0, 64).arrayBuffer()))) return '';
    if (!/\.3mf$/i.test(file.name)) return 'sliced';
    // A zip's directory is at its end and names all files of the package.
    const end = new TextDecoder('latin1').decode(await file.slice(-directoryLength).arrayBuffer());
    return end.includes('.gcode') ? 'sliced' : 'body';
  } catch {
    return '';
  }
}

/** Name of the re-brushed print: "part.gcode.3mf" becomes "part_brushed.gcode.3mf". */
export function brushedName(name: string): string {
  const plain = name.replace(/[\p{Cc}\p{Cs}/\\]/gu, '');
  const [tail = ''] = ending.exec(plain) ?? [];
  const stem = tail === '' ? plain : plain.slice(0, -tail.length);
  return `${stem.replace(/_brushed$/, '') || 'print'}_brushed${tail || '.gcode'}`;
}
