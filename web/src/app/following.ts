// Effects of changes of the state; the plate's results are in pipeline.ts.
import { groundFill, groundOf } from '../model/fills.js';
import { pictureOf, shownPictures } from '../model/lamp.js';
import { drawnLayers } from '../model/layers.js';
import type { OpenedFiles } from '../model/file-role.js';
import type { Plate } from '../model/plate.js';
import type { PlateResult, Theme } from '../model/state.js';
import type { Shown } from '../studio/shown.js';
import type { Studio } from '../studio/studio.js';
import type { Keeper } from './keeping.js';

/** Subscribes all effects of changes of the state. */
export function followState(studio: Studio, keeper: Keeper): void {
  const { store } = studio;
  store.subscribe((state, before) => {
    if (state.theme !== before.theme) applyTheme(studio, state.theme);
    if (shownPictures(state.plate) !== shownPictures(before.plate)) fitLamps(studio, state);
    const arrives = state.welcome && !before.welcome; // the first plate is nobody's work
    const changes = state.plate !== before.plate && !arrives;
    // A plate that waited for its path is kept once the path is there.
    if (changes || state.result !== before.result) keeper.keep(state, before.plate, changes);
    if (changes && state.welcome) studio.endWelcome();
    if (state.opened !== undefined && isGone(studio, state.opened, state.plate)) studio.setOpened(undefined);
    if (state.shimmer !== undefined && (state.result !== undefined || !state.welcome))
      store.set({ shimmer: undefined });
  });
  store.subscribe(({ result }, before) => {
    if (result === before.result || result?.measured !== true) return;
    if (!studio.framed) keeper.picture(result);
    scan(studio, result);
  });
}

export function applyTheme(studio: Studio, theme: Theme): void {
  if (theme === 'auto') delete document.documentElement.dataset['theme'];
  else document.documentElement.dataset['theme'] = theme;
  studio.remember('theme', theme);
}

/** Adapts the lamp and the comparison to the pictures of the plate, which may be others than before, or none. */
function fitLamps({ store }: Studio, { plate, lamp, aimed, flipping, over }: Readonly<Shown>): void {
  const lamps = shownPictures(plate).length;
  if (lamp >= Math.max(1, lamps)) store.set({ lamp: 0 });
  if (aimed !== undefined) store.set({ aimed: undefined });
  if (lamps < 2 && flipping) store.set({ flipping: false });
  const shown = { picture: pictureOf(plate, 0) !== undefined, zigzag: true, conflict: lamps > 1 };
  if (over !== undefined && !shown[over]) store.set({ over: undefined });
}

/** Tells whether a plate made of files was undone, or replaced by one of another kind. */
const isGone = ({ store }: Studio, { before, made }: OpenedFiles, plate: Plate): boolean =>
  store.steps.future.includes(made) ||
  (groundOf(made) !== groundOf(before) && groundFill(made) !== groundFill(plate)) ||
  (made.shape !== before.shape && made.shape.kind === 'file' && plate.shape.kind !== 'file');

/** Tests whether the code of a finished plate can be read. */
function scan({ store, services }: Studio, result: PlateResult): void {
  const { plate } = result;
  if (result.coarse || !drawnLayers(plate).some(({ kind }) => kind === 'code')) return;
  void Promise.all([import('../quality/scan.js'), services.engine()])
    .then(async ([{ scan }, running]) => {
      const azimuths = await scan(result, running, () => store.state.result === result);
      if (azimuths !== undefined) store.set({ scan: { plate, azimuths } });
    })
    .catch(() => undefined); // without a result, nothing is claimed
}
