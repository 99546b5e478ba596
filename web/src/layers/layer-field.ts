// Controls for the values of a layer.
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

/** Changes the layer in its present state. @param gesture  as for `Studio.change` */
export function changeIn(
  studio: Studio,
  { id }: PlateLayer,
  change: (layer: PlateLayer) => Partial<LayerValues>,
  gesture?: string,
): void {
  studio.change((plate) => changeLayer(plate, id, change), gesture);
}

/** Words and changes that replace a value's usual ones. */
interface Own {
  label?: string;
  help?: string;
  /** Name of a choice. */
  choice?: (name: string) => string;
  /** The layer's changes for a value. */
  set?: (value: SettingValue) => Partial<LayerValues>;
}

/** The control of one value. @param own  words and changes that replace the usual ones */
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
  const onInput = (next: SettingValue): void => changeIn(studio, layer, () => set(next), `layer.${layer.id}.${key}`);
  const onSettle = (): void => studio.settle();
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
    nullLabel: '', // nullable values have fields of their own
    choiceLabel: choice,
    onInput,
    onSettle,
  });
}
