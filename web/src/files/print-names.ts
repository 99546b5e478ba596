// The names of the objects in a packed print, which its G-code has codes for.
import { openZip } from './unzip.js';

const codes: Readonly<Record<string, string>> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };

const attributeOf = (tag: string, name: string): string =>
  (new RegExp(`\\s${name}="([^"]*)"`).exec(tag)?.[1] ?? '').replace(
    /&(amp|lt|gt|quot|apos);/g,
    (_, code: string) => codes[code] ?? '',
  );

/** Returns the names of a plate's objects, in the order of their codes. @param info  the package's slice_info.config */
export function namesIn(info: string, plate: string): string[] {
  const plates = info.match(/<plate>[^]*?<\/plate>/g) ?? [];
  const own = plates.find((one) => new RegExp(`key="index" value="${plate}"`).test(one)) ?? plates[0] ?? '';
  return (own.match(/<object\s[^>]*>/g) ?? [])
    .map((tag) => ({ id: Number(attributeOf(tag, 'identify_id')), name: attributeOf(tag, 'name') }))
    .sort((a, b) => a.id - b.id)
    .map(({ name }) => name);
}

/** None where the file tells none, or cannot be read: the engine says what is wrong with it. */
export async function objectNames(file: File): Promise<string[]> {
  if (!/\.3mf$/i.test(file.name)) return [];
  try {
    const entries = openZip(new Uint8Array(await file.arrayBuffer()));
    const gcode = [...entries.keys()].find((path) => path.endsWith('.gcode')) ?? '';
    const info = await entries.get('Metadata/slice_info.config')?.read();
    return info === undefined ? [] : namesIn(new TextDecoder().decode(info), /(\d+)\.gcode$/.exec(gcode)?.[1] ?? '1');
  } catch {
    return [];
  }
}
