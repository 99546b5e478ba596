// The values of a layer as rows of data. Its fields are drawn from them, and layers from elsewhere are checked against
// them.
import type { LayerKey } from './layers.js';
import { layerTable } from './layer-table.js';
import { settingFrom, type LayerSetting, type LayerSettingId, type Span, type TableRow } from './settings.js';

type Table = typeof layerTable;
type KeyOf<Type> = { [Key in keyof Table]: Table[Key] extends { type: Type } ? Key : never }[keyof Table];

/** Steps and ranges of number fields, which the table lacks; `controls` in model/settings.ts has the others. */
const controls: Record<KeyOf<'number' | 'integer' | 'pair'>, Span> = {
  at: { step: 0.1 },
  size: { step: 0.1 },
  rotation: { step: 1, usual: [-180, 180] },
  soft: { step: 0.1, usual: [0, 10] },
  angle: { step: 1 },
  ground: { step: 1 },
  cropMin: { step: 0.01 },
  cropMax: { step: 0.01 },
  weight: { step: 50, usual: [100, 900] },
  textSize: { step: 0.1, usual: [2, 40] },
  circle: { step: 0.5, usual: [-60, 60] },
  waveLength: { step: 0.5, usual: [2, 60] },
  amplitude: { step: 1 },
  width: { step: 0.1, usual: [0.5, 12] },
  seed: { step: 1, usual: [0, 99] },
  from: { step: 1 },
  to: { step: 1 },
  threshold: { step: 0.01 },
  contrast: { step: 0.05, usual: [0.2, 4] },
  smoothing: { step: 0.1, usual: [0, 10] },
};

const rows = Object.entries(layerTable as Record<string, TableRow>).map(([key, entry]) => {
  const control = (controls as Record<string, Span>)[key] ?? { step: 1 };
  return settingFrom<LayerSettingId>('layers', key, entry, control);
});

export const layerSettings: readonly LayerSetting[] = rows;

const byKey = new Map(rows.map((setting) => [setting.key, setting]));

export const layerSettingOf = (key: LayerKey): LayerSetting => byKey.get(key) as LayerSetting;
