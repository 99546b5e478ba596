// Reads the picture file of a plate's view: docs/reference/view.md. Any file may be given, so everything is checked.

export interface ViewFile {
  /** Sides of the plate [mm]. */
  page: [number, number];
  /** Colour of the filament, sRGB 0..255, and its slopes along and across the bead [degrees]. */
  colour: [number, number, number];
  slopes: [number, number];
  /** Compressed bytes: they are few, while decoded texels are kept only for views near the window. */
  png: Blob;
}

const mostBytes = 500e3; // the core writes 200 KiB at most
const mostTexels = 1 << 20; // the core writes at most a quarter as many
const mostComment = 1000;
const headerBytes = 33 + 12 + mostComment; // signature, IHDR, and the text chunk behind it
const patience = 60_000; // [ms]
const pattern =
  /^sillon-view 1 page (\d{1,9}) (\d{1,9}) spacing \d{1,9} colour (\d{1,3}) (\d{1,3}) (\d{1,3}) slopes (\d{1,4}) (\d{1,4})$/;

/** Returns the text chunk right behind the header; undefined if there is none. */
function commentOf(bytes: DataView): string | undefined {
  const header = 33; // signature and IHDR
  if (bytes.byteLength < header + 12 || bytes.getUint32(0) !== 0x89504e47) return undefined;
  const length = bytes.getUint32(header);
  if (length > mostComment || header + 12 + length > bytes.byteLength) return undefined;
  const text = new TextDecoder('latin1').decode(new Uint8Array(bytes.buffer, header + 4, 4 + length));
  return text.startsWith('tEXtComment\0') ? text.slice(12) : undefined;
}

/** Reads all fields but the picture. @param start  first bytes of the file @throws Error with one sentence */
function headerFrom(start: ArrayBuffer, name: string): Omit<ViewFile, 'png'> {
  const bytes = new DataView(start);
  const found = pattern.exec(commentOf(bytes) ?? '');
  if (found === null) throw new Error(`${name} is not a view of a plate; sillon generate --view makes one`);
  const [wide, tall] = [bytes.getUint32(16), bytes.getUint32(20)];
  if (wide * tall > mostTexels)
    throw new Error(`${name} has ${wide} x ${tall} texels; at most ${mostTexels} in all are read`);
  const number = (k: number): number => Number(found[k]);
  const byte = (k: number): number => Math.min(255, number(k));
  const slope = (k: number): number => Math.min(45, Math.max(0.1, number(k) / 100));
  return {
    page: [Math.max(1e-3, number(1) / 1000), Math.max(1e-3, number(2) / 1000)],
    colour: [byte(3), byte(4), byte(5)],
    slopes: [slope(6), slope(7)],
  };
}

/** Fetches a view, and stops reading if the file is no view
 * or too long: a server may send no length, or a wrong one.
 * @throws Error with one sentence; the signal's reason */
export async function fetchView(url: URL, name: string, signal: AbortSignal): Promise<ViewFile> {
  const stop = new AbortController();
  const late = setTimeout(() => stop.abort(new Error(`${name} did not arrive within ${patience / 1000} s`)), patience);
  const give = (): void => stop.abort(signal.reason);
  signal.addEventListener('abort', give);
  try {
    signal.throwIfAborted();
    const response = await fetch(url, { signal: stop.signal });
    if (!response.ok) throw new Error(`${name} came with status ${response.status}`);
    const parts: BlobPart[] = [];
    let size = 0;
    let header: Omit<ViewFile, 'png'> | undefined;
    const reader = response.body?.getReader();
    for (let next = await reader?.read(); next?.value !== undefined; next = await reader?.read()) {
      parts.push(next.value);
      size += next.value.byteLength;
      if (size > mostBytes) throw new Error(`${name} has more than ${mostBytes} bytes; no more are read`);
      if (header === undefined && size >= headerBytes) header = headerFrom(await new Blob(parts).arrayBuffer(), name);
    }
    const png = new Blob(parts, { type: 'image/png' });
    return { ...(header ?? headerFrom(await png.arrayBuffer(), name)), png };
  } finally {
    clearTimeout(late);
    signal.removeEventListener('abort', give);
    stop.abort(); // cancels the rest of the body
  }
}

/** Decodes the stored values without colour management, since they are no colours: red is the direction, green the
 * cover, blue the width.
 * @throws Error with one sentence */
export async function decodeView({ png }: ViewFile, name: string): Promise<ImageBitmap> {
  try {
    return await createImageBitmap(png, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  } catch {
    throw new Error(`${name} is damaged`);
  }
}
