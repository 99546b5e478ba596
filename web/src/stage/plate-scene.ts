// The scene to be drawn of the plate, out of the state.
import { appearance } from '../model/appearance.js';
import { lookOf } from '../model/filaments.js';
import { drawnLayers } from '../model/layers.js';
import { pageOf } from '../model/plate.js';
import type { Over, Shown } from '../studio/shown.js';
import type { Scene } from '../views/scene.js';

/** The plate stands beside a zigzag. */
export const compares = ({ compare, view }: Readonly<Shown>): boolean => compare && view === 'appearance';

/** No bead is told from its neighbours. */
export const blends = ({ sizing, view }: Readonly<Shown>): boolean => sizing === 'arm' && view === 'appearance';

/** The comparison that lies over the left of the plate. */
export const overOf = ({ over, view }: Readonly<Shown>): Over | undefined => (view === 'appearance' ? over : undefined);

export function sceneOf(state: Readonly<Shown>, darkScheme: boolean): Scene {
  const { plate, result, directions, view, colourBy, played, light, marks, theme, tool, wipe } = state;
  const lit = plate.directions.kind === 'lamp' ? plate.directions : undefined;
  // Which way beads run that show a picture, or lie under layers, is known once they are there; a brush is for what the
  // layers lie over.
  const hidden = lit !== undefined || (drawnLayers(plate).length > 0 && tool === 'pan');
  const solved = hidden && view === 'directions';
  return {
    page: pageOf(plate),
    toolpath: result?.toolpath,
    directions,
    view: solved ? 'toolpath' : view,
    colourBy: solved ? 'direction' : colourBy,
    lampSlope: lit === undefined ? appearance.softbox : plate.pictures.lampSize,
    fromAfar: lit !== undefined,
    feed: { printer: plate.printer, layerHeight: plate.print.layerHeight },
    progress: view === 'toolpath' ? played : 1,
    compare: compares(state),
    wipe: overOf(state) === 'zigzag' ? wipe : undefined,
    blended: blends(state),
    light,
    filament: lookOf(plate),
    marks,
    dark: theme === 'auto' ? darkScheme : theme === 'dark',
  };
}
