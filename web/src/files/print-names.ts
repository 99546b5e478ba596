// Reads the names of the objects in a packed print, for which its G-code has only codes.
import { openZip } from './unzip.js';

const codes: Readonly<Record<string, string>> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };

/** An attribute of an XML tag with its entities decoded; empty where it is missing. */
const attributeOf = (tag: string, name: string): string =>
  (new RegExp(`\\s${name}="([^"]*)"`).exec(tag)?.[1] ?? '').replace(
    /&(amp|lt|gt|quot|apos);/g,
    (_, code: string) => codes[code] ?? '',
  );

/** Names of a plate's objects, in the order of their codes. @param info  the package's slice_info.config */
export function namesIn(info: string, plate: string): string[] {
  const plates = info.match(/<plate>[^]*?<\/plate>/g) ?? [];
  const own = plates.find((one) => new RegExp(`key="index" value="${plate}"`).test(one)) ?? plates[0] ?? '';
  return (own.match(/<object\s[^>]*>/g) ?? [])
    .map((tag) => ({ id: Number(attributeOf(tag, 'identify_id')), name: attributeOf(tag, 'name') }))
    .sort((a, b) => a.id - b.id)
    .map(({ name }) => name);
}

/** Names of the objects in a print; empty where the file has none or cannot be read, which the engine then explains. */
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
