// A value of a layer as a control.
import type { TemplateResult } from 'lit';
import { angleField } from '../controls/angle-field.js';
import { valueField } from '../controls/setting-field.js';
import { settingHelp } from '../i18n/help.js';
import { l, layerLabel, type LayersTextId } from '../i18n/layers.js';
import { layerSettingOf } from '../model/layer-settings.js';
import { changeLayer } from '../model/layer-list.js';
import { type LayerKey, type LayerValues } from '../model/layers.js';
import type { PlateLayer } from '../model/plate.js';
import type { SettingValue } from '../model/settings.js';
import type { Studio } from '../studio/studio.js';

/** Changes the layer, whatever it has become; @param gesture  as of Studio.change */
export function changeIn(
  studio: Studio,
  { id }: PlateLayer,
  change: (layer: PlateLayer) => Partial<LayerValues>,
  gesture?: string,
): void {
  studio.change((plate) => changeLayer(plate, id, change), gesture);
}

/** These take the place of what the key shows everywhere. */
interface Own {
  label?: string;
  help?: string;
  /** The name of a choice. */
  choice?: (name: string) => string;
  /** The layer's changes with a value. */
  set?: (value: SettingValue) => Partial<LayerValues>;
}

export function layerField(studio: Studio, layer: PlateLayer, key: LayerKey, own: Own = {}): TemplateResult {
  const setting = layerSettingOf(key);
  const {
    label = layerLabel(setting),
    help = settingHelp(setting),
    choice = (name: string) => l(`${key}.${name}` as LayersTextId),
    set = (next: SettingValue) => ({ [key]: next }),
  } = own;
  const value = layer[key] as SettingValue;
  const id = `layer-${key}`;
  const onInput = (next: SettingValue): void => {
    changeIn(studio, layer, () => set(next), `layer.${layer.id}.${key}`);
  };
  const onSettle = (): void => {
    studio.settle();
  };
  if (key === 'angle' && setting.kind === 'number') {
    const { min, max } = setting;
    return angleField({ id, label, help, value: value as number, min, max, onInput, onSettle });
  }
  return valueField({
    setting,
    id,
    label,
    help,
    value,
    fallback: 0,
    nullLabel: '', // what may be null has fields of its own
    choiceLabel: choice,
    onInput,
    onSettle,
  });
}
