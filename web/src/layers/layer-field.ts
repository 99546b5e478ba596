// A value of a layer as a control.
import type { TemplateResult } from 'lit';
import { angleField } from '../controls/angle-field.js';
import { valueField } from '../controls/setting-field.js';
import { settingHelp } from '../i18n/help.js';
import { l, type LayersTextId } from '../i18n/layers.js';
import { settingLabel } from '../i18n/say.js';
import { layerSettingOf } from '../model/layer-settings.js';
import { changeLayer, type LayerKey, type LayerValues } from '../model/layers.js';
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

/** What differs from how the key is shown everywhere. */
interface Own {
  label?: string;
  help?: string;
  /** What null means. */
  none?: LayersTextId;
  /** What the layer becomes with a value. */
  set?: (value: SettingValue) => Partial<LayerValues>;
}

export function layerField(studio: Studio, layer: PlateLayer, key: LayerKey, own: Own = {}): TemplateResult {
  const setting = layerSettingOf(key);
  const {
    label = settingLabel(setting),
    help = settingHelp(setting),
    none,
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
    nullLabel: none === undefined ? '' : l(none),
    choiceLabel: (choice) => l(`${key}.${choice}` as LayersTextId),
    onInput,
    onSettle,
  });
}
