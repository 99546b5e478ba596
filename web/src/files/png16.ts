// Grey pictures as PNG, 8 or 16 bits deep: browsers write no 16 bits.
import { Zlib } from 'fflate';
import { breathing } from './breath.js';

const crcTable = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
  return crc;
});

/** CRC-32 of PNG and zip. */
export function crc32(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (let k = 0; k < bytes.length; ++k) {
    crc = (crcTable[(crc ^ (bytes[k] as number)) & 0xff] as number) ^ (crc >>> 8);
  }
  return ~crc >>> 0;
}

function chunk(type: string, data: Uint8Array): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(12 + data.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, data.length);
  for (let k = 0; k < 4; ++k) bytes[4 + k] = type.charCodeAt(k);
  bytes.set(data, 8);
  view.setUint32(8 + data.length, crc32(bytes.subarray(4, 8 + data.length)));
  return bytes;
}

/** What each row is told against: nothing, the sample to its left, the sample above. */
const filters = 3;

/** Writes the row in the way that leaves the smallest differences, behind the filter's number. */
function filterRow(row: Uint8Array, above: Uint8Array, bytesPerSample: number, out: Uint8Array): void {
  let best = 0;
  let least = Infinity;
  const predicted = (filter: number, k: number): number =>
    filter === 0
      ? 0
      : filter === 1
        ? k < bytesPerSample
          ? 0
          : (row[k - bytesPerSample] as number)
        : (above[k] as number);
  for (let filter = 0; filter < filters; ++filter) {
    let sum = 0;
    for (let k = 0; k < row.length && sum < least; ++k) {
      sum += Math.abs((((row[k] as number) - predicted(filter, k)) << 24) >> 24); // as signed bytes
    }
    if (sum < least) {
      least = sum;
      best = filter;
    }
  }
  out[0] = best;
  for (let k = 0; k < row.length; ++k) out[k + 1] = (row[k] as number) - predicted(best, k);
}

/** Row 0 on top. The same samples give the same bytes. @param samples  width * height of them, 8 or 16 bits each */
export async function encodeGreyPng(
  width: number,
  height: number,
  samples: Uint8Array | Uint16Array,
): Promise<Uint8Array<ArrayBuffer>> {
  const bytesPerSample = samples.BYTES_PER_ELEMENT;
  const header = new Uint8Array(13);
  const view = new DataView(header.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  header[8] = 8 * bytesPerSample;

  const packed: Uint8Array[] = [];
  const zlib = new Zlib({ level: 6 }, (piece) => packed.push(piece));
  const breathe = breathing();
  let above = new Uint8Array(width * bytesPerSample);
  let row = new Uint8Array(width * bytesPerSample);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const sample = samples[y * width + x] as number;
      if (bytesPerSample === 2) {
        row[2 * x] = sample >> 8;
        row[2 * x + 1] = sample;
      } else {
        row[x] = sample;
      }
    }
    const line = new Uint8Array(1 + row.length);
    filterRow(row, above, bytesPerSample, line);
    zlib.push(line, y === height - 1);
    [above, row] = [row, above];
    await breathe();
  }

  const data = new Uint8Array(await new Blob(packed as Uint8Array<ArrayBuffer>[]).arrayBuffer());
  const parts = [
    Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a),
    chunk('IHDR', header),
    chunk('IDAT', data),
    chunk('IEND', new Uint8Array(0)),
  ];
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}
