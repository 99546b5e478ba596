// Writes animated WebP files (developers.google.com/speed/webp/docs/riff_container), since WebAssembly libraries write
// single pictures only.

export interface WebpFrame {
  /** A WebP file of a single picture. */
  bytes: Uint8Array;
  milliseconds: number;
}

/** A RIFF chunk. Its stated length excludes the byte that pads it to an even size. */
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

/** Numbers of three bytes, in little-endian order. */
const triples = (...values: number[]): Uint8Array =>
  Uint8Array.from(values.flatMap((value) => [value & 255, (value >> 8) & 255, (value >> 16) & 255]));

const headOfFile = 12;
const headOfExtended = 18;

/** The chunks of a single picture, without the file header and the optional canvas chunk. */
function pictureOf(file: Uint8Array): Uint8Array {
  const first = String.fromCharCode(...file.subarray(headOfFile, headOfFile + 4));
  return file.subarray(first === 'VP8X' ? headOfFile + headOfExtended : headOfFile);
}

const animated = 2;
const unblended = 2; // a frame replaces the one before it

/** An endless animation. @param frames  pictures that all fill the whole canvas @param width, height  [pixels] */
export function animatedWebp(frames: readonly WebpFrame[], width: number, height: number): Uint8Array<ArrayBuffer> {
  const size = [width - 1, height - 1] as const;
  return chunk(
    'RIFF',
    Uint8Array.from('WEBP', (letter) => letter.charCodeAt(0)),
    chunk('VP8X', Uint8Array.of(animated, 0, 0, 0), triples(...size)),
    chunk('ANIM', Uint8Array.of(0, 0, 0, 255, 0, 0)), // black background, endless loop
    ...frames.map(({ bytes, milliseconds }) =>
      chunk('ANMF', triples(0, 0, ...size, milliseconds), Uint8Array.of(unblended), pictureOf(bytes)),
    ),
  );
}
