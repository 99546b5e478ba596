// Layers from elsewhere: each becomes one of a plate only as far as a control could have set it.
import { fieldsOf, numberIn, oneOf, Unfit, type Fields, type FileFrom } from './check.js';
import { layerSettingOf } from './layer-settings.js';
import { builtInFonts } from './fonts.js';
import { isFontFile, layerDefaults, layerKeys, mostLayers } from './layer-list.js';
import { type LayerKey, type LayerValues } from './layers.js';
import type { PlateLayer } from './plate.js';
import { accepts } from './settings.js';

/** @param fileFrom  undefined: files are not allowed */
function valueFrom(key: LayerKey, given: unknown, where: string, fileFrom: FileFrom | undefined): unknown {
  const file = (): unknown => {
    if (fileFrom === undefined) throw new Unfit(where, given);
    return fileFrom(given, where);
  };
  switch (key) {
    case 'file':
    case 'maskFile':
      return given === null ? null : file();
    case 'font':
      return typeof given === 'string' && !isFontFile(given) ? oneOf(given, where, builtInFonts) : file();
    default:
      if (!accepts(layerSettingOf(key), given)) throw new Unfit(where, given);
      return given;
  }
}

/** The core asks this of values together. */
function checkTogether({ cropMin, cropMax, lamp }: LayerValues, where: string): void {
  if (!(cropMin[0] < cropMax[0] && cropMin[1] < cropMax[1])) throw new Unfit(`${where}.cropMax`, cropMax);
  if (lamp !== null) numberIn(lamp[1], `${where}.lamp`, 1, 90);
}

function layerFrom(value: unknown, where: string, fileFrom: FileFrom | undefined): LayerValues & { id: unknown } {
  const fields = fieldsOf(value, where, [...layerKeys, 'id']);
  const read: Fields = layerDefaults();
  for (const key of layerKeys) {
    if (fields[key] !== undefined) read[key] = valueFrom(key, fields[key], `${where}.${key}`, fileFrom);
  }
  if (fields['kind'] === undefined) throw new Unfit(`${where}.kind`, undefined);
  const values = read as unknown as LayerValues;
  checkTogether(values, where);
  return { ...values, id: fields['id'] };
}

/** Values that are left out have their defaults; layers without an id get one that no other has.
 * @param fileFrom  undefined: files are not allowed
 * @throws Unfit */
export function layersFrom(value: unknown, fileFrom?: FileFrom): PlateLayer[] {
  if (!Array.isArray(value) || value.length > mostLayers) throw new Unfit('layers', value);
  const read = value.map((one: unknown, k) => layerFrom(one, `layers[${k}]`, fileFrom));
  const taken = new Set<number>();
  read.forEach(({ id }, k) => {
    if (id === undefined) return;
    const where = `layers[${k}].id`;
    const known = numberIn(id, where, 1, 1e9);
    if (!Number.isInteger(known) || taken.has(known)) throw new Unfit(where, id);
    taken.add(known);
  });
  let next = 0;
  const free = (): number => {
    do ++next;
    while (taken.has(next));
    return next;
  };
  return read.map((layer) => ({ ...layer, id: (layer.id as number | undefined) ?? free() }));
}
