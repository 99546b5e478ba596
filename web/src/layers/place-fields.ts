// Makes the fields of a layer's place, size and rotation.
import { html, type TemplateResult } from 'lit';
import { numberInput, type NumberField } from '../controls/fields.js';
import { icon } from '../controls/icons.js';
import { l } from '../i18n/layers.js';
import { a } from '../i18n/shaping.js';
import { hundredth, keepsProportions, scaledLayer, within } from '../model/layer-changes.js';
import type { Frame, Point } from '../model/layer-frame.js';
import { middleOf } from '../model/layer-list.js';
import { layerSettingOf } from '../model/layer-settings.js';
import type { LayerKey, LayerValues } from '../model/layers.js';
import { pageOf, type Plate, type PlateLayer } from '../model/plate.js';
import type { Studio } from '../studio/studio.js';
import { changeIn, layerField } from './layer-field.js';
import { button } from '../controls/button.js';

/** Makes the field of a length in mm. @param set  the layer's changes for a value of the field */
function lengthField(
  studio: Studio,
  layer: PlateLayer,
  key: 'at' | 'size',
  words: { id: string; label: string; value: number },
  set: (value: number) => Partial<LayerValues>,
): TemplateResult {
  const setting = layerSettingOf(key);
  const [min, max, step] = setting.kind === 'pair' ? [setting.min, setting.max, setting.step] : [0, 0, 1];
  const field: NumberField = {
    ...words,
    value: hundredth(words.value),
    min: key === 'size' ? step : min,
    max,
    step,
    unit: 'mm',
    onInput: (value) => changeIn(studio, layer, () => set(value), `layer.${layer.id}.${words.id}`),
    onSettle: () => studio.settle(),
  };
  return html`<div class="field stacked">
    <label for=${field.id}>${field.label}</label>${numberInput(field)}
    <p class="error" id="${field.id}-error" role="status" hidden></p>
  </div>`;
}

/** Stretches the layer over the whole page. A picture is cropped to its proportions; texts, codes and drawings keep
 * theirs. */
export function coveringPage(page: Point, layer: PlateLayer, frame: Frame): Partial<LayerValues> {
  const { size } = frame;
  const placed = { at: null, rotation: 0 };
  switch (layer.kind) {
    case 'picture': {
      const whole = [0, 1].map((k) => {
        const axis = k as 0 | 1;
        return size[axis] / (layer.cropMax[axis] - layer.cropMin[axis]);
      }) as [number, number];
      const scale = Math.max(page[0] / whole[0], page[1] / whole[1]);
      const cut = [0, 1].map((k) => {
        const share = page[k as 0 | 1] / (scale * whole[k as 0 | 1]);
        return Math.max(0, (1 - share) / 2);
      }) as [number, number];
      return { ...placed, size: [...page], cropMin: cut, cropMax: [1 - cut[0], 1 - cut[1]] };
    }
    case 'text':
    case 'code':
    case 'drawing': {
      const scale = Math.min(page[0] / size[0], page[1] / size[1]);
      return { ...placed, ...scaledLayer(layer, frame, [scale, scale]) };
    }
    default:
      return { ...placed, size: [0, 0] };
  }
}

/** Makes the fields of the middle of a pattern that fills the page, about which its rays and waves lie. */
export function middleFields(studio: Studio, layer: PlateLayer): TemplateResult {
  const middle = middleOf(studio.store.state.plate, layer);
  const field = (k: 0 | 1): TemplateResult =>
    lengthField(
      studio,
      layer,
      'at',
      { id: k === 0 ? 'layer-x' : 'layer-y', label: l(k === 0 ? 'x' : 'y'), value: middle[k] },
      // The mask makes the pattern cover the page wherever its middle lies.
      (value) => ({ at: k === 0 ? [value, middle[1]] : [middle[0], value], mask: 'page' }),
    );
  return html`<div class="size">${field(0)}<span></span>${field(1)}</div>`;
}

/** Makes the fields of a layer's place.
 * @param lock  state of the proportions' lock, and the function that toggles it */
export function placeFields(
  studio: Studio,
  layer: PlateLayer,
  frame: Frame,
  lock: { locked: boolean; toggle: () => void },
): TemplateResult {
  const { plate } = studio.store.state;
  const { middle, size } = frame;
  const locked = lock.locked || keepsProportions(layer);
  const place = (k: 0 | 1): TemplateResult =>
    lengthField(
      studio,
      layer,
      'at',
      { id: k === 0 ? 'layer-x' : 'layer-y', label: l(k === 0 ? 'x' : 'y'), value: middle[k] },
      (value) => ({ at: k === 0 ? [value, middle[1]] : [middle[0], value] }),
    );
  const side = (k: 0 | 1): TemplateResult =>
    lengthField(
      studio,
      layer,
      'size',
      {
        id: k === 0 ? 'layer-width' : 'layer-height',
        label: a(k === 0 ? 'size.width' : 'size.height'),
        value: size[k],
      },
      (value) => {
        if (!locked) return { size: k === 0 ? [value, hundredth(size[1])] : [hundredth(size[0]), value] };
        const scale = value / size[k];
        return scaledLayer(layer, frame, [scale, scale]);
      },
    );
  const set = (change: (plate: Plate) => Partial<LayerValues>): void => {
    studio.settle();
    changeIn(studio, layer, () => change(plate));
  };
  return html`<div class="size">
      ${place(0)}<span></span>${place(1)} ${side(0)}
      ${button(
        { look: 'square', name: a('size.lock'), disabled: keepsProportions(layer), pressed: locked },
        icon(locked ? 'lock' : 'unlock', 16),
        lock.toggle,
      )}
      ${side(1)}
    </div>
    <div class="buttons">
      ${button('', l('centre'), () => set(() => ({ at: null })))}
      ${button('', l('cover'), () => set((now) => coveringPage(pageOf(now), layer, frame)))}
    </div>
    ${(['rotation', 'mirror'] satisfies LayerKey[]).map((key) => layerField(studio, layer, key))}`;
}

/** The changes for a height of letters that was typed in: the text then has no other size. */
export const withTextSize = (value: number): Partial<LayerValues> => ({
  textSize: within('textSize', value),
  size: [0, 0],
});
