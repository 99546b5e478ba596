// Names under which the core asks for letters and QR codes as for files: core/src/text/letters.cpp, qr_code_elsewhere.cpp.

/** @param key  font of the line, or error correction of the code */
export const nameOf = (kind: 'line' | 'qr', key: string, text: string): string => `${kind}:${key}\n${text}`;

/** The key of a font at a weight; 0 is the font's own. */
export const keyOf = (font: string, weight: number): string => (weight > 0 ? `${font}\t${weight}` : font);

/** The question that such a name asks. */
export function lettersOf(name: string): { kind: string; key: string; weight: number; text: string } {
  const [, kind = '', key = '', weight = 0, text = ''] = /^(line|qr):([^\n]*?)(?:\t(\d+))?\n([^]*)$/.exec(name) ?? [];
  return { kind, key, weight: Number(weight), text };
}
