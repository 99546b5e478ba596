// Which files are prints that a slicer made, and what a re-brushed one is called.

const ending = /\.(?:gcode\.3mf|3mf|(?:gcode|gco|g)(?:\.gz)?|bgcode|bgc)$/i;

const startsWith = (bytes: Uint8Array, ...magic: readonly number[]): boolean =>
  magic.every((byte, k) => bytes[k] === byte);

/** Whether a file seems to be one: its name says so, and its first bytes do not speak against it. What it holds, the engine
 * tells. @param head  some first bytes */
export function seemsSliced(name: string, head: Uint8Array): boolean {
  if (!ending.test(name)) return startsWith(head, 0x47, 0x43, 0x44, 0x45); // GCDE: binary G-code by any name
  if (/\.3mf$/i.test(name)) return startsWith(head, 0x50, 0x4b);
  return !startsWith(head, 0x89, 0x50, 0x4e, 0x47) && !startsWith(head, 0xff, 0xd8, 0xff);
}

const directoryLength = 1 << 17; // bytes: of a thousand files

/** Tells prints that a slicer made from bodies that none has sliced yet; empty: the file is neither, a folder, or gone. */
export async function printOf(file: File): Promise<'sliced' | 'body' | ''> {
  if (/\.stl$/i.test(file.name)) return 'body';
  try {
    if (!seemsSliced(file.name, new Uint8Array(await file.slice(0, 64).arrayBuffer()))) return '';
    if (!/\.3mf$/i.test(file.name)) return 'sliced';
    // The directory stands at the end, and names all that is in the package.
    const end = new TextDecoder('latin1').decode(await file.slice(-directoryLength).arrayBuffer());
    return end.includes('.gcode') ? 'sliced' : 'body';
  } catch {
    return '';
  }
}

/** "part.gcode.3mf" is "part_brushed.gcode.3mf". */
export function brushedName(name: string): string {
  const plain = name.replace(/[\p{Cc}\p{Cs}/\\]/gu, '');
  const [tail = ''] = ending.exec(plain) ?? [];
  const stem = tail === '' ? plain : plain.slice(0, -tail.length);
  return `${stem.replace(/_brushed$/, '') || 'print'}_brushed${tail || '.gcode'}`;
}
