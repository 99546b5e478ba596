// Words about layers, so that a first visit in English need not load them.
import { isFontFile } from '../model/layer-list.js';
import { fillOf, toldFrom } from '../model/fills.js';
import type { PlateLayer } from '../model/plate.js';
import type { LayerSetting } from '../model/settings.js';
import { words as settings } from './en/core/layer-settings.js';
import { words } from './en/layers.js';
import { say, sayer, t } from './text.js';

export const l = sayer('layers.', words);
export type LayersTextId = Parameters<typeof l>[0];

export const layerLabel = ({ id }: Pick<LayerSetting, 'id'>): string => say(settings, `setting.${id}`);

const longest = 40;

const shortened = (text: string): string => {
  const [line = ''] = text.trim().split(/\s*\n\s*/);
  return line.length > longest ? `${line.slice(0, longest)}…` : line;
};

/** Name of a layer: its letters, else its file, else its kind. */
export function layerName(layer: PlateLayer): string {
  const { kind, text } = layer;
  if ((kind === 'text' || kind === 'code') && text.trim() !== '') return shortened(text);
  const [file] = toldFrom(layer);
  if (file !== undefined) return file.name;
  const fill = fillOf(layer);
  return fill === undefined ? l(`kind.${kind}`) : t(`source.${fill}`);
}

/** Name of a layer among others. Later layers with the same name get a number. */
export function layerNameIn(layers: readonly PlateLayer[], layer: PlateLayer): string {
  const name = layerName(layer);
  const k = layers.filter((one) => layerName(one) === name).indexOf(layer);
  return k > 0 ? `${name} (${k + 1})` : name;
}

/** Name of a font, without the extension of its file. */
export const fontName = (font: PlateLayer['font']): string => {
  if (typeof font === 'string') return font;
  return isFontFile(font.name) ? font.name.replace(/\.\w+$/, '') : font.name;
};
