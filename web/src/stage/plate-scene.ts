// Derives the scene of the plate from the state.
import { lookOf } from '../model/filaments.js';
import { pictureLayers } from '../model/layers.js';
import { pageOf, type Plate } from '../model/plate.js';
import { sameSolved } from '../model/result.js';
import type { Over, Shown } from '../studio/shown.js';
import { seenBy } from '../views/plate-look.js';
import type { Scene } from '../views/scene.js';

/** Tells whether the plate stands beside a zigzag. */
export const compares = ({ compare, view }: Readonly<Shown>): boolean => compare && view === 'appearance';

/** Tells whether beads blend into one surface. */
export const blends = ({ sizing, view }: Readonly<Shown>): boolean => sizing === 'arm' && view === 'appearance';

/** Tells whether rulers are shown: they measure the design, and the finished look needs none. */
export const isRuled = ({ view, tool }: Readonly<Shown>): boolean => view !== 'appearance' || tool !== 'pan';

/** Returns the comparison that covers the left of the plate. */
export const overOf = ({ over, view }: Readonly<Shown>): Over | undefined => (view === 'appearance' ? over : undefined);

/** Tells whether the present beads show the current plate, apart from print settings. Otherwise its directions are
 * drawn, or those of the last drag. */
function showsBeads({ plate, result, directions }: Readonly<Shown>): boolean {
  if (result === undefined) return false;
  const of = result.plate;
  if (sameSolved(of, plate)) return true;
  return pageOf(of).join() === pageOf(plate).join() && (directions === undefined || sameSolved(directions.plate, of));
}

/** Returns the plate whose beads or directions are shown. */
export const shownPlate = (state: Readonly<Shown>): Plate | undefined =>
  showsBeads(state) ? state.result?.plate : state.directions?.plate;

/** Builds the scene to draw. */
export function sceneOf(state: Readonly<Shown>, darkScheme: boolean): Scene {
  const { plate, result, directions, view, colourBy, played, light, marks, theme, wipe } = state;
  // The directions of beads that show a picture are known only once the beads are there.
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
