// Finds the layers that the engine's warnings name by number.
import type { Report } from 'sillon';
import { completeLayers } from './layers.js';
import type { PlateLayer } from './plate.js';
import type { State } from './state.js';

type Warning = Report['warnings'][number];

/** Warnings by layer, as the layers were when the plate was made, so that layers changed since then have none.
 * Previews have none either: at their larger spacing, letters look too thin that are not. */
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
