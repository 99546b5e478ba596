// Files as a plate keeps them: bytes in memory, which do not change with the disk, and an id derived from them.
import type { SourceFile } from '../model/plate.js';
import { enoughToKnow, kindOf } from './kind.js';

const hex = (bytes: Uint8Array): string => Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');

/** Digest for pages served without TLS, where browsers offer none: FNV-1a in four lanes. Somebody could make two
 * files with the same id, but would only confuse their own page. */
export function plainDigest(bytes: Uint8Array): string {
  const lanes = Uint32Array.of(0x811c9dc5, 0x01000193, 0x9e3779b9, 0x7f4a7c15);
  for (let k = 0; k < bytes.length; ++k) {
    lanes[k & 3] = Math.imul((lanes[k & 3] as number) ^ (bytes[k] as number), 0x01000193);
  }
  return `${bytes.length.toString(16)}-${hex(new Uint8Array(lanes.buffer))}`;
}

export async function digest(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
  const { subtle } = crypto as { subtle?: SubtleCrypto };
  return subtle === undefined ? plainDigest(bytes) : hex(new Uint8Array(await subtle.digest('SHA-256', bytes)));
}

/** File name without folders and control characters; never empty. */
export function cleanName(name: string): string {
  const last = name.split(/[\\/]/).at(-1) ?? '';
  const plain = last.replace(/[\p{Cc}\p{Cs}]/gu, '').trim();
  return Array.from(plain).slice(0, 120).join('') || 'file'; // cuts between whole characters
}

export async function sourceFile(name: string, bytes: Uint8Array<ArrayBuffer>): Promise<SourceFile> {
  const { mime } = kindOf(bytes.subarray(0, enoughToKnow), name);
  return { id: await digest(bytes), name: cleanName(name), bytes: new Blob([bytes], { type: mime }) };
}

/** Name without its last extension: "Leaf.final.svg" becomes "Leaf.final". */
export const stemOf = (name: string): string => name.replace(/\.[^.]*$/, '') || name;
