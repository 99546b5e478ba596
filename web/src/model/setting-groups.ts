// The settings that the Print section shows at once, and the folded groups that hold the others.
import { expertSettings, settings, type Setting, type SettingId } from './settings.js';

/** At most 15 fields are seen at first, with the printer's, the filament's, the thickness and the quality: what people change
 * for a plate. Nozzle and beads have controls of their own. */
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

/** Keys in the order of their fields. */
const keysOf = {
  bed: 'place rotate mirror showSide copies copyGap startHeight',
  layers: 'rim rimWidth firstLayerHeight basePattern basePerimeters brim skirt elephantFoot strict',
  flow: 'flow baseFlow bedFlow filamentFlow constantFlow pressureAdvance setPressureAdvance maxFlow coast scarf purgeLength retractLength retractSpeed lift',
  heat: 'firstLayerNozzleTemperature firstLayerFan baseFan showFan minLayerTime maxNozzleTemperature maxBedTemperature generalHeatLimits',
  speed:
    'showSpeed baseSpeed firstLayerSpeed travelSpeed machineSpeed acceleration firstLayerAcceleration machineAcceleration cornerSpeed machineCornerSpeed curveAcceleration maxSegmentsPerSecond',
} as const;

type Listed = keyof typeof keysOf;
/** 'path': all of the toolpath's; 'machine': what is in no other. */
export type GroupName = 'path' | Listed | 'machine';

const groupOf = ({ section, key }: Setting): GroupName => {
  if (section === 'toolpath') return 'path';
  const listed = (Object.keys(keysOf) as Listed[]).find((name) => keysOf[name].split(' ').includes(key));
  return listed ?? 'machine';
};

export const isAtFirst = (id: SettingId): boolean => (settingsAtFirst as readonly SettingId[]).includes(id);
const folded = settings.filter(({ id }) => !isAtFirst(id) && !expertSettings.has(id));

/** Settings that are folded away. */
export const settingGroups = (['bed', 'layers', 'path', 'flow', 'heat', 'speed', 'machine'] as const).map(
  (name): { name: GroupName; rows: readonly Setting[] } => {
    const order = name === 'path' || name === 'machine' ? [] : keysOf[name].split(' ');
    const rows = folded.filter((setting) => groupOf(setting) === name);
    return { name, rows: rows.sort((a, b) => order.indexOf(a.key) - order.indexOf(b.key)) };
  },
);
