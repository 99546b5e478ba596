// Grey pictures of 16 bits as PNG.
import { crc32, deflateSync } from 'node:zlib';

function chunk(type: string, data: Uint8Array): Uint8Array<ArrayBuffer> {
  const head = Buffer.alloc(8);
  head.writeUInt32BE(data.length);
  head.write(type, 4, 'latin1');
  const tail = Buffer.alloc(4);
  tail.writeUInt32BE(crc32(Buffer.concat([head.subarray(4), data])));
  return Uint8Array.from(Buffer.concat([head, data, tail]));
}

export function encodeGreyPng(width: number, height: number, samples: Uint16Array | Uint8Array): Promise<Blob> {
  const bytes = samples.BYTES_PER_ELEMENT;
  const rows = Buffer.alloc(height * (1 + bytes * width));
  samples.forEach((sample, k) => {
    const at = (1 + bytes * width) * Math.floor(k / width) + 1 + bytes * (k % width);
    rows.writeUIntBE(sample, at, bytes);
  });
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width);
  header.writeUInt32BE(height, 4);
  header.set([8 * bytes, 0, 0, 0, 0], 8);
  const parts = [
    Uint8Array.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunk('IHDR', header),
    chunk('IDAT', deflateSync(rows)),
    chunk('IEND', Buffer.alloc(0)),
  ];
  return Promise.resolve(new Blob(parts, { type: 'image/png' }));
}
