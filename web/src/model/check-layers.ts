// Layers from elsewhere: each becomes one of a plate only as far as a control could have set it.
import { fieldsOf, numberIn, oneOf, Unfit, type Fields, type FileFrom } from './check.js';
import { layerSettingOf } from './layer-settings.js';
import { builtInFonts } from './fonts.js';
import { layerTable, mostEntries } from './layer-table.js';
import { isFontFile, layerDefaults, layerKeys, mostLayers } from './layer-list.js';
import { type LayerKey, type LayerValues } from './layers.js';
import type { PlateLayer } from './plate.js';
import { accepts } from './settings.js';

function listIn(given: unknown, where: string, most: number): unknown[] {
  if (!Array.isArray(given) || given.length > most) throw new Unfit(where, given);
  return given;
}

function lampIn(given: unknown, where: string): [number, number] {
  const [azimuth, elevation, ...more] = listIn(given, where, 2);
  if (more.length > 0) throw new Unfit(where, given);
  return [numberIn(azimuth, where, -360, 360), numberIn(elevation, where, 1, 90)];
}

const coloursIn = (given: unknown, where: string): PlateLayer['colours'] =>
  listIn(given, where, mostEntries.colours).map((one, k) => {
    const { colour, angle } = fieldsOf(one, `${where}[${k}]`, ['colour', 'angle']);
    if (typeof colour !== 'string' || !/^#[\da-f]{6}$/i.test(colour)) throw new Unfit(`${where}[${k}].colour`, colour);
    return { colour, angle: numberIn(angle ?? 0, `${where}[${k}].angle`, -360, 360) };
  });

const modes = layerTable.mode.choices;

/** The most points of all strokes of a layer together, as the core has it. */
const mostPoints = 200_000;

function strokesIn(given: unknown, where: string): PlateLayer['strokes'] {
  let left = 2 * mostPoints;
  return listIn(given, where, mostEntries.strokes).map((one, k) => {
    const at = `${where}[${k}]`;
    const fields = fieldsOf(one, at, ['tool', 'radius', 'soft', 'mode', 'points']);
    const { tool = 'comb', radius = 4, soft = 0.5, mode, points } = fields;
    const places = listIn(points, `${at}.points`, left).map((value) => numberIn(value, `${at}.points`, -1e4, 1e4));
    if (places.length % 2 !== 0) throw new Unfit(`${at}.points`, points);
    left -= places.length;
    return {
      tool: oneOf(tool, `${at}.tool`, ['comb', 'mode', 'erase'] as const),
      radius: numberIn(radius, `${at}.radius`, 0.1, 1000),
      soft: numberIn(soft, `${at}.soft`, 0, 1),
      ...(mode !== undefined && { mode: oneOf(mode, `${at}.mode`, modes) }),
      points: places,
    };
  });
}

/** @param fileFrom  undefined: files are not allowed */
function valueFrom(key: LayerKey, given: unknown, where: string, fileFrom: FileFrom | undefined): unknown {
  const file = (): unknown => {
    if (fileFrom === undefined) throw new Unfit(where, given);
    return fileFrom(given, where);
  };
  switch (key) {
    case 'file':
    case 'maskFile':
    case 'modeFile':
      return given === null ? null : file();
    case 'lamp':
      return given === null ? null : lampIn(given, where);
    case 'others':
      return listIn(given, where, mostEntries.pictures - 1).map((one, k) => {
        const fields = fieldsOf(one, `${where}[${k}]`, ['file', 'lamp']);
        if (fileFrom === undefined) throw new Unfit(where, given);
        const lamp = fields['lamp'] === null ? null : lampIn(fields['lamp'], `${where}[${k}].lamp`);
        return { file: fileFrom(fields['file'], `${where}[${k}].file`), lamp };
      });
    case 'colours':
      return coloursIn(given, where);
    case 'strokes':
      return strokesIn(given, where);
    case 'font':
      return typeof given === 'string' && !isFontFile(given) ? oneOf(given, where, builtInFonts) : file();
    default:
      if (!accepts(layerSettingOf(key), given)) throw new Unfit(where, given);
      return given;
  }
}

/** The core asks this of values together. */
function checkTogether({ cropMin, cropMax }: LayerValues, where: string): void {
  if (!(cropMin[0] < cropMax[0] && cropMin[1] < cropMax[1])) throw new Unfit(`${where}.cropMax`, cropMax);
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
