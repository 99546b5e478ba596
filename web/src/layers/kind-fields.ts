// Makes the fields of a layer: the few that matter for its kind, and those that are folded away.
import { html, nothing, type TemplateResult } from 'lit';
import { angleField } from '../controls/angle-field.js';
import { flag, select } from '../controls/fields.js';
import { fileChip } from '../controls/file-chip.js';
import { icon } from '../controls/icons.js';
import { settingHelp } from '../i18n/help.js';
import { fontName, l, layerLabel } from '../i18n/layers.js';
import { t } from '../i18n/text.js';
import { groundOf } from '../model/fills.js';
import { uncropped } from '../model/layer-changes.js';
import { layerSettingOf } from '../model/layer-settings.js';
import { builtInFonts } from '../model/fonts.js';
import { withoutLayer } from '../model/layer-list.js';
import { hasFill, needsFile, needsMask, type LayerKey, type LayerKind } from '../model/layers.js';
import { modeChoices, type PlateLayer, type SourceFile } from '../model/plate.js';
import type { Studio } from '../studio/studio.js';
import '../quality/scan-note.js';
import { chosenFile, drawingFiles, fontFiles, oneFile, pictureFiles } from './add-layer.js';
import './colours-panel.js';
import { layerIcon } from './icons.js';
import './lamps-panel.js';
import { changeIn, layerField } from './layer-field.js';
import { withTextSize } from './place-fields.js';
import { replaceFile } from './replace-file.js';
import { button } from '../controls/button.js';

type Content = TemplateResult | typeof nothing;

/** Values shown at once, in the order in which a layer is usually made. */
const keysOf: Record<LayerKind, readonly LayerKey[]> = {
  text: ['text', 'font', 'weight', 'textSize', 'fill', 'angle', 'circle'],
  picture: ['pictures', 'cropMin'],
  drawing: ['file', 'fill', 'angle'],
  code: ['text', 'correction', 'angle'],
  pattern: ['pattern', 'file', 'angle', 'waveLength', 'amplitude', 'seed'],
  tones: ['file', 'by', 'colours', 'from', 'to', 'threshold', 'contrast', 'smoothing', 'angle'],
  strokes: ['strokes'],
  direction: ['angle'],
  border: ['width', 'fill', 'angle'],
  map: ['file', 'encoding'],
};

const usuallyFolded: readonly LayerKey[] = ['mask', 'soft', 'mode'];

const foldedOf: Partial<Record<LayerKind, readonly LayerKey[]>> = {
  text: ['align', 'ground', 'mask', 'soft', 'mode'],
  drawing: ['ground', 'mask', 'soft', 'mode'],
  code: ['ground', 'mask', 'soft', 'mode'],
  strokes: [],
  border: ['soft', 'mode'],
};

/** Tells whether a value has any effect while the other values stay as they are. */
function hasEffect(key: LayerKey, layer: PlateLayer): boolean {
  const { kind, pattern, fill, by } = layer;
  switch (key) {
    case 'angle':
      if (kind === 'tones') return by === 'edges';
      return kind === 'pattern' ? pattern !== 'echo' : fill === 'angle' || !hasFill(layer);
    case 'waveLength':
      return pattern === 'waves' || pattern === 'spiral' || pattern === 'noise';
    case 'amplitude':
      return pattern === 'waves' || pattern === 'noise';
    case 'seed':
      return pattern === 'noise';
    case 'from':
    case 'to':
      return by === 'brightness' || by === 'levels';
    case 'threshold':
      return by === 'levels';
    case 'contrast':
      return by === 'brightness';
    case 'smoothing':
      return by === 'brightness' || by === 'edges';
    case 'colours':
      return by === 'colours';
    case 'file':
      return needsFile(layer);
    case 'weight':
      return typeof layer.font !== 'string'; // the studio's own fonts have a single weight
    default:
      return true;
  }
}

/** Keys that get no field on the ground: cards choose its pattern and fill, and its picture fills the page
 * uncropped. */
const notOfGround: readonly LayerKey[] = ['pattern', 'by', 'cropMin'];

/** Makes the fields shown at once for a layer. */
export function kindFields(studio: Studio, layer: PlateLayer): Content[] {
  const ground = groundOf(studio.store.state.plate) === layer;
  return keysOf[layer.kind]
    .filter((key) => hasEffect(key, layer) && !(ground && notOfGround.includes(key)))
    .map((key) => fieldOf(studio, layer, key));
}

/** Makes the fields that are folded away for a layer. */
export const foldedFields = (studio: Studio, layer: PlateLayer): Content[] =>
  (foldedOf[layer.kind] ?? usuallyFolded).map((key) => fieldOf(studio, layer, key));

function fieldOf(studio: Studio, layer: PlateLayer, key: LayerKey): Content {
  switch (key) {
    case 'file':
      return fileField(studio, layer, 'file', layer.kind === 'map' ? pictureFiles : drawingFiles);
    case 'font':
      return fontField(studio, layer);
    case 'textSize':
      return layerField(studio, layer, key, { set: (value) => withTextSize(value as number) });
    case 'pictures':
      return html`<sillon-lamps class="stack" .studio=${studio} .layer=${layer}></sillon-lamps>`;
    case 'colours':
      return html`<sillon-colours class="stack" .studio=${studio} .layer=${layer}></sillon-colours>`;
    case 'strokes':
      return strokesField(studio, layer);
    case 'mode':
      return modeFields(studio, layer);
    case 'cropMin':
      return cropField(studio, layer);
    case 'text':
      return html`${layerField(studio, layer, key, layer.kind === 'code' ? { label: t('field.qrText') } : {})}
      ${layer.kind === 'code' ? html`<sillon-scan-note .studio=${studio}></sillon-scan-note>` : nothing}`;
    case 'encoding':
      return layerField(studio, layer, key, {
        choice: (name) => t(`field.encoding.${name as PlateLayer['encoding']}`),
      });
    case 'ground':
      return groundField(studio, layer);
    case 'mask':
      return html`${layerField(studio, layer, key)}
      ${needsMask(layer) ? fileField(studio, layer, 'maskFile', drawingFiles) : nothing}`;
    default:
      return layerField(studio, layer, key);
  }
}

/** Makes the field of a file: a chip that names it, or a button to choose one. */
function fileField(studio: Studio, layer: PlateLayer, key: 'file' | 'maskFile', accept: string): TemplateResult {
  const file = layer[key];
  const use = async (found: SourceFile | undefined): Promise<void> => {
    if (found === undefined) return;
    if (key === 'file') await replaceFile(studio, layer, found);
    else changeIn(studio, layer, () => ({ maskFile: found }));
  };
  if (file !== null) {
    return fileChip(studio, file, accept, undefined, async (files) => {
      await use(await oneFile(studio, files, accept));
    });
  }
  return html`<div class="buttons">
    ${button('', html`${icon('open', 16)} ${l('chooseFile')}`, async () => {
      await use(await chosenFile(studio, accept));
    })}
  </div>`;
}

/** Makes the field of the font: it offers the studio's fonts and the layer's own, and a button for a file. */
function fontField(studio: Studio, layer: PlateLayer): TemplateResult {
  const { font } = layer;
  const setting = layerSettingOf('font');
  const own = typeof font === 'string' ? [] : [{ value: font.id, label: fontName(font) }];
  return html`${select<string>({
      id: 'layer-font',
      label: layerLabel(setting),
      help: settingHelp(setting),
      value: typeof font === 'string' ? font : font.id,
      options: [...builtInFonts.map((name) => ({ value: name, label: name })), ...own],
      onChoose: (name) => {
        if (typeof font === 'string' || name !== font.id) changeIn(studio, layer, () => ({ font: name }));
      },
    })}
    <div class="buttons">
      ${button('', l('ownFont'), async () => {
        const found = await chosenFile(studio, fontFiles);
        if (found !== undefined) changeIn(studio, layer, () => ({ font: found }));
      })}
    </div>`;
}

/** Makes the selector of the layer's mode, and a chip for its picture of modes if it has one. */
export function modeFields(studio: Studio, layer: PlateLayer): TemplateResult {
  const { mode, modeFile } = layer;
  return html`${select({
      id: 'mode-base',
      label: t('modes.base'),
      value: mode,
      options: modeChoices.map((value) => ({ value, label: t(`mode.${value}`) })),
      onChoose: (chosen) => changeIn(studio, layer, () => ({ mode: chosen })),
    })}
    <p class="note">${t(`mode.${mode}.help`)}</p>
    ${
      modeFile === null
        ? nothing
        : html`<p>${t('modes.map')}</p>
            ${fileChip(studio, modeFile, pictureFiles, () => changeIn(studio, layer, () => ({ modeFile: null })))}`
    }`;
}

/** Shows the number of strokes, and a button that removes the whole layer. */
function strokesField(studio: Studio, layer: PlateLayer): TemplateResult {
  return html`<div class="strokes">
    <span class="note">${t('tool.strokes', { n: layer.strokes.length })}</span>
    ${button('', html`${icon('erase', 16)} ${t('tool.clear')}`, () =>
      studio.change((plate) => withoutLayer(plate, layer.id)),
    )}
  </div>`;
}

/** Makes the buttons that start a crop and undo it. */
function cropField(studio: Studio, layer: PlateLayer): Content {
  const { cropping } = studio.store.state;
  const whole = [...layer.cropMin, ...layer.cropMax].join() === '0,0,1,1';
  return html`<div class="buttons">
      ${button({ pressed: cropping }, html`${layerIcon('crop', 16)} ${l('crop')}`, () =>
        studio.store.set({ cropping: !cropping, tool: 'pan' }),
      )}
      ${whole ? nothing : button('', l('uncrop'), () => changeIn(studio, layer, () => uncropped))}
    </div>
    ${cropping ? html`<p class="note">${l('crop.help')}</p>` : nothing}`;
}

/** Makes the field of the direction in the box around the ink. Null leaves what lies below; for a code, light modules
 * then lie across the dark ones. */
function groundField(studio: Studio, layer: PlateLayer): TemplateResult {
  const { ground } = layer;
  const setting = layerSettingOf('ground');
  const [min, max] = setting.kind === 'number' ? [setting.min, setting.max] : [0, 0];
  const label = layerLabel(setting);
  const set = (next: number | null, gesture?: string): void =>
    changeIn(studio, layer, () => ({ ground: next }), gesture);
  return html`${flag({
    id: 'layer-ground-null',
    label: t('setting.value', { label, value: l(layer.kind === 'code' ? 'null.modules' : 'null.ground') }),
    value: ground === null,
    help: settingHelp(setting),
    onChange: (below) => set(below ? null : 0),
  })}
  ${
    ground === null
      ? nothing
      : angleField({
          id: 'layer-ground',
          label,
          value: ground,
          min,
          max,
          onInput: (angle) => set(angle, `layer.${layer.id}.ground`),
          onSettle: () => studio.settle(),
        })
  }`;
}
