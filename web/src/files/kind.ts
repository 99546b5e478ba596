// Recognises the kind of a file by its first bytes, never by its name alone.

export type Kind = 'svg' | 'picture' | 'font' | 'zip' | 'json' | 'unknown';

/** MIME type of all TrueType and OpenType fonts, packed or not. */
export const fontType = 'font/sfnt';

export interface Known {
  kind: Kind;
  /** Type for the browser's own decoders. */
  mime: string;
}

const unknown: Known = { kind: 'unknown', mime: '' };

export const startsWith = (bytes: Uint8Array, ...magic: readonly number[]): boolean =>
  magic.every((byte, k) => bytes[k] === byte);

/** Tells whether a file is a TGA picture. That format has no signature, so its header must make sense and its name
 * must say so. */
function isTga(bytes: Uint8Array, name: string): boolean {
  const [, mapType = 9, imageType = 0] = bytes;
  const sane = bytes.length >= 18 && mapType <= 1 && [1, 2, 3, 9, 10, 11].includes(imageType);
  return sane && [8, 15, 16, 24, 32].includes(bytes[16] ?? 0) && /\.tga$/i.test(name);
}

function textOf(bytes: Uint8Array): string {
  const utf16 = startsWith(bytes, 0xff, 0xfe) ? 'utf-16le' : startsWith(bytes, 0xfe, 0xff) ? 'utf-16be' : undefined;
  return new TextDecoder(utf16 ?? 'utf-8').decode(bytes).replace(/^\ufeff/, ''); // a second BOM may follow
}

/** Position after the next `end` from `from` on; undefined where there is none. */
function behind(text: string, end: string, from: number): number | undefined {
  const at = text.indexOf(end, from);
  return at < 0 ? undefined : at + end.length;
}

/** Tells whether the root element is svg, after any XML declaration, comments and document type. */
function isSvg(text: string): boolean {
  let at: number | undefined = 0;
  for (;;) {
    while (/\s/.test(text.charAt(at))) ++at;
    if (text.startsWith('<?', at)) at = behind(text, '?>', at);
    else if (text.startsWith('<!--', at)) at = behind(text, '-->', at + 4);
    else if (/^<!doctype/i.test(text.slice(at, at + 9))) {
      const subset = text.indexOf('[', at);
      const close = text.indexOf('>', at);
      // Drawing programs declare entities in square brackets, which contain '>' themselves.
      at = subset >= 0 && subset < close ? behind(text, ']', subset) : close < 0 ? undefined : close + 1;
      if (at !== undefined && subset >= 0 && subset < close) at = behind(text, '>', at);
    } else return /^<(?:[\w-]{1,40}:)?svg[\s/>]/.test(text.slice(at, at + 50));
    if (at === undefined) return false;
  }
}

/** MIME type of a picture that only browsers read, by its first bytes; empty for any other file. */
export function browserPicture(bytes: Uint8Array): string {
  const text = String.fromCharCode(...bytes.subarray(0, 64));
  if (/^GIF8[79]a/.test(text)) return 'image/gif';
  if (/^RIFF[^]{4}WEBP/.test(text)) return 'image/webp';
  const [, brands = ''] = /^[^]{4}ftyp([^]*)/.exec(text) ?? [];
  if (/^(?:avif|avis)/.test(brands)) return 'image/avif';
  if (/^(?:heic|heix|hevc|heim|heis|mif1|msf1)/.test(brands)) return /avif/.test(brands) ? 'image/avif' : 'image/heic';
  return '';
}

/** Formats of other drawing programs by file extension. Their bytes are less telling, or only show the format they
 * build on. */
const drawings: Readonly<Record<string, string>> = {
  ai: 'Illustrator',
  cdr: 'CorelDRAW',
  dwg: 'DWG',
  dxf: 'DXF',
  emf: 'EMF',
  eps: 'PostScript',
  wmf: 'WMF',
  xcf: 'GIMP',
};

/** Name of a format that people take for a picture or drawing but that cannot be read; empty for any other file. */
export function otherFormat(bytes: Uint8Array, name: string): string {
  const drawing = drawings[/\.(\w+)$/.exec(name)?.[1]?.toLowerCase() ?? ''];
  if (drawing !== undefined) return drawing;
  const text = String.fromCharCode(...bytes.subarray(0, 8));
  const formats = { PDF: /^%PDF/, PostScript: /^%!PS/, Photoshop: /^8BPS/, TIFF: /^(?:II\*\0|MM\0\*)/ };
  return Object.entries(formats).find(([, magic]) => magic.test(text))?.[0] ?? '';
}

/** Number of bytes that `kindOf` looks at. */
export const enoughToKnow = 1 << 16;

/** Kind of a file. @param bytes  the first `enoughToKnow` bytes of the file */
export function kindOf(bytes: Uint8Array, name: string): Known {
  if (startsWith(bytes, 0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a)) return { kind: 'picture', mime: 'image/png' };
  if (startsWith(bytes, 0xff, 0xd8, 0xff)) return { kind: 'picture', mime: 'image/jpeg' };
  if (startsWith(bytes, 0x42, 0x4d) && bytes.length >= 26) return { kind: 'picture', mime: 'image/bmp' };
  if (startsWith(bytes, 0x50, 0x4b, 3, 4) || startsWith(bytes, 0x50, 0x4b, 5, 6)) {
    return { kind: 'zip', mime: 'application/zip' };
  }
  const mark = String.fromCharCode(...bytes.subarray(0, 4));
  if (startsWith(bytes, 0, 1, 0, 0) || ['OTTO', 'true', 'ttcf', 'wOFF', 'wOF2'].includes(mark))
    return { kind: 'font', mime: fontType };
  const text = textOf(bytes.subarray(0, enoughToKnow));
  if (isSvg(text)) return { kind: 'svg', mime: 'image/svg+xml' };
  if (/^\s*\{/.test(text)) return { kind: 'json', mime: 'application/json' };
  if (isTga(bytes, name)) return { kind: 'picture', mime: 'image/x-tga' };
  return unknown;
}
