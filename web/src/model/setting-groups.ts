// The settings that the Print section shows at first, and the folded groups that hold the others.
import { expertSettings, settings, type Setting, type SettingId } from './settings.js';

/** Settings shown at first, which people change for a plate. With the printer, the filament, the thickness and the
 * quality there are at most 15 fields. Nozzle and beads have controls of their own. */
export const settingsAtFirst = [
  'printer.nozzle',
  'printer.nozzleTemperature',
  'printer.bedTemperature',
  'printer.speed',
  'print.layerHeight',
  'print.layers',
  'print.base',
  'toolpath.spacing',
  'toolpath.perimeterMode',
  'toolpath.perimeters',
] as const satisfies readonly SettingId[];

/** Keys of each group, in the order of their fields. */
const keysOf = {
  bed: 'place rotate mirror showSide copies copyGap startHeight',
  layers: 'rim rimWidth firstLayerHeight basePattern basePerimeters brim skirt elephantFoot strict',
  flow: 'flow baseFlow bedFlow filamentFlow constantFlow pressureAdvance setPressureAdvance maxFlow coast scarf purgeLength retractLength retractSpeed lift',
  heat: 'firstLayerNozzleTemperature firstLayerFan baseFan showFan minLayerTime maxNozzleTemperature maxBedTemperature generalHeatLimits',
  speed:
    'showSpeed baseSpeed firstLayerSpeed travelSpeed machineSpeed acceleration firstLayerAcceleration machineAcceleration cornerSpeed machineCornerSpeed curveAcceleration maxSegmentsPerSecond',
} as const;

type Listed = keyof typeof keysOf;
/** Name of a group: 'path' holds all settings of the toolpath, 'machine' those of no other group. */
export type GroupName = 'path' | Listed | 'machine';

const groupOf = ({ section, key }: Setting): GroupName => {
  if (section === 'toolpath') return 'path';
  const listed = (Object.keys(keysOf) as Listed[]).find((name) => keysOf[name].split(' ').includes(key));
  return listed ?? 'machine';
};

export const isAtFirst = (id: SettingId): boolean => (settingsAtFirst as readonly SettingId[]).includes(id);
const folded = settings.filter(({ id }) => !isAtFirst(id) && !expertSettings.has(id));

/** Groups of the settings that are folded away. */
export const settingGroups = (['bed', 'layers', 'path', 'flow', 'heat', 'speed', 'machine'] as const).map(
  (name): { name: GroupName; rows: readonly Setting[] } => {
    const order = name === 'path' || name === 'machine' ? [] : keysOf[name].split(' ');
    const rows = folded.filter((setting) => groupOf(setting) === name);
    return { name, rows: rows.sort((a, b) => order.indexOf(a.key) - order.indexOf(b.key)) };
  },
);
