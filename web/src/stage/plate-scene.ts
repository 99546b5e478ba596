// The scene to be drawn of the plate, out of the state.
import { appearance } from '../model/appearance.js';
import { lookOf } from '../model/filaments.js';
import { groundPictures } from '../model/fills.js';
import { pictureLayers } from '../model/layers.js';
import { pageOf } from '../model/plate.js';
import type { Over, Shown } from '../studio/shown.js';
import type { Scene } from '../views/scene.js';

/** The plate stands beside a zigzag. */
export const compares = ({ compare, view }: Readonly<Shown>): boolean => compare && view === 'appearance';

/** No bead is told from its neighbours. */
export const blends = ({ sizing, view }: Readonly<Shown>): boolean => sizing === 'arm' && view === 'appearance';

/** Rulers measure what is made; a picture of the plate needs none. */
export const isRuled = ({ view, tool }: Readonly<Shown>): boolean => view !== 'appearance' || tool !== 'pan';

/** The comparison that lies over the left of the plate. */
export const overOf = ({ over, view }: Readonly<Shown>): Over | undefined => (view === 'appearance' ? over : undefined);

export function sceneOf(state: Readonly<Shown>, darkScheme: boolean): Scene {
  const { plate, result, directions, view, colourBy, played, light, marks, theme, wipe } = state;
  const lit = groundPictures(plate).length > 0;
  // The directions of beads that show a picture are known once the beads are there.
  const solved = view === 'directions' && pictureLayers(plate).length > 0;
  return {
    page: pageOf(plate),
    toolpath: result?.toolpath,
    directions,
    view: solved ? 'toolpath' : view,
    colourBy: solved ? 'direction' : colourBy,
    lampSlope: lit ? plate.pictures.lampSize : appearance.softbox,
    fromAfar: lit,
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
