// Names under which core asks for letters and QR codes as for files: core/src/text/letters.cpp, qr_code_elsewhere.cpp.

/** @param key  font of the line, with a tab and its weight if that is not the font's own, or error correction of the code */
export const nameOf = (kind: 'line' | 'qr', key: string, text: string): string => `${kind}:${key}\n${text}`;

/** Parses such a name. */
export function lettersOf(name: string): { kind: string; key: string; text: string } {
  const [, kind = '', key = '', text = ''] = /^(line|qr):([^\n]*)\n([^]*)$/.exec(name) ?? [];
  return { kind, key, text };
}
