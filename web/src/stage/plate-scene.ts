// The scene to be drawn of the plate, out of the state.
import { lookOf } from '../model/filaments.js';
import { pictureLayers } from '../model/layers.js';
import { pageOf, type Plate } from '../model/plate.js';
import { sameSolved } from '../model/result.js';
import type { Over, Shown } from '../studio/shown.js';
import { seenBy } from '../views/plate-look.js';
import type { Scene } from '../views/scene.js';

/** The plate stands beside a zigzag. */
export const compares = ({ compare, view }: Readonly<Shown>): boolean => compare && view === 'appearance';

/** No bead is told from its neighbours. */
export const blends = ({ sizing, view }: Readonly<Shown>): boolean => sizing === 'arm' && view === 'appearance';

/** Rulers measure what is made; a picture of the plate needs none. */
export const isRuled = ({ view, tool }: Readonly<Shown>): boolean => view !== 'appearance' || tool !== 'pan';

/** The comparison that lies over the left of the plate. */
export const overOf = ({ over, view }: Readonly<Shown>): Over | undefined => (view === 'appearance' ? over : undefined);

/** Tells whether the beads that there are show the plate as it is, but for how they are laid: else its directions do, or those of
 * a hand's last move. */
function showsBeads({ plate, result, directions }: Readonly<Shown>): boolean {
  if (result === undefined) return false;
  const of = result.plate;
  if (sameSolved(of, plate)) return true;
  return pageOf(of).join() === pageOf(plate).join() && (directions === undefined || sameSolved(directions.plate, of));
}

/** The plate whose beads or directions are shown. */
export const shownPlate = (state: Readonly<Shown>): Plate | undefined =>
  showsBeads(state) ? state.result?.plate : state.directions?.plate;

export function sceneOf(state: Readonly<Shown>, darkScheme: boolean): Scene {
  const { plate, result, directions, view, colourBy, played, light, marks, theme, wipe } = state;
  // The directions of beads that show a picture are known once the beads are there.
  const solved = view === 'directions' && pictureLayers(plate).length > 0;
  return {
    ...seenBy(plate),
    toolpath: showsBeads(state) ? result?.toolpath : undefined,
    directions,
    spacing: plate.toolpath.spacing,
    view: solved ? 'toolpath' : view,
    colourBy: solved ? 'direction' : colourBy,
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
