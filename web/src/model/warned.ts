// Warnings of the engine that are about one layer, whatever they are about: they name its number.
import type { Report } from 'sillon';
import { completeLayers } from './layers.js';
import type { PlateLayer } from './plate.js';
import type { State } from './state.js';

type Warning = Report['warnings'][number];

/** By the layers as they were when the plate was made, so that nothing is said of one that has changed since. A preview says
 * nothing: at its spacing letters are thin that are not on the plate. */
export function warnedLayers({ result }: Pick<State, 'result'>): ReadonlyMap<PlateLayer, readonly Warning[]> {
  const warned = new Map<PlateLayer, Warning[]>();
  if (result === undefined || result.coarse) return warned;
  const layers = completeLayers(result.plate);
  for (const warning of result.report.warnings) {
    const layer = layers[Number(warning.values['layer']) - 1];
    if (layer !== undefined) warned.set(layer, [...(warned.get(layer) ?? []), warning]);
  }
  return warned;
}
