// Thickness of a plate: its bottom layers, and the layers that show.
import type { Plate } from './plate.js';
import { settingOf, withValue } from './settings.js';

type Height = Pick<Plate, 'print'>;

const shownLayers = ({ print }: Height): number => print.layers * (print.showSide === 'both' ? 2 : 1);

const firstLayer = ({ print: { startHeight, firstLayerHeight, layerHeight } }: Height): number =>
  (startHeight === 0 && firstLayerHeight) || layerHeight;

/** [mm], without the rim. */
export function thicknessOf(plate: Height): number {
  const { base, layerHeight } = plate.print;
  return (shownLayers(plate) + base - 1) * layerHeight + firstLayer(plate);
}

/** The plate with as many bottom layers as come nearest to a thickness [mm]. */
export function withThickness(plate: Plate, thickness: number): Plate {
  const setting = settingOf('print.base');
  const all = 1 + Math.round((thickness - firstLayer(plate)) / plate.print.layerHeight);
  const most = 'max' in setting ? setting.max : all;
  return withValue(plate, setting, Math.min(most, Math.max(0, all - shownLayers(plate))));
}

/** Thicknesses that people ask for: a coaster to look at, one to use, a sign [mm]. */
export const usualThicknesses = [0.6, 2, 3] as const;
