// Tells whether a picture is an animation; the studio then uses its first frame only.
import { startsWith } from './kind.js';

const text = (bytes: Uint8Array, from: number, to: number): string => String.fromCharCode(...bytes.subarray(from, to));

/** Tells whether a GIF has several frames. Each has a graphic control extension before it. */
function isMovingGif(bytes: Uint8Array): boolean {
  let pictures = 0;
  for (let k = bytes.indexOf(0x21); k >= 0 && pictures < 2; k = bytes.indexOf(0x21, k + 1)) {
    const isControl = bytes[k + 1] === 0xf9 && bytes[k + 2] === 4 && bytes[k + 7] === 0;
    if (isControl && [0x21, 0x2c].includes(bytes[k + 8] ?? 0)) ++pictures;
  }
  return pictures > 1;
}

/** Tells whether a PNG is animated: an acTL chunk then comes before its pixels. */
function isMovingPng(bytes: Uint8Array): boolean {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let k = 8; k + 8 <= bytes.length; k += 12 + view.getUint32(k)) {
    const type = text(bytes, k + 4, k + 8);
    if (type === 'acTL' || type === 'IDAT') return type === 'acTL';
  }
  return false;
}

/** Tells whether a GIF, PNG, WebP or AVIF file is an animation. */
export function isAnimated(bytes: Uint8Array): boolean {
  const head = text(bytes, 0, 64);
  if (startsWith(bytes, 0x89, 0x50, 0x4e, 0x47)) return isMovingPng(bytes);
  if (head.startsWith('GIF8')) return isMovingGif(bytes);
  if (/^RIFF[^]{4}WEBPVP8X/.test(head)) return ((bytes[20] ?? 0) & 2) !== 0;
  return /^[^]{4}ftyp[^]*avis/.test(head);
}
