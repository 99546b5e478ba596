// Thickness of a plate, made of its bottom layers and the layers that show.
import type { Plate } from './plate.js';
import { settingOf, withValue } from './settings.js';

type Height = Pick<Plate, 'print'>;

const shownLayers = ({ print }: Height): number => print.layers * (print.showSide === 'both' ? 2 : 1);

/** Height of the first layer [mm]: its own where it is set and the print begins on the bed, else that of all layers. */
const firstLayer = ({ print: { startHeight, firstLayerHeight, layerHeight } }: Height): number =>
  (startHeight === 0 && firstLayerHeight) || layerHeight;

/** Thickness of the plate without its rim [mm]. */
export function thicknessOf(plate: Height): number {
  const { base, layerHeight } = plate.print;
  return (shownLayers(plate) + base - 1) * layerHeight + firstLayer(plate);
}

/** Sets the number of bottom layers that comes nearest to a thickness [mm]. */
export function withThickness(plate: Plate, thickness: number): Plate {
  const setting = settingOf('print.base');
  const all = 1 + Math.round((thickness - firstLayer(plate)) / plate.print.layerHeight);
  const most = 'max' in setting ? setting.max : all;
  return withValue(plate, setting, Math.min(most, Math.max(0, all - shownLayers(plate))));
}

/** Thicknesses that people ask for [mm]: a coaster to look at, a coaster to use, a sign. */
export const usualThicknesses = [0.6, 2, 3] as const;
