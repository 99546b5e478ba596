// Reads the picture that a plate's view is: docs/reference/view.md. It may be any file.

export interface ViewFile {
  /** Of the plate [mm]. */
  page: [number, number];
  /** Of its filament: sRGB 0..255, slopes along and across the bead [degrees]. */
  colour: [number, number, number];
  slopes: [number, number];
  /** Red: direction; green: cover; blue: width. */
  texels: ImageBitmap;
}

const mostBytes = 4e6;
const mostSide = 4096; // [texels]
const pattern =
  /^sillon-view 1 page (\d{1,9}) (\d{1,9}) spacing \d{1,9} colour (\d{1,3}) (\d{1,3}) (\d{1,3}) slopes (\d{1,4}) (\d{1,4})$/;

/** Of the chunk of text right behind the header; undefined where there is none. */
function commentOf(bytes: DataView): string | undefined {
  const header = 33; // signature and IHDR
  if (bytes.byteLength < header + 12 || bytes.getUint32(0) !== 0x89504e47) return undefined;
  const length = bytes.getUint32(header);
  if (length > 1000 || header + 12 + length > bytes.byteLength) return undefined;
  const text = new TextDecoder('latin1').decode(new Uint8Array(bytes.buffer, header + 4, 4 + length));
  return text.startsWith('tEXtComment\0') ? text.slice(12) : undefined;
}

/** @throws Error with one sentence */
export async function readViewFile(file: ArrayBuffer, name: string): Promise<ViewFile> {
  if (file.byteLength > mostBytes)
    throw new Error(`${name} has ${file.byteLength} bytes; at most ${mostBytes} are read`);
  const bytes = new DataView(file);
  const found = pattern.exec(commentOf(bytes) ?? '');
  if (found === null) throw new Error(`${name} is no view of a plate; sillon generate --view makes one`);
  const [wide, tall] = [bytes.getUint32(16), bytes.getUint32(20)];
  if (wide > mostSide || tall > mostSide)
    throw new Error(`${name} has ${wide} x ${tall} texels; at most ${mostSide} a side`);
  const number = (k: number): number => Number(found[k]);
  const byte = (k: number): number => Math.min(255, number(k));
  // Stored values, as they are: they are no colours.
  const texels = await createImageBitmap(new Blob([file], { type: 'image/png' }), {
    colorSpaceConversion: 'none',
    premultiplyAlpha: 'none',
  }).catch(() => {
    throw new Error(`${name} is damaged`);
  });
  const slope = (k: number): number => Math.min(45, Math.max(0.1, number(k) / 100));
  return {
    page: [Math.max(1e-3, number(1) / 1000), Math.max(1e-3, number(2) / 1000)],
    colour: [byte(3), byte(4), byte(5)],
    slopes: [slope(6), slope(7)],
    texels,
  };
}
