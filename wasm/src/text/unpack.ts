// Unpacks web fonts, like core/src/text/unpack_font_here.cpp. Built into one file of its own (dist/engine/unpack.js),
// which only web fonts load.
import { unzlibSync } from 'fflate';
import unpackedWoff2 from 'woff2-encoder/decompress';

const mostFontBytes = 30 * 1024 * 1024; // same limit as in the library for WOFF2

/** Unpacks a font whose tables are packed by zlib, one by one. @throws if the file is damaged */
function unpackedWoff(file: Uint8Array): Uint8Array {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const count = view.getUint16(12);
  const tables = Array.from({ length: count }, (_, k) => {
    const entry = 44 + 20 * k;
    const [at, packed, size] = [4, 8, 12].map((field) => view.getUint32(entry + field)) as [number, number, number];
    return { tag: view.getUint32(entry), at, packed, size, begin: 0 };
  });
  let end = 12 + 16 * count;
  for (const table of tables) {
    table.begin = end;
    end += Math.ceil(table.size / 4) * 4;
  }
  if (end > mostFontBytes) throw new RangeError('the font is too large');
  const font = new Uint8Array(end);
  const head = new DataView(font.buffer);
  head.setUint32(0, view.getUint32(4));
  head.setUint16(4, count);
  for (const [k, { tag, at, packed, size, begin }] of tables.entries()) {
    const entry = 12 + 16 * k;
    head.setUint32(entry, tag);
    head.setUint32(entry + 8, begin);
    head.setUint32(entry + 12, size);
    if (at + packed > file.length) throw new RangeError('a table lies behind the end');
    const bytes = file.subarray(at, at + packed);
    const table = packed === size ? bytes : unzlibSync(bytes, { out: new Uint8Array(size) });
    if (table.length !== size) throw new RangeError('a table is incomplete');
    font.set(table, begin);
  }
  return font;
}

/** Unpacks a font. @returns no bytes for a packed font that is damaged, or larger than the limit */
export async function unpackedFont(file: Uint8Array): Promise<Uint8Array> {
  try {
    return file[3] === 0x32 ? await unpackedWoff2(file) : unpackedWoff(file);
  } catch {
    return new Uint8Array();
  }
}
