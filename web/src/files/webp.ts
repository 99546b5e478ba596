// The container of animated WebP (developers.google.com/speed/webp/docs/riff_container): libraries that write pictures by
// WebAssembly write single ones.

export interface WebpFrame {
  /** A WebP file of one picture. */
  bytes: Uint8Array;
  milliseconds: number;
}

/** A chunk's length is told without the byte that makes it even. */
function chunk(name: string, ...parts: Uint8Array[]): Uint8Array<ArrayBuffer> {
  const length = parts.reduce((sum, part) => sum + part.length, 0);
  const bytes = new Uint8Array(8 + length + (length % 2));
  for (let k = 0; k < 4; ++k) bytes[k] = name.charCodeAt(k);
  new DataView(bytes.buffer).setUint32(4, length, true);
  let at = 8;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

/** Numbers of three bytes, the low one first. */
const triples = (...values: number[]): Uint8Array =>
  Uint8Array.from(values.flatMap((value) => [value & 255, (value >> 8) & 255, (value >> 16) & 255]));

const headOfFile = 12;
const headOfExtended = 18;

/** The picture's own chunks, without the head of its file and the canvas that it may tell. */
function pictureOf(file: Uint8Array): Uint8Array {
  const first = String.fromCharCode(...file.subarray(headOfFile, headOfFile + 4));
  return file.subarray(first === 'VP8X' ? headOfFile + headOfExtended : headOfFile);
}

const animated = 2;
const unblended = 2; // a frame replaces the one before

/** An endless loop. @param frames  all of the whole size [pixels] */
export function animatedWebp(frames: readonly WebpFrame[], width: number, height: number): Uint8Array<ArrayBuffer> {
  const size = [width - 1, height - 1] as const;
  return chunk(
    'RIFF',
    Uint8Array.from('WEBP', (letter) => letter.charCodeAt(0)),
    chunk('VP8X', Uint8Array.of(animated, 0, 0, 0), triples(...size)),
    chunk('ANIM', Uint8Array.of(0, 0, 0, 255, 0, 0)), // black, shown as often as one looks
    ...frames.map(({ bytes, milliseconds }) =>
      chunk('ANMF', triples(0, 0, ...size, milliseconds), Uint8Array.of(unblended), pictureOf(bytes)),
    ),
  );
}
