// Reads zip archives that anybody may have made. The whole directory is checked strictly at first; contents are
// unpacked on demand, and never beyond the size that the directory states. (fflate's own unzip keeps inflating an entry
// that exceeds its size.)
import { Inflate } from 'fflate';
import { breathing } from './breath.js';

const crcTable = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
  return crc;
});

function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (let k = 0; k < bytes.length; ++k) {
    crc = (crcTable[(crc ^ (bytes[k] as number)) & 0xff] as number) ^ (crc >>> 8);
  }
  return ~crc >>> 0;
}

const mostEntries = 1000;
const pieceLength = 1 << 14; // bytes; inflates to at most 16 MB

export interface Entry {
  path: string;
  /** Size when unpacked [bytes]. */
  size: number;
  read(): Promise<Uint8Array<ArrayBuffer>>;
}

/** Fault of an archive; its message is a sentence. */
export class ZipError extends Error {}

/** Refuses paths that could leave the archive's folder or confuse a file system. @throws ZipError */
function checkedPath(path: string): string {
  const parts = path.split('/');
  // eslint-disable-next-line no-control-regex
  if (path.length > 1000 || /[\\:\u0000-\u001f]/.test(path) || parts.includes('..') || path.startsWith('/')) {
    throw new ZipError(`it holds a file of a name that is not allowed: ${JSON.stringify(path.slice(0, 80))}`);
  }
  return path;
}

/** Inflates an entry. @throws ZipError where its size is not the one that the directory states */
async function inflated(packed: Uint8Array, size: number, path: string): Promise<Uint8Array<ArrayBuffer>> {
  const out = new Uint8Array(size);
  let length = 0;
  const inflate = new Inflate((piece) => {
    if (length + piece.length > size) throw new ZipError(`${path} is larger than the archive says`);
    out.set(piece, length);
    length += piece.length;
  });
  const breathe = breathing();
  for (let at = 0; at < packed.length; at += pieceLength) {
    inflate.push(packed.subarray(at, at + pieceLength), at + pieceLength >= packed.length);
    await breathe();
  }
  if (length !== size) throw new ZipError(`${path} is incomplete`);
  return out;
}

/** Position of the end-of-directory record, after which only a comment may follow. */
function endOf(view: DataView): number {
  for (let at = view.byteLength - 22; at >= Math.max(0, view.byteLength - 22 - 0xffff); --at) {
    if (view.getUint32(at, true) === 0x06054b50) return at;
  }
  throw new ZipError('its end is missing');
}

/** Opens an archive. @returns the files by their paths @throws ZipError here and from `read`, RangeError, or
 * fflate's errors */
export function openZip(bytes: Uint8Array<ArrayBuffer>): Map<string, Entry> {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const end = endOf(view);
  const count = view.getUint16(end + 10, true);
  if (count > mostEntries) throw new ZipError(`it holds ${count} files; at most ${mostEntries}`);
  const entries = new Map<string, Entry>();
  let at = view.getUint32(end + 16, true);
  for (let k = 0; k < count; ++k) {
    if (view.getUint32(at, true) !== 0x02014b50) throw new ZipError('its directory is broken');
    const flags = view.getUint16(at + 8, true);
    const method = view.getUint16(at + 10, true);
    const crc = view.getUint32(at + 16, true);
    const packedSize = view.getUint32(at + 20, true);
    const size = view.getUint32(at + 24, true);
    const nameLength = view.getUint16(at + 28, true);
    const local = view.getUint32(at + 42, true);
    const name = bytes.subarray(at + 46, at + 46 + nameLength);
    const path = checkedPath(new TextDecoder().decode(name));
    at += 46 + nameLength + view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
    if (path.endsWith('/')) continue;
    if (entries.has(path)) throw new ZipError(`it holds ${path} twice`);

    const read = async (): Promise<Uint8Array<ArrayBuffer>> => {
      if ((flags & 1) !== 0) throw new ZipError(`${path} is encrypted`);
      if (view.getUint32(local, true) !== 0x04034b50) throw new ZipError(`${path} is not where the directory says`);
      const begin = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
      if (begin + packedSize > bytes.length) throw new ZipError(`${path} is incomplete`);
      const packed = bytes.subarray(begin, begin + packedSize);
      if (method !== 0 && method !== 8) throw new ZipError(`${path} is packed in a way that is not known (${method})`);
      if (method === 0 && size !== packedSize) throw new ZipError(`${path} has two sizes`);
      const content = method === 0 ? packed.slice() : await inflated(packed, size, path);
      if (crc32(content) !== crc) throw new ZipError(`${path} is damaged`);
      return content;
    };
    entries.set(path, { path, size, read });
  }
  return entries;
}
